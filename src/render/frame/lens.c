/* The part of a frame that follows rays: the lens map and the light that it brings, band by band, in short submissions. */
#include "render/frame/job.h"

#include "render/view/camera.h"
#include "render/view/critical_kept.h"
#include "render/lens/listed.h"
#include "render/device/prepare.h"
#include "base/clock.h"

#include <math.h>
#include <string.h>

#define SLICE_MS 40.0 /* of device time a submission: short enough for progress, fairness and a driver's watchdog */

static const struct kd_critical_lattice on_grid; /* none */

/* Kernels are looked up for each slice: while others had the device theirs may have taken their places. */

/* Rows of pixels that one submission takes, given nanoseconds a row. */
static uint32_t slice_rows(double ns_per_row, uint32_t rows)
{
    double n = SLICE_MS * 1e6 / fmax(ns_per_row, 1);
    return n < 1 ? 1 : n > rows ? rows : (uint32_t)n;
}

/* NULL where no kernel is run for it. l: of the listed pixels; all 0: for the grid. */
static enum kd_status trace_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l, const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    *out = NULL;
    if (p->path == KD_LENS_LISTED)
        return KD_OK;
    if (p->path == KD_LENS_CLOSED) {
        const struct kd_spec_lens_closed spec = {
            .QUANTITIES = p->quantities, .ORDERS = p->orders, .SIGHT = kd_camera_sight(j->scene),
            .CRITICAL = l->rays, .GENERATOR = l->generator, .SHIFT = l->shift,
        };
        return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_CLOSED, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
    }
    const struct kd_spec_lens_map spec = {
        .QUANTITIES = p->quantities, .ORDERS = p->orders, .STEPS = p->setting.steps,
        .METHOD = p->setting.engine == KD_ENGINE_MINO_RKN4 ? 4 : 6, .SIGHT = kd_camera_sight(j->scene),
        .CRITICAL = l->rays, .GENERATOR = l->generator, .SHIFT = l->shift, .INGOING = p->ingoing,
    };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_MAP, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* What a kernel makes: rays, the light of the picture, or the plan's layer of that number. */
enum { RAYS = -2, PICTURE = -1 };

static enum kd_status transfer_kernel(struct kd_frame_job *j, const struct kd_critical_lattice *l, int layer, const struct kd_vk_pipeline **out)
{
    const enum kd_kernel kernel = layer < 0 ? KD_KERNEL_TRANSFER : KD_KERNEL_LAYERS;
    const struct kd_plan *p = j->plan;
    struct kd_spec_transfer spec = {
        .QUANTITIES = p->quantities, .ORDERS = p->orders, .SIDE = p->side, .SIGHT = kd_camera_sight(j->scene),
        .CRITICAL = l->rays, .GENERATOR = l->generator, .SHIFT = l->shift,
        .ORDER = KD_NO_ORDER,
    };
    if (layer >= 0)
        spec.LAYER = (uint32_t)p->layers[layer].kind;
    if (layer >= 0 && p->layers[layer].order >= 0)
        spec.ORDER = (uint32_t)p->layers[layer].order;
    memcpy(spec.traits, p->traits, sizeof spec.traits);
    return kd_kernels_get(&j->r->kernels, j->r->vk, kernel, &spec.QUANTITIES, sizeof spec / 4, out, j->error);
}

/* Rows of pixels of a band, traced and lit in one go. */
struct slice { uint32_t band, first, count; };

/* Whether the transfer kernel goes through columns of pixels, and leaves those without light as they are. */
static bool in_columns(const struct kd_plan *p) { return p->side == 1 && !p->ends; }

enum kd_status kd_frame_send_cameras(struct kd_frame_job *j)
{
    const struct kd_scene critical = kd_critical_camera(j->scene, j->plan->critical ? j->plan->critical : 1);
    const struct kd_camera_block cameras[] = {
        [KD_CAMERA_GRID] = kd_camera_block(j->scene), [KD_CAMERA_CRITICAL] = kd_camera_block(&critical),
    };
    return kd_store_send_cameras(j->store, cameras, j->error);
}

static struct kd_vk_binding camera_binding(const struct kd_frame_job *j, int camera)
{
    return (struct kd_vk_binding) { j->store->cameras, (uint64_t)camera * KD_CAMERA_BYTES, KD_CAMERA_BYTES, false };
}

/* Record the kernel that makes something over a slice: of RAYS the grid is theirs, else that of the pixels. */
static enum kd_status record(struct kd_frame_job *j, const struct slice *s, struct kd_vk_dispatch *d, int makes)
{
    const bool rays = makes == RAYS, columns = makes == PICTURE && in_columns(j->plan);
    const struct kd_plan *p = j->plan;
    const struct kd_slice push = {
        .row0 = s->first * p->side, .rows = s->count * p->side, .band0 = kd_frame_band_first(j, s->band) * p->side,
        .stride = p->width * p->side * p->band_rows * p->side,
    };
    d->push = &push;
    d->groups[0] = kd_frame_groups(rays ? (uint64_t)p->width * p->side : p->width);
    d->groups[1] = rays ? push.rows : columns ? (s->count + KD_TRANSFER_ROWS - 1) / KD_TRANSFER_ROWS : s->count;
    return kd_vk_dispatch(j->r->vk, d, j->error);
}

static enum kd_status list_rays(struct kd_frame_job *j, const struct kd_lens_rows *rows)
{
    double start = kd_clock_ms();
    enum kd_status status = kd_lens_listed(j->r, j->scene, j->plan, rows, &j->undecided, j->error);
    j->listed_ms += kd_clock_ms() - start;
    return status;
}

static enum kd_status list_slice(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_plan *p = j->plan;
    uint64_t width = (uint64_t)p->width * p->side;
    const struct kd_lens_rows rows = {
        .first = s->first * p->side, .count = s->count * p->side, .to = kd_frame_band_lens(j, s->band),
        .offset = (s->first - kd_frame_band_first(j, s->band)) * p->side * width, .stride = width * p->band_rows * p->side,
    };
    return list_rays(j, &rows);
}

static struct kd_vk_dispatch trace_dispatch(const struct kd_frame_job *j, const struct kd_vk_pipeline *pipeline, struct kd_vk_buffer *lens,
                                            int camera)
{
    return (struct kd_vk_dispatch) {
        kd_passes[KD_PASS_TRACE].name,
        pipeline,
        { { lens, 0, 0, true }, { j->store->undecided, 0, 0, true }, camera_binding(j, camera) },
        NULL,
        { 0 },
    };
}

/* pipeline: of trace_kernel. */
static enum kd_status trace_slice(struct kd_frame_job *j, const struct slice *s, const struct kd_vk_pipeline *pipeline)
{
    if (j->plan->path == KD_LENS_LISTED)
        return list_slice(j, s);
    struct kd_vk_dispatch d = trace_dispatch(j, pipeline, kd_frame_band_lens(j, s->band), KD_CAMERA_GRID);
    return record(j, s, &d, RAYS);
}

static struct kd_vk_dispatch transfer_dispatch(const struct kd_frame_job *j, const struct kd_vk_pipeline *pipeline,
                                               struct kd_vk_buffer *lens, uint32_t band, int camera, int makes)
{
    struct kd_vk_buffer *own[KD_OWN_COUNT];
    struct kd_vk_dispatch d = {
        kd_passes[makes < 0 ? KD_PASS_TRANSFER : KD_PASS_LAYERS].name,
        pipeline,
        { { lens, 0, 0, false },
          { j->store->transfer, 0, sizeof(struct kd_emission), false },
          { j->store->transfer, offsetof(struct kd_emit_data, tables), sizeof(struct kd_emit_tables), false },
          { j->store->radiance.buffers[band], 0, 0, true },
          camera_binding(j, camera) },
        NULL,
        { 0 },
    };
    kd_prepared_buffers(j->prepared, j->plan, own);
    own[KD_OWN_point_light] = j->plan->points ? j->store->star_light.buffers[band] : NULL; /* stars.c has made it, band by band */
    for (int i = 0; i < KD_OWN_COUNT; i++) /* something must be bound where nothing is read */
        d.bindings[KD_OWN_BINDING + i].buffer = own[i] ? own[i] : j->store->transfer;
    if (makes >= 0) {
        d.bindings[3].buffer = j->store->layers.buffers[band];
        d.bindings[3].offset = (uint64_t)makes * kd_plan_layer_bytes(j->plan);
        d.bindings[3].size = kd_plan_layer_bytes(j->plan);
    }
    return d;
}

/* Of a slice that was just traced, the rows that can be finished. Footprints need the row of rays below too, and two at the upper edge:
 * they are held back by so much, until the band ends. */
static struct slice complete(const struct kd_frame_job *j, const struct slice *s)
{
    if (!kd_plan_has_footprints(j->plan))
        return *s;
    uint32_t first = kd_frame_band_first(j, s->band), end = s->first + s->count, back = j->plan->side == 1 ? 2 : 1;
    uint32_t from = s->first > first + back ? s->first - back : first, to = end > first + back ? end - back : first;
    return (struct slice) { s->band, from, (end == first + kd_frame_band_rows(j, s->band) ? end : to) - from };
}

static enum kd_status footprint_slice(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_plan *p = j->plan;
    const uint32_t row0 = s->first - kd_frame_band_first(j, s->band), width = p->width * p->side;
    const struct kd_footprint_area area = {
        .lens = kd_frame_band_lens(j, s->band),
        .push = { .width = width, .rows = kd_frame_band_rows(j, s->band) * p->side, .first = row0 * p->side,
                  .end = (row0 + s->count) * p->side, .stride = width * p->band_rows * p->side },
    };
    return kd_frame_footprint(j, &area);
}

/* Trace a slice, and finish what then can be. */
static enum kd_status map_slice(struct kd_frame_job *j, const struct slice *traced, const struct slice *whole)
{
    const struct kd_vk_pipeline *trace;
    enum kd_status status = trace_kernel(j, &on_grid, &trace);
    if (!status)
        status = trace_slice(j, traced, trace);
    return status ? status : footprint_slice(j, whole);
}

/* Make those pixels dark. */
static enum kd_status darken(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_plan *p = j->plan;
    struct kd_vk_buffer *radiance = j->store->radiance.buffers[s->band];
    uint64_t first = (uint64_t)p->width * (s->first - kd_frame_band_first(j, s->band)), n = (uint64_t)p->width * s->count;
    enum kd_status status = KD_OK;
    if (!in_columns(p))
        return KD_OK;
    KD_TRY(kd_vk_fill(j->r->vk, "transfer", radiance, 12 * first, 12 * n, 0, j->error));
    if (p->apart)
        KD_TRY(kd_vk_fill(j->r->vk, "transfer", radiance, 12ull * p->width * p->band_rows + 4 * first, 4 * n, 0, j->error));
done:
    return status;
}

/* Record and submit; s: what is lit. */
static enum kd_status light_slice(struct kd_frame_job *j, const struct slice *s)
{
    const struct kd_vk_pipeline *transfer;
    enum kd_status status = darken(j, s);
    for (int makes = PICTURE; s->count && makes < (int)j->plan->n_layers && !status; makes++) {
        status = transfer_kernel(j, &on_grid, makes, &transfer);
        if (status)
            break;
        struct kd_vk_dispatch d = transfer_dispatch(j, transfer, kd_frame_band_lens(j, s->band), s->band, KD_CAMERA_GRID, makes);
        status = record(j, s, &d, makes);
    }
    return status ? status : kd_vk_submit(j->r->vk, NULL, j->error);
}

/* A band, slice by slice, so that what is done of a long picture can be looked at. ns: of a ray. */
static enum kd_status light_band(struct kd_frame_job *j, uint32_t band, bool needed, double ns)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    uint32_t step = slice_rows(ns * p->width * p->side * p->side, rows);
    enum kd_status status = KD_OK;
    for (uint32_t row = 0; row < rows; row += step) {
        const struct slice s = { band, first + row, rows - row < step ? rows - row : step };
        const struct slice whole = needed ? complete(j, &s) : s;
        if (needed)
            KD_TRY(map_slice(j, &s, &whole));
        KD_TRY(light_slice(j, &whole));
        j->lit = whole.first + whole.count;
        KD_TRY(kd_frame_report(j, needed ? 2 * whole.count : whole.count));
    }
done:
    return status;
}

/* A part of the pixels at the critical curve. */
struct part {
    uint64_t first, n; /* among those pixels */
    struct kd_vk_buffer *lens;
    struct kd_slice push;
};

static struct part part_of(const struct kd_frame_job *j, uint32_t number)
{
    const struct kd_plan *p = j->plan;
    struct part part = { number * p->critical_part, p->critical_part, j->lens->critical.buffers[number], { 0 } };
    if (part.n > p->critical_pixels - part.first)
        part.n = p->critical_pixels - part.first;
    part.push.stride = (uint32_t)p->critical_part * p->critical;
    part.push.list = p->planes * part.push.stride;
    return part;
}

/* Run the kernel that makes something over pixels `from` to `to` of a part in slices: RAYS are an invocation each, else pixels. base: the dispatch but for its pipeline and size. */
static enum kd_status run_part(struct kd_frame_job *j, const struct part *part, uint64_t from, uint64_t to,
                               const struct kd_vk_dispatch *base, int makes, double ns_per_ray)
{
    const struct kd_critical_lattice lattice = kd_critical_lattice(j->plan->critical);
    uint32_t step = slice_rows(ns_per_ray * j->plan->critical, (uint32_t)part->n);
    enum kd_status status = KD_OK;
    for (; from < to; from += step) {
        struct kd_slice push = part->push;
        struct kd_vk_dispatch d = *base;
        push.row0 = (uint32_t)from;
        push.rows = (uint32_t)(to - from < step ? to - from : step);
        d.push = &push;
        d.groups[0] = kd_frame_groups(makes == RAYS ? (uint64_t)push.rows * j->plan->critical : push.rows);
        d.groups[1] = 1;
        KD_TRY(makes == RAYS ? trace_kernel(j, &lattice, &d.pipeline) : transfer_kernel(j, &lattice, makes, &d.pipeline));
        KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

/* The list behind the planes. */
static enum kd_status upload_pixels(struct kd_frame_job *j, const struct part *part)
{
    struct kd_vk_buffer *staging;
    struct kd_vk *vk = j->r->vk;
    uint64_t bytes = 8 * part->n;
    enum kd_status status = kd_vk_buffer_create(vk, bytes, KD_VK_UPLOAD, "pixels at the critical curve", &staging, j->error);
    if (status)
        return status;
    float *to = kd_vk_buffer_map(staging);
    for (uint64_t i = 0; i < part->n; i++) {
        to[2 * i] = (float)j->lens->pixels.pixels[part->first + i].x;
        to[2 * i + 1] = (float)j->lens->pixels.pixels[part->first + i].y;
    }
    status = kd_vk_copy(vk, "upload", part->lens, 4ull * part->push.list, staging, 0, bytes, j->error);
    kd_vk_buffer_destroy(vk, staging);
    return status;
}

static enum kd_status list_part(struct kd_frame_job *j, const struct part *part)
{
    const struct kd_plan *p = j->plan;
    uint32_t step = slice_rows(p->trace_ns * p->critical, (uint32_t)part->n);
    enum kd_status status = KD_OK;
    for (uint64_t from = 0; from < part->n; from += step) {
        const struct kd_lens_rows rows = {
            .first = (uint32_t)(part->first + from), .count = (uint32_t)(part->n - from < step ? part->n - from : step),
            .pixels = j->lens->pixels.pixels, .to = part->lens, .offset = from * p->critical, .stride = part->push.stride,
        };
        KD_TRY(list_rays(j, &rows));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

/* Footprints of a part that is traced, in slices. */
static enum kd_status footprint_part(struct kd_frame_job *j, const struct part *part)
{
    const struct kd_critical_lattice lattice = kd_critical_lattice(j->plan->critical);
    struct kd_footprint_area area = { .lens = part->lens, .lattice = &lattice, .push = { .rows = (uint32_t)part->n, .list = part->push.list, .stride = part->push.stride } };
    const uint32_t rays = (uint32_t)(part->n * j->plan->critical), step = slice_rows(j->plan->trace_ns, rays);
    enum kd_status status = KD_OK;
    for (uint32_t from = 0; kd_plan_has_footprints(j->plan) && from < rays; from += step) {
        area.push.first = from;
        area.push.end = from + (rays - from < step ? rays - from : step);
        KD_TRY(kd_frame_footprint(j, &area));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, 0));
    }
done:
    return status;
}

static enum kd_status trace_part(struct kd_frame_job *j, const struct part *part)
{
    enum kd_status status = upload_pixels(j, part);
    if (status || j->plan->path == KD_LENS_LISTED)
        return status ? status : list_part(j, part);
    const struct kd_vk_dispatch d = trace_dispatch(j, NULL, part->lens, KD_CAMERA_CRITICAL);
    return run_part(j, part, 0, part->n, &d, RAYS, j->plan->trace_ns);
}

/* A pixel's light is written anew, for the picture or a layer of light. */
static enum kd_status transfer_part(struct kd_frame_job *j, struct part *part, int makes, double ns)
{
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->bands && !status; band++) {
        uint32_t row = kd_frame_band_first(j, band);
        uint64_t from = kd_critical_pixels_above(&j->lens->pixels, row), first = part->first;
        uint64_t to = kd_critical_pixels_above(&j->lens->pixels, row + kd_frame_band_rows(j, band));
        from = from > first ? from - first : 0;
        to = to < first ? 0 : to - first < part->n ? to - first : part->n;
        const struct kd_vk_dispatch d = transfer_dispatch(j, NULL, part->lens, band, KD_CAMERA_CRITICAL, makes);
        part->push.band0 = row;
        status = run_part(j, part, from, to, &d, makes, ns);
    }
    return status;
}

/* The pixels at the critical curve, by more rays than the others. */
static enum kd_status light_at_curve(struct kd_frame_job *j, bool needed, double transfer_ns)
{
    const struct kd_plan *p = j->plan;
    enum kd_status status = KD_OK;
    if (needed) {
        kd_critical_pixels_finish(&j->lens->pixels);
        KD_TRY(kd_critical_kept(j->scene, &j->lens->pixels, j->error));
    }
    for (uint32_t k = 0; k < kd_plan_critical_parts(p); k++) {
        struct part part = part_of(j, k);
        if (needed)
            KD_TRY(trace_part(j, &part));
        if (needed)
            KD_TRY(footprint_part(j, &part));
        for (int makes = PICTURE; makes < (int)p->n_layers; makes++)
            if (makes == PICTURE || kd_layer_kinds[p->layers[makes].kind].of == KD_OF_LIGHT)
                KD_TRY(transfer_part(j, &part, makes, transfer_ns));
    }
done:
    return status;
}

static enum kd_status forget_undecided(struct kd_frame_job *j)
{
    return j->plan->path != KD_LENS_LISTED ? kd_vk_fill(j->r->vk, "trace", j->store->undecided, 0, 16, 0, j->error) : KD_OK;
}

/* The map of a band alone. */
static enum kd_status map_band(struct kd_frame_job *j, uint32_t band, double ns)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    uint32_t step = slice_rows(ns * p->width * p->side * p->side, rows);
    enum kd_status status = KD_OK;
    for (uint32_t row = 0; row < rows; row += step) {
        const struct slice s = { band, first + row, rows - row < step ? rows - row : step }, whole = complete(j, &s);
        KD_TRY(map_slice(j, &s, &whole));
        KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
        KD_TRY(kd_frame_report(j, s.count));
    }
done:
    return status;
}

/* Points of light need the whole map of a band before its light, and of the bands next to it where all are kept. */
static enum kd_status light_bands(struct kd_frame_job *j, bool needed, double transfer_ns)
{
    const struct kd_plan *p = j->plan;
    double ns = transfer_ns + (needed ? p->trace_ns : 0);
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; p->points && needed && p->cacheable && band < p->bands; band++)
        KD_TRY(map_band(j, band, p->trace_ns));
    for (uint32_t band = 0; band < p->bands; band++) {
        if (p->points && needed && !p->cacheable)
            KD_TRY(map_band(j, band, p->trace_ns));
        if (p->points)
            KD_TRY(kd_frame_stars(j, band));
        KD_TRY(light_band(j, band, needed && !p->points, p->points ? transfer_ns : ns));
    }
done:
    return status;
}

enum kd_status kd_frame_light(struct kd_frame_job *j, bool reused)
{
    struct kd_capacity c;
    kd_renderer_capacity(j->r, &c);
    const struct kd_plan *p = j->plan;
    bool needed = !reused && p->planes;
    enum kd_status status = KD_OK;
    if (needed)
        KD_TRY(forget_undecided(j));
    KD_TRY(light_bands(j, needed, c.ns[KD_NS_SAMPLE_TRANSFER]));
    if (p->critical)
        KD_TRY(light_at_curve(j, needed, c.ns[KD_NS_SAMPLE_TRANSFER]));
done:
    return status;
}

/* Rays of the whole map that were given up. */
enum kd_status kd_frame_undecided(struct kd_frame_job *j, uint64_t *out)
{
    struct kd_store *s = j->store;
    struct kd_vk *vk = j->r->vk;
    *out = j->undecided;
    if (j->plan->path == KD_LENS_LISTED || !kd_plan_holds(j->plan, KD_LENS_SKY))
        return KD_OK;
    enum kd_status status;
    KD_TRY(kd_vk_copy(vk, "readback", s->counts, 0, s->undecided, 0, 16, j->error));
    KD_TRY(kd_vk_submit(vk, NULL, j->error));
    KD_TRY(kd_vk_wait(vk, 0, j->error));
    *out = *(const uint32_t *)kd_vk_buffer_map(s->counts);
done:
    return status;
}

/* Copy one band of the lens map to its place in each plane. */
static enum kd_status read_band(struct kd_frame_job *j, uint32_t band, struct kd_vk_buffer *host, float *planes)
{
    const struct kd_plan *p = j->plan;
    struct kd_vk *vk = j->r->vk;
    uint64_t row = (uint64_t)p->width * p->side * p->side, stride = row * p->band_rows;
    uint64_t first = row * kd_frame_band_first(j, band), rays = row * kd_frame_band_rows(j, band);
    enum kd_status status = KD_OK;
    for (uint32_t plane = 0; plane < p->planes; plane++) {
        KD_TRY(kd_vk_copy(vk, "readback", host, 0, kd_frame_band_lens(j, band), 4 * plane * stride, 4 * rays, j->error));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
        memcpy(planes + plane * p->rays + first, kd_vk_buffer_map(host), 4 * rays);
    }
done:
    return status;
}

enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error)
{
    struct kd_frame_job job = {
        .r = renderer, .store = &renderer->store, .scene = scene, .plan = plan, .weight = 1, .error = error,
    };
    struct kd_vk_buffer *host = NULL;
    bool reused;
    kd_vk_times_reset(renderer->vk);
    enum kd_status status;
    KD_TRY(kd_store_lens_map(&renderer->store, plan, &job.lens, &reused, error));
    KD_TRY(kd_vk_buffer_create(renderer->vk, 4ull * plan->width * plan->side * plan->side * plan->band_rows, KD_VK_READBACK,
                               "lens map on the host", &host, error));
    KD_TRY(kd_frame_send_cameras(&job));
    KD_TRY(forget_undecided(&job));
    for (uint32_t band = 0; band < plan->bands; band++) {
        uint32_t rows = kd_frame_band_rows(&job, band);
        uint32_t step = slice_rows(plan->trace_ns * plan->width * plan->side * plan->side, rows);
        for (uint32_t row = 0; row < rows; row += step) {
            const struct slice s = { band, kd_frame_band_first(&job, band) + row, rows - row < step ? rows - row : step };
            const struct slice whole = complete(&job, &s);
            KD_TRY(map_slice(&job, &s, &whole));
            KD_TRY(kd_vk_submit(renderer->vk, NULL, error));
        }
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
