/* Motion blur: averages the light of several pictures, at times while a shutter is open, before exposure, glare and
 * tone curve. The average is of linear light, for each pixel, on the host, in double precision. The thread that has
 * the renderer. */
#ifndef KD_RENDER_FRAME_BLUR_H
#define KD_RENDER_FRAME_BLUR_H

#include "render/frame/frame.h"

enum { KD_BLUR_SAMPLES = 64 }; /* pictures that one may be the mean of, at most */

/* Which pictures. Sample 0 is the one that is rendered by its own scene and plan; the others' scenes are asked for. */
struct kd_blur {
    unsigned samples; /* 0 or 1: there is no blur */
    const void *user;
    unsigned frame;
    enum kd_status (*scene)(const struct kd_blur *blur, unsigned sample, struct kd_scene *out, struct kd_error *error);
};

/* Makes a picture's plan one of its mean with others: bytes, time, and what its file says of it. KD_EINVAL at a
 * field of a scene that cannot be blurred, a pair of eyes or a map of numbers; KD_ETOOBIG: the host has no memory
 * for the light. */
enum kd_status kd_blur_plan(unsigned samples, double shutter, const struct kd_capacity *capacity, struct kd_plan *plan,
                            struct kd_error *error);

/* How kd_render and kd_render_aside (aside; glance: of sample 0, which comes last, without the others) are called. */
struct kd_blurred {
    struct kd_renderer *renderer;
    const struct kd_blur *blur;
    const struct kd_scene *scene; /* of sample 0, with its plan from kd_blur_plan */
    const struct kd_plan *plan;
    bool aside;
    kd_progress_fn progress;
    const struct kd_glance *glance;
    void *user;
};
/* Errors as kd_render, and those of the scenes. */
enum kd_status kd_render_blurred(const struct kd_blurred *blurred, struct kd_frame *out, struct kd_error *error);

#endif
