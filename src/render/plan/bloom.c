#include "render/plan/bloom.h"

#include <math.h>

/* Cells along a side: a multiple of the coarsest grid's unit, at least one unit. */
static uint32_t cells(double wanted, uint32_t unit) { return unit * (uint32_t)fmax(round(wanted / unit), 1); }

/* Reserves n cells of the buffer and returns their offset. */
static uint64_t reserve(struct kd_bloom *bloom, uint64_t n)
{
    const uint64_t at = bloom->bytes;
    bloom->bytes = at + (16 * n + 255) / 256 * 256;
    return at;
}

/* Blocks of pixels are at most seven tenths as wide as cells. Uniform light then stays uniform, to 1e-3, and a point of
 * light is displaced by at most a third of a cell. Kernels handle 1, 2 or a multiple of 4 pixels. */
static uint32_t block_of(double pixels_a_cell)
{
    const double most = 0.715 * pixels_a_cell;
    return most >= 4 ? 4 * (uint32_t)(most / 4) : most >= 2 ? 2 : 1;
}

struct kd_bloom kd_bloom_of(uint32_t width, uint32_t height, double strength, bool around)
{
    struct kd_bloom bloom = { .strength = strength, .around = around };
    const double side = fmax(height, width / 4.0);
    if (strength <= 0)
        return bloom;
    /* The finest grid whose cells are not smaller than pixels; the smallest pictures have no grid. */
    for (bloom.levels = KD_BLOOM_LEVELS; bloom.levels; bloom.levels--) {
        const double rows = KD_BLOOM_ROWS >> (KD_BLOOM_LEVELS - bloom.levels);
        bloom.rows = cells(rows * (height / side), 1u << (bloom.levels - 1));
        bloom.columns = cells(rows * (width / side), 1u << (bloom.levels - 1));
        if (rows <= side && bloom.rows <= height && bloom.columns <= width)
            break;
    }
    if (!bloom.levels)
        return (struct kd_bloom) { 0 };
    for (uint32_t level = 0; level < bloom.levels; level++) {
        bloom.light[level] = reserve(&bloom, kd_bloom_cells(&bloom, level));
        bloom.sums[level] = reserve(&bloom, kd_bloom_cells(&bloom, level));
    }
    bloom.block_x = block_of((double)width / bloom.columns);
    bloom.block_y = block_of((double)height / bloom.rows);
    bloom.blocks_x = (width + bloom.block_x - 1) / bloom.block_x;
    bloom.blocks_y = (height + bloom.block_y - 1) / bloom.block_y;
    bloom.blocks = reserve(&bloom, kd_bloom_blocks(&bloom));
    bloom.share = 1.0 / bloom.levels;
    /* light that the missing fine grids would spread, by about a pixel, is not spread */
    bloom.strength *= (double)bloom.levels / KD_BLOOM_LEVELS;
    return bloom;
}
