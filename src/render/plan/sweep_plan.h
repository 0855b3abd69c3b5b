/* This says what all scenes of a sweep would take together, those that share a lens map counted with one. Pure, any thread. */
#ifndef KD_RENDER_PLAN_SWEEP_PLAN_H
#define KD_RENDER_PLAN_SWEEP_PLAN_H

#include "render/plan/plan.h"
#include "scene/sweep.h"

/* The document of `kerrd plan --axis`. Errors are those of the first scene that is none, or that the device has no room for, by its number. */
enum kd_status kd_sweep_plan_json(const struct kd_sweep *sweep, const struct kd_capacity *capacity, struct kd_buffer *out, struct kd_error *error);

#endif
