/* One exposure for all frames of a job whose style.exposure is "auto". Before the first frame, small pictures of some
 * frames are rendered; the median of their exposures becomes that of all. Each frame's scene then has it as a number,
 * so that it renders the same picture again.
 *
 *     n = kd_job_exposure_frames(spec, frames);
 *     for (i < n) kd_job_exposure_plan(spec, frames[i], ...), and render it: stops[i] is the exposure of the picture
 *     spec->exposure = kd_job_exposure_of(stops, n);
 *
 * Pure; any thread. */
#ifndef KD_JOB_EXPOSURE_H
#define KD_JOB_EXPOSURE_H

#include "job/spec.h"

enum { KD_JOB_EXPOSURE_FRAMES = 9, KD_JOB_EXPOSURE_WIDTH = 160 };

/* Finds which frames are measured: of nine that are evenly spaced over all, the first and the last among them, those
 * whose exposure is "auto"; where none of these is, the first frame that is. 0: the exposure is known, each frame
 * has its own, or none is "auto". Maps of numbers have none. */
unsigned kd_job_exposure_frames(const struct kd_job_spec *spec, unsigned out[KD_JOB_EXPOSURE_FRAMES]);

/* Makes the scene of a frame in few pixels, KD_JOB_EXPOSURE_WIDTH of them a row at most and a ray each, and its
 * plan. */
enum kd_status kd_job_exposure_plan(const struct kd_job_spec *spec, unsigned frame, const struct kd_capacity *capacity,
                                    struct kd_scene *scene, struct kd_plan *plan, struct kd_error *error);

/* The median of n of them, 1 or more, which it puts in order; to a hundredth of a stop, so that scenes stay short. */
double kd_job_exposure_of(double *stops, unsigned n);

#endif
