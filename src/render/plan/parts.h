/* A picture is made in one, or of parts, each by a plan of its own: an eye's of a pair, a tile with its margin,
 * strips of what does not fit (parts.c). This is what plan.c and parts.c share; others call kd_plan_make. Any
 * thread. */
#ifndef KD_RENDER_PLAN_PARTS_H
#define KD_RENDER_PLAN_PARTS_H

#include "render/plan/plan.h"

/* The plan of a picture, or of a tile as it stands, that is made in one. Errors are those of kd_plan_make. */
enum kd_status kd_plan_one(const struct kd_scene *scene, const struct kd_needs *needs,
                           const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Checks the same without the list of pixels at the critical curve, as kd_plan_check does. */
enum kd_status kd_plan_one_fits(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_error *error);

/* Writes the sentences in force for a scene into its plan. */
void kd_plan_say(struct kd_plan *plan, const struct kd_scene *scene);

#endif
