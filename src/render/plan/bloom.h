/* Glare of a lens (style.bloom): how much light is spread and how far. Any thread.
 *
 * A grid of KD_BLOOM_ROWS rows of square cells covers the picture; further grids each have half as many cells along a
 * side. Each grid holds the light as a quadratic B-spline, is smoothed once, and is interpolated by such a spline. The
 * light of a point thus falls off as a sum of functions that are nearly Gaussian. The n-th of these has the standard
 * deviation d 2^n, where d is the side of the finest grid's cells. All of these functions have the same amount of
 * light. Brightness thus falls off as the square of the angle, about as the glare of eyes and lenses does (G. Spencer
 * et al. 1995). The glare covers the same fraction of a picture of any size; grids with cells smaller than pixels are
 * left out. If a picture is wider than four times its height, d is relative to a quarter of its width. */
#ifndef KD_RENDER_PLAN_BLOOM_H
#define KD_RENDER_PLAN_BLOOM_H

#include "interface.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_bloom {
    uint32_t columns, rows;      /* size of the finest grid, multiples of 2^(levels - 1) */
    uint32_t levels;             /* number of grids; 0: no light is spread */
    bool around;                 /* true if the picture shows all directions, so that its left and right edges adjoin */
    double strength;             /* fraction of the light above white that is spread */
    double share;                /* fraction of the spread light on each grid: equal for each octave of the angle */
    uint32_t block_x, block_y;   /* sides in pixels of the blocks whose light is summed first */
    uint32_t blocks_x, blocks_y; /* number of blocks */
    /* Offsets in one buffer, each a multiple of 256. light: offset of the first cell of each grid. sums: offset of
     * the first cell of the sum of each grid with the coarser grids. blocks: offset of the first block. bytes: size
     * of the buffer. */
    uint64_t light[KD_BLOOM_LEVELS], sums[KD_BLOOM_LEVELS], blocks, bytes;
};

/* Layout for a picture of this size. strength: style.bloom, 0: no glare. around: true if the picture shows all
 * directions. */
struct kd_bloom kd_bloom_of(uint32_t width, uint32_t height, double strength, bool around);

static inline uint32_t kd_bloom_cells(const struct kd_bloom *bloom, uint32_t level)
{
    return (bloom->columns >> level) * (bloom->rows >> level);
}
static inline uint64_t kd_bloom_blocks(const struct kd_bloom *bloom)
{
    return (uint64_t)bloom->blocks_x * bloom->blocks_y;
}
/* The largest number of vectors that a kernel reads through one binding. This is usually the number of blocks;
 * because of rounding there may be more cells than blocks. */
static inline uint64_t kd_bloom_most(const struct kd_bloom *bloom)
{
    const uint64_t blocks = kd_bloom_blocks(bloom), cells = kd_bloom_cells(bloom, 0);
    return blocks > cells ? blocks : cells;
}

/* Number of columns of cells that KD_POST_PIXELS adjacent pixels read, at most five. The post pass then reads these
 * columns together. 0: the pixels may read more columns, or need not be in one row of the picture. */
static inline uint32_t kd_bloom_together(const struct kd_bloom *bloom, uint32_t width)
{
    /* distance from the first pixel to the last in cells, times the width */
    const uint32_t apart = (KD_POST_PIXELS - 1) * bloom->columns;
    return !bloom->levels || width % KD_POST_PIXELS ? 0 : apart <= width ? 4 : apart <= 2 * width ? 5 : 0;
}

#endif
