/* Null geodesics of Kerr and Kerr-Newman in closed form: the places and times at which the ray seen at (alpha, beta)
 * crosses the equatorial plane, and the ray's origin. Double precision; pure functions, any thread. Lengths and times
 * in M (G = c = M = 1), angles in radians. This code uses no integrator and shares nothing with the shaders, because it
 * is the reference in their tests.
 *
 * Sources: Gralla & Lupsasca 2020, arXiv:1910.12881 (the motion in Mino time, four cases of roots) and 1910.12873;
 * Kapec & Lupsasca 2019, arXiv:1905.11406; Carlson 1995 and DLMF 19.29 (the integrals). The parts are null_quartic.h,
 * null_polar.h, null_radial.h, each with its own formulas.
 *
 * Accuracy: each crossing has `error_*`, which is estimated from the numerical derivatives of the answer by alpha and
 * beta, times some ten machine epsilons. The true error is typically a twentieth of this estimate, and exceeds it for
 * one crossing in ten thousand. The relative error of r is 2e-16 in the median, and 1e-13 for 99 % of the crossings of
 * orders 0-3 within 8 M. phi and delay are similarly accurate, but less so near the horizon. At a distance of 1e-10
 * from the critical curve order 3 still has an error of 1e-11. At 1 - |a| = 1e-12 phi and delay lose up to six digits
 * because the horizons nearly meet. */
#ifndef KD_PHYSICS_NULL_NULL_GEODESIC_H
#define KD_PHYSICS_NULL_NULL_GEODESIC_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_NULL_ORDERS = 32 };

/* The ray. alpha, beta: labels of the constants of motion, at any radius. With i the inclination, lambda = L/E = -alpha
 * sin i and eta = Q/E^2 = (alpha^2 - a^2) cos^2 i + beta^2. The p^theta of the arriving photon has the sign of beta. E
 * is positive. */
struct kd_null_ray {
    struct kd_hole hole;
    double radius;    /* radius of the observer; outside the horizon, or INFINITY */
    double cos_theta; /* cos(theta) of the observer, in [-1, 1]; 0, 1 and -1 may be exact */
    /* sin(theta) of the observer; 0 if it is to be computed from cos_theta. Within 1e-5 of the axis, cos_theta
     * determines the sine only to 1e-6. */
    double sin_theta;
    double alpha, beta;
    /* only for an observer at a finite radius: true if the traced ray starts outwards, that is, if the photon arrives
     * moving inwards */
    bool outward;
    int orders; /* number of wanted crossings, at most KD_NULL_ORDERS */
};

enum kd_null_status {
    KD_NULL_OK,
    KD_NULL_IN_PLANE,  /* the ray lies in the equatorial plane; only its fate and direction are given */
    KD_NULL_CRITICAL,  /* the ray is on the critical curve within rounding, so that fate, direction and late crossings
                          are uncertain */
    KD_NULL_NO_RAY,    /* no photon with these constants reaches the observer's radius */
    KD_NULL_BAD_INPUT, /* an input is NaN, or outside the ranges above */
};

/* where the ray, traced back, ends: in the past horizon, or at infinity */
enum kd_null_fate { KD_NULL_CAPTURED, KD_NULL_ESCAPED };

/* A crossing of the equatorial plane. Crossings n = 0, 1, ... count back from the observer; a start in the plane does
 * not count.
 *   phi    Boyer-Lindquist, source minus observer, not reduced to a turn. On the axis the observer's azimuth is
 *          such that the image's right, +alpha, is +90 degrees: phi is atan2(alpha, -beta cos(theta)) at the ray's
 *          start. A ray through the axis (alpha = 0) turns by pi there, towards -phi.
 *   delay  t(observed) - t(emitted); from INFINITY less r_o + 2 ln r_o.
 *   sense  sign of the real photon's p^r: +1 before the traced ray's turning point, -1 after it (of rays traced
 *          inwards).
 *   error  estimated: error_r relative, error_phi and error_delay absolute. INFINITY where the answer is not
 *          determined. */
struct kd_null_crossing {
    double r, phi, delay;
    int sense;
    double error_r, error_phi, error_delay;
};

/* The path of a ray. sky_u, sky_phi: cos(theta) and azimuth (as phi above) of the direction of escape; NaN if the ray
 * is captured. sky_error: absolute error of each of the two. turned: true if the traced ray meets a radial turning
 * point, which includes rays that start outwards and are captured. doubtful: true if the number of crossings changes
 * when the labels change by 1e-13 to 1e-11, because a crossing is at the horizon or far out; kd_null_trace_fast does
 * not set this member. */
struct kd_null_path {
    enum kd_null_status status;
    enum kd_null_fate fate;
    bool turned, doubtful;
    int crossings;
    struct kd_null_crossing crossing[KD_NULL_ORDERS];
    double sky_u, sky_phi, sky_error;
};

/* Traces a ray. If the status is not OK, IN_PLANE or CRITICAL, there are no crossings and no direction. */
struct kd_null_path kd_null_trace(const struct kd_null_ray *ray);

/* kd_null_trace without estimates of errors: all errors are set to 0. It takes a quarter to a third of the time of
 * kd_null_trace. */
struct kd_null_path kd_null_trace_fast(const struct kd_null_ray *ray);

/* kd_null_trace_fast without phi, delay, sky_u and sky_phi, which are NaN. Fate, turn, and r and sense of each crossing
 * are the same to the bit. It takes a third of the time of kd_null_trace_fast. */
struct kd_null_path kd_null_trace_radii(const struct kd_null_ray *ray);

#endif
