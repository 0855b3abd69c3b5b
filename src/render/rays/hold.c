#include "render/rays/hold.h"

#include "render/device/device_internal.h"
#include "render/rays/device.h"

#include <stdlib.h>
#include <string.h>

#define SLICE ((size_t)16384) /* number of rays that are traced again together, which takes a tenth of a second */
/* The least number of rays for which the device is used again. For fewer rays the closed form takes less time than
 * compiling a kernel. */
#define WORTH_A_KERNEL 8192
/* factor by which the number of steps grows: at order 6 the error then falls by a factor of 4096 */
#define MORE_STEPS 4

/* The rays of one slice that are traced again. */
struct batch {
    size_t n, *which;
    double *alpha_beta;
    bool *outward;
    struct kd_ray_crossing *crossings;
    struct kd_ray_end *ends;
};

static void finish(struct batch *b)
{
    free(b->which);
    free(b->alpha_beta);
    free(b->outward);
    free(b->crossings);
    free(b->ends);
}

static enum kd_status init(struct batch *b, size_t n, uint32_t orders, struct kd_error *error)
{
    *b = (struct batch) { .which = malloc(n * sizeof *b->which),
                          .alpha_beta = malloc(2 * n * sizeof *b->alpha_beta),
                          .outward = malloc(n * sizeof *b->outward),
                          .crossings = malloc(n * orders * sizeof *b->crossings),
                          .ends = malloc(n * sizeof *b->ends) };
    if (b->which && b->alpha_beta && b->outward && b->crossings && b->ends)
        return KD_OK;
    finish(b);
    return kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays that are followed again", n);
}

/* Gathers the rays from *at on that fit, and advances *at. */
static void gather(struct batch *b, const struct kd_ray_labels *rays, const struct kd_ray_end *ends, double tolerance,
                   size_t *at)
{
    for (b->n = 0; *at < rays->n && b->n < SLICE; ++*at) {
        if (kd_rays_held(&ends[*at], tolerance))
            continue;
        memcpy(b->alpha_beta + 2 * b->n, rays->alpha_beta + 2 * *at, 2 * sizeof *b->alpha_beta);
        b->outward[b->n] = rays->outward && rays->outward[*at];
        b->which[b->n++] = *at;
    }
}

/* Replaces results by those of a finer setting, except where that would leave a decided ray undecided. */
static void adopt(const struct batch *b, uint32_t orders, struct kd_ray_crossing *crossings, struct kd_ray_end *ends)
{
    for (size_t i = 0; i < b->n; i++) {
        size_t k = b->which[i];
        ends[k].again = true;
        if (b->ends[i].fate == KD_RAY_UNDECIDED && ends[k].fate != KD_RAY_UNDECIDED)
            continue;
        ends[k] = b->ends[i];
        ends[k].again = true;
        memcpy(crossings + k * orders, b->crossings + i * orders, orders * sizeof *crossings);
    }
}

static enum kd_status follow(struct kd_renderer *renderer, const struct kd_rays_params *finer, double tolerance,
                             const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    struct batch b;
    enum kd_status status = init(&b, rays->n < SLICE ? rays->n : SLICE, finer->orders, error);
    if (status)
        return status;
    for (size_t at = 0; at < rays->n && !status;) {
        gather(&b, rays, ends, tolerance, &at);
        const struct kd_ray_labels some = { b.alpha_beta, b.outward, b.n };
        if (b.n)
            status = kd_rays_follow(renderer, finer, &some, b.crossings, b.ends, NULL, NULL, error);
        if (!status)
            adopt(&b, finer->orders, crossings, ends);
        if (!status && progress && !progress(user, 1))
            status = kd_error_set(error, KD_ECANCELLED, "the rays were cancelled");
    }
    finish(&b);
    return status;
}

static size_t beyond(const struct kd_ray_end *ends, size_t n, double tolerance)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        count += !kd_rays_held(&ends[i], tolerance);
    return count;
}

/* Finds a finer setting for the device. Returns false if there is none. */
static bool finer_on_device(const struct kd_renderer *renderer, const struct kd_rays_params *params,
                            struct kd_rays_params *out)
{
    enum { FINEST = 128 }; /* largest number of steps: with more, rounding errors dominate */
    uint32_t steps = params->steps ? params->steps : kd_engine_steps(params->engine, params->precision);
    bool mino = params->engine == KD_ENGINE_MINO_RKN6;
    if (!kd_vk_info(renderer->vk)->float64 ||
        (mino && params->precision == KD_PRECISION_F64 && MORE_STEPS * steps > FINEST))
        return false;
    out->engine = KD_ENGINE_MINO_RKN6;
    out->precision = KD_PRECISION_F64;
    out->steps = mino ? MORE_STEPS * steps : kd_engine_steps(KD_ENGINE_MINO_RKN6, KD_PRECISION_F64);
    out->steps = out->steps > FINEST ? FINEST : out->steps;
    return true;
}

enum kd_status kd_rays_hold_ask(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n)
{
    struct kd_rays_params finer = *params;
    return n >= WORTH_A_KERNEL && finer_on_device(renderer, params, &finer)
               ? kd_rays_device_ask(renderer, &finer, false)
               : KD_OK;
}

enum kd_status kd_rays_hold(struct kd_renderer *renderer, const struct kd_rays_params *params,
                            const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                            struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    struct kd_rays_params finer = *params;
    enum kd_status status = KD_OK;
    finer.tolerance = finer.holds = 0;
    if (beyond(ends, rays->n, params->tolerance) >= WORTH_A_KERNEL && finer_on_device(renderer, params, &finer))
        status = follow(renderer, &finer, params->tolerance, rays, crossings, ends, progress, user, error);
    finer.engine = KD_ENGINE_CLOSED;
    finer.precision = KD_PRECISION_F64;
    finer.steps = 0;
    if (!status && beyond(ends, rays->n, params->tolerance))
        status = follow(NULL, &finer, params->tolerance, rays, crossings, ends, progress, user, error);
    return status;
}
