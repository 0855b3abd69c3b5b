/* Deflection of light in the equatorial plane of Kerr, with or without charge. Double precision, pure functions, any
 * thread. G = c = M = 1; impact parameter b = |L|/E > 0. The light turns towards +phi, so a hole with a < 0 turns
 * against the light. Angles in radians.
 *
 * Sources: C. G. Darwin 1959, Proc. R. Soc. Lond. A 249, 180 (Schwarzschild); S. V. Iyer & E. C. Hioki 2009,
 * arXiv:0907.0352 (Kerr, and the weak field to the second order in M/b); V. Bozza 2002, Phys. Rev. D 66, 103001 (the
 * strong limit); E. F. Eiroa, G. E. Romero & D. F. Torres 2002, Phys. Rev. D 66, 024010 (charge). Domain |a| < 1;
 * outside: NaN. */
#ifndef KD_PHYSICS_NULL_DEFLECTION_H
#define KD_PHYSICS_NULL_DEFLECTION_H

#include "physics/spacetime/hole.h"

/* The impact parameter of the circular photon orbit: 3 sqrt(3) at a = 0, 2 at a = 1, 7 at a = -1. A few ulp. */
double kd_deflection_critical(const struct kd_hole *hole);

/* Total deflection of a ray with b > kd_deflection_critical(a), including whole turns. NaN for smaller b (the ray is
 * captured), INFINITY if b equals the critical value to within rounding. Below b = 20 it uses the closed form
 * (null_radial.h), beyond it an integral without differences of nearly equal numbers. The relative error is below 1e-14
 * + 1e-15/(b/critical - 1), up to any b. The second term is the effect of the last digit of b; it is ten times larger
 * at a = 0.9999. */
double kd_deflection(const struct kd_hole *hole, double b);

/* The closest approach of that ray, in Boyer-Lindquist r. */
double kd_deflection_closest(const struct kd_hole *hole, double b);

/* Largest radius that light of the same b reaches before it falls back, if it is emitted inside the photon orbit. This
 * is the turning point below the photon orbit. NaN also for b > (2 r+ - q^2)/a, a > 0: at the horizon all light has E
 * >= L a/(2 r+ - q^2), so that no light has such a b. */
double kd_deflection_farthest(const struct kd_hole *hole, double b);

/* Weak-field deflection: 4/b, and with the next order 4/b + (15 pi/4 - 4a - 3 pi q^2/4)/b^2. */
double kd_deflection_weak(double b);
double kd_deflection_weak_second(const struct kd_hole *hole, double b);

/* Bozza's limit for b -> critical: -rate ln(b/critical - 1) + offset. rate = 1 and offset = ln(216 (7 - 4 sqrt 3)) - pi
 * at a = 0. The error of the limit falls as (b/critical - 1) ln(b/critical - 1). Relative error of rate and offset:
 * 1e-12 for a <= 0.99. */
struct kd_deflection_strong { double rate, offset; };
struct kd_deflection_strong kd_deflection_strong(const struct kd_hole *hole);

#endif
