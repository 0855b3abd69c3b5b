/* The bloom pass: spreads light above white as a lens does (render/plan/bloom.h). */
#include "render/frame/job.h"

#include <math.h>

static struct kd_vk_binding range(struct kd_frame_job *j, uint64_t offset, uint64_t cells, bool write)
{
    return (struct kd_vk_binding) { j->store->bloom, offset, 16 * cells, write };
}

/* Sums the bright light of a band, in blocks. */
static enum kd_status brighten_band(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    const struct kd_bloom *b = &p->picture.bloom;
    const uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_lit(j, band),
                   wide = b->block_x < 4 ? 4 : b->block_x;
    const struct kd_spec_bloom_bright spec = { .BLOCK_X = b->block_x,
                                               .BLOCK_Y = b->block_y,
                                               .BEGUN = first % b->block_y != 0 };
    const struct kd_bloom_bright_push push = {
        .gain = (float)exp2(j->frame->exposure),
        .strength = (float)b->strength,
        .pixels_x = p->picture.width,
        .row0 = first,
        .rows = rows,
        .blocks_x = b->blocks_x,
        .block_row0 = first / b->block_y,
        .block_rows = (first + rows + b->block_y - 1) / b->block_y - first / b->block_y,
        .across = (p->picture.width + wide - 1) / wide,
    };
    const uint64_t band_pixels = (uint64_t)p->picture.width * p->picture.band_rows;
    const bool texels = p->picture.width % 4 == 0 && kd_kernels_texels(j->r->vk, band_pixels);
    const struct kd_vk_pipeline *pipeline;
    enum kd_status status = kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_BLOOM_BRIGHT + (texels ? 1 : 0),
                                           &spec.BLOCK_X, sizeof spec / 4, &pipeline, j->error);
    const struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_BLOOM].name,
        pipeline,
        { { kd_frame_band_light(j, band), 0, kd_post_radiance_bytes(band_pixels), false },
          range(j, b->blocks, kd_bloom_blocks(b), true) },
        &push,
        { kd_frame_groups((uint64_t)push.across * push.block_rows) },
    };
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

/* Sums the bright light of all completed rows, band by band. */
static enum kd_status brighten(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    enum kd_status status = KD_OK;
    if (j->lit < p->picture.height) /* clears blocks whose light is not complete */
        KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_BLOOM].name, j->store->bloom, p->picture.bloom.blocks,
                          16 * kd_bloom_blocks(&p->picture.bloom), 0, j->error));
    for (uint32_t band = 0; band < p->picture.bands && kd_frame_band_lit(j, band); band++) {
        KD_TRY(brighten_band(j, band));
        if (p->picture.bands == 1)
            continue;
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error)); /* keeps submissions short */
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

/* Maximum number of blocks along an axis that two adjacent cells read together. Together they read the blocks within
 * four cells. A narrow last block moves the centres of blocks closer together, so that the two cells may read two more
 * blocks. */
static uint32_t taps(uint32_t pixels, uint32_t cells, uint32_t block, bool around)
{
    return 4 * pixels / (cells * block) + (pixels % block ? 3 : 1) + (around ? 1 : 0);
}

/* Converts blocks to cells of the finest grid. */
static enum kd_status gather(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const struct kd_bloom *b = &p->picture.bloom;
    const struct kd_bloom_gather_push push = {
        .pixels_x = p->picture.width,
        .pixels_y = p->picture.height,
        .blocks_x = b->blocks_x,
        .blocks_y = b->blocks_y,
        .cells_x = b->columns,
        .cells_y = b->rows,
        .block_x = b->block_x,
        .block_y = b->block_y,
    };
    const struct kd_spec_bloom_gather spec = {
        .TAPS_X = taps(p->picture.width, b->columns, b->block_x, b->around),
        .TAPS_Y = taps(p->picture.height, b->rows, b->block_y, false),
        .RAGGED = p->picture.width % b->block_x || p->picture.height % b->block_y,
        .AROUND = b->around,
    };
    const struct kd_vk_pipeline *pipeline;
    const enum kd_kernel kernel = KD_KERNEL_BLOOM_GATHER + (kd_kernels_cells_as_texels(j->r->vk, b) ? 1 : 0);
    enum kd_status status =
        kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.TAPS_X, sizeof spec / 4, &pipeline, j->error);
    const struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_BLOOM].name,
        pipeline,
        { range(j, b->blocks, kd_bloom_blocks(b), false), range(j, b->light[0], kd_bloom_cells(b, 0), true) },
        &push,
        { kd_frame_groups((uint64_t)((b->columns + 1) / 2) * ((b->rows + 1) / 2)) },
    };
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

/* Runs a kernel that makes all cells of a grid. Its variant for texels is the next kernel in the list. */
static enum kd_status make(struct kd_frame_job *j, enum kd_kernel kernel, uint32_t level, float share,
                           float coarse_share, const struct kd_vk_binding bindings[3])
{
    const struct kd_bloom *b = &j->plan->picture.bloom;
    const struct kd_vk_pipeline *pipeline;
    const struct {
        uint32_t columns, rows;
        float share, coarse_share;
    } push = { b->columns >> level, b->rows >> level, share, coarse_share };
    /* number of cells along each side of the square that one invocation makes */
    const uint32_t side = kernel == KD_KERNEL_BLOOM_UP ? 2 : 1;
    const uint64_t invocations = (uint64_t)((push.columns + side - 1) / side) * ((push.rows + side - 1) / side);
    kernel += kd_kernels_cells_as_texels(j->r->vk, b) ? 1 : 0;
    const struct kd_spec_bloom_grid spec = { .AROUND = b->around };
    enum kd_status status =
        kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.AROUND, sizeof spec / 4, &pipeline, j->error);
    const struct kd_vk_dispatch d = { kd_passes[KD_PASS_BLOOM].name,
                                      pipeline,
                                      { bindings[0], bindings[1], bindings[2] },
                                      &push,
                                      { kd_frame_groups(invocations) } };
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

/* Makes a grid from the next finer one. */
static enum kd_status down(struct kd_frame_job *j, uint32_t level)
{
    const struct kd_bloom *b = &j->plan->picture.bloom;
    const struct kd_vk_binding bindings[3] = { range(j, b->light[level - 1], kd_bloom_cells(b, level - 1), false),
                                               range(j, b->light[level], kd_bloom_cells(b, level), true) };
    return make(j, KD_KERNEL_BLOOM_DOWN, level, 0, 0, bindings);
}

/* Adds the light of one grid to the sum of all coarser grids. The coarsest grid has no such sum. So its own light is
 * bound in the place of the sum, with weight 0. */
static enum kd_status up(struct kd_frame_job *j, uint32_t level)
{
    const struct kd_bloom *b = &j->plan->picture.bloom;
    const bool last = level + 1 == b->levels;
    const uint64_t n = kd_bloom_cells(b, level);
    const struct kd_vk_binding bindings[3] = { last ? range(j, b->light[level], n, false)
                                                    : range(j, b->sums[level + 1], n / 4, false),
                                               range(j, b->light[level], n, false), range(j, b->sums[level], n, true) };
    return make(j, KD_KERNEL_BLOOM_UP, level, (float)b->share, last ? 0 : 1, bindings);
}

enum kd_status kd_frame_bloom(struct kd_frame_job *j)
{
    const uint32_t levels = j->plan->picture.bloom.levels;
    enum kd_status status;
    if (!levels)
        return KD_OK;
    KD_TRY(brighten(j));
    KD_TRY(gather(j));
    for (uint32_t i = 1; i < levels; i++)
        KD_TRY(down(j, i));
    for (uint32_t i = levels; i > 0; i--)
        KD_TRY(up(j, i - 1));
done:
    return status;
}
