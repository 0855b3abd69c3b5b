/* Motion blur: averages the light of several pictures, at several times while a shutter is open. The host averages the
 * linear light of each pixel in double precision, before exposure, bloom and tone curve. Only the thread that owns the
 * renderer. */
#ifndef KD_RENDER_FRAME_BLUR_H
#define KD_RENDER_FRAME_BLUR_H

#include "render/frame/frame.h"

enum { KD_BLUR_SAMPLES = 64 }; /* largest number of pictures in one mean */

/* The pictures of a mean. Sample 0 has its own scene and plan; the scenes of the others come from the callback. */
struct kd_blur {
    unsigned samples; /* number of pictures in the mean; 0 or 1: no blur */
    const void *user;
    unsigned frame;
    enum kd_status (*scene)(const struct kd_blur *blur, unsigned sample, struct kd_scene *out, struct kd_error *error);
};

/* Adapts a picture's plan to motion blur: bytes, time, and the description in its file. Returns KD_EINVAL at a field if
 * the scene cannot be blurred (a pair of eyes, a tile, a map of numbers). Returns KD_ETOOBIG if the picture fits on the
 * device only in strips, or if the host lacks memory for the light. */
enum kd_status kd_blur_plan(unsigned samples, double shutter, const struct kd_capacity *capacity, struct kd_plan *plan,
                            struct kd_error *error);

/* Parameters for kd_render, or for kd_render_in_background if `background`. preview: shows sample 0 without the
 * other samples; sample 0 is rendered last. */
struct kd_blurred {
    struct kd_renderer *renderer;
    const struct kd_blur *blur;
    const struct kd_scene *scene; /* the scene of sample 0; its plan is from kd_blur_plan */
    const struct kd_plan *plan;
    bool background;
    kd_progress_fn progress;
    const struct kd_preview_hook *preview;
    void *user;
};
/* Returns the errors of kd_render and of the callback. */
enum kd_status kd_render_blurred(const struct kd_blurred *blurred, struct kd_frame *out, struct kd_error *error);

#endif
