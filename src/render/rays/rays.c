#include "render/rays/rays.h"

#include "render/rays/check.h"
#include "render/rays/closed.h"
#include "render/rays/device.h"
#include "render/rays/hold.h"
#include "render/rays/looks.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *kd_ray_fate_name(enum kd_ray_fate fate)
{
    static const char *const names[] = { [KD_RAY_CAPTURED] = "captured",
                                         [KD_RAY_ESCAPED] = "escaped",
                                         [KD_RAY_UNDECIDED] = "undecided" };
    return names[fate];
}

bool kd_ray_ends_equal(const struct kd_ray_end *a, const struct kd_ray_end *b)
{
    const double x[] = { a->theta, a->phi, a->error }, y[] = { b->theta, b->phi, b->error };
    return a->fate == b->fate && a->n_crossings == b->n_crossings && a->again == b->again && !memcmp(x, y, sizeof x);
}

/* The angle between the directions of two rays that escape. */
static double angle(const struct kd_ray_end *a, const struct kd_ray_end *b)
{
    double s = sin((a->theta - b->theta) / 2), t = sin((a->phi - b->phi) / 2);
    return 2 * asin(fmin(1, sqrt(s * s + sin(a->theta) * sin(b->theta) * t * t)));
}

/* Error of a ray against the reference result, including the reference's own error. */
static double error_of(const struct kd_ray_crossing *found, const struct kd_ray_end *end,
                       const struct kd_ray_crossing *truth, const struct kd_ray_end *true_end)
{
    bool other = end->fate != true_end->fate || end->n_crossings != true_end->n_crossings;
    double worst = other;
    if (!other && !end->n_crossings)
        return end->fate == KD_RAY_ESCAPED ? angle(end, true_end) + true_end->error : NAN;
    for (uint32_t k = 0; k < end->n_crossings && k < true_end->n_crossings; k++)
        worst = fmax(worst, fabs(found[k].r / truth[k].r - 1));
    return worst + (1 + worst) * (fmax(true_end->error, 0) + 2 * DBL_EPSILON); /* fmax ignores NaN, which is the error
                                                                                * of a captured ray without crossings */
}

#define SLICE ((size_t)16384) /* rays compared at once, which takes a tenth of a second */

/* The Kerr-Schild engines have no error estimate. They exist for comparison, so their rays are compared with the
 * closed form, which takes less time than these engines. */
static enum kd_status compare(const struct kd_rays_params *params, const struct kd_ray_labels *rays,
                              const struct kd_ray_crossing *crossings, struct kd_ray_end *ends, kd_progress_fn progress,
                              void *user, struct kd_error *error)
{
    struct kd_rays_params closed = *params;
    closed.engine = KD_ENGINE_CLOSED;
    closed.precision = KD_PRECISION_F64;
    closed.steps = 0;
    size_t n = rays->n, most = n < SLICE ? n : SLICE;
    struct kd_ray_crossing *truth = malloc(most * params->orders * sizeof *truth);
    struct kd_ray_end *true_ends = malloc(most * sizeof *true_ends);
    enum kd_status status = KD_OK;
    if (!truth || !true_ends)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays", most));
    for (size_t first = 0, m; first < n; first += m) {
        m = n - first < SLICE ? n - first : SLICE;
        const struct kd_ray_labels labels = { rays->alpha_beta + 2 * first,
                                              rays->outward ? rays->outward + first : NULL, m };
        KD_TRY(kd_rays_closed(&closed, &labels, KD_CLOSED_ERRORS, truth, true_ends, NULL, NULL, error));
        for (size_t i = 0; i < m; i++)
            ends[first + i].error = error_of(crossings + (first + i) * params->orders, &ends[first + i],
                                             truth + i * params->orders, &true_ends[i]);
        if (progress && !progress(user, 1))
            KD_TRY(kd_error_set(error, KD_ECANCELLED, "the rays were cancelled"));
    }
done:
    free(truth);
    free(true_ends);
    return status;
}

static enum kd_status trace_on_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                                      const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                                      struct kd_ray_end *ends, kd_progress_fn progress, void *user,
                                      struct kd_error *error)
{
    if (!renderer)
        return kd_error_field(error, "/accuracy/engine", "engine %s needs a Vulkan device",
                              kd_engine_name(params->engine));
    enum kd_status status;
    KD_TRY(kd_rays_device(renderer, params, rays, crossings, ends, progress, user, error));
    kd_rays_redshift(params, rays, crossings, ends);
    if (params->engine >= KD_ENGINE_KS_EULER)
        KD_TRY(compare(params, rays, crossings, ends, progress, user, error));
    if (params->tolerance > 0)
        KD_TRY(kd_rays_hold(renderer, params, rays, crossings, ends, progress, user, error));
done:
    return status;
}

/* Drops the errors of rays without numbers, for all engines. A ray without a crossing that does not escape has no
 * number that could be wrong, unless a crossing may be missing. */
static void drop_idle_errors(struct kd_ray_end *ends, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!ends[i].n_crossings && ends[i].fate != KD_RAY_ESCAPED && !(ends[i].error >= 1))
            ends[i].error = NAN;
}

enum kd_status kd_rays_follow(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    enum kd_status status = params->engine == KD_ENGINE_CLOSED
                                ? kd_rays_closed(params, rays, KD_CLOSED_ERRORS, crossings, ends, progress, user, error)
                                : trace_on_device(renderer, params, rays, crossings, ends, progress, user, error);
    if (!status)
        drop_idle_errors(ends, rays->n);
    return status;
}

static enum kd_status look(struct kd_renderer *renderer, const struct kd_rays_params *params, const double *directions,
                           size_t n, struct kd_ray_crossing *crossings, struct kd_ray_end *ends,
                           kd_progress_fn progress, void *user, struct kd_error *error)
{
    double *alpha_beta = malloc(2 * n * sizeof *alpha_beta), *energy = malloc(n * sizeof *energy);
    bool *outward = malloc(n * sizeof *outward);
    enum kd_status status = KD_OK;
    if (!alpha_beta || !energy || !outward)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu directions", n));
    kd_rays_looks_label(params, directions, n, alpha_beta, outward, energy);
    const struct kd_ray_labels rays = { alpha_beta, outward, n };
    KD_TRY(kd_rays_follow(renderer, params, &rays, crossings, ends, progress, user, error));
    kd_rays_looks_see(params, energy, n, crossings, ends);
done:
    free(alpha_beta);
    free(energy);
    free(outward);
    return status;
}

enum kd_status kd_rays_ask_kernels(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n)
{
    const enum kd_status status = kd_rays_device_ask(renderer, params, false);
    return status || !(params->tolerance > 0) ? status : kd_rays_hold_ask(renderer, params, n);
}

enum kd_status kd_rays_trace(struct kd_renderer *renderer, const struct kd_rays_params *params, const double *rays,
                             size_t n, struct kd_ray_crossing *crossings, struct kd_ray_end *ends,
                             kd_progress_fn progress, void *user, struct kd_error *error)
{
    enum kd_status status = kd_rays_check(params, rays, n, error);
    if (status)
        return status;
    if (params->observer)
        return look(renderer, params, rays, n, crossings, ends, progress, user, error);
    const struct kd_ray_labels labels = { rays, NULL, n };
    return kd_rays_follow(renderer, params, &labels, crossings, ends, progress, user, error);
}
