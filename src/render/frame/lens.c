/* Traces rays of a frame: makes the lens map and its light, band by band, in short submissions. */
#include "render/frame/lens.h"

#include "render/view/camera.h"
#include "render/view/critical_cache.h"
#include "render/lens/listed.h"
#include "render/device/prepare.h"
#include "render/frame/sample.h"
#include "render/plan/sample.h"
#include "scene/hole.h"
#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct kd_critical_lattice on_grid; /* all members 0 means rays of the grid */

/* Number of rows of pixels of a band, from `row` on, that one submission processes. A slice of a sampled map ends at
 * the end of a block, so that no block is traced twice. */
static uint32_t rows_of_slice(const struct kd_frame_job *j, uint32_t band, uint32_t row, double ns_per_row, bool maps)
{
    const struct kd_plan *p = j->plan;
    const uint32_t left = kd_frame_band_rows(j, band) - row, rows = kd_frame_slice(j, ns_per_row, left);
    if (!maps || !(p->lens.interpolates > 0))
        return rows;
    const uint32_t most = p->lens.sample_rows, block = KD_CELL_BLOCK / p->lens.side ? KD_CELL_BLOCK / p->lens.side : 1,
                   first = kd_scene_window(j->scene).top + kd_frame_band_first(j, band) + row,
                   end = (first + (rows < most ? rows : most)) / block * block;
    const uint32_t n = end > first ? end - first : block - first % block, held = n < most ? n : most;
    j->r->slice_pace.expected_ms *= (double)(held < left ? held : left) / rows;
    return held < left ? held : left;
}

/* Kernels are looked up for each slice, because other work may have evicted a kernel meanwhile. */

/* *out is NULL if no kernel is needed. l: lattice of the listed pixels; all members 0: the grid. */
enum kd_status kd_frame_trace_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l,
                                     const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    *out = NULL;
    if (p->lens.path == KD_LENS_LISTED)
        return KD_OK;
    const uint32_t rays = l->rays || !(p->lens.interpolates > 0) ? l->rays : KD_RAYS_BY_PLACE;
    if (p->lens.path == KD_LENS_CLOSED) {
        const struct kd_spec_lens_closed spec = {
            .QUANTITIES = p->lens.quantities,
            .ORDERS = p->lens.orders,
            .SIGHT = kd_camera_sight(j->scene),
            .CRITICAL = rays,
            .GENERATOR = l->generator,
            .SHIFT = l->shift,
        };
        return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_CLOSED, &spec.QUANTITIES, sizeof spec / 4, out,
                              j->error);
    }
    const struct kd_spec_lens_map spec = {
        .QUANTITIES = p->lens.quantities,
        .ORDERS = p->lens.orders,
        .STEPS = p->lens.setting.steps,
        .METHOD = p->lens.setting.engine == KD_ENGINE_MINO_RKN4 ? 4 : 6,
        .SIGHT = kd_camera_sight(j->scene),
        .CRITICAL = rays,
        .GENERATOR = l->generator,
        .SHIFT = l->shift,
        .INGOING = p->lens.ingoing,
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_MAP, &spec.QUANTITIES, sizeof spec / 4, out,
                          j->error);
}

static bool is_layer_of(const struct kd_plan_picture *picture, int makes, enum kd_layer_of of)
{
    return makes >= 0 && kd_layer_kinds[picture->layers[makes].kind].of == of;
}

/* True if the march makes this light or layer. Layers of a crossing need the march as well, because a body may hide
 * the crossing. */
static bool marches(const struct kd_plan *p, int makes)
{
    return p->light.march.steps && makes != KD_MAKES_RAYS &&
           (makes < 0 || is_layer_of(&p->picture, makes, KD_OF_LIGHT) ||
            (p->light.meets && is_layer_of(&p->picture, makes, KD_OF_CROSSING)));
}

uint32_t kd_frame_turns(const struct kd_plan *plan, uint32_t rays, int makes)
{
    return makes < 0 && marches(plan, makes) ? rays : 1; /* a layer needs at most one ray */
}

enum kd_status kd_frame_light_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l, int makes,
                                     const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    const bool march = marches(p, makes);
    const enum kd_kernel kernel =
        makes == KD_MAKES_PIECES ? KD_KERNEL_MARCH_PIECES
        : makes == KD_MAKES_TOLD ? march ? KD_KERNEL_MARCH_PROBE : KD_KERNEL_TRANSFER_PROBE
        : makes < 0 ? march ? KD_KERNEL_MARCH : KD_KERNEL_TRANSFER + (kd_kernels_map_as_texels(j->r->vk) ? 1 : 0)
        : march     ? KD_KERNEL_LAYERS_MARCH
                    : KD_KERNEL_LAYERS;
    struct kd_spec_transfer spec = {
        .QUANTITIES = p->lens.quantities,
        .ORDERS = p->lens.orders,
        .SIDE = p->lens.side,
        .SIGHT = kd_camera_sight(j->scene),
        .CRITICAL = l->rays,
        .GENERATOR = l->generator,
        .SHIFT = l->shift,
        .ORDER = KD_NO_ORDER,
        .BEYOND_KERR = !kd_hole_is_kerr(kd_scene_hole(j->scene)),
    };
    if (march)
        spec.INGOING = p->lens.ingoing;
    if (makes == KD_MAKES_PICTURE || makes == KD_MAKES_PIECES)
        spec.STOKES = p->light.stokes_words > 0;
    if (makes >= 0)
        spec.LAYER = (uint32_t)p->picture.layers[makes].kind;
    if (makes >= 0 && p->picture.layers[makes].order >= 0)
        spec.ORDER = (uint32_t)p->picture.layers[makes].order;
    memcpy(spec.traits, p->light.traits, sizeof spec.traits);
    if (kd_kernels_map_as_texels(j->r->vk))
        kd_emit_as_texels(spec.traits);
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* Rows of pixels of a band whose rays are traced, and whose light is computed, in one step. */
struct slice { uint32_t band, first, count; };

/* True if the transfer kernel processes columns of pixels, and leaves pixels without light as they are. */
static bool in_columns(const struct kd_plan *p)
{
    return p->lens.side == 1 && !(p->lens.ends && kd_plan_is_spread(&p->light)) && !p->light.march.steps;
}

enum kd_status kd_frame_send_cameras(struct kd_frame_job *j)
{
    const struct kd_scene critical = kd_critical_camera(j->scene, j->plan->lens.critical ? j->plan->lens.critical : 1);
    const struct kd_scene dense = kd_critical_camera(j->scene, KD_PLAN_ADAPTIVE_SIDE),
                          truth = kd_critical_camera(j->scene, KD_PLAN_TRUTH_SIDE);
    const struct kd_scene dense_critical =
        kd_critical_camera(j->scene, j->plan->lens.critical_dense ? j->plan->lens.critical_dense : 1);
    const struct kd_scene whole = kd_scene_whole(j->scene);
    const struct kd_camera_block cameras[] = {
        [KD_CAMERA_GRID] = kd_camera_block(j->scene), [KD_CAMERA_CRITICAL] = kd_camera_block(&critical),
        [KD_CAMERA_DENSE] = kd_camera_block(&dense),  [KD_CAMERA_DENSE_CRITICAL] = kd_camera_block(&dense_critical),
        [KD_CAMERA_TRUTH] = kd_camera_block(&truth),  [KD_CAMERA_WHOLE] = kd_camera_block(&whole),
    };
    return kd_store_send_cameras(j->store, cameras, j->error);
}

static struct kd_vk_binding camera_binding(const struct kd_frame_job *j, int camera)
{
    return (struct kd_vk_binding) { j->store->cameras, (uint64_t)camera * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false };
}

static struct kd_slice slice_of(const struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    return (struct kd_slice) {
        .band0 = kd_frame_band_first(j, band) * p->lens.side,
        .stride = p->picture.width * p->lens.side * p->picture.band_rows * p->lens.side,
        .steps = p->light.march.steps,
        .fine = p->light.march.fine,
        .opaque = (float)p->light.march.opaque,
        .unseen = (float)p->light.march.unseen,
        .lost_most = kd_plan_lost_most(p),
    };
}

/* Records a kernel over a slice. There is one invocation for each ray if the kernel makes rays, otherwise one for
 * each pixel. */
static enum kd_status record(struct kd_frame_job *j, const struct slice *s, struct kd_vk_dispatch *d, int makes)
{
    const bool rays = makes == KD_MAKES_RAYS, columns = makes == KD_MAKES_PICTURE && in_columns(j->plan);
    const struct kd_plan *p = j->plan;
    struct kd_slice push = slice_of(j, s->band);
    push.row0 = s->first * p->lens.side;
    push.rows = s->count * p->lens.side;
    d->push = &push;
    d->groups[0] = kd_frame_groups(rays ? (uint64_t)p->picture.width * p->lens.side : p->picture.width);
    d->groups[1] = rays ? push.rows : columns ? (s->count + KD_TRANSFER_ROWS - 1) / KD_TRANSFER_ROWS : s->count;
    enum kd_status status = KD_OK;
    for (const uint32_t turns = kd_frame_turns(p, p->lens.side * p->lens.side, makes); push.ray < turns && !status;
         push.ray++)
        status = kd_vk_dispatch(j->r->vk, d, j->error);
    return status;
}

enum kd_status kd_frame_list_rays(struct kd_frame_job *j, const struct kd_lens_rows *rows)
{
    /* waits for the march, which is slow, so that the time of the march does not count as time for these rays */
    enum kd_status status = j->plan->light.march.steps ? kd_vk_wait(j->r->vk, 0, j->error) : KD_OK;
    double start = kd_clock_ms();
    if (!status)
        status = kd_lens_listed(j->r, j->scene, j->plan, rows, &j->undecided, j->error);
    j->listed_ms += kd_clock_ms() - start;
    return status;
}

static enum kd_status list_slice(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_plan *p = j->plan;
    uint64_t width = (uint64_t)p->picture.width * p->lens.side;
    const struct kd_lens_rows rows = {
        .first = s->first * p->lens.side,
        .count = s->count * p->lens.side,
        .to = kd_frame_band_lens(j, s->band),
        .offset = (s->first - kd_frame_band_first(j, s->band)) * p->lens.side * width,
        .stride = width * p->picture.band_rows * p->lens.side,
    };
    return kd_frame_list_rays(j, &rows);
}

struct kd_vk_dispatch kd_frame_trace(const struct kd_frame_job *j, const struct kd_vk_pipeline *pipeline,
                                     struct kd_vk_buffer *lens, int camera)
{
    return (struct kd_vk_dispatch) {
        kd_passes[KD_PASS_TRACE].name,
        pipeline,
        { { lens, 0, 0, true },
          { j->store->undecided, 0, 0, true },
          camera_binding(j, camera),
          /* this camera's binding is replaced if rays are given by place */
          [KD_PLACES_BINDING] = camera_binding(j, camera) },
    };
}

/* pipeline: from kd_frame_trace_kernel. */
static enum kd_status trace_slice(struct kd_frame_job *j, const struct slice *s, const struct kd_vk_pipeline *pipeline)
{
    if (j->plan->lens.path == KD_LENS_LISTED)
        return list_slice(j, s);
    if (j->plan->lens.interpolates > 0)
        return kd_frame_sample(j, s->band, s->first, s->count);
    struct kd_vk_dispatch d = kd_frame_trace(j, pipeline, kd_frame_band_lens(j, s->band), KD_CAMERA_GRID);
    return record(j, s, &d, KD_MAKES_RAYS);
}

struct kd_vk_dispatch kd_frame_transfer(const struct kd_frame_job *j, const struct kd_vk_pipeline *pipeline,
                                        struct kd_vk_buffer *lens, uint32_t band, int camera, int makes)
{
    struct kd_vk_buffer *own[KD_OWN_COUNT];
    struct kd_vk_dispatch d = {
        kd_passes[makes < 0 ? kd_plan_light_pass(&j->plan->light) : KD_PASS_LAYERS].name,
        pipeline,
        { { lens, 0, 0, false },
          { j->store->transfer, 0, sizeof(struct kd_emission), false },
          { j->store->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { j->store->radiance.buffers[band], 0, 0, true },
          camera_binding(j, camera) },
        NULL,
        { 0 },
    };
    kd_prepared_buffers(j->prepared, &j->plan->light, own);
    own[KD_OWN_point_light] =
        /* stars.c makes the light of stars, band by band */
        j->plan->light.points ? j->lens->star_light.buffers[band] : NULL;
    for (int i = 0; i < KD_OWN_COUNT; i++) /* any buffer can be bound where none is
                                            * used */
        d.bindings[KD_OWN_BINDING + i].buffer = own[i] ? own[i] : j->store->transfer;
    if (makes >= 0) {
        d.bindings[3].buffer = j->store->layers.buffers[band];
        d.bindings[3].offset = (uint64_t)makes * kd_plan_layer_bytes(&j->plan->picture);
        d.bindings[3].size = kd_plan_layer_bytes(&j->plan->picture);
        if (marches(j->plan, makes))
            d.bindings[KD_LIGHT_BINDING] = (struct kd_vk_binding) { j->store->radiance.buffers[band], 0, 0, false };
    }
    return d;
}

/* The rows that can be completed after a slice was traced. Footprints also need the row of rays below, and at the
 * upper edge two rows. Rows that lack these wait until more rows are traced or the band ends. */
static struct slice complete(const struct kd_frame_job *j, const struct slice *s)
{
    if (!kd_plan_has_footprints(&j->plan->lens))
        return *s;
    uint32_t first = kd_frame_band_first(j, s->band), end = s->first + s->count, back = j->plan->lens.side == 1 ? 2 : 1;
    uint32_t from = s->first > first + back ? s->first - back : first, to = end > first + back ? end - back : first;
    return (struct slice) { s->band, from, (end == first + kd_frame_band_rows(j, s->band) ? end : to) - from };
}

/* Makes footprints. s: rows that can be completed; traced: the rows among them that were just traced. In a sampled
 * map, footprints are made for rays traced singly, and for marked rays in rows that had to wait. */
static enum kd_status footprint_slice(struct kd_frame_job *j, const struct slice *s, const struct slice *traced)
{
    const struct kd_plan *p = j->plan;
    const uint32_t first = kd_frame_band_first(j, s->band), width = p->picture.width * p->lens.side;
    struct kd_footprint_area area = {
        .lens = kd_frame_band_lens(j, s->band),
        .push = { .width = width,
                  .rows = kd_frame_band_rows(j, s->band) * p->lens.side,
                  .first = (s->first - first) * p->lens.side,
                  .end = (s->first + s->count - first) * p->lens.side,
                  .stride = width * p->picture.band_rows * p->lens.side },
    };
    if (!(p->lens.interpolates > 0))
        return kd_frame_footprint(j, &area);
    return kd_frame_footprint_sampled(j, &area, first * p->lens.side, (traced->first - first) * p->lens.side);
}

/* Traces a slice, settles the undecided rays, and completes the rows that are then ready. */
static enum kd_status map_slice(struct kd_frame_job *j, const struct slice *traced, const struct slice *whole)
{
    const struct kd_vk_pipeline *trace;
    enum kd_status status;
    KD_TRY(kd_frame_trace_kernel(j, &on_grid, &trace));
    KD_TRY(kd_frame_forget_open(j, NULL));
    KD_TRY(trace_slice(j, traced, trace));
    KD_TRY(kd_frame_settle(j, NULL, traced->band));
    if (j->plan->lens.interpolates > 0)
        kd_frame_count_sampled(j, traced->count);
    KD_TRY(footprint_slice(j, whole, traced));
done:
    return status;
}

/* Makes the slice's pixels black. */
static enum kd_status darken(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_plan *p = j->plan;
    struct kd_vk_buffer *radiance = j->store->radiance.buffers[s->band];
    uint64_t first = (uint64_t)p->picture.width * (s->first - kd_frame_band_first(j, s->band)),
             n = (uint64_t)p->picture.width * s->count;
    enum kd_status status = KD_OK;
    if (!in_columns(p) || !s->count)
        return KD_OK;
    KD_TRY(kd_vk_fill(j->r->vk, "transfer", radiance, 12 * first, 12 * n, 0, j->error));
    if (p->light.apart)
        KD_TRY(kd_vk_fill(j->r->vk, "transfer", radiance, 12ull * p->picture.width * p->picture.band_rows + 4 * first,
                          4 * n, 0, j->error));
    for (uint32_t i = 0; i < p->light.stokes_words; i++)
        KD_TRY(kd_vk_fill(j->r->vk, "transfer", radiance,
                          4ull * ((p->light.apart ? 4 : 3) + i) * p->picture.width * p->picture.band_rows + 4 * first,
                          4 * n, 0, j->error));
done:
    return status;
}

/* Records and submits the light of the slice's rows. */
static enum kd_status light_slice(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_vk_pipeline *transfer;
    enum kd_status status = darken(j, s);
    for (int makes = KD_MAKES_PICTURE; s->count && makes < (int)j->plan->picture.n_layers && !status; makes++) {
        if (makes >= 0 && kd_plan_gathers(&j->plan->light, j->plan->picture.layers[makes].kind))
            continue;
        status = kd_frame_light_kernel(j, &on_grid, makes, &transfer);
        if (status)
            break;
        struct kd_vk_dispatch d =
            kd_frame_transfer(j, transfer, kd_frame_band_lens(j, s->band), s->band, KD_CAMERA_GRID, makes);
        status = record(j, s, &d, makes);
    }
    return status ? status : kd_vk_submit(j->r->vk, NULL, j->error);
}

enum kd_status kd_frame_gather(struct kd_frame_job *j)
{
    const struct kd_vk_pipeline *pipeline;
    const struct kd_plan *p = j->plan;
    enum kd_status status = KD_OK;
    for (int makes = 0; makes < (int)p->picture.n_layers; makes++) {
        if (!kd_plan_gathers(&p->light, p->picture.layers[makes].kind))
            continue;
        KD_TRY(kd_frame_light_kernel(j, &on_grid, makes, &pipeline));
        for (uint32_t band = 0; band < p->picture.bands && kd_frame_band_lit(j, band); band++) {
            const struct slice s = { band, kd_frame_band_first(j, band), kd_frame_band_lit(j, band) };
            struct kd_vk_dispatch d =
                kd_frame_transfer(j, pipeline, kd_frame_band_lens(j, band), band, KD_CAMERA_GRID, makes);
            KD_TRY(record(j, &s, &d, makes));
        }
    }
done:
    return status;
}

/* Continues the stopped rays of a lit band. */
static enum kd_status follow_lost(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_vk_dispatch d =
        kd_frame_transfer(j, NULL, kd_frame_band_lens(j, band), band, KD_CAMERA_GRID, KD_MAKES_PICTURE);
    const struct kd_slice push = slice_of(j, band);
    const uint32_t turns = kd_frame_turns(j->plan, j->plan->lens.side * j->plan->lens.side, KD_MAKES_PICTURE);
    return kd_frame_follow_lost(j, &d, &push, &on_grid, turns);
}

/* Lights rows whose map is recorded or made, and reports their progress. A slice of a sampled map has at least the
 * rows of a block. So its light may take several submissions. map_ns, light_ns: time for the map and for the light of
 * a row of pixels, in ns. */
static enum kd_status light_rows(struct kd_frame_job *j, const struct slice *whole, double map_ns, double light_ns)
{
    struct slice part = *whole;
    uint32_t left = whole->count;
    enum kd_status status;
    do {
        const uint32_t most = left ? kd_frame_slice(j, light_ns, left) : 1, parts = (left + most - 1) / most;
        part.count = parts ? (left + parts - 1) / parts : 0; /* the rest is divided into parts of equal size */
        j->r->slice_pace.expected_ms = 1e-6 * (light_ns * part.count + (left == whole->count ? map_ns * left : 0));
        KD_TRY(light_slice(j, &part));
        part.first += part.count;
        left -= part.count;
        j->lit = part.first;
        KD_TRY(kd_frame_report(j, map_ns > 0 ? 2 * part.count : part.count));
    } while (left);
done:
    return status;
}

/* Lights a band slice by slice, so that a long picture can be previewed. light_ns: time in ns for
 * the light of a ray. */
static enum kd_status light_band(struct kd_frame_job *j, uint32_t band, bool needed, double light_ns)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    const double rays = (double)p->picture.width * p->lens.side * p->lens.side,
                 map_ns = needed ? kd_plan_map_ns(p) * rays : 0, ns_per_row = map_ns + light_ns * rays;
    enum kd_status status = KD_OK;
    for (uint32_t row = 0, step; row < rows && !status; row += step) {
        step = rows_of_slice(j, band, row, ns_per_row, needed);
        const struct slice s = { band, first + row, step };
        const struct slice whole = needed ? complete(j, &s) : s;
        if (needed)
            KD_TRY(map_slice(j, &s, &whole));
        KD_TRY(light_rows(j, &whole, map_ns, light_ns * rays));
    }
    KD_TRY(follow_lost(j, band));
done:
    return status;
}

/* Lights the pixels at the critical curve, each with its additional rays. */
static enum kd_status light_at_curve(struct kd_frame_job *j, bool needed)
{
    enum kd_status status = KD_OK;
    if (needed) {
        kd_critical_pixels_finish(&j->lens->pixels);
        status = kd_critical_cache(j->scene, &j->lens->pixels, j->error);
    }
    const struct kd_frame_list list = {
        .pixels = &j->lens->pixels,
        .camera = KD_CAMERA_CRITICAL,
        .lattice = kd_critical_lattice(j->plan->lens.critical),
        .most = j->plan->lens.critical_part,
        .buffers = j->lens->critical.buffers,
        .layers = true,
    };
    return status ? status : kd_frame_light_list(j, &list, needed);
}

/* Makes only the map of a band. */
static enum kd_status map_band(struct kd_frame_job *j, uint32_t band, double ns)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    const double ns_per_row = ns * p->picture.width * p->lens.side * p->lens.side;
    enum kd_status status = KD_OK;
    for (uint32_t row = 0, step; row < rows && !status; row += step) {
        step = rows_of_slice(j, band, row, ns_per_row, true);
        const struct slice s = { band, first + row, step }, whole = complete(j, &s);
        KD_TRY(map_slice(j, &s, &whole));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, s.count));
    }
done:
    return status;
}

/* Lights all bands. Points of light need the complete map of a band before the light of that band is made. If all maps
 * are cached, points of light also need the maps of the adjacent bands. */
static enum kd_status light_bands(struct kd_frame_job *j, bool needed, double transfer_ns)
{
    const struct kd_plan *p = j->plan;
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; p->light.points && needed && p->lens.cacheable && band < p->picture.bands; band++)
        KD_TRY(map_band(j, band, kd_plan_map_ns(p)));
    for (uint32_t band = 0; band < p->picture.bands; band++) {
        if (p->light.points && needed && !p->lens.cacheable)
            KD_TRY(map_band(j, band, kd_plan_map_ns(p)));
        if (p->light.points)
            KD_TRY(kd_frame_stars(j, band));
        KD_TRY(light_band(j, band, needed && !p->light.points, transfer_ns));
        KD_TRY(kd_frame_probe(j, band));
        KD_TRY(kd_frame_sample_march(j, band));
    }
done:
    return status;
}

enum kd_status kd_frame_light(struct kd_frame_job *j, bool reused)
{
    struct kd_capacity c;
    kd_renderer_capacity(j->r, &c);
    const struct kd_plan *p = j->plan;
    bool needed = !reused && p->lens.planes;
    enum kd_status status = KD_OK;
    kd_slice_begin(&j->r->slice_pace, kd_clock_ms());
    KD_TRY(light_bands(j, needed, kd_plan_light_ns(&p->light, &c)));
    if (p->lens.critical)
        KD_TRY(light_at_curve(j, !reused));
done:
    return status;
}

/* Copies one band of the lens map to its place in each plane. */
static enum kd_status read_band(struct kd_frame_job *j, uint32_t band, struct kd_vk_buffer *host, float *planes)
{
    const struct kd_plan *p = j->plan;
    struct kd_vk *vk = j->r->vk;
    uint64_t row = (uint64_t)p->picture.width * p->lens.side * p->lens.side, stride = row * p->picture.band_rows;
    uint64_t first = row * kd_frame_band_first(j, band), rays = row * kd_frame_band_rows(j, band);
    enum kd_status status = KD_OK;
    for (uint32_t plane = 0; plane < p->lens.planes; plane++) {
        KD_TRY(
            kd_vk_copy(vk, "readback", host, 0, kd_frame_band_lens(j, band), 4 * plane * stride, 4 * rays, j->error));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
        memcpy(planes + plane * p->lens.rays + first, kd_vk_buffer_map(host), 4 * rays);
    }
done:
    return status;
}

enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error)
{
    struct kd_frame_job job = {
        .r = renderer,
        .store = &renderer->store,
        .scene = scene,
        .plan = plan,
        .weight = 1,
        .error = error,
    };
    struct kd_vk_buffer *host = NULL;
    bool reused;
    kd_vk_times_reset(renderer->vk);
    enum kd_status status;
    KD_TRY(kd_store_lens_map(&renderer->store, plan, &job.lens, &reused, error));
    KD_TRY(kd_vk_buffer_create(renderer->vk,
                               4ull * plan->picture.width * plan->lens.side * plan->lens.side * plan->picture.band_rows,
                               KD_VK_READBACK, "lens map on the host", &host, error));
    KD_TRY(kd_frame_send_cameras(&job));
    for (uint32_t band = 0; band < plan->picture.bands; band++) {
        uint32_t rows = kd_frame_band_rows(&job, band);
        const double ns_per_row = kd_plan_map_ns(plan) * plan->picture.width * plan->lens.side * plan->lens.side;
        for (uint32_t done = 0, step; done < rows && !status; done += step) {
            step = rows_of_slice(&job, band, done, ns_per_row, true);
            const struct slice s = { band, kd_frame_band_first(&job, band) + done, step };
            const struct slice whole = complete(&job, &s);
            KD_TRY(map_slice(&job, &s, &whole));
            KD_TRY(kd_vk_submit(renderer->vk, NULL, error));
        }
        KD_TRY(status);
        KD_TRY(read_band(&job, band, host, planes));
    }
done:
    if (status) {
        kd_vk_discard(renderer->vk);
        kd_store_give_up(&renderer->store);
    }
    kd_vk_buffer_destroy(renderer->vk, host);
    struct kd_vk_time times[KD_VK_MAX_PASSES];
    size_t n = kd_vk_times(renderer->vk, times);
    for (size_t i = 0; i < n && trace_ms; i++)
        if (!strcmp(times[i].pass, kd_passes[KD_PASS_TRACE].name))
            *trace_ms = times[i].ms;
    return status;
}
