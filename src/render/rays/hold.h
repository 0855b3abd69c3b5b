/* Enforces a tolerance for each ray: rays whose own error estimate exceeds it are traced again by finer settings,
 * finally in closed form. Private to src/render; render thread only. */
#ifndef KD_RENDER_RAYS_HOLD_H
#define KD_RENDER_RAYS_HOLD_H

#include "render/rays/rays.h"

/* Called after kd_rays_trace with this setting; params->tolerance > 0. Replaces crossings and ends of the rays
 * concerned. */
enum kd_status kd_rays_hold(struct kd_renderer *renderer, const struct kd_rays_params *params,
                            const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                            struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

/* Asks for the kernel that it may take for so many rays. */
enum kd_status kd_rays_hold_ask(struct kd_renderer *renderer, const struct kd_rays_params *params, size_t n);

/* Whether a ray is decided and within the tolerance by its own error. A ray without an error has nothing that could
 * be wrong. */
static inline bool kd_rays_held(const struct kd_ray_end *end, double tolerance)
{
    return end->fate != KD_RAY_UNDECIDED && !(end->error > tolerance);
}

#endif
