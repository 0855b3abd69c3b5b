/* Particles (render/emit/particles.h) on the device: how many are where on their grids, and where some of them are. Render thread only. */
#ifndef KD_RENDER_DEVICE_DEPOSIT_H
#define KD_RENDER_DEVICE_DEPOSIT_H

#include "base/error.h"
#include "render/emit/particles.h"

struct kd_renderer;
struct kd_particles; /* buffers: render/device/internal.h */
struct kd_vk;

/* The density at scene->top.time less that, in the buffers given, ready for the transfer pass. Submits. */
enum kd_status kd_particles_deposit(struct kd_renderer *renderer, struct kd_particles *particles, const struct kd_scene *scene,
                                    const struct kd_particle_grid *grid, double ns_per_particle, struct kd_error *error);

/* Places of the particles first, first + stride, ..., n of them, at scene->top.time, as the device
 * computes them: Boyer-Lindquist r in M and phi in turns of 2^32, latitude in radians. */
enum kd_status kd_particles_places(struct kd_renderer *renderer, const struct kd_scene *scene, uint32_t first, uint32_t stride,
                                   size_t n, struct kd_particle_place *out, struct kd_error *error);

void kd_particles_finish(struct kd_particles *particles, struct kd_vk *vk);
/* `guides` may not have come to the device: work was given up. */
void kd_particles_forget(struct kd_particles *particles);

#endif
