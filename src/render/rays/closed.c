#include "render/rays/closed.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/angle.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"
#include "base/cores.h"
#include "base/pause.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>

/* number of rays in a slice, which takes some milliseconds; another thread is not worth while for less work */
#define SLICE 1024
#define THREADS_MAX 16

_Static_assert(KD_NULL_ORDERS >= KD_RAYS_MAX_ORDERS, "the closed form gives too few crossings");

/* The part of a ray's description that is the same for all rays of a list. */
static struct kd_null_ray common_of(const struct kd_rays_params *p)
{
    return (struct kd_null_ray) { .hole = kd_rays_hole(p),
                                  .radius = p->r,
                                  .cos_theta = kd_cos_deg(p->inclination_deg),
                                  .sin_theta = kd_sin_deg(p->inclination_deg),
                                  .orders = (int)p->orders };
}

static struct kd_null_ray ray_of(const struct kd_null_ray *common, const double *alpha_beta, bool outward)
{
    struct kd_null_ray ray = *common;
    ray.alpha = alpha_beta[0], ray.beta = alpha_beta[1];
    ray.outward = outward && isfinite(ray.radius);
    return ray;
}

/* The redshift factor at a crossing. outwards: true if the real photon moves outwards when it leaves the gas. */
static double redshift(const struct kd_rays_params *p, const double *alpha_beta, double r, bool outwards)
{
    const struct kd_hole hole = kd_rays_hole(p);
    double a = p->spin, s = kd_sin_deg(p->inclination_deg), c = kd_cos_deg(p->inclination_deg);
    double alpha = alpha_beta[0], beta = alpha_beta[1], lambda = -alpha * s;
    if (r >= kd_kerr_isco(&hole))
        return kd_disk_redshift(&hole, r, lambda);
    return kd_disk_redshift_plunging(&hole, r, lambda, (alpha - a) * (alpha + a) * c * c + beta * beta, outwards);
}

static struct kd_null_path path_of(const struct kd_null_ray *ray, enum kd_closed_results results)
{
    switch (results) {
    case KD_CLOSED_RADII: return kd_null_trace_radii(ray);
    case KD_CLOSED_PLACES: return kd_null_trace_fast(ray);
    case KD_CLOSED_ERRORS: return kd_null_trace(ray);
    }
    __builtin_unreachable();
}

static void trace_one(const struct kd_rays_params *p, const struct kd_null_ray *common, const double *alpha_beta,
                      bool outward, enum kd_closed_results results, struct kd_ray_crossing *crossings,
                      struct kd_ray_end *end)
{
    const struct kd_null_ray ray = ray_of(common, alpha_beta, outward);
    const struct kd_null_path path = path_of(&ray, results);
    bool errors = results == KD_CLOSED_ERRORS;
    bool sound = path.status == KD_NULL_OK || path.status == KD_NULL_IN_PLANE;
    *end = (struct kd_ray_end) {
        .fate = !sound                         ? KD_RAY_UNDECIDED
                : path.fate == KD_NULL_ESCAPED ? KD_RAY_ESCAPED
                                               : KD_RAY_CAPTURED,
        .n_crossings = (uint32_t)path.crossings,
        .theta = NAN,
        .phi = NAN,
        .error = NAN,
    };
    if (end->fate == KD_RAY_ESCAPED && results != KD_CLOSED_RADII) {
        end->theta = acos(fmax(-1, fmin(1, path.sky_u)));
        end->phi = remainder(path.sky_phi, 2 * M_PI); /* whole turns are dropped, because this is a direction */
        end->error = path.crossings || !errors ? NAN : path.sky_error;
    }
    for (uint32_t k = 0; k < p->orders; k++) {
        const struct kd_null_crossing *c = &path.crossing[k];
        crossings[k] = (struct kd_ray_crossing) { NAN, NAN, NAN, NAN };
        if (k >= end->n_crossings)
            continue;
        crossings[k] = (struct kd_ray_crossing) { c->r, c->phi, c->delay, NAN };
        if (!errors)
            continue;
        crossings[k].g = redshift(p, alpha_beta, c->r, c->sense > 0);
        /* fmax ignores NaN; an infinite error means that the crossing may not exist */
        end->error = fmax(end->error, fmin(c->error_r, 1));
    }
    if (path.doubtful)
        end->error = 1;
}

struct share {
    const struct kd_rays_params *params;
    struct kd_null_ray common;
    const struct kd_ray_labels *rays;
    enum kd_closed_results results;
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
    _Atomic size_t next;
    _Atomic bool stop;
};

/* Traces the next slice. Returns false if none is left. */
static bool trace_slice(struct share *share)
{
    const struct kd_ray_labels *rays = share->rays;
    size_t first = atomic_load(&share->stop) ? rays->n : atomic_fetch_add(&share->next, SLICE);
    for (size_t i = first; i < rays->n && i < first + SLICE; i++) {
        kd_pause_every(i, 64);
        trace_one(share->params, &share->common, rays->alpha_beta + 2 * i, rays->outward && rays->outward[i],
                  share->results, share->crossings + i * share->params->orders, &share->ends[i]);
    }
    return first < rays->n;
}

static void *work(void *user)
{
    while (trace_slice(user))
        ;
    return NULL;
}

/* Number of additional threads that are worth creating. */
static size_t helpers(size_t n)
{
    size_t cores = kd_cores(), most = n / (8 * SLICE) + 1;
    cores = cores > THREADS_MAX ? THREADS_MAX : cores;
    return (cores < most ? cores : most) - 1;
}

enum kd_status kd_rays_closed(const struct kd_rays_params *params, const struct kd_ray_labels *rays,
                              enum kd_closed_results results, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    struct share share = { .params = params,
                           .common = common_of(params),
                           .rays = rays,
                           .results = results,
                           .crossings = crossings,
                           .ends = ends };
    size_t n = rays->n;
    pthread_t threads[THREADS_MAX];
    size_t begun = 0, wanted = helpers(n);
    while (begun < wanted && !pthread_create(&threads[begun], NULL, work, &share)) /* if a thread cannot be created,
                                                                                    * fewer threads do the work */
        begun++;
    while (trace_slice(&share)) {
        size_t taken = atomic_load(&share.next);
        if (progress && !progress(user, taken < n ? (double)taken / (double)n : 1))
            atomic_store(&share.stop, true);
    }
    for (size_t i = 0; i < begun; i++)
        pthread_join(threads[i], NULL);
    return atomic_load(&share.stop) ? kd_error_set(error, KD_ECANCELLED, "the rays were cancelled") : KD_OK;
}

/* True if the photon leaves the gas outwards. Inside the ISCO the closed form gives the photon's radial direction,
 * because a ray that starts inwards and is captured never turns. */
static bool leaves_outwards(const struct kd_rays_params *p, const double *alpha_beta, bool outward,
                            const struct kd_ray_end *end, uint32_t crossing)
{
    if (end->fate == KD_RAY_CAPTURED && !outward)
        return true;
    const struct kd_null_ray common = common_of(p), ray = ray_of(&common, alpha_beta, outward);
    const struct kd_null_path path = kd_null_trace_radii(&ray);
    return (int)crossing >= path.crossings || path.crossing[crossing].sense > 0;
}

void kd_rays_redshift(const struct kd_rays_params *params, const struct kd_ray_labels *rays,
                      struct kd_ray_crossing *crossings, const struct kd_ray_end *ends)
{
    const struct kd_hole hole = kd_rays_hole(params);
    double isco = kd_kerr_isco(&hole);
    for (size_t i = 0; i < rays->n; i++)
        for (uint32_t k = 0; k < ends[i].n_crossings; k++) {
            const double *alpha_beta = rays->alpha_beta + 2 * i;
            struct kd_ray_crossing *c = &crossings[i * params->orders + k];
            bool outwards =
                c->r >= isco || leaves_outwards(params, alpha_beta, rays->outward && rays->outward[i], &ends[i], k);
            c->g = redshift(params, alpha_beta, c->r, outwards);
        }
}

/* Uses w'^2 = W^2 - D K w^2, as shaders/ray/radial_step.glsl does. This form is precise next to the horizon. */
double kd_rays_slope(const struct kd_rays_params *p, const double *alpha_beta, bool outward,
                     const struct kd_ray_end *end, uint32_t k, double r)
{
    const struct kd_hole hole = kd_rays_hole(p);
    double a = p->spin, s = kd_sin_deg(p->inclination_deg), c = kd_cos_deg(p->inclination_deg), w2 = 1 / (r * r);
    double alpha = alpha_beta[0], beta = alpha_beta[1], j = -alpha * s - a, all = 1 - a * j * w2;
    double d = kd_hole_delta(&hole, r) * w2;
    double carter = (alpha - a) * (alpha + a) * c * c + beta * beta + j * j;
    double slope = sqrt(fmax(0, all * all - d * carter * w2));
    return leaves_outwards(p, alpha_beta, outward, end, k) ? slope : -slope;
}
