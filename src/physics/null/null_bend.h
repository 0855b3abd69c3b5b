/* Deflection of an escaping ray, given as two angles. They are smooth functions of the ray, however often it goes
 * round, across the axis or along the equator. They can therefore be interpolated from a few rays. The direction of
 * escape cannot. Double precision; pure; any thread.
 *
 * The ray turns by `turn` in a plane through the hole. Initially the plane is spanned by the observer's place o and the
 * tangent t; it is dragged about the axis by `drag`. The ray traced back ends at Rz(drag) (cos(turn) o + sin(turn) t),
 * with o = (sin, 0, cos) of the observer, t = t_theta e_theta + t_phi e_phi.
 *
 * With u = cos(theta) = sqrt(z) cos x (null_polar.h), x' = sqrt(N + a^2 u^2) in Mino time, and L = sqrt(N + a^2), the
 * angle iota with cos(iota) = lambda/L is the inclination of a plane in which x is the angle from the highest latitude.
 * The azimuth in that plane grows by cos(iota) x'/(1 - u^2), and the ray's own by lambda/(1 - u^2) + a (2r - a
 * lambda)/Delta (Gralla & Lupsasca 2020, arXiv:1910.12881, eqs. 6-8). The difference is, as L^2 - x'^2 = a^2 (1 - u^2),
 *
 *   drag' = a^2 lambda/(L (L + x')) + a (2r - a lambda)/Delta,
 *
 * without a pole. Int dtau of the first term becomes an integral of dx/x' of a function with period pi: by
 * Gauss-Legendre quadrature. */
#ifndef KD_PHYSICS_NULL_NULL_BEND_H
#define KD_PHYSICS_NULL_NULL_BEND_H

#include "physics/null/null_geodesic.h"

struct kd_null_bend {
    double turn, drag;     /* angles of the ray traced back; not reduced to a turn */
    double t_theta, t_phi; /* a unit vector */
};

/* Returns false, and leaves *out undefined, if the ray does not escape, does not cross the equator (eta <= 0), or is
 * outside the domain of null_geodesic.h. Takes some 1.5 us. The error is 1e-14 divided by the distance from the
 * critical curve. ray->orders is ignored. */
bool kd_null_bend_of(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* Computes only the tangent, which needs no integral. */
void kd_null_bend_tangent(const struct kd_null_ray *ray, struct kd_null_bend *out);

/* The direction of escape, a unit vector in the hole's frame with the observer at Boyer-Lindquist azimuth 0. */
void kd_null_bend_sky(const struct kd_null_bend *bend, double cos_theta, double sin_theta, double out[3]);

#endif
