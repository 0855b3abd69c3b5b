/* The key of a lens map: a hash of everything that it depends on. Frames of a sweep are grouped by
 * kd_plan_lens_group of plan.h instead. Any thread. */
#ifndef KD_RENDER_PLAN_LENS_KEY_H
#define KD_RENDER_PLAN_LENS_KEY_H

#include "render/plan/plan.h"

/* Sets plan->lens.key; the rest of the plan must be set. The only error is KD_ENOMEM. */
enum kd_status kd_plan_lens_key(struct kd_plan *plan, const struct kd_scene *scene);

#endif
