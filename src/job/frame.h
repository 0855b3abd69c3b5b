/* Plans one frame of a job. Pure; any thread. */
#ifndef KD_JOB_FRAME_H
#define KD_JOB_FRAME_H

#include "job/spec.h"
#include "render/frame/blur.h"

/* Makes the scene of a frame, and its plan. crowd: what a frame of a playground shows, as it was `late` M before;
 * NULL: it shows none. most_s: what it may take, by its plan; INFINITY: whatever. Errors name the frame, with the
 * pointer into the request; KD_ETOOBIG: it would take longer. */
enum kd_status kd_job_frame_plan(const struct kd_job_spec *spec, unsigned frame, const struct kd_crowd *crowd,
                                 double late, double most_s, const struct kd_capacity *capacity, struct kd_scene *scene,
                                 struct kd_plan *plan, struct kd_error *error);

/* The motion blur of a frame, to render it by; samples 0: it has none. It refers to the spec. */
struct kd_blur kd_job_frame_blur(const struct kd_job_spec *spec, unsigned frame);

#endif
