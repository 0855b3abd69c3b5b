/* The size of a sampled lens map (render/frame/sample.h): its blocks of cells, and bytes. Pure, any thread. */
#ifndef KD_RENDER_PLAN_SAMPLE_H
#define KD_RENDER_PLAN_SAMPLE_H

#include "render/plan/plan.h"

/* The blocks that some rows of rays lie in. They begin where those of the whole picture do. */
struct kd_sample_grid {
    int32_t origin_x, origin_y; /* of the first block, in rays from the picture's, or the tile's, first one */
    uint32_t blocks_x, blocks_y;
    uint32_t room;                                /* for nodes, */
    uint32_t places, alone;                       /* where their places begin in the lists, and those of rays alone */
    uint64_t list_bytes, index_bytes, node_bytes; /* of the three buffers */
};

/* left, top: of the picture at hand in the whole one, in rays; row0, rows: those that are wanted. */
struct kd_sample_grid kd_sample_grid(const struct kd_plan *plan, uint32_t left, uint32_t top, uint32_t row0,
                                     uint32_t rows);

/* Sets plan->sample_rows, such that no buffer takes more than the given bytes, which the device binds. A picture so
 * wide that some device could not bind one row of pixels has every ray followed, on every device, so that its bytes are
 * the same. plan: its band_rows are known. */
void kd_sample_fit(struct kd_plan *plan, uint64_t bytes);
/* The bytes of all three buffers for sample_rows; 0 of a plan all of whose rays are followed. */
uint64_t kd_sample_bytes(const struct kd_plan *plan);

/* The relative error of what is interpolated that a scene's accuracy allows (docs/decisions/0017);
 * 0: every ray is followed. plan: its path and setting are known. */
double kd_sample_tolerance(const struct kd_plan *plan, const struct kd_scene *scene);

/* Makes every ray of a plan be followed after all: by another map, and what its passes take is not learned from. */
void kd_plan_follow_all(struct kd_plan *plan);

#endif
