/* The glare of a lens (style.bloom): which part of the light it spreads how far. Any thread.
 *
 * A grid of KD_BLOOM_ROWS rows of square cells covers the picture, and grids of half as many cells each way follow it. Each grid holds the light as
 * a quadratic B-spline, is smoothed once, and is seen through such a spline: what is spread from a point falls off as a sum of near
 * Gaussians, the n-th of standard deviation d 2^n, d the side of the finest grid's cells. Each has as
 * much light, so that brightness falls off as the square of the angle, as the glare of eyes and lenses about does (G. Spencer et al. 1995). So it spreads over the same part of a picture of any size; grids with
 * cells smaller than pixels are left out. Where a picture is wider than four times its height, d is a part of a quarter of its width. */
#ifndef KD_RENDER_PLAN_BLOOM_H
#define KD_RENDER_PLAN_BLOOM_H

#include "interface.h"

#include <stdint.h>

struct kd_bloom {
    uint32_t columns, rows;          /* of the finest grid, multiples of 2^(levels - 1) */
    uint32_t levels;                 /* grids; 0: nothing is spread */
    double strength;                 /* of light over white, the share that is spread */
    double share;                    /* of that, by each grid: as much in each octave of the angle */
    /* In one buffer, multiples of 256: where each grid begins, where its sum with the coarser ones does, and where nine cells for each
     * of the finest grid's do (shaders/comp/bloom_gather.comp); all. */
    uint64_t light[KD_BLOOM_LEVELS], sums[KD_BLOOM_LEVELS], parts, bytes;
};

/* Of a picture of so many pixels. strength: style.bloom, 0: none. */
struct kd_bloom kd_bloom_of(uint32_t width, uint32_t height, double strength);

static inline uint32_t kd_bloom_cells(const struct kd_bloom *bloom, uint32_t level) { return (bloom->columns >> level) * (bloom->rows >> level); }
static inline uint64_t kd_bloom_parts_bytes(const struct kd_bloom *bloom) { return 9 * 16ull * kd_bloom_cells(bloom, 0); }

#endif
