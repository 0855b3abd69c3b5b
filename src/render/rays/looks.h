/* Converts directions in the frame of a moving observer to labels of rays, and the results back into that frame.
 * Private to src/render/rays but for `kerrd rays --trace`. Pure, any thread. */
#ifndef KD_RENDER_RAYS_LOOKS_H
#define KD_RENDER_RAYS_LOOKS_H

#include "render/rays/rays.h"

/* KD_EINVAL: this observer cannot be here, or has numbers that are another's. params->observer is set. */
enum kd_status kd_rays_looks_check(const struct kd_rays_params *params, struct kd_error *error);

/* The labels of n directions, [yaw, pitch] in degrees as camera.yaw_deg and camera.pitch_deg have them. energy: at
 * infinity, per unit that the observer measures. alpha_beta: 2 n; outward, energy: n. */
void kd_rays_looks_label(const struct kd_rays_params *params, const double *directions, size_t n, double *alpha_beta,
                         bool *outward, double *energy);

/* Redshifts by the energies that the observer measures; a ray whose energy at infinity is below 0 goes round the other
 * way, and its time runs the other way (view/camera.h). */
void kd_rays_looks_see(const struct kd_rays_params *params, const double *energy, size_t n,
                       struct kd_ray_crossing *crossings, struct kd_ray_end *ends);

#endif
