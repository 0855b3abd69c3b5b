/* Makes the bodies (scene/dynamic_bodies.h) that show a playground's present state in a picture of a scene. Call these
 * functions on the thread that owns the playground.
 *
 * A body's r, theta, phi are used as Boyer-Lindquist coordinates (body.h). With gravity "kerr" this is exact, and
 * velocities are relative to the observer of zero angular momentum. In the potential of Paczynski and Wiita a body has
 * a Newtonian velocity u of any size up to c, with kinetic energy u^2/2. This u is used as gamma v, so v = u/sqrt(1 +
 * u^2) relative to the same observer. For comparison, circular orbits have (gamma v)^2 = 1/(r - 3) in Schwarzschild's
 * metric, and u^2 = r/(r - 2)^2 here.
 *
 * Debris is projected onto the plane of the disk at its r and phi, as a density (kd_dynamic_bodies_debris). The weight
 * of a piece is its share of its body's mass. This share follows from the number of pieces into which the body split
 * when the piece was torn off. */
#ifndef KD_PLAYGROUND_SHOW_H
#define KD_PLAYGROUND_SHOW_H

#include "playground/playground.h"
#include "playground/preset.h"
#include "scene/dynamic_bodies.h"
#include "scene/scene.h"

/* Makes the bodies. The caller gets a reference to *out. */
enum kd_status kd_playground_show(const struct kd_playground *p, struct kd_dynamic_bodies **out,
                                  struct kd_error *error);

/* Calls kd_playground_show, and also stores the hash of the playground's state, which files of pictures contain. */
enum kd_status kd_playground_show_named(struct kd_playground *p, struct kd_dynamic_bodies **out,
                                        struct kd_error *error);

/* Checks that the scene can show this playground; otherwise returns KD_EINVAL. With gravity "kerr" the scene must have
 * the same hole as the playground. With the other gravity the hole's parameters other than the spin must be 0. */
enum kd_status kd_playground_may_show(const struct kd_playground *p, const struct kd_scene *scene,
                                      struct kd_error *error);

/* Widens the field of view of a scene at infinity until it shows all bodies, and nine in ten pieces of debris. */
enum kd_status kd_playground_widen(const struct kd_playground *p, struct kd_scene *scene, struct kd_error *error);

/* Makes a suitable scene of 640 x 360: the scene of the preset or, if preset is NULL, one that is wide enough for the
 * playground's bodies. */
enum kd_status kd_playground_usual_scene(const struct kd_playground_preset *preset, const struct kd_playground *p,
                                         struct kd_scene *out, struct kd_error *error);

/* The functions from here on are private to src/playground, and for tests. They compute the places of pieces in (ln r,
 * azimuth), choose the grid (at most KD_SHOW_NODES nodes), and distribute the pieces over the nodes. worth: for each
 * source, the weight of one piece, in bodies. */
enum { KD_SHOW_NODES = 1 << 20, KD_SHOW_TURN_LEAST = 512, KD_SHOW_TURN_MOST = 8192 };
struct kd_show_place {
    float row, column;
    /* place in cells of a grid with KD_SHOW_TURN_MOST columns a turn; column is counted from 0, and is NAN if the
     * piece is not in the picture */
};
void kd_show_places(const struct kd_debris_piece *pieces, size_t n, struct kd_show_place *out);
void kd_show_grid(const struct kd_show_place *places, size_t n, struct kd_dynamic_bodies_debris *out);
void kd_show_share_out(const struct kd_debris_piece *pieces, const struct kd_show_place *places, size_t n,
                       const float worth[KD_DEBRIS_SOURCES], bool approximate, struct kd_dynamic_bodies_debris *to);

#endif
