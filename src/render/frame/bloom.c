/* The pass that spreads light over white as a lens does (render/plan/bloom.h). */
#include "render/frame/job.h"

#include <math.h>

/* Bright light of what is lit, band by band: what each cell of the finest grid has for those round it. */
static enum kd_status gather(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const struct kd_bloom *b = &p->bloom;
    const struct kd_vk_pipeline *gather;
    const uint64_t bytes = kd_bloom_parts_bytes(b);
    enum kd_status status;
    KD_TRY(kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_BLOOM_GATHER, NULL, 0, &gather, j->error));
    if (j->lit < p->height) /* cells that nothing is written to */
        KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_BLOOM].name, j->store->bloom, b->parts, bytes, 0, j->error));
    for (uint32_t band = 0; band < p->bands && kd_frame_band_lit(j, band); band++) {
        const uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_lit(j, band);
        const uint32_t top = (uint32_t)((uint64_t)first * b->rows / p->height);
        const uint32_t end = (uint32_t)(((uint64_t)(first + rows) * b->rows + p->height - 1) / p->height);
        const struct kd_bloom_push push = {
            .gain = (float)exp2(j->frame->exposure), .strength = (float)b->strength,
            .pixels_x = p->width, .pixels_y = p->height, .row0 = first, .rows = rows,
            .cells_x = b->columns, .cells_y = b->rows, .cell_row0 = top, .cell_rows = end - top,
        };
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_BLOOM].name, gather, { { j->store->radiance.buffers[band], 0, 0, false }, { j->store->bloom, b->parts, bytes, true } }, &push,
            { kd_frame_groups((uint64_t)b->columns * push.cell_rows) },
        };
        KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
        if (p->bands == 1)
            continue;
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error)); /* short submissions */
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

static struct kd_vk_binding range(struct kd_frame_job *j, uint64_t offset, uint64_t cells, bool write)
{
    return (struct kd_vk_binding) { j->store->bloom, offset, 16 * cells, write };
}

/* A kernel that makes all cells of a grid. Its twin that reads cells as texels is the next one. */
static enum kd_status make(struct kd_frame_job *j, enum kd_kernel kernel, uint32_t level, float share, float coarse_share,
                           const struct kd_vk_binding bindings[3])
{
    const struct kd_bloom *b = &j->plan->bloom;
    const struct kd_vk_pipeline *pipeline;
    const struct { uint32_t columns, rows; float share, coarse_share; } push = { b->columns >> level, b->rows >> level, share, coarse_share };
    kernel += kd_kernels_cells_as_texels(j->r->vk, b) ? 1 : 0;
    enum kd_status status = kd_kernels_get(&j->r->kernels, j->r->vk, kernel, NULL, 0, &pipeline, j->error);
    const struct kd_vk_dispatch d = { kd_passes[KD_PASS_BLOOM].name, pipeline, { bindings[0], bindings[1], bindings[2] }, &push, { kd_frame_groups(kd_bloom_cells(b, level)) } };
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

static enum kd_status join(struct kd_frame_job *j)
{
    const struct kd_bloom *b = &j->plan->bloom;
    const struct kd_vk_binding bindings[3] = { range(j, b->parts, 9 * kd_bloom_cells(b, 0), false), range(j, b->light[0], kd_bloom_cells(b, 0), true) };
    return make(j, KD_KERNEL_BLOOM_JOIN, 0, 0, 0, bindings);
}

/* The light of a grid from that of the next finer one. */
static enum kd_status down(struct kd_frame_job *j, uint32_t level)
{
    const struct kd_bloom *b = &j->plan->bloom;
    const struct kd_vk_binding bindings[3] = { range(j, b->light[level - 1], kd_bloom_cells(b, level - 1), false),
                                               range(j, b->light[level], kd_bloom_cells(b, level), true) };
    return make(j, KD_KERNEL_BLOOM_DOWN, level, 0, 0, bindings);
}

/* The sum of a grid and all coarser ones. Behind the coarsest there is none: its own light, which is finite, counts nothing there. */
static enum kd_status up(struct kd_frame_job *j, uint32_t level)
{
    const struct kd_bloom *b = &j->plan->bloom;
    const bool last = level + 1 == b->levels;
    const uint64_t n = kd_bloom_cells(b, level);
    const struct kd_vk_binding bindings[3] = { last ? range(j, b->light[level], n, false) : range(j, b->sums[level + 1], n / 4, false),
                                               range(j, b->light[level], n, false), range(j, b->sums[level], n, true) };
    return make(j, KD_KERNEL_BLOOM_UP, level, (float)b->share, last ? 0 : 1, bindings);
}

enum kd_status kd_frame_bloom(struct kd_frame_job *j)
{
    const uint32_t levels = j->plan->bloom.levels;
    enum kd_status status;
    if (!levels)
        return KD_OK;
    KD_TRY(gather(j));
    KD_TRY(join(j));
    for (uint32_t i = 1; i < levels; i++)
        KD_TRY(down(j, i));
    for (uint32_t i = levels; i > 0; i--)
        KD_TRY(up(j, i - 1));
done:
    return status;
}
