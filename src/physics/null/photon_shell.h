/* Spherical photon orbits, at constant Boyer-Lindquist radius, and how nearby rays depart from them in each
 * half orbit. Double precision; pure functions, any thread. Units G = c = M = 1, E = 1; a^2 + q^2 < 1.
 *
 * Sources: Teo 2003, Gen. Rel. Grav. 35, 1909, and Bardeen 1973 (in Black Holes, eq. 49): lambda and eta of r.
 * Johnson et al. 2020, arXiv:1907.04329 (the exponent gamma); Gralla & Lupsasca 2020, arXiv:1910.12873, section V
 * (gamma, delta, tau).
 *
 * The usual formula lambda = a + (r/a)(r - 2 Delta/(r - 1)) loses all digits at small a, where all orbits have r = 3,
 * and near a = 1, where many orbits have r = 1. Let y = r - 1 and N = 1 - a^2. The index P denotes the orbit over the
 * poles (lambda = 0). Then for a >= 0
 *
 *   w = (r - r_P)/a      x = (r - 3)/a = x_P + w      y_P^3 - (3 - a^2) y_P - 2N = 0      x_P = -4a/(r_P^2 + a^2)
 *   lambda = -w (y + y_P + 2N/(y y_P))
 *   eta = (r^3/y^2)(4 - r x^2) = (r^3/a^2)(3 - y - 4N/y^2)
 *
 * There is no cancellation; the second form of eta is for y < 1. A hole with a < 0 is the mirror image of the hole with
 * |a|.
 *
 * With charge N = 1 - a^2 - q^2, and y_0 = (1 + sqrt(1 + 8 (N + a^2)))/2 is the y of the orbits at a = 0; without
 * charge it is 2. Then x = (y - y_0)/a, and
 *
 *   y_P^3 - (1 + a^2 + 2N) y_P - 2N = 0      x_P = -a (y_P + 2)/((y_P + 1)(y_P + y_0 - 1))      lambda as above
 *   eta = (r/y)^2 (4 (y + N + a^2) - x^2 (y + y_0 - 1)^2)
 *       = (r/(a y))^2 (y^2 (2a - 1 + y)(2a + 1 - y) - 4N (N + a^2 + y (1 - y)))      for y < a. */
#ifndef KD_PHYSICS_NULL_PHOTON_SHELL_H
#define KD_PHYSICS_NULL_PHOTON_SHELL_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

struct kd_shell {
    double a;                    /* spin a, with its sign                                       */
    double spin, n;              /* |a|; N = 1 - a^2 - q^2 */
    double y_polar, x_polar;     /* y_P and x_P */
    double prograde, retrograde; /* places of the equatorial orbits (see kd_shell_orbit_at) */
    double y_still;              /* y_0                                                     */
    bool charged;
};

/* A spherical orbit. y = r - 1; w and n are w and N defined above. At a = 0, r alone does not identify an orbit. */
struct kd_shell_orbit { double a, r, y, w, lambda, eta, n; };

struct kd_shell kd_shell_of(const struct kd_hole *hole);

/* The orbit at a place. `place` numbers the orbits of a hole in order, from the prograde to the retrograde equatorial
 * orbit. It is w where y >= y_P/2, and follows the logarithm of y at smaller y, so that it distinguishes orbits at r =
 * 1. Beyond the equatorial orbits eta would be negative, and there is no orbit. */
struct kd_shell_orbit kd_shell_orbit_at(const struct kd_shell *shell, double place);

/* The orbit of radius r, for a != 0. Returns NaN unless r is between the radii of the equatorial orbits. */
struct kd_shell_orbit kd_shell_orbit_of_radius(const struct kd_hole *hole, double r);

/* (1/2) d^2R/dr^2 at the orbit, which is 4 r (y^3 + N)/y^2. Nearby rays depart from the orbit as exp(tau sqrt(bend)) in
 * Mino time tau. */
double kd_shell_bend(const struct kd_shell_orbit *orbit);

/* -R(0)/r^2 = (a^2 eta + q^2 K)/r^2, with K = 4 r^2 Delta/y^2. It determines R of the orbit's photon at any radius r_o:
 * R(r_o) = (r_o - r)^2 (r_o^2 + 2 r r_o + R(0)/r^2). */
double kd_shell_inside(const struct kd_hole *hole, const struct kd_shell_orbit *orbit);

/* Changes from one crossing of the equatorial plane to the next:
 *   mino   Mino time;
 *   gamma  a ray at a small distance d from the orbit departs to the distance d e^gamma. gamma is pi at a = 0. In the
 *   limit each
 *          order of images is closer to the critical curve than the order before, by the factor e^-gamma;
 *   delta  azimuth. At a = 0: pi, with the sign of lambda. It jumps by 2 pi where the orbit passes over the axis:
 *          at lambda = 0 it is the limit lambda -> 0+ (a >= 0; mirrored for a < 0);
 *   tau    time t.
 * Complete elliptic integrals in Carlson's form. The relative error is below 1e-14, except within 1e-6 of |a| = 1,
 * where y = r - 1 is known to 1e-16 / (1 - |a|)^(1/2) at least. */
struct kd_shell_exponents { double mino, gamma, delta, tau; };
struct kd_shell_exponents kd_shell_exponents(const struct kd_shell_orbit *orbit);

#endif
