/* The beam pass: convolves light with a telescope's beam (render/plan/beam.h). */
#include "render/frame/job.h"

#include <math.h>

/* Largest number of weights summed in one submission: about 40 ms on a small device. */
#define SUBMISSION 2e7

static struct kd_vk_binding lines(struct kd_frame_job *j, bool write)
{
    return (struct kd_vk_binding) { j->store->beam_lines, 0, kd_beam_lines_bytes(&j->plan->picture.beam), write };
}

static struct kd_vk_binding grid(struct kd_frame_job *j, int number, bool write)
{
    const uint64_t bytes = kd_beam_cells_bytes(&j->plan->picture.beam);
    return (struct kd_vk_binding) { j->store->beam_grids, (uint64_t)number * ((bytes + 255) / 256 * 256), bytes,
                                    write };
}

/* Runs a kernel that converts between a band of pixels and rows of cells. Its variant for texels is the next kernel
 * in the list. */
static enum kd_status band(struct kd_frame_job *j, uint32_t number, enum kd_kernel kernel, bool texels,
                           uint64_t invocations, struct kd_vk_binding from, struct kd_vk_binding to)
{
    const struct kd_beam_grid *b = &j->plan->picture.beam;
    const struct kd_spec_beam spec = { .COARSE = b->cell > 1 };
    const struct kd_beam_push push = {
        .pixels_x = j->plan->picture.width,
        .row0 = kd_frame_band_first(j, number),
        .rows = kd_frame_band_lit(j, number),
        .columns = b->columns,
        .cell = b->cell,
        .cells = (float)(1.0 / b->cell),
    };
    const struct kd_vk_pipeline *pipeline;
    enum kd_status status;
    KD_TRY(kd_kernels_get(&j->r->kernels, j->r->vk, kernel + (texels ? 1 : 0), &spec.COARSE, sizeof spec / 4, &pipeline,
                          j->error));
    const struct kd_vk_dispatch d = {
        kd_passes[KD_PASS_BEAM].name, pipeline, { from, to }, &push, { kd_frame_groups(invocations) }
    };
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    if (j->plan->picture.bands == 1)
        return KD_OK;
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error)); /* keeps submissions short */
    KD_TRY(kd_frame_report(j, 0));
done:
    return status;
}

/* Sums completed light, band by band, into rows of cells. */
static enum kd_status gather(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const uint64_t pixels = (uint64_t)p->picture.width * p->picture.band_rows, bytes = kd_post_radiance_bytes(pixels);
    enum kd_status status = KD_OK;
    if (j->lit < p->picture.height) /* clears rows whose light is not complete */
        KD_TRY(kd_vk_fill(j->r->vk, kd_passes[KD_PASS_BEAM].name, j->store->beam_lines, 0,
                          kd_beam_lines_bytes(&p->picture.beam), 0, j->error));
    for (uint32_t i = 0; i < p->picture.bands && kd_frame_band_lit(j, i); i++)
        KD_TRY(band(j, i, KD_KERNEL_BEAM_GATHER, kd_kernels_texels(j->r->vk, pixels),
                    (uint64_t)p->picture.beam.columns * kd_frame_band_lit(j, i),
                    (struct kd_vk_binding) { j->store->radiance.buffers[i], 0, bytes, false }, lines(j, true)));
done:
    return status;
}

/* Interpolates from cells back to pixels. The result is in separate buffers, so that the light before the beam is
 * kept. */
static enum kd_status spread(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const bool texels = kd_kernels_texels_of(j->r->vk, kd_beam_lines_bytes(&p->picture.beam));
    enum kd_status status = KD_OK;
    for (uint32_t i = 0; i < p->picture.bands && kd_frame_band_lit(j, i); i++)
        KD_TRY(band(j, i, KD_KERNEL_BEAM_SPREAD, texels, ((uint64_t)p->picture.width * kd_frame_band_lit(j, i) + 3) / 4,
                    lines(j, false), (struct kd_vk_binding) { j->store->beamed.buffers[i], 0, 0, true }));
done:
    return status;
}

/* Finds the kernel that makes one grid from another, or its variant for texels. */
static enum kd_status grid_kernel(struct kd_frame_job *j, enum kd_kernel kernel, const uint32_t *constants, size_t n,
                                  const struct kd_vk_binding *from, const struct kd_vk_pipeline **out)
{
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel + (kd_kernels_texels_of(j->r->vk, from->size) ? 1 : 0),
                          constants, n, out, j->error);
}

/* Dispatches a slice of rows. all: true if the slice has all rows; it is then not submitted by itself. */
static enum kd_status slice(struct kd_frame_job *j, const struct kd_vk_dispatch *d, bool all)
{
    enum kd_status status;
    KD_TRY(kd_vk_dispatch(j->r->vk, d, j->error));
    if (all)
        return KD_OK;
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_frame_report(j, 0));
done:
    return status;
}

/* Returns the number of rows of one submission, a multiple of four. Each row has `weights` weights. */
static uint32_t rows_at_once(double weights, uint32_t rows)
{
    return 4 * (uint32_t)fmin(fmax(SUBMISSION / weights / 4, 1), (rows + 3) / 4);
}

static enum kd_status blur(struct kd_frame_job *j, bool rows, struct kd_vk_binding from, struct kd_vk_binding to)
{
    const struct kd_beam_grid *b = &j->plan->picture.beam;
    const struct kd_spec_beam_blur spec = { .ROWS = rows };
    const uint32_t step = rows_at_once((double)b->columns * (2 * b->reach + 1), b->rows);
    const struct kd_vk_pipeline *pipeline;
    double sum = 0, narrow = 0.5 / (b->sigma * b->sigma);
    enum kd_status status;
    for (int k = -(int)b->reach; k <= (int)b->reach; k++)
        sum += exp(-narrow * k * k);
    struct kd_beam_blur_push push = {
        .columns = b->columns,
        .length_ = rows ? b->rows : b->columns,
        .reach = b->reach,
        .narrow = (float)narrow,
        .weight = (float)(1 / sum),
    };
    KD_TRY(grid_kernel(j, KD_KERNEL_BEAM_BLUR, &spec.ROWS, sizeof spec / 4, &from, &pipeline));
    for (push.row0 = 0; push.row0 < b->rows; push.row0 += step) {
        const uint32_t n = b->rows - push.row0 < step ? b->rows - push.row0 : step;
        push.lines = rows ? (n + 3) / 4 : n;
        const uint64_t invocations = (uint64_t)push.lines * (rows ? b->columns : (b->columns + 3) / 4);
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_BEAM].name, pipeline, { from, to }, &push, { kd_frame_groups(invocations) }
        };
        KD_TRY(slice(j, &d, step >= b->rows));
    }
done:
    return status;
}

/* push: complete except for columns and slice. rows: number of rows of the result. */
static enum kd_status spline(struct kd_frame_job *j, struct kd_beam_spline_push push, uint32_t rows,
                             struct kd_vk_binding from, struct kd_vk_binding to)
{
    const uint32_t columns = j->plan->picture.beam.columns, step = rows_at_once((double)columns * push.count, rows);
    const struct kd_vk_pipeline *pipeline;
    enum kd_status status;
    push.columns = columns;
    KD_TRY(grid_kernel(j, KD_KERNEL_BEAM_SPLINE, NULL, 0, &from, &pipeline));
    for (push.row0 = 0; push.row0 < rows; push.row0 += step) {
        push.rows = rows - push.row0 < step ? rows - push.row0 : step;
        const struct kd_vk_dispatch d = { kd_passes[KD_PASS_BEAM].name,
                                          pipeline,
                                          { from, to },
                                          &push,
                                          { kd_frame_groups((uint64_t)columns * push.rows) } };
        KD_TRY(slice(j, &d, step >= rows));
    }
done:
    return status;
}

/* Sums the rows of cells to rows of the grid. There is one row of cells for each row of pixels. The grid's cell i
 * begins (i - 1) cells below the upper edge of the picture. */
static enum kd_status down(struct kd_frame_job *j, struct kd_vk_binding from, struct kd_vk_binding to)
{
    const struct kd_beam_grid *b = &j->plan->picture.beam;
    const struct kd_beam_spline_push push = {
        .length_ = b->height,
        .first_times = b->cell,
        .first_over = 1,
        .before = 2 * b->cell,
        .count = 3 * b->cell,
        .from_scale = (float)(1.0 / b->cell),
        .to_scale = 1,
        .shift = -1,
        .weight = (float)(1.0 / b->cell),
    };
    return spline(j, push, b->rows, from, to);
}

static enum kd_status up(struct kd_frame_job *j, struct kd_vk_binding from, struct kd_vk_binding to)
{
    const struct kd_beam_grid *b = &j->plan->picture.beam;
    const struct kd_beam_spline_push push = {
        .length_ = b->rows,
        .first_times = 1,
        .first_over = b->cell,
        .count = 3,
        .from_scale = 1,
        .to_scale = (float)(1.0 / b->cell),
        .shift = 1,
        .weight = 1,
    };
    return spline(j, push, b->height, from, to);
}

enum kd_status kd_frame_beam(struct kd_frame_job *j)
{
    const bool coarse = j->plan->picture.beam.cell > 1;
    enum kd_status status;
    if (!j->plan->picture.beam.cell)
        return KD_OK;
    KD_TRY(gather(j));
    if (coarse) {
        KD_TRY(down(j, lines(j, false), grid(j, 0, true)));
        KD_TRY(blur(j, false, grid(j, 0, false), grid(j, 1, true)));
        KD_TRY(blur(j, true, grid(j, 1, false), grid(j, 0, true)));
        KD_TRY(up(j, grid(j, 0, false), lines(j, true)));
    } else {
        KD_TRY(blur(j, false, lines(j, false), grid(j, 0, true)));
        KD_TRY(blur(j, true, grid(j, 0, false), lines(j, true)));
    }
    KD_TRY(spread(j));
done:
    return status;
}
