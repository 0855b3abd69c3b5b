/* What the parts of a picture take of a device: bytes, bindings, workgroups. Each of these sets its part of a plan,
 * in this order. Any thread. */
#ifndef KD_RENDER_PLAN_ROOM_H
#define KD_RENDER_PLAN_ROOM_H

#include "render/plan/plan.h"

/* KD_ETOOBIG: the rows or the grids of a beam are larger than one binding. */
enum kd_status kd_plan_beam_fits(const struct kd_plan *plan, const struct kd_capacity *c, struct kd_error *error);
/* Pixels may have more rays than others; those of a ring are wide as it is. One buffer is for all, part by part. */
void kd_plan_adapt(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c);
/* Plans bands: rows of pixels whose lens map, radiance and packed pixels each fit one buffer and one binding, and
 * whose workgroups one dispatch. KD_ETOOBIG: one row does not, or all of them not the memory. */
enum kd_status kd_plan_bands(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                             struct kd_error *error);
/* Plans the pixels at the critical curve, where the image orders that are thinner than a pixel would show; the bands
 * are planned anew behind it. KD_ENOMEM. */
enum kd_status kd_plan_critical(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                                struct kd_error *error);

#endif
