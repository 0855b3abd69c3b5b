/* Embedding of the equatorial plane of Kerr at constant t in flat space, as a surface of revolution: Flamm's
 * paraboloid (L. Flamm 1916, Phys. Z. 17, 448) and its generalisation to a != 0. Double precision, pure, any thread.
 * G = c = M = 1; r at or outside the horizon.
 *
 * By Boyer & Lindquist 1967, dl^2 = r^2/Delta dr^2 + R^2 dphi^2 with R^2 = r^2 + a^2 + 2a^2/r, so that dz^2 = r^2/Delta
 * dr^2 - dR^2 and R^2 Delta (dz/dr)^2 = 2r^3 + 4a^2 r - 4a^2 + 2a^4/r - a^4/r^2 + 2a^4/r^3 - a^6/r^4. Each negative
 * term is smaller than the one before it for r >= 1 >= |a|: the plane can be embedded down to the horizon at any spin.
 * With charge 2a^2/r becomes a^2 (2r - q^2)/r^2, and with t = a^2 (r - q^2)/r^3 the polynomial is (2r - q^2)(r^2 + a^2)
 * + t Delta (2r - t), which is positive too. */
#ifndef KD_PHYSICS_SPACETIME_EMBEDDING_H
#define KD_PHYSICS_SPACETIME_EMBEDDING_H

#include "physics/spacetime/hole.h"

/* R: the circumference of the circle at r, divided by 2 pi. */
double kd_embedding_radius(const struct kd_hole *hole, double r);

/* Height z above the circle at the horizon; for a = 0 it is sqrt(8 (r - 2)). Its relative error is below 1e-14 plus the
 * relative error of r - r+. */
double kd_embedding_height(const struct kd_hole *hole, double r);

/* Proper distance from the horizon along r: sqrt(Delta) + ln((r - 1 + sqrt(Delta))/sqrt(1 - a^2)). Its relative error
 * is the same as that of the height. */
double kd_embedding_distance(const struct kd_hole *hole, double r);

#endif
