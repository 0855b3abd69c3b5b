/* A sampled lens map is followed in nodes, where it bends closely and where it bends little in few, and interpolated
 * between them: a ray is followed for one pixel in ten. Where polynomials through the nodes do not tell two more rays
 * to the plan's tolerance, and where orders or fates change, rays are followed one by one (comp/lens_cells.comp,
 * comp/lens_fill.comp; measured in docs/accuracy.md). Render thread only. */
#ifndef KD_RENDER_FRAME_SAMPLE_H
#define KD_RENDER_FRAME_SAMPLE_H

#include "render/frame/job.h"

/* The map of some rows of pixels of a band, at most sample_rows of them: nodes, rays that are followed alone, and
 * what lies between. Recorded, not submitted: the open rays among those that were followed alone are then to be
 * settled, and footprints of the marked ones made (footprint.comp). */
enum kd_status kd_frame_sample(struct kd_frame_job *job, uint32_t band, uint32_t first, uint32_t count);
/* What that came to, after the device has been waited for, is added to the job's counts. */
void kd_frame_count_sampled(struct kd_frame_job *job, uint32_t count);
/* All of its kernels but the one that traces. */
enum kd_status kd_frame_sample_kernels(struct kd_frame_job *job);

#endif
