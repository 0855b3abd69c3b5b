/* The key of a lens map: a hash of everything that it depends on. The group of a scene, by which the scenes of a sweep
 * are ordered, is kd_plan_lens_group of plan.h. Any thread. */
#ifndef KD_RENDER_PLAN_LENS_KEY_H
#define KD_RENDER_PLAN_LENS_KEY_H

#include "render/plan/plan.h"

/* Sets plan->lens_key, all else of the plan being there. KD_ENOMEM. */
enum kd_status kd_plan_lens_key(struct kd_plan *plan, const struct kd_scene *scene);

#endif
