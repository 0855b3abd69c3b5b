/* Enforces a tolerance for each ray. Rays whose own error estimate exceeds the tolerance are traced again by finer
 * settings, finally in closed form. Private to src/render; render thread only. */
#ifndef KD_RENDER_RAYS_HOLD_H
#define KD_RENDER_RAYS_HOLD_H

#include "render/rays/rays.h"

/* Call after kd_rays_trace with this setting; params->tolerance must be > 0. Replaces crossings and ends of the rays
 * traced again. */
enum kd_status kd_rays_hold(struct kd_renderer *renderer, const struct kd_rays_params *params,
                            const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                            struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

/* Requests the kernel that kd_rays_hold may need for n rays. */
enum kd_status kd_rays_hold_ask(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n);

/* True if a ray is decided and within the tolerance by its own error estimate. A ray without an error estimate counts
 * as within the tolerance, because nothing about it could be wrong. */
static inline bool kd_rays_held(const struct kd_ray_end *end, double tolerance)
{
    return end->fate != KD_RAY_UNDECIDED && !(end->error > tolerance);
}

#endif
