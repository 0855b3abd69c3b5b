/* A sampled lens map. Rays are traced at nodes, and the map is interpolated between the nodes. Nodes are dense where
 * the map bends strongly, and sparse elsewhere. About one pixel in ten has a traced ray. In two kinds of places each
 * ray is traced: where polynomials through the nodes do not predict two further rays within the plan's tolerance, and
 * where orders or fates change (comp/lens_cells.comp, comp/lens_fill.comp). docs/accuracy.md has measurements. Render
 * thread only. */
#ifndef KD_RENDER_FRAME_SAMPLE_H
#define KD_RENDER_FRAME_SAMPLE_H

#include "render/frame/job.h"

/* Makes the map of at most sample_rows rows of pixels of a band: nodes, single rays, and the interpolation. Some
 * commands are submitted; the last ones are only recorded. The caller then settles undecided rays among the single
 * rays, and computes the footprints that are marked as missing (footprint.comp). */
enum kd_status kd_frame_sample(struct kd_frame_job *job, uint32_t band, uint32_t first, uint32_t count);
/* Adds the counts of the sampled map to the job's counts. Call this after waiting for the device. */
void kd_frame_count_sampled(struct kd_frame_job *job, uint32_t count);
/* Gets all kernels of the sampled map except the one that traces. */
enum kd_status kd_frame_sample_kernels(struct kd_frame_job *job);

#endif
