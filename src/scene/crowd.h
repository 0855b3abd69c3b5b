/* A crowd is what a picture shows besides what its scene says: bodies, in any number up to KD_CROWD_BODIES, and
 * debris as a density on the plane of the disk, as they are at one time. Whoever moves them makes one for each
 * picture (playground/show.h).
 *
 * It does not change once it is made, and may be read by any thread. It is counted: who makes it holds it, and
 * whoever has a scene that shows it (kd_scene_show) must have it held until all that is done with that scene, or
 * with a copy, is over. Neither the JSON of a scene nor its hash knows of it. Lengths in M, angles in radians. */
#ifndef KD_SCENE_CROWD_H
#define KD_SCENE_CROWD_H

#include "base/error.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_CROWD_BODIES 4096 /* at most */

struct kd_scene;

struct kd_seen_body {
    double r, u, s, phi; /* Boyer-Lindquist: radius outside the outer horizon; cosine and sine of the polar angle;
                            azimuth, in the hole's own frame */
    double
        velocity[3]; /* along e_r, e_theta, e_phi of the observer of zero angular momentum there, less than 1 in all */
    double radius;   /* in its own frame; 0 or less: it is not seen */
    uint32_t which;  /* what a pixel that shows it is told: its place in whoever's list */
    double temperature_k, brightness,
        limb_darkening; /* as bodies.* of a scene has them; of temperature 0 it is dark, and hides what is behind it */
    double albedo; /* share of the disk's light that it throws back, evenly to all sides; 0: that is not looked for */
};

/* Debris lies on nodes, 2 pi/turn apart in azimuth and in ln r, turn being a power of two: `rows` rows of `columns`
 * nodes each, which begin at ln r = first_row 2 pi/turn, and at the azimuth first_column 2 pi/turn. All round, where
 * there are `turn` columns, else as far as there is debris. A piece is shared out among the four nodes round it,
 * linearly in both, so that all nodes together hold as much as all pieces. */
struct kd_crowd_debris {
    uint32_t turn, rows, columns, first_column; /* rows 0: there is no debris */
    int32_t first_row;
    float *nodes; /* of each KD_CROWD_NODE: bodies' worth of debris, and that times the velocity along e_r and e_phi, as
                     kd_seen_body has it */
    uint32_t pieces; /* on them; */
    uint32_t hidden; /* and pieces that are not, as they are nowhere */
    double thick;    /* mean of |z|/r of the pieces that were put on the plane */
    double temperature_k,
        depth; /* it shines as a black body of that; of so much optical depth is a body's worth over 1000 M^2 */
};
#define KD_CROWD_NODE 3

struct kd_crowd {
    atomic_uint holders;
    uint64_t generation; /* no two crowds of a process have the same */
    double time;         /* that all is at, in M */
    char snapshot[65];   /* SHA-256 of the state that it was made of, for files of pictures; "": it is not told */
    bool approximate; /* its bodies move in a potential, not in the metric: their r and velocity are put in the place of
                         the metric's */
    size_t n;
    struct kd_seen_body *bodies;
    struct kd_crowd_debris debris;
};

/* One that the caller holds, fills, and from then on leaves as it is: n bodies and nodes of debris, all 0.
 * KD_ENOMEM. */
enum kd_status kd_crowd_create(size_t n, uint32_t rows, uint32_t columns, struct kd_crowd **out,
                               struct kd_error *error);
void kd_crowd_keep(struct kd_crowd *crowd);    /* accepts NULL */
void kd_crowd_release(struct kd_crowd *crowd); /* accepts NULL; the last holder's frees it */

/* The scene, and copies of it, show this crowd from now on; NULL: none. */
void kd_scene_show(struct kd_scene *scene, const struct kd_crowd *crowd);

#endif
