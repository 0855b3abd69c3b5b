/* Common exposure of all frames of a job whose style.exposure is "auto". Before the first frame, small pictures of some
 * frames are rendered. The median of their exposures becomes the exposure of all frames. Each frame's scene then
 * contains it as a number, so that the scene renders the same picture again.
 *
 *     n = kd_job_exposure_frames(spec, frames);
 *     for (i < n) kd_job_exposure_plan(spec, frames[i], ...), and render it: stops[i] is the exposure of the
 *     picture
 *     spec->exposure = kd_job_exposure_of(stops, n);
 *
 * Pure; any thread. */
#ifndef KD_JOB_EXPOSURE_H
#define KD_JOB_EXPOSURE_H

#include "job/spec.h"

enum { KD_JOB_EXPOSURE_FRAMES = 9, KD_JOB_EXPOSURE_WIDTH = 160 };

/* Chooses the frames to measure. Nine frames at equal intervals are considered, including the first and the last.
 * Those whose exposure is "auto" are chosen. If none of the nine has "auto", the first frame of the job that has it
 * is chosen. Returns 0 if the exposure is known, if each frame has its own, or if no frame is "auto". Maps of
 * numbers have no exposure. */
unsigned kd_job_exposure_frames(const struct kd_job_spec *spec, unsigned out[KD_JOB_EXPOSURE_FRAMES]);

/* Makes the scene of a frame, at most KD_JOB_EXPOSURE_WIDTH pixels wide and with one ray for each pixel, and its
 * plan. */
enum kd_status kd_job_exposure_plan(const struct kd_job_spec *spec, unsigned frame, const struct kd_capacity *capacity,
                                    struct kd_scene *scene, struct kd_plan *plan, struct kd_error *error);

/* Median of n exposures, n >= 1. It is rounded to a hundredth of a stop, so that scenes stay short. Sorts stops. */
double kd_job_exposure_of(double *stops, unsigned n);

#endif
