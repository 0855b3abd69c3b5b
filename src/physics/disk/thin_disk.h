/* Thin accretion disk: radial flux, temperature and redshift factor. Double precision, pure, any thread. G = c = M = 1.
 * The sign of the spin is as in physics/spacetime/kerr.h. The gas rotates towards +phi. */
#ifndef KD_PHYSICS_DISK_THIN_DISK_H
#define KD_PHYSICS_DISK_THIN_DISK_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

/* Page & Thorne 1974, ApJ 191, 499, eqs 11b, 12 and 15n: F / Mdot, where F is the energy radiated from one face per
 * comoving area and proper time. The disk ends at the ISCO without torque; F is 0 at and inside the ISCO. For |a| <=
 * 0.9999 the relative error is below 1e-11 + 4e-14/(r - r_isco)^2, because the closed form loses digits by cancellation
 * towards the ISCO, where F has a double zero. With charge the integral is computed by quadrature, and the relative
 * error is below 1e-12 up to a^2 + q^2 = 1 - 1e-6. */
double kd_disk_flux_page_thorne(const struct kd_hole *hole, double r);

/* F / Mdot of Shakura & Sunyaev 1973 (Newtonian), with the inner edge r_in at the ISCO: 3/(8 pi r^3) (1 -
 * sqrt(r_in/r)). */
double kd_disk_flux_shakura_sunyaev(const struct kd_hole *hole, double r);

typedef double (*kd_disk_flux_fn)(const struct kd_hole *hole, double r);

/* Radius of the largest flux. For Page & Thorne's flux it is the root of the derivative, accurate to 1e-15 up to |a| =
 * 0.9999, and to 1e-12 beyond. For the flux of Shakura & Sunyaev it has a closed form. */
double kd_disk_peak_page_thorne(const struct kd_hole *hole);
double kd_disk_peak_shakura_sunyaev(const struct kd_hole *hole);

/* Redshift factor g = nu_infinity / nu_emitted = 1 / (u^t (1 - Omega lambda)) of gas on a circular orbit at r >= ISCO
 * (Cunningham 1975, ApJ 202, 788). lambda: L/E of the photon. */
double kd_disk_redshift(const struct kd_hole *hole, double r, double lambda);

/* Redshift factor of gas that plunges from the ISCO with the energy and angular momentum of the orbit there (Cunningham
 * 1975), for r+ < r <= ISCO. outwards: true if the photon leaves the gas with p^r > 0, that is, if the ray traced back
 * from the eye has not yet passed its turning point. eta: Q/E^2 of the photon, whose E is positive. The factor is 0 at
 * the horizon for photons emitted outwards. */
double kd_disk_redshift_plunging(const struct kd_hole *hole, double r, double lambda, double eta, bool outwards);

/* Conversions to SI units. The mass is in solar masses, and the accretion rate in units of L_Edd / (efficiency(a) c^2),
 * with L_Edd = 4 pi G M m_p c / sigma_T. The first function converts the rate to kg/s. The second converts a flux
 * F/Mdot (as above) to W/m^2. The third converts a flux to its effective temperature in K, by sigma T^4 = F. Constants
 * are those of physics/math/constants.h. */
double kd_disk_rate(const struct kd_hole *hole, double mass_msun, double mdot_edd);
double kd_disk_flux_si(double flux, const struct kd_hole *hole, double mass_msun, double mdot_edd);
double kd_disk_temperature(double flux, const struct kd_hole *hole, double mass_msun, double mdot_edd);

#endif
