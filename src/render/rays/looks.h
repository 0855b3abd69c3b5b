/* Converts directions in the frame of a moving observer to labels of rays, and the results back to that frame.
 * Private to src/render/rays and `kerrd rays --trace`. Pure, any thread. */
#ifndef KD_RENDER_RAYS_LOOKS_H
#define KD_RENDER_RAYS_LOOKS_H

#include "render/rays/rays.h"

/* Returns KD_EINVAL if this observer cannot exist at its place, or if parameters of another kind of observer are set.
 * params->observer must be set. */
enum kd_status kd_rays_looks_check(const struct kd_rays_params *params, struct kd_error *error);

/* Computes the labels of n directions; a direction is [yaw, pitch] in degrees, as camera.yaw_deg and
 * camera.pitch_deg. energy: each ray's energy at infinity, in units of the energy that the observer measures.
 * alpha_beta has 2 n numbers; outward and energy have n each. */
void kd_rays_looks_label(const struct kd_rays_params *params, const double *directions, size_t n, double *alpha_beta,
                         bool *outward, double *energy);

/* Converts redshifts to the energies that the observer measures. For a ray of negative energy at infinity, azimuth
 * and time change sign (view/camera.h). */
void kd_rays_looks_see(const struct kd_rays_params *params, const double *energy, size_t n,
                       struct kd_ray_crossing *crossings, struct kd_ray_end *ends);

#endif
