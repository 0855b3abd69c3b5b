/* Labels (alpha, beta and direction) of the ray at a place of the lens map, for closed forms and lists of rays.
 * Pure, any thread. */
#ifndef KD_RENDER_LENS_LABEL_H
#define KD_RENDER_LENS_LABEL_H

#include "render/plan/plan.h"
#include "render/view/camera.h"

/* Computes, in double precision, the labels of the ray at (x, y); x and y count rays from the upper left one. The
 * kernels compute labels in single precision, which moves a ray by about 1e-7 of the picture. Near a turning point or
 * the critical curve so small a shift changes the ray's end. */
void kd_lens_label(const struct kd_scene *scene, const struct kd_plan_lens *lens, uint32_t x, uint32_t y,
                   struct kd_camera_label *out);

#endif
