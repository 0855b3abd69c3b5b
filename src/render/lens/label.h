/* Labels (alpha, beta and direction) of the ray at a place of the lens map, for closed forms and lists of rays.
 * Pure, any thread. */
#ifndef KD_RENDER_LENS_LABEL_H
#define KD_RENDER_LENS_LABEL_H

#include "render/plan/plan.h"
#include "render/view/camera.h"

/* Labels of the ray at (x, y), in rays from the upper left one, in double. The kernels compute them in single
 * precision, which moves a ray by about 1e-7 of the picture; at a turning point or next to the critical curve that
 * is a different ray. */
void kd_lens_label(const struct kd_scene *scene, const struct kd_plan *plan, uint32_t x, uint32_t y,
                   struct kd_camera_label *out);

#endif
