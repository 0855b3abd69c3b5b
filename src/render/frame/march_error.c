/* Measures the error of light from volumes. On a lattice of pixels, the first ray of each pixel is traced twice more by
 * the same kernel into a separate buffer: once as in the picture, and once KD_MARCH_FINER times as finely. */
#include "render/frame/lens.h"

#include <math.h>
#include <stdlib.h>

static uint32_t pixels_of(const struct kd_march_sample *s) { return s->columns * s->rows; }

/* Number of rows of the lattice that lie above a row of the picture. */
static uint32_t above(const struct kd_march_sample *s, uint32_t row)
{
    const uint32_t n = row > s->first[1] ? (row - s->first[1] + s->every[1] - 1) / s->every[1] : 0;
    return n < s->rows ? n : s->rows;
}

/* Lights the sample's pixels of a band, writes to the buffer from index `to` on, and submits. */
static enum kd_status sample(struct kd_frame_job *j, uint32_t band, const struct kd_march *march, uint32_t to)
{
    static const struct kd_critical_lattice on_grid; /* all members 0 means rays of the grid */
    const struct kd_plan *p = j->plan;
    const struct kd_march_sample *s = &p->light.march.sample;
    const uint32_t first = kd_frame_band_first(j, band), from = above(s, first),
                   rows = above(s, first + kd_frame_band_rows(j, band)) - from;
    const struct kd_slice push = {
        .row0 = (s->first[1] + from * s->every[1]) * p->lens.side,
        .band0 = first * p->lens.side,
        .stride = p->picture.width * p->lens.side * p->picture.band_rows * p->lens.side,
        .steps = march->steps,
        .fine = march->fine,
        .opaque = (float)march->opaque,
        .unseen = (float)march->unseen,
        .first = s->first[0],
        .every_x = s->every[0],
        .every_y = s->every[1],
        .columns = s->columns,
        .to = to + from * s->columns,
        .lost_most = KD_MARCH_SAMPLED,
    };
    const struct kd_vk_pipeline *pipeline;
    enum kd_status status;
    if (!rows)
        return KD_OK;
    KD_TRY(kd_frame_light_kernel(j, &on_grid, KD_MAKES_PICTURE, &pipeline));
    struct kd_vk_dispatch d =
        kd_frame_transfer(j, pipeline, kd_frame_band_lens(j, band), band, KD_CAMERA_GRID, KD_MAKES_PICTURE);
    d.pass = kd_passes[KD_PASS_MARCH_ERROR].name;
    d.bindings[3] = (struct kd_vk_binding) { j->marched, 0, 0, true };
    d.push = &push;
    d.groups[0] = kd_frame_groups(s->columns);
    d.groups[1] = rows;
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    KD_TRY(kd_frame_follow_lost(j, &d, &push, &on_grid, 1));
done:
    return status;
}

enum kd_status kd_frame_sample_march(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_march *march = &j->plan->light.march, finer = kd_march_finer(*march);
    const uint32_t n = pixels_of(&march->sample);
    enum kd_status status = KD_OK;
    if (!march->steps || !n)
        return KD_OK;
    if (!j->marched)
        KD_TRY(kd_vk_buffer_create(j->r->vk, 2 * n * sizeof(float[3]) + kd_plan_lost_bytes(KD_MARCH_SAMPLED),
                                   KD_VK_READBACK, "a sample of the light of volumes", &j->marched, j->error));
    KD_TRY(kd_frame_forget_lost(j, j->marched, kd_passes[KD_PASS_MARCH_ERROR].name));
    KD_TRY(sample(j, band, march, 0));
    KD_TRY(sample(j, band, &finer, n));
done:
    return status;
}

static double brightest(const float c[3]) { return fmax(fmax(c[0], c[1]), c[2]); }

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* True if light is finite and the ray was not given up. A ray that was given up has the mark -1. */
static bool right(const float c[3]) { return isfinite(c[0] + c[1] + c[2]) && c[0] >= 0 && c[1] >= 0 && c[2] >= 0; }

/* Relative differences of the light of n rays, sorted. Returns their number. Rays whose light is the same, such as
 * those that meet no volume, are left out. A ray without valid light counts as 1. */
static uint32_t compare(const float *light, const float *finer, uint32_t n, double off[KD_MARCH_SAMPLED])
{
    double most = 0;
    uint32_t lit = 0;
    for (uint32_t i = 0; i < n; i++)
        most = right(finer + 3 * i) ? fmax(most, brightest(finer + 3 * i)) : most;
    for (uint32_t i = 0; i < n; i++) {
        const float *a = light + 3 * i, *b = finer + 3 * i,
                    apart[3] = { fabsf(a[0] - b[0]), fabsf(a[1] - b[1]), fabsf(a[2] - b[2]) };
        const double own = fmax(brightest(a), brightest(b));
        if (!right(a) || !right(b))
            off[lit++] = 1;
        else if (brightest(apart) > 0)
            off[lit++] = brightest(apart) / fmax(own, KD_MARCH_DARK * most);
    }
    qsort(off, lit, sizeof *off, by_size);
    return lit;
}

enum kd_status kd_frame_march_error(struct kd_frame_job *j)
{
    struct kd_accuracy_report *to = &j->frame->accuracy;
    const uint32_t n = pixels_of(&j->plan->light.march.sample);
    double off[KD_MARCH_SAMPLED];
    if (!j->marched)
        return KD_OK;
    enum kd_status status = kd_vk_wait(j->r->vk, 0, j->error);
    if (status)
        return status;
    const float *light = kd_vk_buffer_map(j->marched);
    to->volume_sampled = compare(light, light + 3 * n, n, off);
    if (to->volume_sampled) {
        to->volume_error = off[(to->volume_sampled - 1) * 9 / 10];
        to->volume_error_worst = off[to->volume_sampled - 1];
    }
    return KD_OK;
}
