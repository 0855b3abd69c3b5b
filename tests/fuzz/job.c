/* Fuzz target: the specification of a job. The scenes of its first, middle and last frame must be valid, or the error
 * must name the keyframes between which a scene is invalid. */
#include "fuzz.h"

#include "job/exposure.h"
#include "job/spec.h"

static void look(const struct kd_job_spec *spec, unsigned frame)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    enum kd_status status = kd_job_spec_scene(spec, frame, &scene, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        kd_fuzz_fields(&scene);
        status = kd_scene_validate(&scene, &error);
        CHECK(!status, "frame %u is not a valid scene: %s: %s", frame, error.pointer, error.message);
    }
    if (spec->blur.samples && (status = kd_job_spec_sample(spec, frame, spec->blur.samples - 1, &scene, &error)))
        kd_fuzz_refused(status, &error);
}

int kd_fuzz_job(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text text = kd_fuzz_bare(data, size);
    struct kd_job_spec spec;
    struct kd_error error = { 0 };
    unsigned measured[KD_JOB_EXPOSURE_FRAMES];
    const enum kd_status status =
        kd_job_spec_parse(text.at, text.size, &(struct kd_job_base) { 0 }, NULL, &spec, &error);
    free(text.at);
    if (status) {
        kd_fuzz_refused(status, &error);
        return 0;
    }
    CHECK(spec.frames >= 1 && spec.frames <= KD_SWEEP_MOST, "a job has %u frames", spec.frames);
    look(&spec, 0);
    look(&spec, spec.frames / 2);
    look(&spec, spec.frames - 1);
    const unsigned n = kd_job_exposure_frames(&spec, measured);
    CHECK(n <= KD_JOB_EXPOSURE_FRAMES, "the exposure of %u frames is measured", n);
    for (unsigned i = 0; i < n; i++)
        CHECK(measured[i] < spec.frames && (!i || measured[i] > measured[i - 1]),
              "the exposure of frame %u of %u is measured", measured[i], spec.frames);
    kd_job_spec_finish(&spec);
    return 0;
}
