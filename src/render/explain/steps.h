/* Steps of the device along a ray (rays/steps.h) as a table: names, columns and numbers. Pure, any thread. */
#ifndef KD_RENDER_EXPLAIN_STEPS_H
#define KD_RENDER_EXPLAIN_STEPS_H

#include "base/json.h"
#include "render/rays/steps.h"

#include <stddef.h>

struct kd_steps_column {
    const char *name;
    size_t at;
};
/* The columns for the engine of these steps. The list ends with a column without a name. */
const struct kd_steps_column *kd_steps_columns(const struct kd_rays_steps *steps);
double kd_steps_value(const struct kd_rays_step *step, const struct kd_steps_column *column);
const char *kd_steps_stage(const struct kd_rays_step *step); /* "start", "step", "crossing", "end" */

/* Writes the member `trace`: the engine, its settings, the names in `columns`, and a row for each step. */
void kd_steps_json(struct kd_json *json, const struct kd_rays_steps *steps);

#endif
