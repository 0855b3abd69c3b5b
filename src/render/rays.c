#include "render/rays.h"

#include "render/rays_check.h"
#include "render/rays_closed.h"
#include "render/rays_device.h"

static enum kd_status trace_on_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                                      const double *alpha_beta, size_t n, struct kd_ray_crossing *crossings,
                                      struct kd_ray_end *ends, kd_progress_fn progress, void *user,
                                      struct kd_error *error)
{
    if (!renderer)
        return kd_error_field(error, "/accuracy/engine", "engine %s needs a device", kd_engine_name(params->engine));
    enum kd_status status =
        kd_rays_device(renderer, params, &(struct kd_ray_labels) { alpha_beta, NULL, n }, crossings, ends, progress, user, error);
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
        return kd_rays_closed(params, &(struct kd_ray_labels) { alpha_beta, NULL, n }, true, crossings, ends, progress, user, error);
    return trace_on_device(renderer, params, alpha_beta, n, crossings, ends, progress, user, error);
}
