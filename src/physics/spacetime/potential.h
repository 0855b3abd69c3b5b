/* Effective potential in the equatorial plane of Kerr: the least energy of a particle with angular momentum L at r.
 * Motion is possible where E >= V. Double precision, pure, any thread. G = c = M = 1; a and L signed, L > 0 towards
 * +phi.
 *
 *     V = (a L (2r - q^2) + r sqrt(Delta (r^2 L^2 + mu^2 A))) / A,   A = r^4 + a^2 r^2 + a^2 (2r - q^2)
 *
 * It is the larger root of A E^2 - 2 a (2r - q^2) L E - (r^2 - 2r + q^2) L^2 - mu^2 r^2 Delta = 0: J. M. Bardeen, W. H.
 * Press & S. A. Teukolsky 1972, ApJ 178, 347, eq. 2.9 with R = 0; C. W. Misner, K. S. Thorne & J. A. Wheeler 1973, eq.
 * 33.32. For a = 0 it is sqrt((1 - 2/r)(mu^2 + L^2/r^2)). Relative error below 1e-14 for a L >= 0. For a L < 0 and
 * large |L|, V has a zero at the static limit, and its error is 1e-15 of either term of the sum. */
#ifndef KD_PHYSICS_SPACETIME_POTENTIAL_H
#define KD_PHYSICS_SPACETIME_POTENTIAL_H

#include "physics/spacetime/hole.h"

/* V for angular momentum l at r, which must be at or outside the horizon. mu2 = 0: light, where V is the E for this L,
 * and V/L depends on r alone. mu2 = 1: matter, with energy and angular momentum per unit mass. */
double kd_potential(const struct kd_hole *hole, double l, double mu2, double r);

/* Circular orbits with a given angular momentum: V has its maximum at r_max (unstable orbit) and its minimum at r_min
 * (stable orbit). Members are NaN where there is no such orbit: matter with |L| below that of the ISCO has neither, and
 * light has no minimum. */
struct kd_potential_extrema { double r_max, v_max, r_min, v_min; };
struct kd_potential_extrema kd_potential_of_light(const struct kd_hole *hole, double l);
struct kd_potential_extrema kd_potential_of_matter(const struct kd_hole *hole, double l);

#endif
