/* Size of a sampled lens map (render/frame/sample.h): its blocks of cells, and bytes. Pure, any thread. */
#ifndef KD_RENDER_PLAN_SAMPLE_H
#define KD_RENDER_PLAN_SAMPLE_H

#include "render/plan/plan.h"

/* The blocks that cover some rows of rays. Blocks are aligned to the whole picture. */
struct kd_sample_grid {
    int32_t origin_x, origin_y; /* place of the first block, in rays from the first ray of the picture or tile */
    uint32_t blocks_x, blocks_y;
    uint32_t room; /* number of nodes for which there is room */
    /* offsets in the buffer of lists. places: offset of the nodes' places; alone: offset of the places of rays that
     * are traced singly */
    uint32_t places, alone;
    uint64_t list_bytes, index_bytes, node_bytes; /* sizes of the three buffers */
};

/* left, top: offset of this picture in the whole picture, in rays; row0, rows: the requested rows. */
struct kd_sample_grid kd_sample_grid(const struct kd_plan *plan, uint32_t left, uint32_t top, uint32_t row0,
                                     uint32_t rows);

/* Sets plan->lens.sample_rows such that no buffer exceeds `bytes`, the limit of a binding. A picture may be so wide
 * that some device could not bind one row of its pixels. Then every ray is traced, on all devices, so that the
 * picture's bytes are the same on every device. plan->picture.band_rows must be set. */
void kd_sample_fit(struct kd_plan *plan, uint64_t bytes);
/* Bytes of all three buffers for sample_rows; 0 if every ray is traced. */
uint64_t kd_sample_bytes(const struct kd_plan *plan);

/* Tolerated relative error of interpolation for a scene's accuracy (docs/decisions/0017); 0: every ray is traced.
 * The plan's path and setting must be set. */
double kd_sample_tolerance(const struct kd_plan *plan, const struct kd_scene *scene);

/* Makes a plan trace every ray after all. The plan then has another lens map, and the times of its passes do not update
 * any performance figure. */
void kd_plan_follow_all(struct kd_plan *plan);

#endif
