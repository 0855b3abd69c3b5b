/* Lensing bands of Kerr. A band is the part of the image plane that shows the equatorial plane between two radii in its
 * n-th image. The observer is at infinity. Double precision; pure functions, any thread. Units G = c = M = 1.
 *
 * Order n counts the crossings of the plane back from the eye, as null_geodesic.h does. For n >= 1 the image of the
 * plane between r_in and r_out is a ring round or beside the critical curve (Gralla, Holz & Wald 2019,
 * arXiv:1906.00873, for a = 0; Gralla & Lupsasca 2020, arXiv:1910.12873, section VI). The image of the whole plane
 * outside the horizon contains the curve. Each ring is thinner than the ring of the order before by the factor e^-gamma
 * (photon_shell.h).
 *
 * Positions are given in coordinates adapted to the curve: the angle about its centre, and the signed relative distance
 * from it,
 *
 *   d = rho/rho_c(angle) - 1
 *
 * which is positive outside. At an edge of a band two Mino times are equal. One is the time of the n-th crossing, from
 * the polar motion. The other is the time at which the ray has the source's radius, from the radial motion. Both are
 * smooth functions of ln|d|, and the second is almost linear, so roots are sought in ln|d|. kd_null_roots_beside uses d
 * directly, without adding it to 1, so that d may be arbitrarily small. The relative error of d is some 1e-15 (n + 1),
 * times 1/(1 - |a|)^(1/2) along the flat side of a hole near a = 1. Only the point (alpha, beta) itself does not
 * resolve positions with d < 1e-15. */
#ifndef KD_PHYSICS_NULL_LENSING_H
#define KD_PHYSICS_NULL_LENSING_H

#include "physics/null/critical.h"

/* d of the n-th image of the circle of radius `source`, with n >= 1 and r+ <= source <= INFINITY. `point` is the point
 * of the curve at the wanted angle, for an observer at infinity. The result is NaN if there is no such image, because
 * it would lie beyond the centre (n = 1 seen almost edge-on), or because the rays lie in the equatorial plane. Takes
 * some ten microseconds. */
double kd_lensing_edge(const struct kd_critical *curve, const struct kd_critical_point *point, int n, double source);

/* Radius that is seen at the distance d in order n >= 1. It is INFINITY if the ray escapes before its n-th crossing,
 * and 0 if the ray falls into the hole before it. */
double kd_lensing_source(const struct kd_critical *curve, const struct kd_critical_point *point, int n, double d);

#endif
