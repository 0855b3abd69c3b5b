/* A crowd is moving content that a picture shows beside its scene, at one time: up to KD_CROWD_BODIES bodies, and
 * debris as a density on the plane of the disk. The playground makes one for each picture (playground/show.h).
 *
 * A crowd is immutable once made, may be read by any thread, and is reference-counted. Its maker holds a reference.
 * A scene shows it by kd_scene_show, which takes no reference: the caller holds one until all use of that scene and
 * its copies is over. It is part of neither the scene's JSON nor its hash. Lengths in M, angles in radians. */
#ifndef KD_SCENE_DYNAMIC_BODIES_H
#define KD_SCENE_DYNAMIC_BODIES_H

#include "base/error.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_CROWD_BODIES 4096 /* maximum */

struct kd_scene;

struct kd_seen_body {
    /* Boyer-Lindquist: radius (outside the outer horizon); cosine and sine of the polar angle; azimuth in the hole's
     * frame. */
    double r, u, s, phi;
    /* Components along e_r, e_theta, e_phi of the local observer of zero angular momentum; magnitude less than 1. */
    double velocity[3];
    double radius;  /* in its own frame; not drawn if 0 or less */
    uint32_t which; /* index in the maker's list, reported for a pixel that shows it */
    /* As bodies.* of a scene. A body of temperature 0 is dark and hides what is behind it. */
    double temperature_k, brightness, limb_darkening;
    double albedo; /* fraction of the disk's light that it reflects, isotropically; 0: reflection is not computed */
};

/* Debris is a density on a grid of nodes, spaced 2 pi/turn in azimuth and in ln r; turn is a power of two. There are
 * `rows` rows of `columns` nodes each, starting at ln r = first_row 2 pi/turn and azimuth first_column 2 pi/turn.
 * With columns == turn the grid covers all azimuths, otherwise only those that hold debris. Each piece is deposited
 * bilinearly on its four nearest nodes, so that the nodes' sum equals that of the pieces. */
struct kd_dynamic_bodies_debris {
    uint32_t turn, rows, columns, first_column; /* rows 0: no debris */
    int32_t first_row;
    /* KD_CROWD_NODE numbers a node: debris in units of a body, and that times its velocity along e_r and e_phi, as
     * in kd_seen_body. */
    float *nodes;
    uint32_t pieces; /* number deposited on the nodes */
    uint32_t hidden; /* number not deposited, because they have no valid position */
    double thick;    /* mean of |z|/r over the pieces projected onto the plane */
    /* Black-body temperature, and the optical depth of one body's worth of debris spread over 1000 M^2. */
    double temperature_k, depth;
};
#define KD_CROWD_NODE 3

struct kd_dynamic_bodies {
    atomic_uint holders;
    uint64_t generation; /* unique in the process */
    double time;         /* coordinate time of the contents, in M */
    char snapshot[65];   /* SHA-256 of the source state, for files of pictures; "": unknown */
    /* Its bodies move in a potential, not in the metric; their r and velocity are used as if they were the metric's. */
    bool approximate;
    size_t n;
    struct kd_seen_body *bodies;
    struct kd_dynamic_bodies_debris debris;
};

/* Creates a crowd of n bodies and of nodes of debris, all 0. The caller owns a reference, fills it, and must not
 * change it afterwards. KD_ENOMEM. */
enum kd_status kd_dynamic_bodies_create(size_t n, uint32_t rows, uint32_t columns, struct kd_dynamic_bodies **out,
                                        struct kd_error *error);
void kd_dynamic_bodies_keep(struct kd_dynamic_bodies *crowd); /* takes a reference; accepts NULL */
void kd_dynamic_bodies_release(
    struct kd_dynamic_bodies *crowd); /* drops a reference and frees the crowd with the last; accepts NULL */

/* Makes the scene, and later copies of it, show this crowd; NULL: none. */
void kd_scene_show(struct kd_scene *scene, const struct kd_dynamic_bodies *crowd);

#endif
