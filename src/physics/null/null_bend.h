/* Says how a hole bends a ray that escapes, in two angles that are smooth functions of the ray: however often
 * it goes round, across the axis, along the equator. So they can be interpolated from a few rays, which the
 * direction of escape itself cannot. Double precision; pure; any thread.
 *
 * The ray turns by `turn` in a plane through the hole that begins as that of the observer's place o and the tangent
 * t, and all is dragged about the axis by `drag`. Traced back it ends at Rz(drag) (cos(turn) o + sin(turn) t), with
 * o = (sin, 0, cos) of the observer, t = t_theta e_theta + t_phi e_phi.
 *
 * With u = cos(theta) = sqrt(z) cos x (null_polar.h), x' = sqrt(N + a^2 u^2) in Mino time, and L = sqrt(N + a^2),
 * cos(iota) = lambda/L is that of the inclination of a plane in which x is the angle from the highest latitude. The
 * azimuth in that plane grows by cos(iota) x'/(1 - u^2), and the ray's own by lambda/(1 - u^2) + a (2r - a
 * lambda)/Delta (Gralla & Lupsasca 2020, arXiv:1910.12881, eqs. 6-8). The difference is, as L^2 - x'^2 = a^2 (1 -
 * u^2),
 *
 *   drag' = a^2 lambda/(L (L + x')) + a (2r - a lambda)/Delta,
 *
 * without a pole. Int dtau of the first term is one over dx/x', of a function with period pi: by Gauss and
 * Legendre's quadrature. */
#ifndef KD_PHYSICS_NULL_NULL_BEND_H
#define KD_PHYSICS_NULL_NULL_BEND_H

#include "physics/null/null_geodesic.h"

struct kd_null_bend {
    double turn, drag;     /* as the ray is traced back; not reduced to a turn */
    double t_theta, t_phi; /* a unit vector */
};

/* False: the ray does not escape, or is one that crosses no equator (eta <= 0), or is beyond null_geodesic.h; then
 * nothing is said. Some 1.5 us. Error 1e-14 over the distance from the critical curve. ray->orders is not read. */
bool kd_null_bend_of(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* The tangent alone, which needs no integral. */
void kd_null_bend_tangent(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* A unit vector in the hole's frame, the observer at azimuth 0 of Boyer and Lindquist. */
void kd_null_bend_sky(const struct kd_null_bend *bend, double cos_theta, double sin_theta, double out[3]);

#endif
