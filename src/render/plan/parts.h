/* Plans of pictures that may be made of parts, each with a plan of its own: the two eyes of a pair, a tile with its
 * margin, or strips of a picture that does not fit (parts.c). Shared by plan.c and parts.c; others call
 * kd_plan_make. Any thread. */
#ifndef KD_RENDER_PLAN_PARTS_H
#define KD_RENDER_PLAN_PARTS_H

#include "render/plan/plan.h"

/* The plan of a picture or tile that is made in one piece. Errors are those of kd_plan_make. */
enum kd_status kd_plan_one(const struct kd_scene *scene, const struct kd_needs *needs,
                           const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Checks whether kd_plan_one would succeed, without listing the pixels at the critical curve, as kd_plan_check does. */
enum kd_status kd_plan_one_fits(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_error *error);

/* Writes the approximations in force for a scene into its plan. */
void kd_plan_say(struct kd_plan *plan, const struct kd_scene *scene);

#endif
