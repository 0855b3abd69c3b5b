/* Bodies as the kernels of light have them: opaque spheres, given by place, velocity and size, and a tree of balls over them (shaders/emit/bodies.glsl).
 * Lengths in M, angles in radians. Pure; any thread. */
#ifndef KD_RENDER_EMIT_BODIES_H
#define KD_RENDER_EMIT_BODIES_H

#include "render/emit/emission.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_SEEN_BODIES 4096 /* at most */

struct kd_seen_body {
    double r, u, s, phi;     /* Boyer-Lindquist: radius outside the outer horizon; cosine and sine of the polar angle; azimuth, in the hole's own frame */
    double velocity[3];      /* along e_r, e_theta, e_phi of the observer of zero angular momentum there, less than 1 in all */
    double radius;           /* in its own frame; 0 or less: it is not seen */
    uint32_t which;          /* what a pixel that shows it is told: its place in whoever's list */
    double temperature_k, brightness, limb_darkening; /* as bodies.* of a scene has them */
};

/* Counts the floats of n bodies and their tree. */
size_t kd_bodies_words(size_t n);
/* Writes them, and the numbers of *out. spin: of the hole; azimuth: the observer's; peak_k: temperature that the disk's brightness 1 is of. n at most
 * KD_SEEN_BODIES. Some 10 us of 16 bodies. Bodies that cannot be, or have no size, are left out: they have none of the numbers above, or are within 1.05 of the horizon's radius. */
enum kd_status kd_bodies_pack(const struct kd_seen_body *bodies, size_t n, double spin, double azimuth, double peak_k, struct kd_bodies_block *out, float *words,
                              struct kd_error *error);

/* Lists those of a valid scene as they are at its time. */
size_t kd_bodies_of(const struct kd_scene *scene, struct kd_seen_body out[KD_SCENE_BODIES]);

/* Brings the buffer to what a scene's bodies are (emit/own.h). */
extern const struct kd_own kd_own_bodies;

#endif
