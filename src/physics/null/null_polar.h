/* Polar motion of a null geodesic of Kerr in Mino time, in closed form. Units G = c = M = 1, E = 1. Pure functions,
 * any thread.
 *
 * With u = cos(theta), v = u^2 (Gralla & Lupsasca 2020, arXiv:1910.12881, section III; Kapec & Lupsasca 2019),
 *
 *   (du/dtau)^2 = eta + A u^2 - a^2 u^4 = (z - v)(N + a^2 v),   z N = eta
 *
 * and u = sqrt(z) cos(x), dx/dtau = sqrt(s (1 - kappa sin^2 x)), s = N + a^2 z, kappa = a^2 z / s. For eta > 0 the
 * ray crosses the equator at x = pi/2, 3 pi/2, ...; for eta < 0 (vortical) N < 0, kappa > 1, and x oscillates about
 * 0.
 *
 * The azimuth, Int lambda dtau / sin^2(theta), has poles at the axis, and rays with small lambda almost touch the axis.
 * With cc = |lambda|/(N + a^2) and nu = (a cc)^2, differentiation shows that
 *
 *   |lambda| / (1 - v) = -d/dtau atan2(sqrt(z - v), cc u sqrt(N + a^2 v)) (for du/dtau < 0: +)
 *                      + a^2 cc (1 - v/z) / (1 - nu v/z)
 *
 * The first term contains the poles and is elementary; the second is regular however close the axis is, and its
 * integral takes one R_J. */
#ifndef KD_PHYSICS_NULL_NULL_POLAR_H
#define KD_PHYSICS_NULL_NULL_POLAR_H

#include "physics/null/null_quartic.h"

#include <stdbool.h>

/* Integrals along the ray. tau: Mino time. phi: azimuth of a photon with lambda > 0, without frame dragging. u2: Int
 * u^2 dtau. */
struct kd_null_polar_sum { double tau, phi, u2; };

struct kd_null_polar {
    double a, u, side,
        /* u: |cos theta| of the observer. side: sign of cos theta. sense: sign of lambda or, on the axis, of
         * -alpha */
        sense;
    double z, n, s, kappa;
    double cc, nu;
    bool fixed;    /* true if theta does not change, as for principal null rays and rays in the equatorial plane */
    bool vortical; /* true if eta < 0 */
    bool crosses;  /* true if the ray crosses the equatorial plane: eta > 0 and not `fixed` */
    enum kd_null_parts parts;
    /* integrals from a turning point of theta to the plane or, if vortical, to the other turning point */
    struct kd_null_polar_sum quarter;
    /* integrals from a turning point at z to the observer; negative if it is the next turning point instead of the
     * previous one */
    struct kd_null_polar_sum start;
    double first, first_phi; /* Mino time and azimuth from the observer to the first crossing             */
};

/* Makes the polar motion of a ray. parts: if it is KD_NULL_TAU, the integrals of azimuth and of u^2 are 0, and
 * kd_null_polar_at must not be called; otherwise all integrals are computed. */
struct kd_null_polar kd_null_polar_of(const struct kd_null_motion *m, enum kd_null_parts parts);

/* Numbers of the polar motion at the observer, each computed without cancellation. gap: z - u^2. weight: N + a^2 u^2.
 * s: N + a^2 z. */
void kd_null_polar_gap(const struct kd_null_motion *m, double *s, double *gap, double *weight);

/* Computes only the Mino time from the observer to the first crossing; INFINITY if there is no crossing. */
double kd_null_polar_first(const struct kd_null_motion *m);

/* Computes only the Mino time from one crossing to the next. eta must be > 0. */
double kd_null_polar_half(const struct kd_null_motion *m);

/* Integrals from the observer to crossing n = 0, 1, ...; valid only if p->crosses. */
struct kd_null_polar_sum kd_null_polar_crossing(const struct kd_null_polar *p, int n);

/* A place of the polar motion at Mino time tau: cos(theta), and the azimuth since the observer. */
struct kd_null_polar_place { double u, phi; };
struct kd_null_polar_place kd_null_polar_at(const struct kd_null_polar *p, const struct kd_null_motion *m, double tau);

#endif
