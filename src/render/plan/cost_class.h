/* Cost classes: pictures of one class differ in size, time, azimuth, direction of view and exposure alone, and in
 * distance and field of view by less than a factor of two, so that their passes take about the same time for an item.
 * The measured cost of a class is a better estimate than a figure of pass.h, a mean over all scenes, from which
 * volumes and gas differ by factors of up to six. Any thread. */
#ifndef KD_RENDER_PLAN_COST_CLASS_H
#define KD_RENDER_PLAN_COST_CLASS_H

#include "render/plan/plan.h"

/* Returns the class of a picture, never 0. */
uint64_t kd_cost_class(const struct kd_plan *plan, const struct kd_scene *scene);

/* Returns what an item of a pass was measured to take, in ns; 0: that was not measured. */
double kd_cost_known(const struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass);
/* Returns the mean of what was measured so far and of one measurement more, which counts for 0.3 of it. */
static inline double kd_cost_mean(double so_far, double ns) { return so_far > 0 ? so_far + 0.3 * (ns - so_far) : ns; }
/* Learns what an item took. The class that was learned from longest ago makes room for a new one. */
void kd_cost_learn(struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass, double ns);

#endif
