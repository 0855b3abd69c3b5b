/* The exact timelike Kerr geodesic of a test body, as a function of coordinate time. One thread at a time may use a
 * geodesic.
 *
 * It is integrated in Mino time with a fixed step, by physics/orbit/orbit_path.h. The place at a coordinate time is
 * found between two steps. Positions are x = r sin(theta) cos(phi), y = r sin(theta) sin(phi), z = r cos(theta) of the
 * Boyer-Lindquist coordinates. A velocity is measured by the local observer of zero angular momentum along e_r,
 * e_theta, e_phi; its components are combined as if e_r, e_theta and e_phi were directions in flat space. */
#ifndef KD_PLAYGROUND_GEODESIC_H
#define KD_PLAYGROUND_GEODESIC_H

#include "physics/orbit/orbit_path.h"
#include "physics/spacetime/hole.h"

#define KD_GEODESIC_FAR 1e6 /* radius, M, beyond which a body is removed */
#define KD_GEODESIC_NEAR \
    1.05 /* a body closer than this multiple of the horizon's radius counts as captured, because in the time of \
          * distant observers it never reaches the horizon */

struct kd_playground_geodesic {
    /* position, velocity and time at the start, which determine the constants of motion */
    double from_x[3], from_v[3], from_t;
    double phi;                 /* azimuth at the start */
    double h;                   /* step in Mino time */
    struct kd_orbit_path path;  /* state that kd_geodesic_approach reached last, at its time or before it */
    struct kd_orbit_path begun; /* state at the last time reached; kd_geodesic_back returns to it */
};

/* Begins the motion. Returns KD_EINVAL, with the pointer "/position" or "/velocity", if there is no such motion. */
enum kd_status kd_geodesic_begin(struct kd_playground_geodesic *g, const struct kd_hole *hole, const double x[3],
                                 const double v[3], double t, struct kd_error *error);

/* Advances up to the step that would pass time t, or until the body is captured or far away. t must not decrease from
 * call to call. *steps: number of steps that may be taken; it is reduced by the number of steps taken. Returns false if
 * no steps are left; the next call then continues. */
bool kd_geodesic_approach(struct kd_playground_geodesic *g, double t, uint32_t *steps);
enum kd_geodesic_fate { KD_GEODESIC_GOES, KD_GEODESIC_CAPTURED, KD_GEODESIC_AWAY };
void kd_geodesic_back(struct kd_playground_geodesic *g);
/* Number of steps per unit of coordinate time, at the present position. */
double kd_geodesic_pace(const struct kd_playground_geodesic *g);
/* Position and velocity at time t, which must have been approached. After this call kd_geodesic_back cannot return to
 * an earlier time. */
enum kd_geodesic_fate kd_geodesic_at(struct kd_playground_geodesic *g, double t, double x[3], double v[3]);

/* State for a snapshot, in addition to the start. Restoring it restores exactly the state to which kd_geodesic_back
 * returns. */
enum { KD_GEODESIC_STATE = 20 };
void kd_geodesic_save(const struct kd_playground_geodesic *g, double state[KD_GEODESIC_STATE]);
void kd_geodesic_restore(struct kd_playground_geodesic *g,
                         /* restores this state; call it after kd_geodesic_begin */
                         const double state[KD_GEODESIC_STATE]);

#endif
