/* Device resources for the parts of a picture: bytes, bindings, workgroups. Each function sets its part of a plan; the
 * functions are called in this order. Any thread. */
#ifndef KD_RENDER_PLAN_ROOM_H
#define KD_RENDER_PLAN_ROOM_H

#include "render/plan/plan.h"

/* Returns KD_ETOOBIG if the rows or the grids of a beam exceed one binding. */
enum kd_status kd_plan_beam_fits(const struct kd_plan_picture *picture, const struct kd_capacity *c,
                                 struct kd_error *error);
/* Plans extra rays for refined pixels. A ring round the critical curve gets none, because its image orders are
 * already wide. All parts of the list use the same buffer in turn. */
void kd_plan_adapt(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c);
/* Plans bands. A band has as many rows of pixels as possible. Its lens map, its radiance and its packed pixels must
 * each fit one buffer and one binding. Its workgroups must fit one dispatch. Returns KD_ETOOBIG if one row does not
 * fit, or if all rows together exceed the memory. */
enum kd_status kd_plan_bands(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                             struct kd_error *error);
/* Plans the pixels at the critical curve, if image orders thinner than a pixel would be visible. Then plans the bands
 * again. The only error is KD_ENOMEM. */
enum kd_status kd_plan_critical(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                                struct kd_error *error);

#endif
