/* Radial motion of a null geodesic of Kerr and Kerr-Newman in Mino time, in closed form, outside the horizon. Units G
 * = c = M = 1, E = 1. Pure functions, any thread.
 *
 *   (dr/dtau)^2 = R(r)        phi' = a (2r - q^2 - a lambda)/Delta
 *   t' = r^2 + 2r + 4 - q^2 + ((8 - 4q^2 - 2a lambda) r + q^2 (q^2 + a lambda - 4) - 4a^2)/Delta
 *
 * (the parts that depend on r; Gralla & Lupsasca 2020, arXiv:1910.12881, eqs. 6-8, with 2r - q^2 for 2r). r(tau) is as
 * in their section IV, except that time is counted from infinity or a turning point. Addition theorems then give r -
 * r_i as products. The integrals are Carlson's in terms of r itself (DLMF 19.29.4-10), with r1 or r2 as the root that
 * is singled out. Unlike the reductions to Legendre's Pi they have no removable singularities (r3 = horizon, lambda = 2
 * r+/a), and nearly every term is positive.
 *
 * Motion is possible in two regions: OUTER, from the outermost root r4 (or the horizon) to infinity; and, if r3 >
 * r+, INNER, from the horizon to r3. Times and integrals are counted from `reference`: infinity for OUTER, r3 for
 * INNER. */
#ifndef KD_PHYSICS_NULL_NULL_RADIAL_H
#define KD_PHYSICS_NULL_NULL_RADIAL_H

#include "physics/null/null_quartic.h"

#include <stdbool.h>

/* Integrals from r to the reference: Mino time, azimuth, time. At infinity r + 2 ln r is subtracted from the time. */
struct kd_null_radial_sum { double tau, phi, t; };

/* A radius with its distances from the roots, each without cancellation:
 * d1 = r - r1, d2 = r - r2, pair = sqrt((r - r3)(r - r4)),
 * both = sqrt|r - r3| + sqrt|r - r4| (the sum of conjugate square roots where the roots are),
 * d3 = r3 - r, d4 = r4 - r: INNER only. */
struct kd_null_radius { double r, d1, d2, pair, both, d3, d4; };

struct kd_null_radial {
    struct kd_null_motion motion;
    struct kd_null_roots roots;
    double r_plus, r_minus;
    bool inner, turns;              /* turns: there is a turning point outside the horizon          */
    struct kd_null_radial_sum turn; /* for OUTER with `turns`: from r4 to infinity */
    double tau_horizon;             /* Mino time from the horizon to the reference */
    double rate, k, k1, s0, c0, d0; /* Jacobi's functions: scale, parameter, values at the reference */
    enum kd_null_parts parts;
};

enum kd_null_region { KD_NULL_OUTER, KD_NULL_INNER, KD_NULL_FORBIDDEN };

/* The region of a radius > r+, which may be INFINITY. */
enum kd_null_region kd_null_region_of(const struct kd_null_roots *roots, double radius);

/* The roots must not be of the kind KD_NULL_NO_REAL. `parts`: the parts that all integrals of this motion
 * contain. */
struct kd_null_radial kd_null_radial_of(const struct kd_null_motion *m, const struct kd_null_roots *roots, bool inner,
                                        enum kd_null_parts parts);

struct kd_null_radius kd_null_radius_of(const struct kd_null_radial *q, double r);

/* The radius at Mino time tau from the reference. OUTER: tau >= 0, up to the horizon, or past the turning point, after
 * which the motion is mirrored. INNER: tau of any sign, up to the horizon. */
struct kd_null_radius kd_null_radius_at(const struct kd_null_radial *q, double tau);

/* Computes only the radius, at Mino time tau from infinity. Returns 0 if the ray reaches the horizon before, and
 * INFINITY if it has escaped. For OUTER motion; not for roots of kind KD_NULL_NO_REAL. Takes a fifth of the time of
 * kd_null_radial_of and kd_null_radius_at, since azimuths and times are left out. */
double kd_null_radius_after(const struct kd_null_motion *m, const struct kd_null_roots *roots, double tau);

/* Rates of the integrals in Mino time at r: tau has the rate 1; phi' and t' are given above. */
struct kd_null_radial_sum kd_null_radial_rates(const struct kd_null_motion *m, double r);

/* Integrals from `at` to the reference. Those that q->parts leaves out are 0. */
struct kd_null_radial_sum kd_null_radial_integrals(const struct kd_null_radial *q, const struct kd_null_radius *at);

/* Mino time and azimuth from r to infinity for four complex roots (vortical rays). */
struct kd_null_radial_sum kd_null_radial_complex(const struct kd_null_motion *m, const struct kd_null_roots *roots,
                                                 double r);

#endif
