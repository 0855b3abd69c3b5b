/* A playground is shown in a picture of a scene by a crowd (scene/crowd.h) made of its present state. The thread
 * that has the playground.
 *
 * A body's r, theta, phi are taken for those of Boyer and Lindquist (body.h). With gravity "kerr" that is what they
 * are, and velocities are past the observer of zero angular momentum. The potential of Paczynski and Wiita has a
 * velocity u by Newton, of any size up to c: as u^2/2 is its energy, it is taken for gamma v, v = u/sqrt(1 + u^2)
 * being past that observer. On circles in Schwarzschild's metric (gamma v)^2 = 1/(r - 3), and u^2 = r/(r - 2)^2.
 *
 * Debris is put on the plane of the disk at its r and phi, as a density (kd_crowd_debris). A piece is worth the
 * share that it has of its body's mass, by the number of pieces that bodies fell into when it was torn off. */
#ifndef KD_PLAYGROUND_SHOW_H
#define KD_PLAYGROUND_SHOW_H

#include "playground/playground.h"
#include "playground/preset.h"
#include "scene/crowd.h"
#include "scene/scene.h"

/* The caller holds *out. */
enum kd_status kd_playground_show(const struct kd_playground *p, struct kd_crowd **out, struct kd_error *error);

/* Such a crowd that says of which state it was made, for files of pictures. */
enum kd_status kd_playground_show_named(struct kd_playground *p, struct kd_crowd **out, struct kd_error *error);

/* KD_EINVAL where the scene is not one to show it in: with gravity "kerr" the spins must be the same. */
enum kd_status kd_playground_may_show(const struct kd_playground *p, const struct kd_scene *scene,
                                      struct kd_error *error);

/* Makes a scene at infinity as wide as shows all bodies and nine pieces of debris in ten, and no narrower than it
 * is. */
enum kd_status kd_playground_widen(const struct kd_playground *p, struct kd_scene *scene, struct kd_error *error);

/* Makes the scene that shows it well, at 640 x 360: that of its preset, or, where that is NULL, one as wide as its
 * bodies are far out. */
enum kd_status kd_playground_usual_scene(const struct kd_playground_preset *preset, const struct kd_playground *p,
                                         struct kd_scene *out, struct kd_error *error);

/* Private to src/playground, and for tests. Where pieces are in (ln r, azimuth), which grid has them, at most
 * KD_SHOW_NODES, and what each of its nodes has; worth: of a piece of each source. */
enum { KD_SHOW_NODES = 1 << 20, KD_SHOW_TURN_LEAST = 512, KD_SHOW_TURN_MOST = 8192 };
struct kd_show_place {
    float row, column;
}; /* in cells of KD_SHOW_TURN_MOST a turn, the column from 0 on; NAN: nowhere */
void kd_show_places(const struct kd_debris_piece *pieces, size_t n, struct kd_show_place *out);
void kd_show_grid(const struct kd_show_place *places, size_t n, struct kd_crowd_debris *out);
void kd_show_share_out(const struct kd_debris_piece *pieces, const struct kd_show_place *places, size_t n,
                       const float worth[KD_DEBRIS_SOURCES], bool approximate, struct kd_crowd_debris *to);

#endif
