/* Deflection of light in the equatorial plane of Kerr, with or without charge. Double precision, pure functions, any
 * thread. G = c = M = 1; impact parameter b = |L|/E > 0. The light moves towards +phi, so a hole with a < 0 rotates
 * against the light. Angles are in radians.
 *
 * Sources: C. G. Darwin 1959, Proc. R. Soc. Lond. A 249, 180 (Schwarzschild); S. V. Iyer & E. C. Hioki 2009,
 * arXiv:0907.0352 (Kerr, and the weak field to the second order in M/b); V. Bozza 2002, Phys. Rev. D 66, 103001 (the
 * strong limit); E. F. Eiroa, G. E. Romero & D. F. Torres 2002, Phys. Rev. D 66, 024010 (charge). The domain is |a| <
 * 1. Outside it, results are NaN. */
#ifndef KD_PHYSICS_NULL_DEFLECTION_H
#define KD_PHYSICS_NULL_DEFLECTION_H

#include "physics/spacetime/hole.h"

/* The impact parameter of the circular photon orbit: 3 sqrt(3) at a = 0, 2 at a = 1, 7 at a = -1. The error is a few
 * ulp. */
double kd_deflection_critical(const struct kd_hole *hole);

/* Total deflection of a ray with b > kd_deflection_critical(a), including whole turns. NaN for smaller b (the ray is
 * captured), INFINITY if b equals the critical value to within rounding. Below b = 20 it uses the closed form
 * (null_radial.h), beyond it an integral without differences of nearly equal numbers. The relative error is below 1e-14
 * + 1e-15/(b/critical - 1), up to any b. The second term is due to rounding of b, and is ten times larger at a =
 * 0.9999. */
double kd_deflection(const struct kd_hole *hole, double b);

/* Boyer-Lindquist r of the closest approach of the ray with the impact parameter b. */
double kd_deflection_closest(const struct kd_hole *hole, double b);

/* Largest radius that light with the impact parameter b reaches before it falls back, if it is emitted inside the
 * photon orbit. This is the turning point below the photon orbit. The result is also NaN for a > 0 and b > (2 r+ -
 * q^2)/a: at the horizon all light has E >= L a/(2 r+ - q^2), so no light has such a b. */
double kd_deflection_farthest(const struct kd_hole *hole, double b);

/* Deflection in the weak field: to first order 4/b, and to second order 4/b + (15 pi/4 - 4a - 3 pi q^2/4)/b^2. */
double kd_deflection_weak(double b);
double kd_deflection_weak_second(const struct kd_hole *hole, double b);

/* Bozza's limit of the deflection for b -> critical: -rate ln(b/critical - 1) + offset. At a = 0, rate is 1 and offset
 * is ln(216 (7 - 4 sqrt 3)) - pi. The error of the limit decreases as (b/critical - 1) ln(b/critical - 1). The relative
 * error of rate and offset is 1e-12 for a <= 0.99. */
struct kd_deflection_strong { double rate, offset; };
struct kd_deflection_strong kd_deflection_strong(const struct kd_hole *hole);

#endif
