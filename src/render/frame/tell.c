/* This part of a frame tells the light of one ray, and what became of its pixel. */
#include "render/frame/lens.h"
#include "render/frame/tell.h"

#include <stdlib.h>
#include <string.h>

enum { RECORDS = 8192 }; /* some 360 kB: a march makes one for each part of each step, 3072 at most, and emitters theirs */
struct record { float of, a[4], b[4], c[2]; };
#define SIZE (sizeof(float) + (KD_TELL_SUMS + RECORDS) * sizeof(struct record))
_Static_assert(sizeof(struct record) == KD_TELL_RECORD * sizeof(float), "the record of interface.h");

static void add_glow(struct kd_told_glow *glows, size_t *n, size_t most, const struct record *r, float opacity, float through)
{
    if (*n == most)
        return;
    glows[(*n)++] = (struct kd_told_glow) {
        .emitter = (uint32_t)r->a[0], .light = { r->a[1], r->a[2], r->a[3] }, .opacity = opacity, .through = through, .points = r->of == (float)KD_TELL_OF_POINTS,
    };
}

static struct kd_told_place place_of(const struct record *r)
{
    return (struct kd_told_place) {
        .order = (uint32_t)r->a[0], .w = r->a[1], .phi = r->a[2], .slope = r->a[3], .footprint = r->b[0], .g = r->b[1], .temperature = r->b[2],
        .angle = r->b[3], .through = r->c[0],
    };
}

static struct kd_told_stretch stretch_of(const struct record *r, uint32_t behind)
{
    return (struct kd_told_stretch) {
        .order = behind, .w = { r->a[0], r->a[1] }, .u = { r->a[2], r->a[3] }, .light = { r->b[0], r->b[1], r->b[2] }, .through = { r->b[3], r->c[0] },
    };
}

/* Makes room: two neighbours before the same crossing become one. */
static void join(struct kd_told *told)
{
    struct kd_told_stretch *s = told->stretches;
    size_t n = 0;
    for (size_t i = 0; i < told->n_stretches; i++) {
        s[n] = s[i];
        if (i + 1 < told->n_stretches && s[i + 1].order == s[i].order) {
            const struct kd_told_stretch *next = &s[++i];
            s[n].w[1] = next->w[1], s[n].u[1] = next->u[1], s[n].through[1] = next->through[1];
            for (int c = 0; c < 3; c++)
                s[n].light[c] += next->light[c];
        }
        n++;
    }
    told->n_stretches = n;
}

static void take_stretch(struct kd_told *told, struct kd_told_stretch stretch)
{
    if (told->n_stretches == KD_TOLD_STRETCHES)
        join(told);
    if (told->n_stretches < KD_TOLD_STRETCHES)
        told->stretches[told->n_stretches++] = stretch;
    else
        told->lost++;
}

static void take_met(struct kd_told_met *met, const struct record *r)
{
    if (r->of == (float)KD_TELL_MET)
        *met = (struct kd_told_met) {
            .met = true, .emitter = (uint32_t)r->a[0], .which = (uint32_t)r->b[0], .order = (uint32_t)r->b[1], .cosine = r->b[2],
            .light = { r->a[1], r->a[2], r->a[3] }, .through = r->b[3],
        };
    else
        met->w = r->a[0], met->u = r->a[1], met->phi = r->a[2], met->g = r->a[3];
}

static void take(struct kd_told *told, const struct record *r)
{
    struct kd_told_place *last = told->n_places ? &told->places[told->n_places - 1] : NULL;
    if (r->of == (float)KD_TELL_AT && told->n_places < KD_TOLD_PLACES)
        told->places[told->n_places++] = place_of(r);
    else if (r->of == (float)KD_TELL_OF_PLACE && last)
        add_glow(last->glows, &last->n_glows, KD_PLAN_EMITTERS, r, r->b[0], r->b[1]);
    else if (r->of == (float)KD_TELL_ALONG)
        take_stretch(told, stretch_of(r, last ? last->order + 1 : 0));
    else if (r->of == (float)KD_TELL_AT)
        told->lost++;
    else if (r->of == (float)KD_TELL_ENDS)
        told->end_u = r->a[0], told->end_phi = r->a[1], told->end_footprint = r->a[2], told->ended = true;
    else if (r->of == (float)KD_TELL_OF_END || r->of == (float)KD_TELL_OF_POINTS)
        add_glow(told->ends, &told->n_ends, 2 * KD_PLAN_EMITTERS, r, 0, told->through);
    else if (r->of == (float)KD_TELL_OF_VOLUME && told->n_volumes < KD_PLAN_EMITTERS)
        told->volumes[told->n_volumes++] = (struct kd_told_volume) { (uint32_t)r->a[0], { r->a[1], r->a[2], r->a[3] }, r->b[0] };
    else if (r->of == (float)KD_TELL_MET || r->of == (float)KD_TELL_MET_AT)
        take_met(&told->met, r);
    else if (r->of == (float)KD_TELL_LOST)
        told->given_up = true;
    else if (r->of == (float)KD_TELL_FRONT)
        told->through = r->a[3], told->steps = (uint32_t)r->b[0], told->samples = (uint32_t)r->b[1];
    else if (r->of == (float)KD_TELL_WHOLE)
        memcpy(told->light, r->a, sizeof told->light);
}

/* The ray in the middle of its pixel, or before it, as layers have it. */
static void begin(struct kd_frame_job *j, struct kd_told *told)
{
    const struct kd_plan *p = j->plan;
    *told = (struct kd_told) {
        .through = 1,
        .x = p->told.x, .y = p->told.y, .rays = p->side * p->side,
        .ray_x = p->told.x * p->side + (p->side - 1) / 2, .ray_y = p->told.y * p->side + (p->side - 1) / 2,
    };
}

static enum kd_status follow(struct kd_frame_job *j, uint32_t band, struct kd_vk_buffer *records)
{
    static const struct kd_critical_lattice on_grid; /* none */
    const struct kd_plan *p = j->plan;
    const struct kd_told *told = j->frame->told;
    const struct kd_vk_pipeline *pipeline;
    const struct kd_slice push = {
        .row0 = told->ray_y, .rows = told->ray_x, .band0 = kd_frame_band_first(j, band) * p->side, .stride = p->width * p->side * p->band_rows * p->side,
        .steps = p->march.steps, .fine = p->march.fine, .opaque = (float)p->march.opaque,
    };
    enum kd_status status;
    KD_TRY(kd_frame_light_kernel(j, &on_grid, KD_MAKES_TOLD, &pipeline));
    struct kd_vk_dispatch d = kd_frame_transfer(j, pipeline, kd_frame_band_lens(j, band), band, KD_CAMERA_GRID, KD_MAKES_PICTURE);
    d.bindings[3] = (struct kd_vk_binding) { records, 0, 0, true };
    d.push = &push;
    d.groups[0] = d.groups[1] = 1;
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
done:
    return status;
}

enum kd_status kd_frame_tell(struct kd_frame_job *j, uint32_t band)
{
    const uint32_t first = kd_frame_band_first(j, band);
    if (!j->plan->told.on || j->plan->told.y < first || j->plan->told.y >= first + kd_frame_band_rows(j, band))
        return KD_OK;
    struct kd_vk_buffer *records = NULL;
    enum kd_status status = KD_OK;
    if (!j->frame->told && !(j->frame->told = malloc(sizeof *j->frame->told)))
        return kd_error_set(j->error, KD_ENOMEM, "out of memory for what is told of a pixel");
    struct kd_told *told = j->frame->told;
    begin(j, told);
    if (!j->plan->planes && !j->plan->march.steps) /* nothing shines anywhere */
        return KD_OK;
    KD_TRY(kd_vk_buffer_create(j->r->vk, SIZE, KD_VK_READBACK, "light of a ray", &records, j->error));
    KD_TRY(follow(j, band, records));
    const float *from = kd_vk_buffer_map(records);
    const size_t n = (size_t)from[0], kept = n < RECORDS ? n : RECORDS;
    for (size_t i = 0; i < KD_TELL_SUMS + kept; i++)
        take(told, (const struct record *)(from + 1) + i);
    told->lost += n - kept;
done:
    kd_vk_buffer_destroy(j->r->vk, records);
    return status;
}

/* Rays of the pixel, if it has other ones than those of the grid. */
static uint32_t rays_of(const struct kd_frame_job *j, const struct kd_told *told)
{
    const struct kd_plan *p = j->plan;
    const uint8_t kind = j->kinds ? j->kinds[(size_t)told->y * p->width + told->x] : KD_REFINED_NOT;
    for (size_t i = 0; p->critical && i < j->lens->pixels.n; i++)
        if (j->lens->pixels.pixels[i].x == told->x && j->lens->pixels.pixels[i].y == told->y)
            return kind == KD_REFINED_AT_CURVE ? p->critical_dense : p->critical;
    return kind == KD_REFINED_FOLLOWED || kind == KD_REFINED_BETWEEN ? p->adaptive : told->rays;
}

enum kd_status kd_frame_tell_pixel(struct kd_frame_job *j)
{
    struct kd_told *told = j->frame->told;
    struct kd_vk_buffer *host = NULL;
    enum kd_status status = KD_OK;
    if (!told)
        return KD_OK;
    const uint32_t band = told->y / j->plan->band_rows;
    const uint64_t pixel = (uint64_t)(told->y - kd_frame_band_first(j, band)) * j->plan->width + told->x;
    told->rays = rays_of(j, told);
    KD_TRY(kd_vk_buffer_create(j->r->vk, sizeof told->radiance, KD_VK_READBACK, "light of a pixel", &host, j->error));
    KD_TRY(kd_vk_copy(j->r->vk, "readback", host, 0, j->store->radiance.buffers[band], 12 * pixel, sizeof told->radiance, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
    memcpy(told->radiance, kd_vk_buffer_map(host), sizeof told->radiance);
done:
    kd_vk_buffer_destroy(j->r->vk, host);
    return status;
}
