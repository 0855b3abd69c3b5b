/* Describes the light of one pixel, ray by ray. */
#include "physics/spacetime/kerr.h"
#include "render/frame/lens.h"
#include "render/frame/probe.h"
#include "render/lens/label.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RECORDS = 8192
}; /* about 360 kB: a march makes two records for each part of each step, at most 6144, and each emitter adds its own */
struct record { float of, a[4], b[4], c[2]; };
#define SIZE (sizeof(float) + (KD_PROBE_SUMS + RECORDS) * sizeof(struct record))
_Static_assert(sizeof(struct record) == KD_PROBE_RECORD * sizeof(float), "the record of interface.h");

static void add_glow(struct kd_probed_glow *glows, size_t *n, size_t most, const struct record *r, float opacity,
                     float through)
{
    if (*n == most)
        return;
    glows[(*n)++] = (struct kd_probed_glow) {
        .emitter = (uint32_t)r->a[0],
        .light = { r->a[1], r->a[2], r->a[3] },
        .opacity = opacity,
        .through = through,
        .points = r->of == (float)KD_PROBE_OF_POINTS,
    };
}

static struct kd_probed_place place_of(const struct record *r)
{
    return (struct kd_probed_place) {
        .order = (uint32_t)r->a[0],
        .w = r->a[1],
        .phi = r->a[2],
        .slope = r->a[3],
        .footprint = r->b[0],
        .g = r->b[1],
        .temperature = r->b[2],
        .angle = r->b[3],
        .through = r->c[0],
    };
}

static struct kd_probed_stretch stretch_of(const struct record *r, uint32_t behind)
{
    return (struct kd_probed_stretch) {
        .order = behind,
        .w = { r->a[0], r->a[1] },
        .u = { r->a[2], r->a[3] },
        .light = { r->b[0], r->b[1], r->b[2] },
        .through = { r->b[3], r->c[0] },
        .delay = { NAN, NAN },
    };
}

/* Makes room by joining pairs of adjacent stretches that precede the same crossing. */
static void join(struct kd_probed_ray *told)
{
    struct kd_probed_stretch *s = told->stretches;
    size_t n = 0;
    for (size_t i = 0; i < told->n_stretches; i++) {
        s[n] = s[i];
        if (i + 1 < told->n_stretches && s[i + 1].order == s[i].order) {
            const struct kd_probed_stretch *next = &s[++i];
            s[n].w[1] = next->w[1], s[n].u[1] = next->u[1], s[n].delay[1] = next->delay[1],
            s[n].through[1] = next->through[1];
            for (int c = 0; c < 3; c++)
                s[n].light[c] += next->light[c];
        }
        n++;
    }
    told->n_stretches = n;
}

static void take_stretch(struct kd_probed_ray *told, struct kd_probed_stretch stretch)
{
    if (told->n_stretches == KD_PROBED_STRETCHES)
        join(told);
    if (told->n_stretches < KD_PROBED_STRETCHES)
        told->stretches[told->n_stretches++] = stretch;
    else
        told->lost++;
}

static void take_met(struct kd_probed_met *met, const struct record *r)
{
    if (r->of == (float)KD_PROBE_MET)
        *met = (struct kd_probed_met) {
            .met = true,
            .emitter = (uint32_t)r->a[0],
            .which = (uint32_t)r->b[0],
            .order = (uint32_t)r->b[1],
            .cosine = r->b[2],
            .light = { r->a[1], r->a[2], r->a[3] },
            .through = r->b[3],
        };
    else
        met->w = r->a[0], met->u = r->a[1], met->phi = r->a[2], met->g = r->a[3];
}

static void take_front(struct kd_probed_ray *told, const struct record *r)
{
    told->through = r->a[3];
    told->steps = (uint32_t)r->b[0];
    told->samples = (uint32_t)r->b[1];
    told->transfers = r->c[1] > 0;
    told->stokes[0] = r->b[2];
    told->stokes[1] = r->b[3];
    told->stokes[2] = r->c[0];
}

static void take(struct kd_probed_ray *told, const struct record *r)
{
    struct kd_probed_place *last = told->n_places ? &told->places[told->n_places - 1] : NULL;
    if (r->of == (float)KD_PROBE_AT && told->n_places < KD_PROBED_PLACES)
        told->places[told->n_places++] = place_of(r);
    else if (r->of == (float)KD_PROBE_OF_PLACE && last)
        add_glow(last->glows, &last->n_glows, KD_PLAN_EMITTERS, r, r->b[0], r->b[1]);
    else if (r->of == (float)KD_PROBE_POLARIZED && last)
        last->polarized = true, last->stokes[0] = r->a[0], last->stokes[1] = r->a[1];
    else if (r->of == (float)KD_PROBE_ALONG)
        take_stretch(told, stretch_of(r, last ? last->order + 1 : 0));
    else if (r->of == (float)KD_PROBE_ALONG_AT && told->n_stretches &&
             isnan(told->stretches[told->n_stretches - 1].delay[0]))
        memcpy(told->stretches[told->n_stretches - 1].delay, r->a, sizeof told->stretches[0].delay);
    else if (r->of == (float)KD_PROBE_AT)
        told->lost++;
    else if (r->of == (float)KD_PROBE_ENDS)
        told->end_u = r->a[0], told->end_phi = r->a[1], told->end_footprint = r->a[2], told->ended = true;
    else if (r->of == (float)KD_PROBE_OF_END || r->of == (float)KD_PROBE_OF_POINTS)
        add_glow(told->ends, &told->n_ends, 2 * KD_PLAN_EMITTERS, r, 0, told->through);
    else if (r->of == (float)KD_PROBE_OF_VOLUME && told->n_volumes < KD_PLAN_EMITTERS)
        told->volumes[told->n_volumes++] =
            (struct kd_probed_volume) { (uint32_t)r->a[0], { r->a[1], r->a[2], r->a[3] }, r->b[0] };
    else if (r->of == (float)KD_PROBE_MET || r->of == (float)KD_PROBE_MET_AT)
        take_met(&told->met, r);
    else if (r->of == (float)KD_PROBE_LOST)
        told->given_up = true;
    else if (r->of == (float)KD_PROBE_FRONT)
        take_front(told, r);
    else if (r->of == (float)KD_PROBE_WHOLE)
        memcpy(told->light, r->a, sizeof told->light);
}

/* The rays to be described, and the kernel that describes them. */
struct source {
    const struct kd_critical_lattice *lattice; /* all members 0 means rays of the grid */
    struct kd_vk_buffer *lens, *records;
    uint32_t band;
    int camera;
    struct kd_slice push; /* push constants without the ray's number */
};

static enum kd_status follow(struct kd_frame_job *j, const struct source *s, struct kd_probed_ray *out)
{
    const struct kd_vk_pipeline *pipeline;
    enum kd_status status;
    if (!j->plan->lens.planes && !j->plan->light.march.steps) /* nothing emits light */
        return KD_OK;
    KD_TRY(kd_frame_light_kernel(j, s->lattice, KD_MAKES_TOLD, &pipeline));
    struct kd_vk_dispatch d = kd_frame_transfer(j, pipeline, s->lens, s->band, s->camera, KD_MAKES_PICTURE);
    d.bindings[3] = (struct kd_vk_binding) { s->records, 0, 0, true };
    d.push = &s->push;
    d.groups[0] = d.groups[1] = 1;
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
    const float *from = kd_vk_buffer_map(s->records);
    const size_t n = (size_t)from[0], kept = n < RECORDS ? n : RECORDS;
    for (size_t i = 0; i < KD_PROBE_SUMS + kept; i++)
        take(out, (const struct record *)(from + 1) + i);
    out->lost += n - kept;
done:
    return status;
}

/* Allocates `rays` empty rays of the pixel. */
static enum kd_status make_room(struct kd_frame_job *j, uint32_t rays)
{
    struct kd_probed_pixel *told = j->frame->told;
    free(told->each);
    told->rays = 0;
    if (!(told->each = malloc(rays * sizeof *told->each)))
        return kd_error_set(j->error, KD_ENOMEM, "out of memory for the report on %u rays", rays);
    told->rays = rays;
    return KD_OK;
}

static struct kd_probed_ray ray_at(uint32_t steps_a_pixel, uint32_t x, uint32_t y)
{
    return (struct kd_probed_ray) { .through = 1, .steps_a_pixel = steps_a_pixel, .x = x, .y = y };
}

/* Describes the rays of the square grid. */
static enum kd_status follow_grid(struct kd_frame_job *j, struct source *s)
{
    struct kd_probed_pixel *told = j->frame->told;
    const uint32_t side = j->plan->lens.side, middle = (side - 1) / 2;
    enum kd_status status = make_room(j, side * side);
    for (uint32_t i = 0; i < side * side && !status; i++) {
        struct kd_probed_ray *ray = &told->each[i];
        *ray = ray_at(side, told->x * side + i % side, told->y * side + i / side);
        s->push.rows = ray->x, s->push.row0 = ray->y;
        status = follow(j, s, ray);
        if (i == middle * side + middle)
            told->middle = *ray;
    }
    return status;
}

enum kd_status kd_frame_probe(struct kd_frame_job *j, uint32_t band)
{
    static const struct kd_critical_lattice on_grid; /* all members 0 means rays of the grid */
    const struct kd_plan *p = j->plan;
    const uint32_t first = kd_frame_band_first(j, band);
    if (!p->report.probe.on || p->report.probe.y < first || p->report.probe.y >= first + kd_frame_band_rows(j, band))
        return KD_OK;
    struct source s = {
        .lattice = &on_grid,
        .lens = kd_frame_band_lens(j, band),
        .band = band,
        .camera = KD_CAMERA_GRID,
        .push = { .band0 = first * p->lens.side,
                  .stride = p->picture.width * p->lens.side * p->picture.band_rows * p->lens.side,
                  .steps = p->light.march.steps,
                  .fine = p->light.march.fine,
                  .opaque = (float)p->light.march.opaque,
                  .unseen = (float)p->light.march.unseen },
    };
    enum kd_status status = KD_OK;
    if (!j->frame->told && !(j->frame->told = calloc(1, sizeof *j->frame->told)))
        return kd_error_set(j->error, KD_ENOMEM, "out of memory for the report on a pixel");
    j->frame->told->x = p->report.probe.x, j->frame->told->y = p->report.probe.y;
    KD_TRY(kd_vk_buffer_create(j->r->vk, SIZE, KD_VK_READBACK, "light of a ray", &s.records, j->error));
    KD_TRY(follow_grid(j, &s));
done:
    kd_vk_buffer_destroy(j->r->vk, s.records);
    return status;
}

/* Returns the index of the pixel in the list, or the list's length if the pixel is not in the list. */
static uint64_t listed_at(const struct kd_frame_part *part, const struct kd_probed_pixel *told)
{
    uint64_t i = 0;
    while (i < part->n && (part->list->pixels->pixels[part->first + i].x != told->x ||
                           part->list->pixels->pixels[part->first + i].y != told->y))
        i++;
    return i;
}

enum kd_status kd_frame_probe_listed(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    struct kd_probed_pixel *told = j->frame->told;
    const struct kd_critical_lattice *lattice = &part->list->lattice;
    const uint64_t at = told && !told->whole ? listed_at(part, told) : part->n;
    if (at == part->n)
        return KD_OK;
    struct source s = { .lattice = lattice,
                        .lens = part->lens,
                        .band = told->y / j->plan->picture.band_rows,
                        .camera = part->list->camera,
                        .push = part->push };
    s.push.row0 = (uint32_t)at;
    s.push.rows = 1;
    s.push.band0 = kd_frame_band_first(j, s.band);
    enum kd_status status = KD_OK;
    KD_TRY(kd_vk_buffer_create(j->r->vk, SIZE, KD_VK_READBACK, "light of a ray", &s.records, j->error));
    KD_TRY(make_room(j, lattice->rays));
    for (uint32_t i = 0; i < lattice->rays; i++) {
        const struct kd_pixel place = kd_critical_place(lattice, (struct kd_pixel) { told->x, told->y }, i);
        told->each[i] = ray_at(kd_critical_steps(lattice), place.x, place.y);
        s.push.ray = i;
        KD_TRY(follow(j, &s, &told->each[i]));
    }
done:
    kd_vk_buffer_destroy(j->r->vk, s.records);
    return status;
}

static enum kd_status say_no_steps(struct kd_probed_pixel *told, const char *why)
{
    snprintf(told->no_steps, sizeof told->no_steps, "%.199s", why);
    return KD_OK;
}

static struct kd_rays_params params_of_steps(const struct kd_scene *scene, const struct kd_plan_lens *lens)
{
    return (struct kd_rays_params) {
        KD_HOLE_FROM(&scene->spacetime),
        .r = scene->camera.r,
        .inclination_deg = scene->camera.inclination_deg,
        .orders = (uint32_t)scene->accuracy.orders,
        .engine = lens->setting.engine,
        .precision = lens->setting.precision,
        .steps = lens->setting.steps,
    };
}

enum kd_status kd_frame_probe_ask(struct kd_frame_job *j)
{
    const struct kd_rays_params params = params_of_steps(j->scene, &j->plan->lens);
    return j->plan->report.probe.steps ? kd_rays_steps_ask(j->r, &params) : KD_OK;
}

/* Records the engine's steps along the middle ray, from its labels. */
static enum kd_status tell_steps(struct kd_frame_job *j)
{
    struct kd_probed_pixel *told = j->frame->told;
    const struct kd_setting *by = &j->plan->lens.setting;
    const struct kd_scene *scene = j->scene, counted = told->middle.steps_a_pixel == j->plan->lens.side
                                                           ? *scene
                                                           : kd_critical_camera(scene, told->middle.steps_a_pixel);
    const struct kd_rays_params params = params_of_steps(scene, &j->plan->lens);
    struct kd_camera_label label;
    struct kd_error error = { 0 };
    if (by->engine == KD_ENGINE_CLOSED)
        return say_no_steps(
            told, "the engine of the picture is \"closed\", which takes no steps; accuracy.engine must be another");
    if (scene->camera.r <= kd_scene_hole(scene)->outer)
        return say_no_steps(told, "the observer is inside the horizon, where rays have no alpha and beta; only the "
                                  "path of the ray has steps there");
    kd_lens_label(&counted, &j->plan->lens, told->middle.x, told->middle.y, &label);
    const double alpha_beta[] = { label.alpha, label.beta };
    const bool outward = label.outward && isfinite(scene->camera.r);
    if (!(told->steps = calloc(1, sizeof *told->steps)))
        return kd_error_set(j->error, KD_ENOMEM, "out of memory for the steps of a ray");
    enum kd_status status =
        kd_rays_steps(j->r, &params, &(struct kd_ray_labels) { alpha_beta, &outward, 1 }, told->steps, &error);
    if (!status)
        return KD_OK;
    kd_rays_steps_finish(told->steps);
    free(told->steps);
    told->steps = NULL;
    if (status == KD_EINVAL) /* the labels are rounded, so they may lie outside the range of possible labels */
        return say_no_steps(told, error.message);
    if (j->error)
        *j->error = error;
    return status;
}

enum kd_status kd_frame_probe_pixel(struct kd_frame_job *j)
{
    struct kd_probed_pixel *told = j->frame->told;
    struct kd_vk_buffer *host = NULL;
    enum kd_status status = KD_OK;
    if (!told)
        return KD_OK;
    const uint32_t band = told->y / j->plan->picture.band_rows;
    const uint64_t pixel = (uint64_t)(told->y - kd_frame_band_first(j, band)) * j->plan->picture.width + told->x;
    told->whole = true;
    KD_TRY(kd_vk_buffer_create(j->r->vk, sizeof told->radiance, KD_VK_READBACK, "light of a pixel", &host, j->error));
    KD_TRY(kd_vk_copy(j->r->vk, "readback", host, 0, j->store->radiance.buffers[band], 12 * pixel,
                      sizeof told->radiance, j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
    memcpy(told->radiance, kd_vk_buffer_map(host), sizeof told->radiance);
    if (j->plan->report.probe.steps)
        KD_TRY(tell_steps(j));
done:
    kd_vk_buffer_destroy(j->r->vk, host);
    return status;
}
