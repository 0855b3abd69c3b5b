/* Dynamic bodies are moving content that a picture shows in addition to its scene, as it is at one moment: up to
 * KD_CROWD_BODIES bodies, and debris as a density on the plane of the disk. The playground makes such a set for each
 * picture (playground/show.h).
 *
 * A set is immutable once it is made. Any thread may read it. It is reference-counted, and its maker holds one
 * reference. kd_scene_show adds a set to a scene but takes no reference. The caller must hold a reference as long as
 * that scene or a copy of it is used. The scene's JSON and hash do not include the set. Lengths are in M, angles in
 * radians. */
#ifndef KD_SCENE_DYNAMIC_BODIES_H
#define KD_SCENE_DYNAMIC_BODIES_H

#include "base/error.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_CROWD_BODIES 4096 /* limit of the number of bodies */

struct kd_scene;

struct kd_seen_body {
    /* Boyer-Lindquist coordinates: r, the radius, which is outside the outer horizon; u and s, cosine and sine of
     * the polar angle; phi, the azimuth in the hole's frame. */
    double r, u, s, phi;
    /* Components of the velocity along e_r, e_theta and e_phi, in the frame of the local observer of zero angular
     * momentum, in units of c. The magnitude is below 1. */
    double velocity[3];
    double radius;  /* radius in the frame of the body; 0 or less: the body is not drawn */
    uint32_t which; /* index in the maker's list, which is reported for a pixel that shows the body */
    /* as for the bodies of a scene; a body of temperature 0 is dark and hides everything behind it */
    double temperature_k, brightness, limb_darkening;
    /* fraction of the disk's light that the body reflects isotropically; 0: no reflection is computed */
    double albedo;
};

/* Debris is stored as a density on a grid of nodes. The spacing of the nodes, in azimuth and in ln r, is 2 pi/turn;
 * turn is a power of two. There are `rows` rows of `columns` nodes each. The first node is at ln r = first_row 2
 * pi/turn and azimuth first_column 2 pi/turn. If columns == turn the grid covers all azimuths, otherwise only those
 * with debris. Each piece of debris is distributed bilinearly over its four nearest nodes, so that the sum over all
 * nodes is the amount of debris. */
struct kd_dynamic_bodies_debris {
    uint32_t turn, rows, columns, first_column; /* rows is 0 if there is no debris */
    int32_t first_row;
    /* KD_CROWD_NODE numbers for each node: the amount of debris, in units of one body; this amount times the
     * velocity along e_r; and this amount times the velocity along e_phi. The velocities are in the frame of
     * kd_seen_body. */
    float *nodes;
    uint32_t pieces; /* number of pieces of debris that the nodes include */
    uint32_t hidden; /* number of pieces of debris that were left out, because they have no valid position */
    /* mean of |z|/r over the pieces of debris; it is computed before they are projected onto the plane */
    double thick;
    /* temperature_k: temperature of the debris, which shines as a black body. depth: optical depth of the debris of
     * one body if it were spread over 1000 M^2. */
    double temperature_k, depth;
};
#define KD_CROWD_NODE 3

struct kd_dynamic_bodies {
    atomic_uint holders;
    uint64_t generation; /* number that no other set in this process has */
    double time;         /* coordinate time for which the set was made, in M */
    char snapshot[65];   /* SHA-256 of the playground's state that the set shows, for picture files; "" if unknown */
    /* true if the bodies move in a potential instead of the metric; their r and velocity are used as if they
     * belonged to the metric */
    bool approximate;
    size_t n;
    struct kd_seen_body *bodies;
    struct kd_dynamic_bodies_debris debris;
};

/* Creates a set with n bodies and with nodes of debris, all 0. The caller owns a reference and fills the set. After
 * that, the set must not change. The only error is KD_ENOMEM. */
enum kd_status kd_dynamic_bodies_create(size_t n, uint32_t rows, uint32_t columns, struct kd_dynamic_bodies **out,
                                        struct kd_error *error);
void kd_dynamic_bodies_keep(struct kd_dynamic_bodies *dynamic); /* takes a reference; accepts NULL */
void kd_dynamic_bodies_release(
    struct kd_dynamic_bodies *dynamic); /* drops a reference; the last one frees the set; accepts NULL */

/* Makes the scene show these bodies (NULL: none). Copies of the scene that are made later show them too. */
void kd_scene_show(struct kd_scene *scene, const struct kd_dynamic_bodies *dynamic);

#endif
