/* Traces listed rays on the device: upload, trace in slices, read back. */
#include "render/rays/device.h"

#include "interface.h"
#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "render/device/device_internal.h"
#include "render/view/layout.h"
#include "render/rays/start.h"
#include "base/clock.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Sizes of slices, in rays. Between two slices other work may use the device. The first slice of a list has few rays.
 * Later slices have as many rays as are traced in TARGET_MS. A ray's cost varies by a factor of a million between the
 * fastest engine on a GPU and Tao's with the most steps on one core. A slice is submitted in parts of at most CHUNK
 * rays. The device traces one part while the host unpacks the part before. */
#define LEAST 32u
#define MOST (1u << 20)
#define CHUNK 65536u
#define TARGET_MS 40.0
/* Numbers before the list in rays.comp. rays_kerr_schild.comp has four fewer. */
#define F(name) +1
enum { HEADER = 7 KD_HOLE_MORE_FIELDS_(F) };
#undef F

struct work {
    struct kd_renderer *r;
    const struct kd_rays_params *params;
    bool wide;        /* double precision */
    bool kerr_schild; /* true if the engine uses Kerr-Schild coordinates */
    uint32_t per_ray;
    /* least radius of a crossing: the float next above the horizon's radius */
    double least;
    struct set { struct kd_vk_buffer *rays, *ends, *host; } sets[2]; /* buffers that successive parts use alternately */
    struct kd_vk_buffer *told;                                       /* buffer for the records of trace.glsl, or NULL */
    uint32_t steps;                                                  /* number of steps per half period */
    const struct kd_vk_pipeline *pipeline;
    struct kd_error *error;
};

static uint32_t steps_of(const struct kd_rays_params *p)
{
    return p->steps ? p->steps : kd_engine_steps(p->engine, p->precision);
}

static void put(const struct work *w, void *at, size_t i, double value)
{
    if (w->wide)
        ((double *)at)[i] = value;
    else
        ((float *)at)[i] = (float)value;
}

/* Converts alpha and beta for the device. If both are tiny, they are scaled so that their ratio stays exact, because
 * the azimuth depends on it. */
static void label(const struct work *w, const double *alpha_beta, double out[2])
{
    double larger = fmax(fabs(alpha_beta[0]), fabs(alpha_beta[1])), least = 1e8 * KD_LEAST_FLOAT;
    bool small = !w->wide && larger > 0 && larger < least;
    for (int k = 0; k < 2; k++) {
        out[k] = small ? alpha_beta[k] / larger * least : alpha_beta[k]; /* divides first, because 1/larger may be
                                                                          * infinite */
        if (!w->wide)
            out[k] = kd_lifted(out[k]);
    }
}

static double get(const struct work *w, const void *at, size_t i)
{
    return w->wide ? ((const double *)at)[i] : (double)((const float *)at)[i];
}

/* Radius from which a Cartesian ray from infinity starts. A larger radius would lose digits of b, and in Tao's method
 * also phase. A smaller radius would give smaller errors: from 100 M, single precision has a sixth of the error. But
 * this is only because start.c then traces more of the ray in Mino time, and this engine less of it. */
#define FAR 1e3
/* The radius at which a ray counts as escaped. At this radius its momentum differs from the limit by at most M b/r^2.
 * Further out the direction in single precision does not become more accurate, and the copies of Tao's method
 * diverge. */
static double escape(const struct work *w) { return w->wide && w->params->engine != KD_ENGINE_KS_TAO6 ? 1e7 : 1e4; }

static void upload_states(const struct work *w, const struct set *set, const struct kd_ray_labels *rays)
{
    const struct kd_rays_params *p = w->params;
    void *at = kd_vk_buffer_map(set->rays);
    const size_t per_start = sizeof(struct kd_rays_origin) / sizeof(double);
    union {
        struct kd_rays_origin origin;
        double numbers[sizeof(struct kd_rays_origin) / sizeof(double)];
    } start;
    const struct kd_hole hole = kd_rays_hole(p);
    double u = kd_cos_deg(p->inclination_deg), s = kd_sin_deg(p->inclination_deg);
    put(w, at, 0, p->spin);
    put(w, at, 1, hole.outer);
    put(w, at, 2, escape(w));
    size_t n = 3;
#define F(name) put(w, at, n++, kd_hole_##name(&hole));
    KD_HOLE_MORE_FIELDS_(F)
#undef F
    for (size_t i = 0; i < rays->n; i++) {
        double at_eye[2];
        label(w, rays->alpha_beta + 2 * i, at_eye);
        kd_rays_start(&hole, p->r, u, s, at_eye[0], at_eye[1], rays->outward && rays->outward[i], FAR, &start.origin);
        for (size_t k = 0; k < per_start; k++)
            put(w, at, n + per_start * i + k, start.numbers[k]);
    }
}

static void upload(const struct work *w, const struct set *set, const struct kd_ray_labels *rays)
{
    const struct kd_rays_params *p = w->params;
    void *at = kd_vk_buffer_map(set->rays);
    const struct kd_hole hole = kd_rays_hole(p);
    double u = kd_cos_deg(p->inclination_deg), s = kd_sin_deg(p->inclination_deg);
    double header[HEADER] = {
        p->spin,
        u,
        s,
        1 / hole.outer,
        hole.root,
        isinf(p->r) ? 0 : 1 / p->r,
        w->wide ? DBL_EPSILON / 2 : FLT_EPSILON / 2,
    };
    size_t n = 7;
#define F(name) header[n++] = kd_hole_##name(&hole);
    KD_HOLE_MORE_FIELDS_(F)
#undef F
    for (size_t i = 0; i < n; i++)
        put(w, at, i, w->wide ? header[i] : kd_lifted(header[i]));
    for (size_t i = 0; i < rays->n; i++) {
        double at_eye[2];
        label(w, rays->alpha_beta + 2 * i, at_eye);
        put(w, at, HEADER + 3 * i, at_eye[0]);
        put(w, at, HEADER + 3 * i + 1, at_eye[1]);
        put(w, at, HEADER + 3 * i + 2, rays->outward && rays->outward[i] ? -1 : 1);
    }
}

static enum kd_status send(const struct work *w, const struct set *set, const struct kd_ray_labels *rays,
                           uint64_t *ticket)
{
    struct kd_vk *vk = w->r->vk;
    const uint32_t n = (uint32_t)rays->n, push[] = { 0, n };
    const struct kd_vk_dispatch d = {
        "rays",
        w->pipeline,
        { { set->rays, 0, 0, false }, { set->ends, 0, 0, true }, { w->told, 0, 0, true } },
        push,
        { (n + KD_GROUP_SIZE - 1) / KD_GROUP_SIZE },
    };
    (w->kerr_schild ? upload_states : upload)(w, set, rays);
    enum kd_status status;
    KD_TRY(kd_vk_dispatch(vk, &d, w->error));
    KD_TRY(
        kd_vk_copy(vk, "readback", set->host, 0, set->ends, 0, (uint64_t)n * w->per_ray * (w->wide ? 8 : 4), w->error));
    KD_TRY(kd_vk_submit(vk, ticket, w->error));
done:
    return status;
}

/* Unpacks one ray's numbers into its records. */
static void unpack(const struct work *w, const void *from, size_t i, struct kd_ray_crossing *crossings,
                   struct kd_ray_end *end)
{
    const struct kd_rays_params *p = w->params;
    size_t at = i * w->per_ray;
    *end = (struct kd_ray_end) { .theta = NAN, .phi = NAN, .error = get(w, from, at + 3 * p->orders + 3) };
    for (uint32_t n = 0; n < p->orders; n++, at += 3) {
        double x = get(w, from, at);
        crossings[n] = (struct kd_ray_crossing) { NAN, NAN, NAN, NAN };
        if (!(x > 0))
            continue;
        crossings[n].r = fmax(1 / x, w->least); /* outside the horizon, whose radius a float only approximates */
        crossings[n].phi = get(w, from, at + 1);
        if (!w->kerr_schild)
            crossings[n].delay = get(w, from, at + 2);
        end->n_crossings = n + 1;
    }
    if (w->kerr_schild)
        end->error = NAN;
    double fate = get(w, from, at + 2);
    end->fate = fate == KD_FATE_ESCAPED    ? KD_RAY_ESCAPED
                : fate == KD_FATE_CAPTURED ? KD_RAY_CAPTURED
                                           : KD_RAY_UNDECIDED;
    if (end->fate == KD_RAY_ESCAPED) {
        end->theta = acos(fmax(-1, fmin(1, get(w, from, at))));
        end->phi = get(w, from, at + 1);
    }
}

/* Waits for a part and reads its results. */
static enum kd_status receive(const struct work *w, const struct set *set, uint64_t ticket, size_t n,
                              struct kd_ray_crossing *crossings, struct kd_ray_end *ends)
{
    enum kd_status status = kd_vk_wait(w->r->vk, ticket, w->error);
    const void *from = status ? NULL : kd_vk_buffer_map(set->host);
    for (size_t i = 0; i < n && from; i++)
        unpack(w, from, i, crossings + i * w->params->orders, &ends[i]);
    return status;
}

static struct kd_ray_labels part_of(const struct kd_ray_labels *rays, size_t first, size_t most)
{
    size_t n = rays->n - first < most ? rays->n - first : most;
    return (struct kd_ray_labels) { rays->alpha_beta + 2 * first, rays->outward ? rays->outward + first : NULL, n };
}

/* Makes one of the renderer's buffers for lists of rays large enough. These buffers are reused for the next list and
 * only grow. */
static enum kd_status hold(struct kd_renderer *r, struct kd_vk_buffer **kept, uint64_t size, enum kd_vk_memory memory,
                           const char *name, struct kd_vk_buffer **out, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!*kept || kd_vk_buffer_size(*kept) < size) {
        kd_vk_buffer_destroy(r->vk, *kept);
        *kept = NULL;
        status = kd_vk_buffer_create(r->vk, size, memory, name, kept, error);
    }
    *out = *kept;
    return status;
}

/* Buffers for parts of `room` rays. */
static enum kd_status hold_set(struct work *w, int k, uint64_t room)
{
    struct kd_renderer *r = w->r;
    struct set *set = &w->sets[k];
    uint64_t number = w->wide ? 8 : 4, per_start = w->kerr_schild ? 8 : 3;
    enum kd_status status;
    KD_TRY(hold(r, &r->rays[k][0], (HEADER + per_start * room) * number, KD_VK_UPLOAD, "rays", &set->rays, w->error));
    KD_TRY(hold(r, &r->rays[k][1], room * w->per_ray * number, KD_VK_DEVICE, "ray ends", &set->ends, w->error));
    KD_TRY(hold(r, &r->rays[k][2], room * w->per_ray * number, KD_VK_READBACK, "ray ends on the host", &set->host,
                w->error));
done:
    return status;
}

static enum kd_status kernel_of(struct kd_renderer *r, const struct kd_rays_params *p, bool told,
                                const struct kd_vk_pipeline **out, struct kd_error *error)
{
    const bool wide = p->precision == KD_PRECISION_F64, kerr_schild = p->engine >= KD_ENGINE_KS_EULER;
    const uint32_t method = kerr_schild ? p->engine - KD_ENGINE_KS_EULER : p->engine == KD_ENGINE_MINO_RKN4 ? 4 : 6;
    const struct kd_spec_rays spec = { .ORDERS = p->orders, .STEPS = steps_of(p), .METHOD = method };
    enum kd_kernel kernel = kerr_schild ? (told ? KD_KERNEL_RAYS_KS_TRACE_F32 : KD_KERNEL_RAYS_KS_F32)
                                        : (told ? KD_KERNEL_RAYS_TRACE_F32 : KD_KERNEL_RAYS_F32);
    return kd_kernels_get(&r->kernels, r->vk, kernel + wide, &spec.ORDERS, sizeof spec / 4, out, error);
}

enum kd_status kd_rays_device_ask(struct kd_renderer *r, const struct kd_rays_params *params, bool told)
{
    const struct kd_vk_pipeline *later;
    const bool none =
        params->engine == KD_ENGINE_CLOSED || (params->precision == KD_PRECISION_F64 && !kd_vk_info(r->vk)->float64);
    return none ? KD_OK : kernel_of(r, params, told, &later, NULL);
}

/* Prepares the renderer for a slice, because it may have been used for other rays since the last slice. */
static enum kd_status prepare(struct work *w, size_t n)
{
    enum kd_status status = kernel_of(w->r, w->params, w->told != NULL, &w->pipeline, w->error);
    for (int k = 0; k < (n > CHUNK ? 2 : 1) && !status; k++)
        status = hold_set(w, k, n < CHUNK ? n : CHUNK);
    return status;
}

/* Traces one slice. When it returns without an error, no work is in progress: callbacks between slices may use the
 * device. */
static enum kd_status trace_slice(struct work *w, const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                                  struct kd_ray_end *ends)
{
    enum kd_status status = prepare(w, rays->n);
    uint64_t tickets[2] = { 0 };
    size_t parts = (rays->n + CHUNK - 1) / CHUNK;
    for (size_t k = 0; k <= parts && !status; k++) {
        const struct kd_ray_labels next = part_of(rays, k < parts ? k * CHUNK : rays->n, CHUNK);
        if (next.n)
            status = send(w, &w->sets[k % 2], &next, &tickets[k % 2]);
        size_t first = k ? (k - 1) * CHUNK : 0;
        if (k && !status)
            status = receive(w, &w->sets[(k - 1) % 2], tickets[(k - 1) % 2], part_of(rays, first, CHUNK).n,
                             crossings + first * w->params->orders, ends + first);
    }
    return status;
}

/* Number of rays of the next slice. The last slice had m rays and took `ms`. least_ms: time of the smallest slices so
 * far. On a GPU even one ray may take longer than TARGET_MS, and several rays then take no longer than one. So a
 * slice is doubled while its time is within 1.25 times least_ms. Otherwise its time may be at most TARGET_MS, or 1.5
 * times least_ms if that is longer. */
static uint32_t next_size(uint32_t m, double ms, double least_ms)
{
    double grow = fmax(TARGET_MS / fmax(ms, 1e-3), ms <= 1.25 * least_ms ? 2 : 1.5 * least_ms / ms),
           n = m * fmin(8, grow);
    return n < LEAST ? LEAST : n > MOST ? MOST : (uint32_t)n;
}

/* Size of a list's first slice. If the list has the settings of the previous list, it starts with half of that list's
 * last slice. */
static uint32_t first_size(const struct work *w)
{
    const struct kd_rays_params *p = w->params;
    const struct kd_rays_pace *pace = &w->r->rays_pace;
    bool same = pace->engine == p->engine && pace->precision == p->precision && pace->steps == w->steps &&
                pace->orders == p->orders;
    return same && pace->size / 2 > LEAST ? pace->size / 2 : LEAST;
}

static void keep_size(const struct work *w, uint32_t size)
{
    const struct kd_rays_params *p = w->params;
    w->r->rays_pace = (struct kd_rays_pace) { p->engine, p->precision, w->steps, p->orders, size };
}

static enum kd_status trace(struct work *w, const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                            struct kd_ray_end *ends, kd_progress_fn progress, void *user)
{
    uint32_t size = first_size(w);
    double least_ms = 0;
    for (size_t first = 0, n = rays->n; first < n;) {
        const struct kd_ray_labels slice = part_of(rays, first, size);
        double begun = kd_clock_ms();
        enum kd_status status = trace_slice(w, &slice, crossings + first * w->params->orders, ends + first);
        if (status)
            return status;
        double ms = kd_clock_ms() - begun;
        if (slice.n <= LEAST || ms < least_ms) /* the first slice may have waited for the kernel to be compiled */
            least_ms = ms;
        if (slice.n == size) { /* the last slice of a list is short and not representative */
            size = next_size(size, ms, least_ms);
            keep_size(w, size);
        }
        first += slice.n;
        if (progress && !progress(user, (double)first / (double)n))
            return kd_error_set(w->error, KD_ECANCELLED, "the rays were cancelled");
    }
    return KD_OK;
}

static enum kd_status device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                             const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_vk_buffer *told,
                             struct kd_error *error)
{
    const struct kd_hole hole = kd_rays_hole(params);
    struct kd_vk *vk = renderer->vk;
    struct work w = {
        .r = renderer,
        .params = params,
        .wide = params->precision == KD_PRECISION_F64,
        .kerr_schild = params->engine >= KD_ENGINE_KS_EULER,
        .per_ray = 3 * params->orders + 4,
        .least = nextafter(hole.outer, INFINITY),
        .told = told,
        .error = error,
        .steps = steps_of(params),
    };
    if (w.wide && !kd_vk_info(vk)->float64)
        return kd_error_set(error, KD_EDEVICE, "%s has no double precision; use f32 or the closed engine",
                            kd_vk_info(vk)->name);
    enum kd_status status = trace(&w, rays, crossings, ends, progress, user);
    if (!status)
        return KD_OK;
    kd_vk_discard(vk);
    if (status != KD_EDEVICE) /* a part may still be in progress */
        kd_vk_wait(vk, 0, NULL);
    return status;
}

enum kd_status kd_rays_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    return device(renderer, params, rays, crossings, ends, progress, user, NULL, error);
}

enum kd_status kd_rays_device_told(struct kd_renderer *renderer, const struct kd_rays_params *params,
                                   const struct kd_ray_labels *ray, struct kd_ray_crossing *crossings,
                                   struct kd_ray_end *end, double *told, size_t numbers, struct kd_error *error)
{
    bool wide = params->precision == KD_PRECISION_F64;
    uint64_t size = (uint64_t)numbers * (wide ? 8 : 4);
    struct kd_vk_buffer *buffer = NULL;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(renderer->vk, size, KD_VK_READBACK, "steps of a ray", &buffer, error));
    KD_TRY(device(renderer, params, ray, crossings, end, NULL, NULL, buffer, error));
    const void *from = kd_vk_buffer_map(buffer);
    for (size_t i = 0; i < numbers; i++)
        told[i] = wide ? ((const double *)from)[i] : (double)((const float *)from)[i];
done:
    kd_vk_buffer_destroy(renderer->vk, buffer);
    return status;
}
