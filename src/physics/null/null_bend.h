/* Deflection of an escaping ray, given as two angles. However often the ray goes round, across the axis or along the
 * equator, the two angles are smooth functions of the ray. Unlike the direction of escape, they can therefore be
 * interpolated from a few rays. Double precision; pure; any thread.
 *
 * The ray turns by the angle `turn` in a plane through the hole, and this plane is dragged about the axis by the angle
 * `drag`. At the start the plane is spanned by the direction o of the observer's place and the tangent t. The ray
 * traced back ends at Rz(drag) (cos(turn) o + sin(turn) t), with o = (sin, 0, cos) and t = t_theta e_theta + t_phi
 * e_phi.
 *
 * The motion is u = cos(theta) = sqrt(z) cos x (null_polar.h), with x' = sqrt(N + a^2 u^2) in Mino time. Let L = sqrt(N
 * + a^2), and let iota be the angle with cos(iota) = lambda/L. Then iota is the inclination of a plane in which x is
 * the angle from the highest latitude. The azimuth in that plane grows by cos(iota) x'/(1 - u^2), and the ray's own
 * azimuth by lambda/(1 - u^2) + a (2r - a lambda)/Delta (Gralla & Lupsasca 2020, arXiv:1910.12881, eqs. 6-8). Because
 * L^2 - x'^2 = a^2 (1 - u^2), the difference is
 *
 *   drag' = a^2 lambda/(L (L + x')) + a (2r - a lambda)/Delta,
 *
 * which has no pole. The integral of the first term over tau becomes an integral over x of a function with period pi,
 * divided by x'. Gauss-Legendre quadrature computes it. */
#ifndef KD_PHYSICS_NULL_NULL_BEND_H
#define KD_PHYSICS_NULL_NULL_BEND_H

#include "physics/null/null_geodesic.h"

struct kd_null_bend {
    double turn, drag;     /* turn and drag of the ray traced back, radians, not reduced to a turn */
    double t_theta, t_phi; /* components of the tangent t, a unit vector */
};

/* Computes both angles. Returns false, and leaves *out undefined, if the ray does not escape, does not cross the
 * equator (eta <= 0), or is outside the domain of null_geodesic.h. Ignores ray->orders. Takes some 1.5 us. The error is
 * 1e-14 divided by the distance from the critical curve. */
bool kd_null_bend_of(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* Computes only the tangent, which needs no integral. */
void kd_null_bend_tangent(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* The direction of escape, as a unit vector in the hole's frame. The observer is at Boyer-Lindquist azimuth 0. */
void kd_null_bend_sky(const struct kd_null_bend *bend, double cos_theta, double sin_theta, double out[3]);

#endif
