/* Radius at which a ray meets the equatorial plane of Kerr for the n-th time, for an observer anywhere outside the
 * inner horizon, and for any energy at infinity. This includes observers within the horizon, and light of negative
 * energy in the ergosphere. Double precision; pure functions, any thread. Units G = c = M = 1. Azimuth and time are not
 * computed, so the horizon needs no special treatment.
 *
 * The equations in Mino time, with w = 1/r and u = cos(theta), for constants E, L, Q in any common scale (Carter 1968,
 * Phys. Rev. 174, 1559), are
 *
 *   w'' = A w + 3K w^2 + 2C w^3     u'' = A u - 2 a^2 E^2 u^3     A = a^2 E^2 - Q - L^2,  K = Q + (L - aE)^2,  C =
 *                                   -a^2 Q,
 *
 * They are integrated by Taylor series of order 19, in steps of R/e^2, with R the radius of convergence and e =
 * 2.718... (A. Jorba & M. Zou 2005, Exp. Math. 14, 99). */
#ifndef KD_PHYSICS_NULL_NULL_PLANE_H
#define KD_PHYSICS_NULL_NULL_PLANE_H

#include "physics/spacetime/tetrad.h"

/* Radius of crossing n. photon: the photon as it arrives. Crossings n = 0, 1, ... are counted back from the observer,
 * also within the horizon. A start in the plane is not counted. Returns -INFINITY if, before crossing n, the ray traced
 * back reaches the past horizon. Returns INFINITY if it escapes before crossing n, has no end, or comes from another
 * exterior region. Takes some 10 us. The relative error is 1e-13, times the factor by which the ray's bending amplifies
 * a rounding of its start. */
double kd_null_plane_radius(const struct kd_vantage *at, const struct kd_covector *photon, int n);

#endif
