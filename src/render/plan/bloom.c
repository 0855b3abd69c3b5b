#include "render/plan/bloom.h"

#include <math.h>

/* Cells along a side that the coarsest grid divides, at least one of its own. */
static uint32_t cells(double wanted, uint32_t unit) { return unit * (uint32_t)fmax(round(wanted / unit), 1); }

/* Where so many cells begin, behind those before. */
static uint64_t reserve(struct kd_bloom *bloom, uint64_t n)
{
    const uint64_t at = bloom->bytes;
    bloom->bytes = at + (16 * n + 255) / 256 * 256;
    return at;
}

struct kd_bloom kd_bloom_of(uint32_t width, uint32_t height, double strength)
{
    struct kd_bloom bloom = { .strength = strength };
    const double side = fmax(height, width / 4.0);
    uint32_t finest = 0;
    if (strength <= 0)
        return bloom;
    while (finest < KD_BLOOM_LEVELS - 1 && side < KD_BLOOM_ROWS >> finest)
        finest++;
    bloom.levels = KD_BLOOM_LEVELS - finest;
    bloom.rows = cells((KD_BLOOM_ROWS >> finest) * (height / side), 1u << (bloom.levels - 1));
    bloom.columns = cells((KD_BLOOM_ROWS >> finest) * (width / side), 1u << (bloom.levels - 1));
    for (uint32_t level = 0; level < bloom.levels; level++) {
        bloom.light[level] = reserve(&bloom, kd_bloom_cells(&bloom, level));
        bloom.sums[level] = reserve(&bloom, kd_bloom_cells(&bloom, level));
    }
    bloom.parts = reserve(&bloom, 9ull * kd_bloom_cells(&bloom, 0));
    bloom.share = 1.0 / bloom.levels;
    bloom.strength *= (double)bloom.levels / KD_BLOOM_LEVELS; /* light that stays within a pixel or so stays where it is */
    return bloom;
}
