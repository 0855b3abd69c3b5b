/* One frame: the plan's passes, band by band, in short submissions. */
#include "render/frame/job.h"

#include "render/lens/audit.h"
#include "render/view/camera.h"
#include "render/emit/particles.h"
#include "base/clock.h"
#include "render/device/deposit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Histogram of what is lit to the host. */
static enum kd_status measure(struct kd_frame_job *j)
{
    struct kd_vk *vk = j->r->vk;
    struct kd_store *s = j->store;
    const struct kd_vk_pipeline *expose;
    enum kd_status status = kd_kernels_get(&j->r->kernels, vk, KD_KERNEL_EXPOSE, NULL, 0, &expose, j->error);
    if (!status)
        status = kd_vk_fill(vk, s->histogram, 0, 4 * KD_HISTOGRAM_BINS, 0, j->error);
    for (uint32_t band = 0; band < j->plan->bands && kd_frame_band_lit(j, band) && !status; band++) {
        uint32_t pixels = j->plan->width * kd_frame_band_lit(j, band);
        const uint32_t push[] = { pixels, pixels > 1 << 18 ? 7 : 1 };
        uint32_t n = kd_frame_groups(pixels / push[1] / 64 + 1); /* each invocation counts some 64 pixels */
        status = kd_vk_dispatch(vk,
                                &(struct kd_vk_dispatch){ "expose",
                                                          expose,
                                                          { { s->radiance.buffers[band], 0, 0, false },
                                                            { s->histogram, 0, 0, true } },
                                                          push,
                                                          { n } },
                                j->error);
    }
    if (!status)
        status = kd_vk_copy(vk, "expose", s->counts, 0, s->histogram, 0, 4 * KD_HISTOGRAM_BINS, j->error);
    if (!status)
        status = kd_vk_submit(vk, NULL, j->error);
    return status ? status : kd_vk_wait(vk, 0, j->error);
}

/* Sums of the light of all bands, on their way to the host. */
static enum kd_status add_up(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const struct kd_vk_pipeline *light;
    bool finite = !isinf(j->scene->camera.r);
    const uint64_t sums = kd_light_bytes(p) / p->bands; /* bound band by band: all together may be more than a binding holds */
    const struct kd_spec_photometry spec = { .SPOTS = p->apart, .FINITE = finite };
    const uint32_t per_band = kd_light_groups(p->width * p->band_rows);
    enum kd_status status = kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_PHOTOMETRY, &spec.SPOTS, sizeof spec / 4, &light, j->error);
    for (uint32_t band = 0; band < p->bands && !status; band++) {
        const struct kd_light_push push = {
            .pixels_x = p->width,
            .pixels = p->width * kd_frame_band_rows(j, band),
            .row0 = kd_frame_band_first(j, band),
            .spots = 3 * p->width * p->band_rows,
            .middle_x = (float)(0.5 * (p->width - 1)),
            .middle_y = (float)(0.5 * (p->height - 1)),
            .step_ = (float)(finite ? kd_camera_pixel(j->scene) : 0),
        };
        const struct kd_vk_dispatch d = {
            "light", light, { { j->store->radiance.buffers[band], 0, 0, false }, { j->store->light, band * sums, sums, true } }, &push,
            { per_band }, /* of the last, smaller band too: they write zeros */
        };
        status = kd_vk_dispatch(j->r->vk, &d, j->error);
    }
    if (!status)
        status = kd_vk_copy(j->r->vk, "light", j->store->light_host, 0, j->store->light, 0, kd_light_bytes(p), j->error);
    return status ? status : kd_vk_submit(j->r->vk, NULL, j->error);
}

/* log2 luminance below which lie all but `share` of the lit pixels. */
static double luminance_quantile(const uint32_t *counts, double share)
{
    uint64_t lit = 0, above = 0;
    for (int i = 1; i < KD_HISTOGRAM_BINS; i++)
        lit += counts[i];
    int bin = KD_HISTOGRAM_BINS - 1;
    for (; bin > 1; bin--) {
        above += counts[bin];
        if ((double)above > share * (double)lit)
            break;
    }
    int code = KD_HISTOGRAM_FIRST + bin + 1;
    return log2(ldexp(1 + (code & 7) / 8.0, (code >> 3) - 127));
}

/* sRGB clips at 1: bring the brightest lit pixels (all but four in a thousand) there. The film-like curve has a long
 * shoulder: the wider the range from the median up, the further over white the brightest may go, so that a beamed disk
 * keeps its dim side. */
static double auto_exposure(const uint32_t *counts, int tone_map)
{
    double white = luminance_quantile(counts, 0.004), median = luminance_quantile(counts, 0.5);
    double over = tone_map == KD_TONE_ACES ? fmin(fmax(0.45 * (white - median), 0.75), 4) : 0;
    return over - white;
}

static enum kd_status expose(struct kd_frame_job *j)
{
    const struct kd_scene *scene = j->scene;
    j->frame->exposure = scene->style.exposure;
    if (!isinf(scene->style.exposure))
        return KD_OK;
    enum kd_status status = measure(j);
    if (!status)
        j->frame->exposure =
            kd_plan_exposure(j->plan, auto_exposure(kd_vk_buffer_map(j->store->counts), scene->style.tone_map));
    return status;
}

/* Post and read back what is lit, one band at a time. */
static enum kd_status finish_pixels(struct kd_frame_job *j)
{
    struct kd_frame *frame = j->frame;
    struct kd_vk *vk = j->r->vk;
    struct kd_store *s = j->store;
    const struct kd_scene *scene = j->scene;
    const struct kd_vk_pipeline *post;
    bool wide = kd_frame_bit_depth(frame) == 16;
    size_t pixel_bytes = kd_layer_pixel_bytes(&frame->layers[0]);
    const struct kd_spec_post spec = { .ACES = scene->style.tone_map == KD_TONE_ACES, .WIDE = wide };
    const uint64_t band_pixels = (uint64_t)j->plan->width * j->plan->band_rows;
    const enum kd_kernel kernel = kd_kernel_post(kd_kernels_texels(vk, band_pixels));
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->bands && kd_frame_band_lit(j, band) && !status; band++) {
        status = kd_kernels_get(&j->r->kernels, vk, kernel, &spec.ACES, sizeof spec / 4, &post, j->error);
        if (status)
            break;
        uint32_t pixels = frame->width * kd_frame_band_lit(j, band);
        uint32_t first = frame->width * kd_frame_band_first(j, band);
        struct kd_post_push push = {
            .gain = (float)exp2(frame->exposure),
            .dither = scene->style.dither,
            .pixels = pixels,
            .first = first,
            .pixels_x = frame->width,
        };
        status = kd_vk_dispatch(vk,
                                &(struct kd_vk_dispatch){ "post",
                                                          post,
                                                          { { s->radiance.buffers[band], 0, kd_post_radiance_bytes(band_pixels), false },
                                                            { s->words, 0, 0, true } },
                                                          &push,
                                                          { kd_post_groups(pixels) } },
                                j->error);
        if (!status)
            status = kd_vk_copy(vk, "readback", s->readback, 0, s->words, 0, (pixels * pixel_bytes + 3) / 4 * 4, j->error);
        if (!status)
            status = kd_vk_submit(vk, NULL, j->error);
        if (!status)
            status = kd_vk_wait(vk, 0, j->error);
        if (!status)
            memcpy((char *)kd_frame_pixels(frame) + first * pixel_bytes, kd_vk_buffer_map(s->readback), pixels * pixel_bytes);
        if (!status)
            status = kd_frame_report(j, kd_frame_band_rows(j, band));
    }
    return status;
}

static enum kd_status glance(struct kd_frame_job *j)
{
    size_t lit = j->plan->host_bytes / j->plan->height * j->lit;
    memset((char *)kd_frame_pixels(j->frame) + lit, 0, j->plan->host_bytes - lit);
    j->looking = true;
    enum kd_status status = expose(j);
    if (!status)
        status = finish_pixels(j);
    if (!status)
        j->glance->seen(j->user, j->frame, j->lit);
    j->looking = false;
    return status;
}

/* The device's times since the last reset, added to the picture's own. */
static void keep_times(struct kd_frame_job *j)
{
    struct kd_vk_time now[KD_VK_MAX_PASSES];
    for (size_t i = 0, n = kd_vk_times(j->r->vk, now); i < n; i++) {
        size_t k = 0;
        while (k < j->n_times && strcmp(j->times[k].pass, now[i].pass))
            k++;
        if (k == j->n_times && k < KD_VK_MAX_PASSES)
            j->times[j->n_times++] = (struct kd_vk_time) { .pass = now[i].pass };
        if (k < j->n_times) {
            j->times[k].ms += now[i].ms;
            j->times[k].dispatches += now[i].dispatches;
        }
    }
}

enum kd_status kd_frame_report(struct kd_frame_job *j, double rows)
{
    j->done += j->looking ? 0 : rows; /* none of the picture's own */
    if (j->aside) { /* who comes next need not wait, or measure, what is under way here */
        enum kd_status status = kd_vk_wait(j->r->vk, 0, j->error);
        if (status)
            return status;
        keep_times(j);
    }
    double left = kd_clock_ms();
    bool go_on = !j->progress || j->progress(j->user, fmin(j->done / j->weight, 1));
    if (j->aside) {
        j->away_ms += kd_clock_ms() - left;
        kd_vk_times_reset(j->r->vk);
    }
    if (!go_on)
        return kd_error_set(j->error, KD_ECANCELLED, "the render was cancelled");
    bool part = j->glance && !j->looking && j->lit && j->lit < j->plan->height;
    return part && j->glance->wanted(j->user) ? glance(j) : KD_OK;
}

static void add_timing(struct kd_frame *frame, const char *name, double ms)
{
    if (frame->n_timings >= KD_FRAME_MAX_TIMINGS)
        return;
    struct kd_timing *t = &frame->timings[frame->n_timings++];
    snprintf(t->name, sizeof t->name, "%s", name);
    t->ms = ms;
}

static void collect_timings(struct kd_frame_job *j, struct kd_frame *frame, double total_ms)
{
    keep_times(j);
    if (j->listed_ms > 0)
        add_timing(frame, "trace", j->listed_ms);
    if (j->audit_ms > 0)
        add_timing(frame, "audit", j->audit_ms);
    for (size_t i = 0; i < j->n_times; i++)
        add_timing(frame, j->times[i].pass, j->times[i].ms);
    add_timing(frame, "total", total_ms);
}

static enum kd_status run(struct kd_frame_job *j)
{
    struct kd_renderer *r = j->r;
    struct kd_frame *frame = j->frame;
    struct kd_capacity c;
    bool reused = false;
    kd_renderer_capacity(r, &c);
    /* Beside what is rendered aside there is a quarter to keep; of those each keeps its own lens map. */
    j->store->memory_bytes = j->aside ? j->plan->device_bytes : c.memory_bytes / 4;
    enum kd_status status = kd_store_lens_map(j->store, j->plan, &j->lens, &reused, j->error);
    if (!status)
        status = kd_store_frame(j->store, j->plan, kd_frame_bit_depth(frame), j->error);
    atomic_store(&r->held, kd_vk_allocated(r->vk));
    if (status)
        return status;

    kd_emit_update(r->emit, j->scene, j->plan->width * j->plan->band_rows);
    status = kd_store_send(j->store, &r->emit->data, j->error);
    if (status)
        return status;

    frame->lens_reused = reused;
    j->weight = (double)j->plan->height * (reused ? 2 : 3);
    if (j->plan->particles.count)
        status = kd_particles_deposit(r, j->particles, j->scene, &j->plan->particles, c.ns_per_particle, j->error);
    if (!status)
        status = kd_frame_light(j, reused);
    if (!status && j->plan->light)
        status = add_up(j);
    if (!status)
        status = expose(j);
    if (!status)
        status = finish_pixels(j);
    if (!status && j->plan->light)
        frame->light = kd_light_of(j->scene, kd_vk_buffer_map(j->store->light_host), kd_light_bytes(j->plan) / (4 * KD_LIGHT_SUMS));
    double audited = kd_clock_ms();
    if (!status && !reused)
        status = kd_audit(r, j->scene, j->plan, j->lens, &j->lens->accuracy, j->error);
    if (j->plan->audit && !reused)
        j->audit_ms = kd_clock_ms() - audited;
    if (!status && !reused)
        status = kd_frame_undecided(j, &j->lens->accuracy.undecided);
    if (!status && !reused)
        kd_store_commit(j->store, j->lens, j->plan);
    frame->accuracy = j->lens->accuracy;
    return status;
}

static enum kd_status render(struct kd_frame_job *job, struct kd_frame *out)
{
    const struct kd_plan *plan = job->plan;
    struct kd_frame frame = { .width = plan->width, .height = plan->height };
    const enum kd_layer_type type = job->scene->image.bit_depth == 16 ? KD_LAYER_U16 : KD_LAYER_U8;
    enum kd_status status = kd_frame_add_layer(&frame, "rgb", 3, type, job->error);
    if (status)
        return status;
    job->frame = &frame;
    status = run(job);
    if (!status) {
        *out = frame;
        return KD_OK;
    }
    kd_vk_discard(job->r->vk);
    job->store->sent_whole = false; /* what was to bring it may be lost */
    kd_particles_forget(job->particles);
    if (status != KD_EDEVICE)
        kd_vk_wait(job->r->vk, 0, NULL);
    kd_frame_finish(&frame);
    return status;
}

static enum kd_status run_timed(struct kd_frame_job *job, struct kd_frame *out)
{
    double start = kd_clock_ms();
    kd_vk_times_reset(job->r->vk);
    job->camera = kd_camera_push(job->scene);
    enum kd_status status = render(job, out);
    if (status)
        return status;
    collect_timings(job, out, kd_clock_ms() - start - job->away_ms);
    kd_frame_learn(job->r, job->plan, out);
    return KD_OK;
}

/* An aside that nobody is in and that has the plan's lens map; NULL: none. */
static struct kd_aside *aside_with(struct kd_renderer *r, const struct kd_plan *plan)
{
    for (size_t i = 0; i < KD_ASIDES; i++)
        if (!r->asides[i].busy && kd_store_has(&r->asides[i].store, plan))
            return &r->asides[i];
    return NULL;
}

enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                         kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error)
{
    struct kd_aside *found = kd_store_has(&renderer->store, plan) ? NULL : aside_with(renderer, plan);
    struct kd_frame_job job = {
        .r = renderer, .store = found ? &found->store : &renderer->store,
        .particles = found ? &found->particles : &renderer->particles, .scene = scene, .plan = plan,
        .progress = progress, .user = user, .error = error,
    };
    return run_timed(&job, out);
}

/* What idle ones hold is given up, the oldest first, until so much fits beside what is in use. */
static void make_room_aside(struct kd_renderer *r, uint64_t bytes)
{
    struct kd_capacity c;
    kd_renderer_capacity(r, &c);
    for (;;) {
        struct kd_aside *oldest = NULL;
        uint64_t held = bytes;
        for (size_t i = 0; i < KD_ASIDES; i++) {
            struct kd_aside *a = &r->asides[i];
            uint64_t own = kd_store_bytes(&a->store);
            held += own;
            if (!a->busy && own && (!oldest || a->used < oldest->used))
                oldest = a;
        }
        if (held <= c.memory_bytes / 2 || !oldest)
            return;
        kd_store_empty(&oldest->store);
    }
}

static struct kd_aside *enter_aside(struct kd_renderer *r, const struct kd_plan *plan)
{
    struct kd_aside *a = aside_with(r, plan);
    for (size_t i = 0; i < KD_ASIDES && (!a || !kd_store_has(&a->store, plan)); i++)
        if (!r->asides[i].busy && (!a || r->asides[i].used < a->used))
            a = &r->asides[i];
    if (!a)
        return NULL;
    a->busy = true;
    a->used = ++r->asides_used;
    make_room_aside(r, plan->device_bytes);
    if (!kd_store_has(&a->store, plan))
        kd_store_hand_over(&r->store, &a->store, plan);
    return a;
}

enum kd_status kd_render_aside(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                               kd_progress_fn progress, const struct kd_glance *glance, void *user, struct kd_frame *out,
                               struct kd_error *error)
{
    struct kd_aside *a = enter_aside(renderer, plan);
    if (!a)
        return kd_error_set(error, KD_EBUSY, "%u pictures are being rendered beside others, as many as can be", KD_ASIDES);
    struct kd_frame_job job = {
        .r = renderer, .store = &a->store, .particles = &a->particles, .aside = true, .scene = scene, .plan = plan,
        .progress = progress, .glance = glance, .user = user, .error = error,
    };
    enum kd_status status = run_timed(&job, out);
    a->busy = false;
    return status;
}
