/* Roots of the radial potential of a null geodesic of Kerr and Kerr-Newman. Units G = c = M = 1 and E = 1. Pure
 * functions, any thread.
 *
 *   R(r) = (r^2 + a^2 - a lambda)^2 - Delta (eta + (lambda - a)^2) = r^4 + A r^2 + 2 K r + C
 *
 * Charge q of the hole enters C alone, by Delta: C = -a^2 eta - q^2 K.
 *
 * Sources: Gralla & Lupsasca 2020, arXiv:1910.12881, section IV and appendix A (roots and cases). The roots are found
 * differently: r1 and r2 by Newton's method, started on a side from which it converges monotonically, and r3 and r4 by
 * division. The distance between r3 and r4, which vanishes on the critical curve, is therefore one number (pair) with
 * the accuracy of the coefficients. */
#ifndef KD_PHYSICS_NULL_NULL_QUARTIC_H
#define KD_PHYSICS_NULL_NULL_QUARTIC_H

#include "physics/spacetime/hole.h"

/* The constants of motion of one ray, computed from its labels alpha and beta. With the inclination i, c = cos i and s
 * = sin i,
 *
 *   lambda = -alpha s         eta = (alpha^2 - a^2) c^2 + beta^2
 *   K = eta + (lambda - a)^2 = (alpha + a s)^2 + beta^2
 *   A = a^2 - eta - lambda^2 = a^2 (1 + c^2) - alpha^2 - beta^2            C = -a^2 eta - q^2 K
 *
 * The code uses the rightmost form of each line, which loses the fewest digits by cancellation. */
struct kd_null_motion {
    struct kd_hole hole;
    double c, s, alpha, beta;
    double lambda, eta, quadratic, k, constant; /* numbers of R(r): quadratic is A, k is K, constant is C */
};

/* Constants of a ray. cos_theta: in [-1, 1]. sin_theta: 0 if it is to be computed from cos_theta. */
struct kd_null_motion kd_null_motion_of(const struct kd_hole *hole, double cos_theta, double sin_theta, double alpha,
                                        double beta);

double kd_null_radial_potential(const struct kd_null_motion *m, double r);

enum kd_null_case {
    KD_NULL_FOUR_REAL, /* four real roots, r1 < r2 <= r3 < r4: cases 1 and 2 of Gralla & Lupsasca */
    KD_NULL_TWO_REAL,  /* r1 < r2 are real, and r3 and r4 are complex conjugates: case 3 */
    KD_NULL_NO_REAL,   /* two pairs of complex conjugates, only for eta < 0: case 4 */
};

/* The roots of R. r3 and r4 are mean -+ sqrt(pair). In case 4, r1 and r2 are -mean -+ sqrt(pair_left); otherwise they
 * are the members r1 and r2.
 */
struct kd_null_roots {
    enum kd_null_case kind;
    double r1, r2, mean, pair, pair_left;
    double r3, r4;      /* roots r3 and r4; set only if all four roots are real */
    double r21, p1, p2; /* r2 - r1, (r3 - r1)(r4 - r1) and (r3 - r2)(r4 - r2); not set in case 4 */
    double margin;      /* |pair| / mean^2, which is roughly the relative distance from the critical curve */
};

/* Selects the integrals that are computed along a ray. TAU: Mino time only. TAU_PHI: Mino time and azimuth. TAU_PHI_T:
 * Mino time, azimuth and coordinate time. */
enum kd_null_parts { KD_NULL_TAU, KD_NULL_TAU_PHI, KD_NULL_TAU_PHI_T };

/* Finds the roots. Their errors are those that a relative change of the coefficients by a few 1e-16 causes. An exactly
 * double root r3 = r4 is split by 1e-11 into a conjugate pair. All roots are 0 for a = alpha = beta = 0. */
struct kd_null_roots kd_null_roots_of(const struct kd_null_motion *m);

/* Change from a critical ray, for which R has the double root r, to a ray displaced from it by (dalpha, dbeta).
 * quadratic, k, constant: changes of A, K and C. bend: R''(r)/2 of the critical ray. */
struct kd_null_displacement {
    double r, bend;
    double quadratic, k, constant;
};

struct kd_null_displacement kd_null_displacement_of(const struct kd_null_motion *critical, double r, double bend,
                                                    double dalpha, double dbeta);

/* Finds the roots for a ray beside the critical curve, where the rounded coefficients no longer determine `pair`.
 * `pair` is computed from the displacement, with a relative error of a few 1e-16 for any small displacement. m: the
 * motion of the displaced ray. The displacement must be some percent at most. Where the iteration does not converge
 * (near a = 1, where bend is small), the result is that of kd_null_roots_of. */
struct kd_null_roots kd_null_roots_beside(const struct kd_null_motion *m, const struct kd_null_displacement *d);

#endif
