/* A test body follows an exact timelike geodesic of Kerr, from time to time. One thread a geodesic.
 *
 * The method is that of physics/orbit/orbit_path.h, by Mino time with a step of its own; where the body is at a
 * coordinate time is found between two steps. A place is x = r sin(theta) cos(phi), y = r sin(theta) sin(phi), z = r
 * cos(theta) of its Boyer-Lindquist coordinates, and a velocity what an observer of zero angular momentum there
 * measures along e_r, e_theta, e_phi, put together as if these were the directions of a flat space. */
#ifndef KD_PLAYGROUND_GEODESIC_H
#define KD_PLAYGROUND_GEODESIC_H

#include "physics/orbit/orbit_path.h"
#include "physics/spacetime/hole.h"

#define KD_GEODESIC_FAR 1e6 /* M; who goes farther is let go */
#define KD_GEODESIC_NEAR \
    1.05 /* times the horizon's radius; who comes closer is the hole's: in the time of those far away it never arrives \
          */

struct kd_playground_geodesic {
    double spin, from_x[3], from_v[3], from_t; /* where it began: what does not change follows from it */
    double phi;                                /* there */
    double h;                                  /* the step, in Mino time */
    struct kd_orbit_path path;                 /* not past the time that was approached last */
    struct kd_orbit_path begun;                /* from where that was approached: kd_geodesic_back goes back to it */
};

/* KD_EINVAL, with the pointer "/position" or "/velocity", where there is no such motion. */
enum kd_status kd_geodesic_begin(struct kd_playground_geodesic *g, const struct kd_hole *hole, const double x[3],
                                 const double v[3], double t, struct kd_error *error);

/* Goes on to the step that leads past the time t, which is not before that of the last call, or to where the body is
 * captured or let go: in up to `steps` steps, which are counted down. False: they are spent, and the next call goes
 * on. */
bool kd_geodesic_approach(struct kd_playground_geodesic *g, double t, uint32_t *steps);
enum kd_geodesic_fate { KD_GEODESIC_GOES, KD_GEODESIC_CAPTURED, KD_GEODESIC_AWAY };
void kd_geodesic_back(struct kd_playground_geodesic *g);
/* Steps in a unit of time, as it moves now. */
double kd_geodesic_pace(const struct kd_playground_geodesic *g);
/* Place and velocity at the time t, which has been approached, and is where it goes on from: there is no way back
 * behind it. */
enum kd_geodesic_fate kd_geodesic_at(struct kd_playground_geodesic *g, double t, double x[3], double v[3]);

/* What a geodesic is besides its begin, where it may go back to, to be kept and taken up again exactly. */
enum { KD_GEODESIC_STATE = 20 };
void kd_geodesic_save(const struct kd_playground_geodesic *g, double state[KD_GEODESIC_STATE]);
void kd_geodesic_restore(struct kd_playground_geodesic *g,
                         const double state[KD_GEODESIC_STATE]); /* after kd_geodesic_begin */

#endif
