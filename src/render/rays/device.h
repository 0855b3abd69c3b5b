/* Engines that trace rays on the device. Private to src/render; render thread only. */
#ifndef KD_RENDER_RAYS_DEVICE_H
#define KD_RENDER_RAYS_DEVICE_H

#include "render/rays/rays.h"

/* kd_rays_trace for any engine except KD_ENGINE_CLOSED, with checked params. g stays NaN. With the Kerr-Schild engines
 * the errors also stay NaN. */
enum kd_status kd_rays_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);

/* Requests, for kd_kernels_note, the kernel of kd_rays_device, or that of kd_rays_device_told if `told` is true. */
enum kd_status kd_rays_device_ask(struct kd_renderer *renderer, const struct kd_rays_params *params, bool told);

/* Traces one ray and returns the records that trace.glsl describes, as doubles. There is room for `numbers` of them. */
enum kd_status kd_rays_device_told(struct kd_renderer *renderer, const struct kd_rays_params *params,
                                   const struct kd_ray_labels *ray, struct kd_ray_crossing *crossings,
                                   struct kd_ray_end *end, double *told, size_t numbers, struct kd_error *error);

#endif
