#include "job/exposure.h"

#include "render/output/format.h"
#include "render/plan/layer_kinds.h"

#include <math.h>
#include <stdlib.h>

/* True if the exposure of a scene is automatic. Maps of numbers in false colour have no exposure. */
static bool takes_one(const struct kd_scene *scene)
{
    const struct kd_words *layers = &scene->image.layers;
    bool picture = !layers->count;
    for (int i = 0; i < layers->count; i++)
        picture = picture || layers->at[i].word == KD_LAYER_rgb;
    return picture && isinf(scene->style.exposure);
}

static bool is_auto(const struct kd_job_spec *spec, unsigned frame)
{
    struct kd_scene scene;
    return !kd_job_spec_scene(spec, frame, &scene, NULL) && takes_one(&scene);
}

/* Words are not interpolated between keyframes, so a frame can have "auto" only if a keyframe has it. */
static bool any_auto(const struct kd_job_spec *spec)
{
    for (size_t i = 0; i < spec->timeline.n_keys; i++)
        if (takes_one(&spec->timeline.keys[i].scene))
            return true;
    return false;
}

unsigned kd_job_exposure_frames(const struct kd_job_spec *spec, unsigned out[KD_JOB_EXPOSURE_FRAMES])
{
    const unsigned n = spec->frames < KD_JOB_EXPOSURE_FRAMES ? spec->frames : KD_JOB_EXPOSURE_FRAMES;
    unsigned found = 0;
    if (!spec->one_exposure || !isnan(spec->exposure) || !any_auto(spec))
        return 0;
    for (unsigned i = 0; i < n; i++) {
        const unsigned frame = n > 1 ? (unsigned)((uint64_t)i * (spec->frames - 1) / (n - 1)) : 0;
        if (is_auto(spec, frame))
            out[found++] = frame;
    }
    for (unsigned frame = 0; !found && frame < spec->frames; frame++)
        if (is_auto(spec, frame))
            out[found++] = frame;
    return found;
}

static void make_small(struct kd_scene *scene)
{
    const int32_t width = scene->image.width, height = scene->image.height;
    if (width > KD_JOB_EXPOSURE_WIDTH) {
        scene->image.width = KD_JOB_EXPOSURE_WIDTH;
        scene->image.height = (int32_t)fmax(1, round((double)height * KD_JOB_EXPOSURE_WIDTH / width));
    }
    scene->image.samples = 1;
    scene->image.bit_depth = 8;
}

enum kd_status kd_job_exposure_plan(const struct kd_job_spec *spec, unsigned frame, const struct kd_capacity *capacity,
                                    struct kd_scene *scene, struct kd_plan *plan, struct kd_error *error)
{
    enum kd_status status = kd_job_spec_scene(spec, frame, scene, error);
    if (status)
        return status;
    make_small(scene);
    return kd_format_plan(&kd_format_png, scene, capacity, plan, error);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double kd_job_exposure_of(double *stops, unsigned n)
{
    qsort(stops, n, sizeof *stops, by_size);
    const double middle = 0.5 * (stops[(n - 1) / 2] + stops[n / 2]);
    return fmin(fmax(round(100 * middle) / 100, -40), 40);
}
