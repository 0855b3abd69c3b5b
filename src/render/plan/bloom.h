/* A lens has a glare (style.bloom): this says which part of the light it spreads how far. Any thread.
 *
 * A grid of KD_BLOOM_ROWS rows of square cells covers the picture, and grids of half as many cells each way follow
 * it. Each grid holds the light as a quadratic B-spline, is smoothed once, and is seen through such a spline: what
 * is spread from a point falls off as a sum of near Gaussians, the n-th of standard deviation d 2^n, d the side of
 * the finest grid's cells. Each has as much light, so that brightness falls off as the square of the angle, as the
 * glare of eyes and lenses about does (G. Spencer et al. 1995). So it spreads over the same part of a picture of any
 * size; grids with cells smaller than pixels are left out. Where a picture is wider than four times its height, d is
 * a part of a quarter of its width. */
#ifndef KD_RENDER_PLAN_BLOOM_H
#define KD_RENDER_PLAN_BLOOM_H

#include "interface.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_bloom {
    uint32_t columns, rows;      /* of the finest grid, multiples of 2^(levels - 1) */
    uint32_t levels;             /* grids; 0: nothing is spread */
    bool around;                 /* the picture goes all round: beyond its left and right edges is the other one */
    double strength;             /* of light over white, the share that is spread */
    double share;                /* of that, by each grid: as much in each octave of the angle */
    uint32_t block_x, block_y;   /* pixels along the sides of the blocks whose light is added up first */
    uint32_t blocks_x, blocks_y; /* of these */
    /* In one buffer, multiples of 256: where each grid begins, where its sum with the coarser ones does, and where
     * the blocks do; all. */
    uint64_t light[KD_BLOOM_LEVELS], sums[KD_BLOOM_LEVELS], blocks, bytes;
};

/* Gives that of a picture of so many pixels. strength: style.bloom, 0: none. around: it is one of all directions,
 * not a part of it. */
struct kd_bloom kd_bloom_of(uint32_t width, uint32_t height, double strength, bool around);

static inline uint32_t kd_bloom_cells(const struct kd_bloom *bloom, uint32_t level)
{
    return (bloom->columns >> level) * (bloom->rows >> level);
}
static inline uint64_t kd_bloom_blocks(const struct kd_bloom *bloom)
{
    return (uint64_t)bloom->blocks_x * bloom->blocks_y;
}
/* The most vectors that a kernel reads of one binding: there are more blocks than cells, but for rounding. */
static inline uint64_t kd_bloom_most(const struct kd_bloom *bloom)
{
    const uint64_t blocks = kd_bloom_blocks(bloom), cells = kd_bloom_cells(bloom, 0);
    return blocks > cells ? blocks : cells;
}

/* Says whether four pixels beside one another see five columns of cells at most, all in one row of the picture: the
 * pass post then reads fewer. */
static inline bool kd_bloom_together(const struct kd_bloom *bloom, uint32_t width)
{
    return bloom->levels && width % KD_POST_PIXELS == 0 && 3 * bloom->columns <= 2 * width;
}

#endif
