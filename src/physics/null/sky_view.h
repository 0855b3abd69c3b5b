/* What an observer at a finite radius sees of the sky far away: in which directions there is any, how its light is
 * shifted, and how large the dark disk is that the hole takes out of it. Double precision, pure functions, any
 * thread. Units G = c = M = 1; angles in radians.
 *
 * A photon seen with local energy 1 in the direction (right, up, inwards), unit vector of tetrad.h, has the energy
 * at infinity
 *   E = E_t + inwards E_r + up E_theta - right E_phi,
 * E_i being those of the frame's legs, and is shifted by g = 1/E. E is linear in the direction. So the least and
 * largest g over the sky that is seen are along +-(E_r, E_theta, -E_phi) where there is sky, and on the edge of the
 * dark disk otherwise: the critical curve (critical.h). */
#ifndef KD_PHYSICS_NULL_SKY_VIEW_H
#define KD_PHYSICS_NULL_SKY_VIEW_H

#include "physics/null/critical.h"

struct kd_sky_view {
    enum kd_critical_status status; /* no other member is set, and no function takes it, without KD_CRITICAL_OK */
    struct kd_critical edge;
    struct kd_tetrad tetrad;
    double dark;            /* solid angle of the dark disk */
    double least, greatest; /* g over the sky that is seen */
};

/* The radius must be finite (KD_CRITICAL_BAD_INPUT). Some 1.5 ms. `dark` is good to 1e-9 of it for spins up to 0.99,
 * `least` and `greatest` to 1e-12 of themselves where they are on the edge, which is the rounding of the edge. */
struct kd_sky_view kd_sky_view_of(const struct kd_critical_observer *observer);

/* g of the sky in a direction, a unit vector; NaN where the dark disk is. Some 2 microseconds. */
double kd_sky_view_shift(const struct kd_sky_view *view, const double direction[3]);

#endif
