/* The common exposure of a job: of all its frames whose style.exposure is "auto". Before the first frame is
 * rendered, small pictures of some frames are rendered. The median of their exposures becomes the exposure of all
 * these frames. Each frame's scene then contains this exposure as a number, so that rendering the scene again gives
 * the same picture.
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

/* Chooses the frames to measure. Nine frames at equal intervals are considered, including the first and the last. Of
 * these, the frames whose exposure is "auto" are chosen. If none of the nine has "auto", the first frame of the job
 * that has it is chosen. Returns 0 in three cases: the exposure is known, each frame has its own exposure, or no
 * frame has "auto". Maps of numbers have no exposure. */
unsigned kd_job_exposure_frames(const struct kd_job_spec *spec, unsigned out[KD_JOB_EXPOSURE_FRAMES]);

/* Makes a small version of the scene of a frame, and its plan: at most KD_JOB_EXPOSURE_WIDTH pixels wide, with one
 * ray per pixel. */
enum kd_status kd_job_exposure_plan(const struct kd_job_spec *spec, unsigned frame, const struct kd_capacity *capacity,
                                    struct kd_scene *scene, struct kd_plan *plan, struct kd_error *error);

/* Median of n exposures (n >= 1), rounded to a hundredth of a stop so that scenes stay short. Sorts the array
 * `stops`. */
double kd_job_exposure_of(double *stops, unsigned n);

#endif
