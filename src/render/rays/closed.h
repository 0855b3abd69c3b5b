/* The closed engine, which traces rays in closed form. It also computes the redshift at crossings for all engines.
 * Private to src/render; any thread. */
#ifndef KD_RENDER_RAYS_CLOSED_H
#define KD_RENDER_RAYS_CLOSED_H

#include "render/rays/rays.h"

/* KD_CLOSED_RADII: r of each crossing, and fates; phi, delay, theta, g and errors are NaN. KD_CLOSED_PLACES: everything
 * except g and errors. KD_CLOSED_ERRORS: everything. Each takes some three times as long as the one before it. */
enum kd_closed_results { KD_CLOSED_RADII, KD_CLOSED_PLACES, KD_CLOSED_ERRORS };

/* kd_rays_trace for KD_ENGINE_CLOSED, with checked params. Long lists are divided among the cores; progress is
 * called on the calling thread. */
enum kd_status kd_rays_closed(const struct kd_rays_params *params, const struct kd_ray_labels *rays,
                              enum kd_closed_results results, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

/* Fills in g for an engine that returned positions only. */
void kd_rays_redshift(const struct kd_rays_params *params, const struct kd_ray_labels *rays,
                      struct kd_ray_crossing *crossings, const struct kd_ray_end *ends);

/* dw/dtau, with w = 1/r, of a traced ray of E = 1 at its k-th crossing of the plane. r: radius of this crossing, from
 * any engine. outward: as in kd_ray_labels. */
double kd_rays_slope(const struct kd_rays_params *params, const double *alpha_beta, bool outward,
                     const struct kd_ray_end *end, uint32_t k, double r);

#endif
