/* Bodies for the kernels of light: opaque spheres, by place, velocity and size, and a tree of bounding balls over them
 * (shaders/emit/bodies.glsl). Lengths in M, angles in radians. Pure; any thread. */
#ifndef KD_RENDER_EMIT_BODIES_H
#define KD_RENDER_EMIT_BODIES_H

#include "physics/spacetime/hole.h"
#include "render/emit/emission.h"
#include "scene/crowd.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_SEEN_BODIES (KD_CROWD_BODIES + KD_SCENE_BODIES) /* at most */

/* Where all is seen from: the hole's spin, the observer's azimuth; temperature that the disk's brightness 1 is of. */
struct kd_lit;
struct kd_bodies_view {
    double spin, azimuth, peak_k;
    const struct kd_lit *lit;
}; /* lit: NULL, the disk does not light them */

/* The disk as it lights them (bodies_lit.c). False: there is no thin one. */
enum { KD_LIT_RINGS = 16, KD_LIT_PLACES = 24 };
struct kd_lit {
    struct kd_lit_ring { double r, t, light, lapse, velocity; } rings[KD_LIT_RINGS];
};
bool kd_lit_of(const struct kd_scene *scene, struct kd_lit *out);
/* The light that a body throws back, as the kernels have it: 3 us. lapse: at its place. */
void kd_lit_body(const struct kd_lit *lit, const struct kd_seen_body *body, double lapse, float out[12]);

/* Counts the floats of n bodies and their tree. */
size_t kd_bodies_words(size_t n);
/* Writes them; n at most KD_SEEN_BODIES. Some 10 us of 16 bodies, 2 ms of 4096. Bodies that cannot be, or have no
 * size, are left out: they have none of the numbers above, or are within KD_BODIES_CLEAR of the horizon's radius. */
enum kd_status kd_bodies_pack(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                              float *words, struct kd_error *error);
/* Whether it is among those that are packed. A body of temperature 0 is: it is dark, and hides what lies behind it. */
bool kd_bodies_seen(const struct kd_seen_body *body, const struct kd_hole *hole);
/* Finds the numbers that go with them. */
void kd_bodies_bound(const struct kd_seen_body *bodies, size_t n, const struct kd_bodies_view *view,
                     struct kd_bodies_block *out);
#define KD_BODIES_CLEAR 1.02

/* Count and list those that a valid scene shows: its own as they are at its time, then those of its crowd. */
size_t kd_bodies_count(const struct kd_scene *scene);
size_t kd_bodies_of(const struct kd_scene *scene, struct kd_seen_body *out);

/* Brings the buffer to what a scene's bodies are (emit/own.h). */
extern const struct kd_own kd_own_bodies;

#endif
