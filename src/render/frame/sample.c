#include "render/frame/sample.h"

#include "render/frame/lens.h"
#include "render/plan/sample.h"

#include "interface.h"

#include <string.h>

static enum kd_status cells_kernel(struct kd_frame_job *j, const struct kd_vk_pipeline **out)
{
    const struct kd_spec_sample spec = { .QUANTITIES = j->plan->lens.quantities, .ORDERS = j->plan->lens.orders };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_CELLS, &spec.QUANTITIES, sizeof spec / 4, out,
                          j->error);
}

static enum kd_status fill_kernel(struct kd_frame_job *j, bool of_sky, const struct kd_vk_pipeline **out)
{
    const struct kd_spec_fill spec = { .QUANTITIES = j->plan->lens.quantities,
                                       .ORDERS = j->plan->lens.orders,
                                       .OF_SKY = of_sky };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_FILL + (kd_kernels_map_as_texels(j->r->vk) ? 1 : 0),
                          &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* True if smooth cells must be filled: with the ends of rays if of_sky is true, otherwise with crossings. */
static bool fills(const struct kd_plan_lens *lens, bool of_sky)
{
    return of_sky ? kd_plan_holds(lens, KD_LENS_SKY) : lens->orders > 0;
}

enum kd_status kd_frame_sample_kernels(struct kd_frame_job *j)
{
    const struct kd_vk_pipeline *later;
    enum kd_status status = cells_kernel(j, &later);
    for (int of_sky = 0; of_sky < 2 && !status; of_sky++)
        if (fills(&j->plan->lens, of_sky))
            status = fill_kernel(j, of_sky, &later);
    return status;
}

/* One pass over some rows of a sampled map. */
struct run {
    struct kd_frame_job *j;
    struct kd_vk_buffer *lens; /* lens map of the band */
    struct kd_sample_grid grid;
    struct kd_sample_push push;
    struct kd_vk_binding camera;
};

static const char *name(enum kd_pass_id pass) { return kd_passes[pass].name; }

static enum kd_status make_buffers(struct run *run)
{
    struct kd_frame_job *j = run->j;
    struct kd_store *store = j->store;
    struct kd_vk *vk = j->r->vk;
    enum kd_status status;
    KD_TRY(kd_store_at_least(vk, &store->sample, run->grid.list_bytes, KD_VK_DEVICE, "cells and places", j->error));
    KD_TRY(
        kd_store_at_least(vk, &store->sample_index, run->grid.index_bytes, KD_VK_DEVICE, "index of nodes", j->error));
    KD_TRY(kd_store_at_least(vk, &store->nodes, run->grid.node_bytes, KD_VK_DEVICE, "nodes", j->error));
    KD_TRY(
        kd_store_at_least(vk, &store->sample_head, 4 * KD_SAMPLE_QUEUES, KD_VK_READBACK, "counts of nodes", j->error));
done:
    return status;
}

/* Resets all counts, and marks all places as having no node. */
static enum kd_status clear(struct run *run)
{
    struct kd_frame_job *j = run->j;
    enum kd_status status;
    KD_TRY(kd_vk_fill(j->r->vk, name(KD_PASS_TRACE), j->store->sample, 0, 4 * KD_SAMPLE_QUEUES, 0, j->error));
    KD_TRY(kd_vk_fill(j->r->vk, name(KD_PASS_TRACE), j->store->sample_index, 0, run->grid.index_bytes, 0, j->error));
done:
    return status;
}

static enum kd_status look_at_cells(struct run *run, uint32_t level)
{
    struct kd_frame_job *j = run->j;
    struct kd_vk_dispatch d = { .pass = name(KD_PASS_TRACE),
                                .bindings = { { j->store->sample, 0, 0, true },
                                              { j->store->sample_index, 0, 0, true },
                                              { j->store->nodes, 0, 0, false },
                                              run->camera },
                                .push = &run->push };
    run->push.level = level;
    if (level) {
        d.counts = j->store->sample;
        d.counts_at = 4 * (KD_SAMPLE_CELLS + 4 * (level - 1));
    } else {
        d.groups[0] = kd_frame_groups((uint64_t)run->grid.blocks_x * run->grid.blocks_y);
    }
    const enum kd_status status = cells_kernel(j, &d.pipeline);
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

static enum kd_status trace(struct run *run, uint32_t stage)
{
    static const struct kd_critical_lattice on_grid;
    struct kd_frame_job *j = run->j;
    const struct kd_vk_pipeline *pipeline;
    const bool alone = stage == KD_STAGE_ALONE;
    const enum kd_status status = kd_frame_trace_kernel(j, &on_grid, &pipeline);
    if (status)
        return status;
    struct kd_vk_dispatch d = kd_frame_trace(j, pipeline, alone ? run->lens : j->store->nodes, KD_CAMERA_GRID);
    const struct kd_slice push = {
        .band0 = run->push.band0,
        .stride = alone ? run->push.stride : run->grid.room,
        .list = j->plan->lens.planes * run->grid.room,
        .stage = stage,
        .origin_x = run->push.origin_x,
        .origin_y = run->push.origin_y,
        .places = alone ? run->grid.alone : run->grid.places,
    };
    d.push = &push;
    d.bindings[KD_PLACES_BINDING] = (struct kd_vk_binding) { j->store->sample, 0, 0, false };
    d.counts = j->store->sample;
    d.counts_at = 16 * stage;
    return kd_vk_dispatch(j->r->vk, &d, j->error);
}

static enum kd_status fill(struct run *run, bool of_sky)
{
    struct kd_frame_job *j = run->j;
    struct kd_vk_dispatch d = { .pass = name(KD_PASS_INTERPOLATE),
                                .bindings = { { run->lens, 0, 0, true },
                                              { j->store->sample_index, 0, 0, false },
                                              { j->store->nodes, 0, 0, false },
                                              run->camera,
                                              { j->store->sample, 0, 0, false } },
                                .push = &run->push,
                                .counts = j->store->sample,
                                .counts_at = 4 * (KD_SAMPLE_FILLS + (of_sky ? 4 : 0)) };
    const enum kd_status status = fill_kernel(j, of_sky, &d.pipeline);
    return status ? status : kd_vk_dispatch(j->r->vk, &d, j->error);
}

/* Submits the recorded commands at once. If a driver compiles kernels at their first dispatch, each kernel then has
 * the whole deadline of a submission. */
static enum kd_status submit_new(struct kd_frame_job *j) { return kd_vk_submit(j->r->vk, NULL, j->error); }

/* Initialises the map so that all rays cross nothing and are captured. Kernels then overwrite the rays to which this
 * does not apply. */
static enum kd_status fill_nothing(struct run *run)
{
    const struct kd_plan *p = run->j->plan;
    const uint64_t first = 4ull * (run->push.row0 - run->push.band0) * run->push.width,
                   bytes = 4ull * run->push.rows * run->push.width, plane = 4ull * run->push.stride;
    const float captured = KD_FATE_CAPTURED;
    uint32_t word;
    enum kd_status status = KD_OK;
    memcpy(&word, &captured, sizeof word);
    for (uint32_t n = 0; n < p->lens.orders && !status; n++)
        status =
            kd_vk_fill(run->j->r->vk, name(KD_PASS_INTERPOLATE), run->lens, n * plane + first, bytes, 0, run->j->error);
    if (!status && kd_plan_holds(&p->lens, KD_LENS_FATE))
        status = kd_vk_fill(run->j->r->vk, name(KD_PASS_INTERPOLATE), run->lens,
                            kd_lens_plane(p->lens.quantities, p->lens.orders, KD_LENS_FATE) * plane + first, bytes,
                            word, run->j->error);
    return status;
}

enum kd_status kd_frame_sample(struct kd_frame_job *j, uint32_t band, uint32_t first, uint32_t count)
{
    const struct kd_plan *p = j->plan;
    const struct kd_window window = kd_scene_window(j->scene);
    const uint32_t row0 = first * p->lens.side, rows = count * p->lens.side;
    struct run run = {
        .j = j,
        .lens = kd_frame_band_lens(j, band),
        .grid = kd_sample_grid(p, window.left * p->lens.side, window.top * p->lens.side, row0, rows),
        .camera = { j->store->cameras, KD_CAMERA_GRID * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false },
    };
    run.push = (struct kd_sample_push) {
        .origin_x = (uint32_t)run.grid.origin_x,
        .origin_y = (uint32_t)run.grid.origin_y,
        .blocks_x = run.grid.blocks_x,
        .blocks_y = run.grid.blocks_y,
        .width = p->picture.width * p->lens.side,
        .rows = rows,
        .row0 = row0,
        .band0 = kd_frame_band_first(j, band) * p->lens.side,
        .stride = p->picture.width * p->lens.side * p->picture.band_rows * p->lens.side,
        .room = run.grid.room,
        .tolerance = (float)p->lens.interpolates,
    };
    enum kd_status status;
    KD_TRY(make_buffers(&run));
    j->store->alone = run.grid.alone;
    j->store->alone_x = run.grid.origin_x;
    j->store->alone_y = run.grid.origin_y;
    KD_TRY(clear(&run));
    KD_TRY(fill_nothing(&run));
    for (uint32_t level = 0; level <= KD_CELL_LEVELS; level++) {
        KD_TRY(look_at_cells(&run, level));
        if (!level)
            KD_TRY(submit_new(j));
        KD_TRY(trace(&run, level));
        if (!level)
            KD_TRY(submit_new(j));
    }
    for (int of_sky = 0; of_sky < 2; of_sky++)
        if (fills(&p->lens, of_sky)) {
            KD_TRY(submit_new(j));
            KD_TRY(fill(&run, of_sky));
        }
    KD_TRY(kd_vk_copy(j->r->vk, "readback", j->store->sample_head, 0, j->store->sample, 0, 4 * KD_SAMPLE_QUEUES,
                      j->error));
done:
    return status;
}

void kd_frame_count_sampled(struct kd_frame_job *j, uint32_t count)
{
    const uint32_t *head = kd_vk_buffer_map(j->store->sample_head);
    const uint64_t rays = (uint64_t)count * j->plan->picture.width * j->plan->lens.side * j->plan->lens.side;
    for (uint32_t stage = 0; stage < KD_SAMPLE_STAGES; stage++)
        j->traced += head[4 * stage + 3];
    j->interpolated += rays - head[4 * KD_STAGE_ALONE + 3];
}
