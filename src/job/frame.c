#include "job/frame.h"

#include <stdio.h>

enum kd_status kd_job_frame_plan(const struct kd_job_spec *spec, unsigned frame,
                                 const struct kd_dynamic_bodies *dynamic, double late, double most_s,
                                 const struct kd_capacity *capacity, struct kd_scene *scene, struct kd_plan *plan,
                                 struct kd_error *error)
{
    struct kd_error inner = { 0 };
    char pointer[40];
    enum kd_status status = kd_job_spec_scene(spec, frame, scene, error);
    if (status)
        return status;
    if (dynamic) {
        kd_scene_show(scene, dynamic);
        kd_scene_pass(scene, dynamic->time + late);
        status = kd_scene_validate(scene, &inner);
    }
    if (!status)
        status = kd_format_plan(spec->series->frame, scene, capacity, plan, &inner);
    if (!status && spec->blur.samples)
        status = kd_blur_plan(spec->blur.samples, spec->blur.shutter, capacity, plan, &inner);
    if (!status && plan->cost.estimate_ms > 1e3 * most_s)
        status = kd_error_set(&inner, KD_ETOOBIG, "it would take about %.0f s; a frame must take at most %.0f s",
                              plan->cost.estimate_ms * 1e-3, most_s);
    if (!status)
        return KD_OK;
    const bool among_keyframes = !spec->listed && spec->timeline.n_keys > 1;
    if (spec->listed)
        snprintf(pointer, sizeof pointer, "/scenes/%u", frame);
    else
        snprintf(pointer, sizeof pointer, spec->sweep ? "/axes" : among_keyframes ? "/keyframes" : "/scene");
    /* cleared, because the pointer would not lead to a member of the request */
    if (spec->sweep || among_keyframes)
        *inner.pointer = '\0';
    kd_error_inside(&inner, pointer);
    kd_error_field(error, inner.pointer, "frame %u: %.440s", frame, inner.message);
    return error->status = status;
}

static enum kd_status sample_of(const struct kd_blur *blur, unsigned sample, struct kd_scene *out,
                                struct kd_error *error)
{
    return kd_job_spec_sample(blur->user, blur->frame, sample, out, error);
}

struct kd_blur kd_job_frame_blur(const struct kd_job_spec *spec, unsigned frame)
{
    return (struct kd_blur) { .samples = spec->blur.samples, .user = spec, .frame = frame, .scene = sample_of };
}
