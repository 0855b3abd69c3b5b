/* The part of a frame that follows rays: the lens map and the light that it brings, band by band, in short submissions. */
#include "render/frame_job.h"

#include "render/camera.h"
#include "render/lens_listed.h"

#include <math.h>
#include <string.h>

#define SLICE_MS 40.0 /* of device time a submission: short enough for progress, fairness and a driver's watchdog */

static struct kd_vk_buffer *lens_buffer(const struct kd_frame_job *j, uint32_t band)
{
    return j->lens->bands.buffers[j->plan->cacheable ? band : 0];
}

/* Rows of pixels that one submission takes, given nanoseconds a row. */
static uint32_t slice_rows(double ns_per_row, uint32_t rows)
{
    double n = SLICE_MS * 1e6 / fmax(ns_per_row, 1);
    return n < 1 ? 1 : n > rows ? rows : (uint32_t)n;
}

/* NULL where no kernel is run for it. */
static enum kd_status trace_kernel(struct kd_frame_job *j, const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    *out = NULL;
    if (p->path == KD_LENS_LISTED)
        return KD_OK;
    if (p->path == KD_LENS_RADIUS)
        return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_RADIUS, (uint32_t[]){ p->orders }, 1, out,
                              j->error);
    enum kd_status status = kd_vk_fill(j->r->vk, j->store->undecided, 0, 16, 0, j->error);
    if (status)
        return status;
    const uint32_t method = p->setting.engine == KD_ENGINE_MINO_RKN4 ? 4 : 6;
    const uint32_t constants[] = { p->orders, p->setting.steps, !isinf(j->scene->camera.r), p->phi, p->sky, method, p->fall };
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_LENS_MAP, constants, 7, out, j->error);
}

static enum kd_status transfer_kernel(struct kd_frame_job *j, const struct kd_vk_pipeline **out)
{
    const struct kd_plan *p = j->plan;
    const struct kd_disk *d = &j->scene->disk;
    const uint32_t alpha = p->orders * (1 + p->phi + p->delay + p->fall); /* the planes' order: kd_lens_listed */
    const uint32_t constants[] = {
        p->orders, p->side, !isinf(j->scene->camera.r), d->model != KD_DISK_NONE, p->sky,
        alpha + p->ring, d->doppler, d->redshift, d->band == KD_BAND_VISIBLE, d->opacity >= 1, p->ring, alpha,
        p->particles.count > 0, p->delay, p->spots, j->scene->style.ringdown > 0, p->fall,
    };
    _Static_assert(sizeof constants <= sizeof(uint32_t[KD_KERNEL_MAX_CONSTANTS]), "more than a kernel may have");
    return kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_TRANSFER, constants, sizeof constants / 4, out, j->error);
}

/* Run a kernel over the rows of a band in slices. rays: the grid is that of the rays, not of the pixels. */
static enum kd_status run_band(struct kd_frame_job *j, uint32_t band, const struct kd_vk_dispatch *base, bool rays,
                               double ns_per_ray)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    double row_ns = ns_per_ray * p->width * p->side * p->side;
    uint32_t step = slice_rows(row_ns, rows);
    for (uint32_t done = 0; done < rows; done += step) {
        uint32_t n = rows - done < step ? rows - done : step;
        struct kd_camera_push push = j->camera;
        push.row0 = (first + done) * p->side;
        push.rows = n * p->side;
        push.band0 = first * p->side;
        push.stride = p->width * p->side * p->band_rows * p->side;
        struct kd_vk_dispatch d = *base;
        d.push = &push;
        d.groups[0] = kd_frame_groups(rays ? (uint64_t)p->width * p->side : p->width);
        d.groups[1] = rays ? push.rows : n;
        enum kd_status status = kd_vk_dispatch(j->r->vk, &d, j->error);
        if (!status)
            status = kd_vk_submit(j->r->vk, NULL, j->error);
        if (!status)
            status = kd_frame_report(j, n);
        if (status)
            return status;
    }
    return KD_OK;
}

static enum kd_status list_band(struct kd_frame_job *j, uint32_t band)
{
    const struct kd_plan *p = j->plan;
    uint32_t first = kd_frame_band_first(j, band) * p->side, rows = kd_frame_band_rows(j, band) * p->side;
    uint64_t width = (uint64_t)p->width * p->side;
    uint32_t step = slice_rows(p->trace_ns * (double)width, rows);
    enum kd_status status = KD_OK;
    double start = kd_render_now_ms();
    for (uint32_t done = 0; done < rows && !status; done += step) {
        const struct kd_lens_rows part = {
            .first = first + done, .count = rows - done < step ? rows - done : step, .to = lens_buffer(j, band),
            .offset = done * width, .stride = width * p->band_rows * p->side,
        };
        status = kd_lens_listed(j->r, j->scene, p, &part, &j->undecided, j->error);
        if (!status)
            status = kd_frame_report(j, (double)part.count / p->side);
    }
    j->listed_ms += kd_render_now_ms() - start;
    return status;
}

/* pipeline: of trace_kernel. */
static enum kd_status trace_band(struct kd_frame_job *j, uint32_t band, const struct kd_vk_pipeline *pipeline)
{
    const struct kd_plan *p = j->plan;
    if (p->path == KD_LENS_LISTED)
        return list_band(j, band);
    struct kd_vk_dispatch d = { "trace", pipeline, { { lens_buffer(j, band), 0, 0, true } }, NULL, { 0 } };
    if (p->path == KD_LENS_MAP)
        d.bindings[1] = (struct kd_vk_binding) { j->store->undecided, 0, 0, true };
    return run_band(j, band, &d, true, p->trace_ns);
}

static enum kd_status transfer_band(struct kd_frame_job *j, uint32_t band, const struct kd_vk_pipeline *pipeline, double ns)
{
    const struct kd_vk_dispatch d = {
        "transfer",
        pipeline,
        { { lens_buffer(j, band), 0, 0, false },
          { j->store->transfer, 0, 0, false },
          { j->store->radiance.buffers[band], 0, 0, true },
          { j->plan->particles.count ? j->particles->density : j->store->transfer, 0, 0, false } },
        NULL,
        { 0 },
    };
    return run_band(j, band, &d, false, ns);
}

enum kd_status kd_frame_light(struct kd_frame_job *j, bool reused)
{
    struct kd_capacity c;
    kd_renderer_capacity(j->r, &c);
    const struct kd_plan *p = j->plan;
    const struct kd_vk_pipeline *trace = NULL, *transfer;
    bool needed = !reused && p->planes;
    enum kd_status status = needed ? trace_kernel(j, &trace) : KD_OK;
    if (!status)
        status = transfer_kernel(j, &transfer);
    for (uint32_t band = 0; band < p->bands && !status; band++) {
        if (needed)
            status = trace_band(j, band, trace);
        if (!status)
            status = transfer_band(j, band, transfer, c.ns_per_sample_transfer);
    }
    return status;
}

/* Rays of the whole map that were given up. */
enum kd_status kd_frame_undecided(struct kd_frame_job *j, uint64_t *out)
{
    struct kd_store *s = j->store;
    struct kd_vk *vk = j->r->vk;
    *out = j->undecided;
    if (j->plan->path != KD_LENS_MAP || !j->plan->sky)
        return KD_OK;
    enum kd_status status = kd_vk_copy(vk, "readback", s->counts, 0, s->undecided, 0, 16, j->error);
    if (!status)
        status = kd_vk_submit(vk, NULL, j->error);
    if (!status)
        status = kd_vk_wait(vk, 0, j->error);
    if (!status)
        *out = *(const uint32_t *)kd_vk_buffer_map(s->counts);
    return status;
}

/* Copy one band of the lens map to its place in each plane. */
static enum kd_status read_band(struct kd_frame_job *j, uint32_t band, struct kd_vk_buffer *host, float *planes)
{
    const struct kd_plan *p = j->plan;
    struct kd_vk *vk = j->r->vk;
    uint64_t row = (uint64_t)p->width * p->side * p->side, stride = row * p->band_rows;
    uint64_t first = row * kd_frame_band_first(j, band), rays = row * kd_frame_band_rows(j, band);
    for (uint32_t plane = 0; plane < p->planes; plane++) {
        enum kd_status status = kd_vk_copy(vk, "readback", host, 0, lens_buffer(j, band), 4 * plane * stride, 4 * rays, j->error);
        if (!status)
            status = kd_vk_submit(vk, NULL, j->error);
        if (!status)
            status = kd_vk_wait(vk, 0, j->error);
        if (status)
            return status;
        memcpy(planes + plane * p->rays + first, kd_vk_buffer_map(host), 4 * rays);
    }
    return KD_OK;
}

enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error)
{
    struct kd_frame_job job = { .r = renderer, .store = &renderer->store, .scene = scene, .plan = plan, .camera = kd_camera_push(scene), .weight = 1,
                       .error = error };
    const struct kd_vk_pipeline *trace;
    struct kd_vk_buffer *host = NULL;
    bool reused;
    kd_vk_times_reset(renderer->vk);
    enum kd_status status = kd_store_lens_map(&renderer->store, plan, &job.lens, &reused, error);
    if (!status)
        status = kd_vk_buffer_create(renderer->vk, 4ull * plan->width * plan->side * plan->side * plan->band_rows,
                                     KD_VK_READBACK, "lens map on the host", &host, error);
    if (!status)
        status = trace_kernel(&job, &trace);
    for (uint32_t band = 0; band < plan->bands && !status; band++) {
        status = trace_band(&job, band, trace);
        if (!status)
            status = read_band(&job, band, host, planes);
    }
    if (status)
        kd_vk_discard(renderer->vk);
    kd_vk_buffer_destroy(renderer->vk, host);
    struct kd_vk_time times[KD_VK_MAX_PASSES];
    size_t n = kd_vk_times(renderer->vk, times);
    for (size_t i = 0; i < n && trace_ms; i++)
        if (!strcmp(times[i].pass, "trace"))
            *trace_ms = times[i].ms;
    return status;
}

