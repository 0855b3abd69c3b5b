/* Cost classes. Pictures of one class may differ in size, time, azimuth, view direction and exposure. They may also
 * differ by less than a factor of two in distance and field of view. All else is equal. The passes of such pictures
 * therefore take about the same time per item. The measured cost of a class is a better estimate than a figure of
 * pass.h: a figure is a mean over all scenes, and scenes with volumes and gas differ from the mean by factors of up to
 * six. Any thread. */
#ifndef KD_RENDER_PLAN_COST_CLASS_H
#define KD_RENDER_PLAN_COST_CLASS_H

#include "render/plan/plan.h"

/* The class of a picture, never 0. */
uint64_t kd_cost_class(const struct kd_plan *plan, const struct kd_scene *scene);

/* Measured time of an item of a pass, ns; 0: not measured. */
double kd_cost_known(const struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass);
/* The running mean after one more measurement, which has the weight 0.3. */
static inline double kd_cost_mean(double so_far, double ns) { return so_far > 0 ? so_far + 0.3 * (ns - so_far) : ns; }
/* Adds a measurement. If the table is full, the class whose last measurement is oldest is evicted. */
void kd_cost_learn(struct kd_capacity *capacity, uint64_t class, enum kd_pass_id pass, double ns);

#endif
