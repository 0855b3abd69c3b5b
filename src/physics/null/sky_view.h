/* The distant sky for an observer at a finite radius: the directions in which it is visible, the shift of its light,
 * and the size of the dark disk of the hole. Double precision, pure functions, any thread. Units G = c = M = 1; angles
 * in radians.
 *
 * A photon seen with local energy 1 in the direction (right, up, inwards), a unit vector of tetrad.h, has the energy
 * at infinity
 *   E = E_t + inwards E_r + up E_theta - right E_phi, where the E_i belong to the frame's legs. It is shifted by g =
 * 1/E. E is linear in the direction. Therefore the least and largest g over the visible sky are in the directions
 * +-(E_r, E_theta, -E_phi) if the sky is visible there, and otherwise on the edge of the dark disk, the critical curve
 * (critical.h). */
#ifndef KD_PHYSICS_NULL_SKY_VIEW_H
#define KD_PHYSICS_NULL_SKY_VIEW_H

#include "physics/null/critical.h"

struct kd_sky_view {
    /* unless it is KD_CRITICAL_OK, no other member is set, and no function accepts the view */
    enum kd_critical_status status;
    struct kd_critical edge;
    struct kd_tetrad tetrad;
    double dark;            /* solid angle of the dark disk, sr */
    double least, greatest; /* smallest and largest g over the visible sky */
};

/* Makes a view. The radius must be finite; otherwise the status is KD_CRITICAL_BAD_INPUT. Takes some 1.5 ms. The
 * relative error of `dark` is 1e-9 for spins up to 0.99. The relative error of `least` and `greatest` is 1e-12 where
 * they lie on the edge, from rounding of the edge. */
struct kd_sky_view kd_sky_view_of(const struct kd_critical_observer *observer);

/* g of the sky in a direction, which is a unit vector; NaN in the dark disk. Takes some 2 microseconds. */
double kd_sky_view_shift(const struct kd_sky_view *view, const double direction[3]);

#endif
