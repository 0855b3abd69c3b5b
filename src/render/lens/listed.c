#include "render/lens/listed.h"

#include "render/view/layout.h"

#include "physics/null/null_course.h"
#include "physics/spacetime/kerr.h"
#include "render/view/camera.h"
#include "render/view/critical_pixels.h"
#include "render/rays/closed.h"
#include "render/rays/device.h"
#include "render/view/ring.h"
#include "scene/hole.h"

#include <math.h>
#include <stdlib.h>

struct work {
    const struct kd_plan *plan;
    size_t n;
    double twist; /* angle that is added to the observer's azimuth */
    double *alpha_beta, *energy;
    bool *outward;
    bool *inwards; /* for each crossing, true if the traced ray moves inwards there; NULL: the closed form decides */
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
};

static void finish(struct work *w)
{
    free(w->alpha_beta);
    free(w->energy);
    free(w->outward);
    free(w->inwards);
    free(w->crossings);
    free(w->ends);
}

static enum kd_status init(struct work *w, const struct kd_scene *scene, const struct kd_plan *plan, size_t n,
                           struct kd_error *error)
{
    uint32_t orders = plan->lens.orders ? plan->lens.orders : 1; /* at least one order, because engines need one */
    *w = (struct work) { .plan = plan, .n = n, .twist = kd_camera_twist(scene) };
    w->alpha_beta = malloc(2 * n * sizeof *w->alpha_beta);
    w->energy = malloc(n * sizeof *w->energy);
    w->outward = malloc(n * sizeof *w->outward);
    w->crossings = malloc(n * orders * sizeof *w->crossings);
    w->ends = malloc(n * sizeof *w->ends);
    if (w->alpha_beta && w->energy && w->outward && w->crossings && w->ends)
        return KD_OK;
    finish(w);
    return kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays", n);
}

static struct kd_rays_params params_of(const struct kd_scene *scene, const struct kd_plan_lens *lens,
                                       const struct kd_setting *by)
{
    return (struct kd_rays_params) {
        KD_HOLE_FROM(&scene->spacetime),
        .r = scene->camera.r,
        .inclination_deg = scene->camera.inclination_deg,
        .orders = lens->orders ? lens->orders : 1,
        .engine = by->engine,
        .precision = by->precision,
        .steps = by->steps,
    };
}

static const struct kd_setting exact = { .engine = KD_ENGINE_CLOSED, .precision = KD_PRECISION_F64 };

/* Traces the rays of a plan by any engine, without g and errors. */
static enum kd_status trace(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                            const struct kd_setting *by, const struct kd_ray_labels *rays,
                            struct kd_ray_crossing *crossings, struct kd_ray_end *ends, struct kd_error *error)
{
    const struct kd_rays_params params = params_of(scene, &plan->lens, by);
    if (by->engine == KD_ENGINE_CLOSED)
        return kd_rays_closed(&params, rays, KD_CLOSED_PLACES, crossings, ends, NULL, NULL, error);
    return kd_rays_device(renderer, &params, rays, crossings, ends, NULL, NULL, error);
}

enum kd_status kd_lens_radii(const struct kd_scene *scene, const struct kd_plan *plan, const struct kd_ray_labels *rays,
                             struct kd_ray_crossing *crossings, struct kd_ray_end *ends, struct kd_error *error)
{
    const struct kd_rays_params params = params_of(scene, &plan->lens, &exact);
    return kd_rays_closed(&params, rays, KD_CLOSED_RADII, crossings, ends, NULL, NULL, error);
}

/* Fills one plane with the radii of one order. */
static void fill_radii(const struct work *w, uint32_t order, float *to)
{
    for (size_t i = 0; i < w->n; i++) {
        const struct kd_ray_end *end = &w->ends[i];
        bool open = end->fate == KD_RAY_UNDECIDED;
        to[i] = order < end->n_crossings ? (float)(1 / w->crossings[i * w->plan->lens.orders + order].r)
                : open                   ? -1
                                         : 0;
    }
}

/* A ray of negative energy rotates the other way (view/camera.h). */
static void fill_azimuths(const struct work *w, uint32_t order, float *to)
{
    for (size_t i = 0; i < w->n; i++) {
        double phi = order < w->ends[i].n_crossings ? w->crossings[i * w->plan->lens.orders + order].phi : 0;
        to[i] = (float)((w->energy[i] < 0 ? -phi : phi) + w->twist);
    }
}

static void fill_delays(const struct work *w, uint32_t order, float *to)
{
    for (size_t i = 0; i < w->n; i++)
        to[i] = order < w->ends[i].n_crossings ? (float)w->crossings[i * w->plan->lens.orders + order].delay : 0;
}

/* Fills a plane with slopes, which determine the light of falling gas and all emission angles. */
static void fill_slopes(const struct work *w, const struct kd_scene *scene, uint32_t order, float *to)
{
    const struct kd_rays_params params = params_of(scene, &w->plan->lens, &w->plan->lens.setting);
    for (size_t i = 0; i < w->n; i++) {
        const struct kd_ray_end *end = &w->ends[i];
        double r = w->crossings[i * w->plan->lens.orders + order].r;
        const double slope =
            order < end->n_crossings
                ? fabs(w->energy[i]) * kd_rays_slope(&params, w->alpha_beta + 2 * i, w->outward[i], end, order, r)
                : 0;
        to[i] = (float)(!w->inwards                                    ? slope
                        : w->inwards[i * w->plan->lens.orders + order] ? fabs(slope)
                                                                       : -fabs(slope));
    }
}

static void fill_sky(const struct work *w, float *u, float *phi, float *fate)
{
    for (size_t i = 0; i < w->n; i++) {
        const struct kd_ray_end *end = &w->ends[i];
        bool escaped = end->fate == KD_RAY_ESCAPED;
        u[i] = escaped ? (float)cos(end->theta) : 0;
        phi[i] = escaped ? (float)(end->phi + w->twist) : 0;
        fate[i] = escaped                        ? (float)KD_FATE_ESCAPED
                  : end->fate == KD_RAY_CAPTURED ? (float)KD_FATE_CAPTURED
                                                 : (float)KD_FATE_UNDECIDED;
    }
}

static void fill(const struct work *w, const struct kd_scene *scene, float *planes)
{
    const struct kd_plan *plan = w->plan;
    /* plane of each quantity, indexed by the quantity's bit; NULL: the map does not have the quantity */
    float *of[32] = { 0 };
    for (uint32_t bit = 0; bit < 32; bit++)
        if (plan->lens.quantities >> bit & 1)
            of[bit] = planes + w->n * kd_lens_plane(plan->lens.quantities, plan->lens.orders, 1u << bit);
#define OF(quantity) of[__builtin_ctz(quantity)]
    for (uint32_t k = 0; k < plan->lens.orders; k++) {
        fill_radii(w, k, OF(KD_LENS_W) + k * w->n);
        if (OF(KD_LENS_PHI))
            fill_azimuths(w, k, OF(KD_LENS_PHI) + k * w->n);
        if (OF(KD_LENS_DELAY))
            fill_delays(w, k, OF(KD_LENS_DELAY) + k * w->n);
        if (OF(KD_LENS_SLOPE))
            fill_slopes(w, scene, k, OF(KD_LENS_SLOPE) + k * w->n);
    }
    for (size_t i = 0; OF(KD_LENS_ALPHA) && i < w->n; i++)
        OF(KD_LENS_ALPHA)[i] = (float)w->alpha_beta[2 * i];
    if (OF(KD_LENS_FATE))
        fill_sky(w, OF(KD_LENS_SKY_U), OF(KD_LENS_SKY_PHI), OF(KD_LENS_FATE));
#undef OF
}

static enum kd_status upload(struct kd_renderer *r, const struct kd_scene *scene, const struct work *w,
                             const struct kd_lens_rows *rows, struct kd_error *error)
{
    struct kd_vk_buffer *staging;
    uint64_t bytes = 4 * (uint64_t)w->n;
    enum kd_status status =
        kd_vk_buffer_create(r->vk, bytes * w->plan->lens.planes, KD_VK_UPLOAD, "listed lens map", &staging, error);
    if (status)
        return status;
    fill(w, scene, kd_vk_buffer_map(staging));
    for (uint32_t k = 0; k < w->plan->lens.planes; k++)
        KD_TRY(kd_vk_copy(r->vk, "upload", rows->to, 4 * (rows->offset + k * rows->stride), staging, k * bytes, bytes,
                          error));
    KD_TRY(kd_vk_submit(r->vk, NULL, error));
    KD_TRY(kd_vk_wait(r->vk, 0, error));
done:
    kd_vk_buffer_destroy(r->vk, staging);
    return status;
}

static void keep(struct work *w, size_t i, const struct kd_camera_label *label)
{
    w->alpha_beta[2 * i] = label->alpha;
    w->alpha_beta[2 * i + 1] = label->beta;
    w->energy[i] = label->energy;
    w->outward[i] = label->outward;
}

static void make_rays(const struct kd_scene *scene, const struct kd_lens_rows *rows, uint32_t width, struct work *w)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    struct kd_camera_label label;
    for (size_t i = 0; i < w->n; i++) {
        kd_camera_label(&camera, (uint32_t)(i % width), rows->first + (uint32_t)(i / width), &label);
        keep(w, i, &label);
    }
}

static void make_critical(const struct kd_scene *scene, const struct kd_lens_rows *rows, uint32_t rays, struct work *w)
{
    const struct kd_scene steps = kd_critical_camera(scene, kd_critical_steps(rows->lattice));
    const struct kd_camera_exact camera = kd_camera_exact(&steps);
    struct kd_camera_label label;
    for (size_t i = 0; i < w->n; i++) {
        const struct kd_pixel step =
            kd_critical_place(rows->lattice, rows->pixels[rows->first + i / rays], (uint32_t)(i % rays));
        kd_camera_label(&camera, step.x, step.y, &label);
        keep(w, i, &label);
    }
}

static void make_ring(const struct kd_scene *scene, const struct kd_lens_rows *rows, struct work *w)
{
    const struct kd_ring ring = kd_ring_of(scene);
    for (uint32_t x = 0; x < ring.width; x++) {
        const struct kd_critical_point column = kd_ring_column(&ring, x);
        for (uint32_t k = 0; k < rows->count; k++) {
            const struct kd_camera_label label = kd_ring_label(&ring, &column, rows->first + k);
            keep(w, (size_t)k * ring.width + x, &label);
        }
    }
}

enum kd_status kd_lens_listed(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_lens_rows *rows, uint64_t *undecided, struct kd_error *error)
{
    struct work w;
    uint32_t width = rows->pixels ? rows->lattice->rays : plan->picture.width * plan->lens.side;
    enum kd_status status = init(&w, scene, plan, (size_t)width * rows->count, error);
    if (status)
        return status;
    if (rows->pixels)
        make_critical(scene, rows, width, &w);
    else if (plan->lens.ring)
        make_ring(scene, rows, &w);
    else
        make_rays(scene, rows, width, &w);
    const struct kd_ray_labels labels = { w.alpha_beta, w.outward, w.n };
    KD_TRY(trace(renderer, scene, plan, &plan->lens.setting, &labels, w.crossings, w.ends, error));
    KD_TRY(upload(renderer, scene, &w, rows, error));
    for (size_t i = 0; i < w.n; i++)
        *undecided += w.ends[i].fate == KD_RAY_UNDECIDED;
done:
    finish(&w);
    return status;
}

/* fraction of the horizon's radius. A crossing from outside that is nearer to the horizon than this counts as on the
 * horizon */
#define NEAR 1e-4
enum { PLACES = 2048 };

static void follow_within(struct work *w, const struct kd_scene *scene, size_t i, struct kd_null_place *places)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const double horizon = at.hole.outer;
    const uint32_t orders = w->plan->lens.orders ? w->plan->lens.orders : 1;
    const bool reversed = w->energy[i] < 0;
    const struct kd_null_ray ray = {
        .hole = at.hole,
        .radius = at.r,
        .cos_theta = at.u,
        .sin_theta = at.s,
        .alpha = w->alpha_beta[2 * i],
        .beta = w->alpha_beta[2 * i + 1],
        .outward = w->outward[i],
        .orders = (int)orders,
    };
    const struct kd_null_course course =
        kd_null_course_ingoing(&ray, reversed, INFINITY, NEAR * horizon, places, PLACES);
    struct kd_ray_end *end = &w->ends[i];
    *end = (struct kd_ray_end) { .fate = course.end == KD_COURSE_ESCAPED    ? KD_RAY_ESCAPED
                                         : course.end == KD_COURSE_CAPTURED ? KD_RAY_CAPTURED
                                                                            : KD_RAY_UNDECIDED };
    for (size_t k = 0; k + 1 < course.n; k++) {
        const struct kd_null_place *p = &places[k];
        const bool inwards = places[k + 1].r < p->r;
        if (p->crossing < 0 || (uint32_t)p->crossing >= orders || (inwards && p->r <= horizon))
            continue; /* as in the kernel, a ray ends at the horizon on its way in; on its way out it may be inside */
        const double twist = p->r > horizon ? kd_kerr_twist(&at.hole, p->r) : 0;
        w->crossings[i * orders + (uint32_t)p->crossing] =
            (struct kd_ray_crossing) { .r = p->r, .phi = p->phi + (reversed ? -twist : twist), .delay = p->delay };
        w->inwards[i * orders + (uint32_t)p->crossing] = inwards;
        end->n_crossings = (uint32_t)p->crossing + 1;
    }
    if (end->fate == KD_RAY_ESCAPED) {
        end->theta = acos(places[course.n - 1].u);
        end->phi = places[course.n - 1].phi;
    }
}

/* Traces rays for an observer inside the horizon, where closed forms do not apply. Uses the steps of
 * physics/null/null_course.h in ingoing coordinates. */
static enum kd_status trace_within(struct work *w, const struct kd_scene *scene, struct kd_error *error)
{
    const size_t orders = w->plan->lens.orders ? w->plan->lens.orders : 1;
    struct kd_null_place *places = malloc(PLACES * sizeof *places);
    w->inwards = calloc(w->n * orders, sizeof *w->inwards);
    for (size_t i = 0; places && w->inwards && i < w->n; i++)
        follow_within(w, scene, i, places);
    free(places);
    return places && w->inwards ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays", w->n);
}

enum kd_status kd_lens_again(const struct kd_scene *scene, const struct kd_plan *plan,
                             const struct kd_camera_label *labels, size_t n, float *planes, uint64_t *undecided,
                             struct kd_error *error)
{
    struct work w;
    enum kd_status status = init(&w, scene, plan, n, error);
    if (status)
        return status;
    for (size_t i = 0; i < n; i++)
        keep(&w, i, &labels[i]);
    const struct kd_ray_labels rays = { w.alpha_beta, w.outward, n };
    if (scene->camera.r > kd_scene_hole(scene)->outer)
        KD_TRY(trace(NULL, scene, plan, &exact, &rays, w.crossings, w.ends, error));
    else
        KD_TRY(trace_within(&w, scene, error));
    fill(&w, scene, planes);
    for (size_t i = 0; i < n; i++)
        *undecided += w.ends[i].fate == KD_RAY_UNDECIDED;
done:
    finish(&w);
    return status;
}
