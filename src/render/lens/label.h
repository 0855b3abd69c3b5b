/* Labels (alpha, beta and direction) of the ray at a place of the lens map, as closed forms and lists of rays take
 * them. Pure, any thread. */
#ifndef KD_RENDER_LENS_LABEL_H
#define KD_RENDER_LENS_LABEL_H

#include "render/plan/plan.h"
#include "render/view/camera.h"

/* Makes the labels of the ray at (x, y), in rays from the upper left one, in double: single precision, in which the
 * kernels make them, moves a ray by some 1e-7 of the picture, and at a turning point, or next to the critical curve,
 * into another one. */
void kd_lens_label(const struct kd_scene *scene, const struct kd_plan *plan, uint32_t x, uint32_t y,
                   struct kd_camera_label *out);

#endif
