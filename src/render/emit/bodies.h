/* Prepares bodies for the kernels of light: opaque spheres with position, velocity and size, in a tree of bounding
 * balls (shaders/emit/bodies.glsl). Lengths in M, angles in radians. Pure; any thread. */
#ifndef KD_RENDER_EMIT_BODIES_H
#define KD_RENDER_EMIT_BODIES_H

#include "physics/spacetime/hole.h"
#include "render/emit/emission.h"
#include "scene/dynamic_bodies.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_SEEN_BODIES (KD_CROWD_BODIES + KD_SCENE_BODIES) /* largest number of bodies in a picture */

/* What the appearance of bodies depends on: the hole, the observer's azimuth, and the temperature that corresponds to
 * the disk's brightness 1. */
struct kd_illumination;
struct kd_bodies_view {
    struct kd_hole hole;
    double azimuth, peak_k;
    const struct kd_illumination *lit;
}; /* lit: the disk as a light source; NULL if the disk does not illuminate the bodies */

/* kd_illumination_exists: true if the scene has a thin disk. kd_illumination_of: prepares the disk as a light source
 * for bodies (bodies_illumination.c); returns false if there is no thin disk. */
enum { KD_LIT_RINGS = 16, KD_LIT_PLACES = 24 };
struct kd_illumination {
    struct kd_illumination_ring { double r, t, light, lapse, velocity; } rings[KD_LIT_RINGS];
};
bool kd_illumination_exists(const struct kd_scene *scene);
bool kd_illumination_of(const struct kd_scene *scene, struct kd_illumination *out);
/* Computes the light that a body reflects, in the kernels' layout. Takes 3 us. lapse: the lapse at the body's
 * position. */
void kd_illumination_body(const struct kd_illumination *lit, const struct kd_seen_body *body, double lapse,
                          float out[12]);

/* Number of floats of n bodies and their tree. */
size_t kd_bodies_words(size_t n);
/* Writes bodies and tree, in 10 us for 16 bodies and 2 ms for 4096. n is at most KD_SEEN_BODIES. A body is left out in
 * three cases: it has no size, one of its numbers is out of range, or its r is less than KD_BODIES_CLEAR times the
 * horizon's. */
enum kd_status kd_bodies_pack(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                              float *words, struct kd_error *error);
/* True if a body is packed. A body of temperature 0 is packed, because it is dark but hides what is behind it. */
bool kd_bodies_seen(const struct kd_seen_body *body, const struct kd_hole *hole);
/* Computes the numbers that the kernels read beside the packed bodies, such as the ball that bounds them all. */
void kd_bodies_bound(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                     struct kd_bodies_block *out);
#define KD_BODIES_CLEAR 1.02

/* kd_bodies_count: number of bodies of a valid scene. kd_bodies_of lists them: the scene's own bodies at the scene's
 * time, then those of its playground. */
size_t kd_bodies_count(const struct kd_scene *scene);
size_t kd_bodies_of(const struct kd_scene *scene, struct kd_seen_body *out);

/* Brings the buffer up to date with a scene's bodies (emit/own.h). */
extern const struct kd_emitter_buffers kd_emitter_buffers_bodies;

#endif
