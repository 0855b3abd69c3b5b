/* Counts the particles (render/emit/particles.h) at each node of their grids on the device. Also reads back the
 * positions of listed particles. Render thread only. */
#ifndef KD_RENDER_EMIT_DEPOSIT_H
#define KD_RENDER_EMIT_DEPOSIT_H

#include "base/error.h"
#include "render/emit/own.h"
#include "render/emit/particles.h"

/* Fills the density at the time scene->top.time minus kd_particle_delay, for the transfer pass. */
extern const struct kd_emitter_buffers kd_emitter_buffers_particles;

/* Positions of n particles (first, first + stride, ...) at scene->top.time, as the device computes them. They are
 * Boyer-Lindquist: r in M, phi in units of 2^-32 turn, latitude in radians. */
enum kd_status kd_particles_places(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                                   uint32_t first, uint32_t stride, size_t n, struct kd_particle_place *out,
                                   struct kd_error *error);
/* Requests the kernel that kd_particles_places uses, for kd_kernels_note. */
enum kd_status kd_particles_ask(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene);

#endif
