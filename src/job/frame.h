/* Plans one frame of a job. Pure; any thread. */
#ifndef KD_JOB_FRAME_H
#define KD_JOB_FRAME_H

#include "job/spec.h"
#include "render/frame/blur.h"

/* Makes the scene of a frame, and its plan. dynamic: the bodies of the playground in this frame, in their state
 * `late` M before the frame's time; NULL: none. most_s: limit of the estimated time in seconds; INFINITY: none.
 * Errors name the frame and have a pointer into the request. KD_ETOOBIG: the limit is exceeded. */
enum kd_status kd_job_frame_plan(const struct kd_job_spec *spec, unsigned frame,
                                 const struct kd_dynamic_bodies *dynamic, double late, double most_s,
                                 const struct kd_capacity *capacity, struct kd_scene *scene, struct kd_plan *plan,
                                 struct kd_error *error);

/* The motion blur of a frame, in the renderer's form. samples 0: no blur. The result points into the spec, which
 * must outlive it. */
struct kd_blur kd_job_frame_blur(const struct kd_job_spec *spec, unsigned frame);

#endif
