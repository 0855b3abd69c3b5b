/* Radial motion of a null geodesic of Kerr and Kerr-Newman in Mino time, in closed form, outside the horizon. Units G
 * = c = M = 1, E = 1. Pure functions, any thread.
 *
 *   (dr/dtau)^2 = R(r)        phi' = a (2r - q^2 - a lambda)/Delta
 *   t' = r^2 + 2r + 4 - q^2 + ((8 - 4q^2 - 2a lambda) r + q^2 (q^2 + a lambda - 4) - 4a^2)/Delta
 *
 * phi' and t' are only the parts of the rates that depend on r (Gralla & Lupsasca 2020, arXiv:1910.12881, eqs. 6-8,
 * with 2r - q^2 for 2r). r(tau) is as in section IV of that paper, except that tau is counted from infinity or a
 * turning point. Addition theorems then give each r - r_i as a product. The integrals are Carlson's in terms of r
 * itself (DLMF 19.29.4-10), with r1 or r2 as the root that is singled out. Unlike the reductions to Legendre's Pi they
 * have no removable singularities (r3 = horizon, lambda = 2 r+/a), and nearly every term is positive.
 *
 * Motion is possible in two regions: OUTER, from the outermost root r4 (or the horizon) to infinity; and, if r3 >
 * r+, INNER, from the horizon to r3. Times and integrals are counted from `reference`: infinity for OUTER, r3 for
 * INNER. */
#ifndef KD_PHYSICS_NULL_NULL_RADIAL_H
#define KD_PHYSICS_NULL_NULL_RADIAL_H

#include "physics/null/null_quartic.h"

#include <stdbool.h>

/* Integrals from r to the reference. tau: Mino time. phi: azimuth. t: time; if the reference is infinity, r + 2 ln r is
 * subtracted. */
struct kd_null_radial_sum { double tau, phi, t; };

/* A radius r and its distances from the roots, each without cancellation. d1: r - r1. d2: r - r2. pair: sqrt((r - r3)(r
 * - r4)). both: sqrt|r - r3| + sqrt|r - r4|, or the sum of conjugate square roots for conjugate roots. d3, d4: r3 - r
 * and r4 - r, for INNER motion only. */
struct kd_null_radius { double r, d1, d2, pair, both, d3, d4; };

struct kd_null_radial {
    struct kd_null_motion motion;
    struct kd_null_roots roots;
    double r_plus, r_minus;
    /* inner: true for INNER motion. turns: true if the ray has a radial turning point outside the horizon */
    bool inner, turns;
    struct kd_null_radial_sum turn; /* integrals from r4 to infinity; set for OUTER motion with `turns` */
    double tau_horizon;             /* Mino time from the horizon to the reference */
    /* Numbers of Jacobi's functions. rate: rate of their argument by Mino time. k, k1: parameter, and 1 - k. s0, c0,
     * d0: values of sn, cn and dn at the reference */
    double rate, k, k1, s0, c0, d0;
    enum kd_null_parts parts;
};

enum kd_null_region { KD_NULL_OUTER, KD_NULL_INNER, KD_NULL_FORBIDDEN };

/* The region in which a radius lies. The radius must be outside the horizon, and may be INFINITY. */
enum kd_null_region kd_null_region_of(const struct kd_null_roots *roots, double radius);

/* Makes the radial motion of a ray. The roots must not be of the kind KD_NULL_NO_REAL. parts: the integrals that are
 * computed for this motion (null_quartic.h). */
struct kd_null_radial kd_null_radial_of(const struct kd_null_motion *m, const struct kd_null_roots *roots, bool inner,
                                        enum kd_null_parts parts);

struct kd_null_radius kd_null_radius_of(const struct kd_null_radial *q, double r);

/* The radius at Mino time tau from the reference. For OUTER motion tau must be >= 0. It may reach up to the horizon, or
 * past the turning point, where the motion is mirrored. For INNER motion tau may have either sign, and may reach up to
 * the horizon. */
struct kd_null_radius kd_null_radius_at(const struct kd_null_radial *q, double tau);

/* Computes only the radius, at Mino time tau from infinity. Returns 0 if the ray has reached the horizon by then, and
 * INFINITY if it has escaped. The motion must be OUTER, and the roots not of the kind KD_NULL_NO_REAL. It takes a fifth
 * of the time of kd_null_radial_of and kd_null_radius_at, because it computes no azimuths and times. */
double kd_null_radius_after(const struct kd_null_motion *m, const struct kd_null_roots *roots, double tau);

/* Rates of the integrals by Mino time at r. The rate of tau is 1; phi' and t' are given above. */
struct kd_null_radial_sum kd_null_radial_rates(const struct kd_null_motion *m, double r);

/* Integrals from `at` to the reference. Integrals that q->parts leaves out are 0. */
struct kd_null_radial_sum kd_null_radial_integrals(const struct kd_null_radial *q, const struct kd_null_radius *at);

/* Mino time and azimuth from r to infinity for four complex roots (vortical rays). */
struct kd_null_radial_sum kd_null_radial_complex(const struct kd_null_motion *m, const struct kd_null_roots *roots,
                                                 double r);

#endif
