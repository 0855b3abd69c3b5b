/* Scalars of the Kerr hole that depend on its spin, and circular equatorial orbits. Double precision, pure functions,
 * any thread. Units G = c = M = 1. hole.h defines the sign of the spin and the domain. About a charged hole the orbits
 * are those of neutral matter.
 *
 * Sources: Bardeen, Press & Teukolsky 1972, ApJ 178, 347 [BPT]; Chandrasekhar 1983; with charge N. Dadhich & P. P. Kale
 * 1977, J. Math. Phys. 18, 1727. */
#ifndef KD_PHYSICS_SPACETIME_KERR_H
#define KD_PHYSICS_SPACETIME_KERR_H

#include "physics/spacetime/hole.h"

/* Radius of the static limit at cos(theta): 1 + sqrt(1 - q^2 - a^2 cos^2 theta). */
double kd_kerr_ergosphere(const struct kd_hole *hole, double cos_theta);

/* Radius of the innermost stable circular orbit [BPT eq. 2.21], with a relative error below 1e-14. With charge it is
 * the root of kd_kerr_ring_excess. */
double kd_kerr_isco(const struct kd_hole *hole);

/* The first function: radius of the circular photon orbit [BPT eq. 2.18]; with charge it is the root of P. The second
 * function: radius of the marginally bound orbit [BPT eq. 2.19]; with charge it is the root of E - 1. */
double kd_kerr_photon_orbit(const struct kd_hole *hole);
double kd_kerr_marginally_bound(const struct kd_hole *hole);

/* Impact parameter L/E > 0 of the circular photon orbit towards +phi: b_c = 6 cos(acos(-a)/3) - a (S. Chandrasekhar
 * 1983, The Mathematical Theory of Black Holes, ch. 7 eq. 84). With charge it is 1/Omega of that orbit. */
double kd_kerr_critical_impact(const struct kd_hole *hole);

/* Radius of the outermost photon orbit, which is retrograde. */
double kd_kerr_outermost_photon_orbit(const struct kd_hole *hole);

/* A circular equatorial orbit towards +phi about a hole with or without charge, in terms of y = r - 1 and n = root^2,
 * which keep their digits as a^2 + q^2 -> 1. With s^2 = r - q^2 and sigma = s - a = (y + n)/(s + a), the orbit's
 * velocity in Carter's frame is sigma/sqrt(Delta), and
 *
 *   P^2 = Delta - sigma^2             E = (Delta + a sigma)/(r P)      L = (a Delta + (r^2 + a^2) sigma)/(r P)
 *   u^t = (r^2 + a s)/(r P)           Omega = s/(r^2 + a s)            dE/dr = Omega dL/dr = X/(2 r^2 P^3)
 *   X = r Delta - 4 s^2 sigma^2
 *
 * P vanishes on the photon orbit, and X vanishes at the ISCO. */
struct kd_kerr_ring { double y, s, sigma, delta, p2; };
struct kd_kerr_ring kd_kerr_ring_at(const struct kd_hole *hole, double y);
double kd_kerr_ring_excess(const struct kd_hole *hole, const struct kd_kerr_ring *ring); /* X */
/* y of the circular photon orbit */
double kd_kerr_ring_of_light(const struct kd_hole *hole);
/* y of the innermost stable circular orbit */
double kd_kerr_ring_innermost(const struct kd_hole *hole);

/* Numbers of the circular equatorial orbit at a radius r outside the photon orbit. kd_kerr_omega: angular velocity
 * d(phi)/dt [BPT 2.16]. kd_kerr_energy, kd_kerr_momentum: energy and angular momentum per mass [BPT 2.12, 2.13].
 * kd_kerr_ut: u^t. */
double kd_kerr_omega(const struct kd_hole *hole, double r);
double kd_kerr_energy(const struct kd_hole *hole, double r);
double kd_kerr_momentum(const struct kd_hole *hole, double r);
double kd_kerr_ut(const struct kd_hole *hole, double r);

/* Squares of the radial and of the vertical epicyclic frequency of the circular orbit at r, in units of (Omega/r)^2
 * (epicyclic.h). */
double kd_kerr_stiffness_radial(const struct kd_hole *hole, double r);
double kd_kerr_stiffness_vertical(const struct kd_hole *hole, double r);

/* Effects in weak fields. kd_kerr_weak_bending: bending of light in the equatorial plane with the impact parameter b,
 * to the second order in 1/b (deflection.h). The other function: advance of the periastron of an orbit with semi-latus
 * rectum p, to the first order in 1/p and for a = 0. It is 6 pi/p (Einstein 1915), or with charge (6 - q^2) pi/p, the
 * limit of kd_orbit_periastron_advance for p -> infinity. */
double kd_kerr_weak_bending(const struct kd_hole *hole, double b);
double kd_kerr_weak_advance(const struct kd_hole *hole, double p);

/* Efficiency of a thin disk: 1 - E at the ISCO. */
double kd_kerr_efficiency(const struct kd_hole *hole);

/* Boyer-Lindquist azimuth minus ingoing Kerr-Schild azimuth, where both are equal at infinity: the integral of a/Delta
 * from r to infinity. r must be outside the horizon, where the result diverges. */
double kd_kerr_twist(const struct kd_hole *hole, double r);

/* Angular velocity of frame dragging, -g_tphi/g_phiphi. */
double kd_kerr_dragging(const struct kd_hole *hole, double r, double cos_theta);

/* Half the range of d(phi)/dt about the angular velocity of frame dragging: every motion at r has a d(phi)/dt within
 * this distance of that velocity, and light reaches both limits. It is sqrt(Delta) Sigma/(B sin(theta)), with B = (r^2
 * + a^2)^2 - a^2 Delta sin^2(theta) [BPT eqs 2.3, 2.5], and is infinite on the axis. */
double kd_kerr_rotation_reach(const struct kd_hole *hole, double r, double cos_theta, double sin_theta);

/* dOmega/dr of circular orbits at r. */
double kd_kerr_shear(const struct kd_hole *hole, double r);

#endif
