/* This finds the one exposure of frames whose style.exposure is "auto", before the first of them is drawn: small pictures of some of them are rendered, and the middle one of their
 * exposures is that of all. A frame then says it as a number, so that its scene gives the same picture again.
 *
 *     n = kd_job_exposure_frames(spec, frames);
 *     for (i < n) kd_job_exposure_measure(spec, frames[i], renderer, ..., &stops[i], error);
 *     spec->exposure = kd_job_exposure_of(stops, n); */
#ifndef KD_JOB_EXPOSURE_H
#define KD_JOB_EXPOSURE_H

#include "job/spec.h"
#include "render/frame/frame.h"

enum { KD_JOB_EXPOSURE_FRAMES = 9, KD_JOB_EXPOSURE_WIDTH = 160 };

/* Finds which frames are measured: of nine that are evenly spaced over all, the first and the last among them, those whose exposure is "auto"; where none of these is, the
 * first frame that is. 0: the exposure is known, each frame has its own, or none is "auto". Pure. */
unsigned kd_job_exposure_frames(const struct kd_job_spec *spec, unsigned out[KD_JOB_EXPOSURE_FRAMES]);

/* The exposure of a frame, in stops, of a picture that is KD_JOB_EXPOSURE_WIDTH pixels wide at most, with a ray a pixel. The thread that has the renderer. */
enum kd_status kd_job_exposure_measure(const struct kd_job_spec *spec, unsigned frame, struct kd_renderer *renderer, kd_progress_fn progress, void *user, double *stops,
                                       struct kd_error *error);

/* The median of n of them, 1 or more, which it puts in order; to a hundredth of a stop, so that scenes stay short. */
double kd_job_exposure_of(double *stops, unsigned n);

#endif
