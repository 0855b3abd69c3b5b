/* Epicyclic frequencies: angular frequencies, in coordinate time, of small oscillations about a circular equatorial
 * orbit of Kerr. Double precision, pure, any thread. G = c = M = 1; The sign of the spin is as in
 * physics/spacetime/kerr.h. r must be outside the photon orbit.
 *
 *     kappa^2     = Omega^2 (1 - 6/r + 8a r^(-3/2) - 3a^2/r^2)       radial
 *     Omega_th^2  = Omega^2 (1 - 4a r^(-3/2) + 3a^2/r^2)             vertical
 *
 * With charge, in the notation of struct kd_kerr_ring (kerr.h),
 *
 *     kappa^2     = Omega^2 X/(r s)^2
 *     Omega_th^2  = Omega^2 ((r^2 + a^2) sigma^2 + 2a sigma Delta + a^2 Delta)/(r s)^2
 *
 * These follow from the second derivatives of Carter's potentials, -R''/2 = X/P^2 and L^2 + a^2 (1 - E^2), with
 * dt/dlambda = r (r^2 + a s)/P.
 *
 * Sources: J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972; A. T. Okazaki, S. Kato & J. Fukue 1987, PASJ 39, 457; S.
 * Kato 1990, PASJ 42, 99. The relative error is below 1e-14. For kappa, which has a zero at the ISCO, the error is
 * below 1e-15 r_isco/|r - r_isco| times the error for a = 0. */
#ifndef KD_PHYSICS_SPACETIME_EPICYCLIC_H
#define KD_PHYSICS_SPACETIME_EPICYCLIC_H

#include "physics/spacetime/hole.h"

/* The radial frequency kappa; 0 at the ISCO, and NaN inside it, where the orbit is not stable. */
double kd_epicyclic_radial(const struct kd_hole *hole, double r);
double kd_epicyclic_vertical(const struct kd_hole *hole, double r);

/* Derivative in r of the angular velocity d(phi)/dt of a body that keeps the E and L of the circular orbit. A small
 * radial oscillation A cos(kappa t) advances the azimuth, relative to the guiding centre, by this times A/kappa
 * sin(kappa t). Newton's limit is -2 Omega/r. */
double kd_epicyclic_shear(const struct kd_hole *hole, double r);

#endif
