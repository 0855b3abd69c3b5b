#include "render/rays.h"

#include "render/internal.h"
#include "render/rays_check.h"
#include "render/rays_closed.h"

const char *kd_engine_name(enum kd_engine engine)
{
    static const char *const names[KD_ENGINE_COUNT] = {
        [KD_ENGINE_CLOSED] = "closed",       [KD_ENGINE_MINO_RKN4] = "mino-rkn4", [KD_ENGINE_MINO_RKN6] = "mino-rkn6",
        [KD_ENGINE_KS_EULER] = "ks-euler",   [KD_ENGINE_KS_RK4] = "ks-rk4",       [KD_ENGINE_KS_TAO6] = "ks-tao6",
    };
    return (unsigned)engine < KD_ENGINE_COUNT ? names[engine] : "unknown";
}

const char *kd_precision_name(enum kd_precision precision)
{
    return precision == KD_PRECISION_F32 ? "f32" : "f64";
}

static enum kd_status trace_on_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                                      const double *alpha_beta, size_t n, struct kd_ray_crossing *crossings,
                                      struct kd_ray_end *ends, kd_progress_fn progress, void *user,
                                      struct kd_error *error)
{
    if (!renderer)
        return kd_error_field(error, "/accuracy/engine", "engine %s needs a device", kd_engine_name(params->engine));
    enum kd_status status =
        kd_rays_device(renderer, params, alpha_beta, n, crossings, ends, progress, user, error);
    if (!status)
        kd_rays_redshift(params, alpha_beta, n, crossings, ends);
    return status;
}

enum kd_status kd_rays_trace(struct kd_renderer *renderer, const struct kd_rays_params *params,
                             const double *alpha_beta, size_t n, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    enum kd_status status = kd_rays_check(params, alpha_beta, n, error);
    if (status)
        return status;
    if (params->engine == KD_ENGINE_CLOSED)
        return kd_rays_closed(params, alpha_beta, n, crossings, ends, progress, user, error);
    return trace_on_device(renderer, params, alpha_beta, n, crossings, ends, progress, user, error);
}
