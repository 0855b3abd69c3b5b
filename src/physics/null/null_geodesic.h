/* Null geodesics of Kerr and Kerr-Newman in closed form: where the ray seen at (alpha, beta) crosses the equatorial
 * plane, when, and where it came from. Double precision; pure functions, any thread. Lengths and times in M (G = c = M
 * = 1), angles in radians. It uses no integrator and shares nothing with the shaders, because it is the reference in
 * their tests.
 *
 * Sources: Gralla & Lupsasca 2020, arXiv:1910.12881 (the motion in Mino time, four cases of roots) and 1910.12873;
 * Kapec & Lupsasca 2019, arXiv:1905.11406; Carlson 1995 and DLMF 19.29 (the integrals). The parts are null_quartic.h,
 * null_polar.h, null_radial.h, each with its own formulas.
 *
 * Accuracy: each crossing has `error_*`, estimated as the numerical derivatives of the answer in (alpha, beta) times
 * some ten times the machine epsilon. The true error is below it except for one crossing in ten thousand, and typically
 * a twentieth of it. The relative error of r is 2e-16 in the median, and 1e-13 for 99 % of the crossings of orders 0-3
 * within 8 M. phi and delay are similar, less accurate near the horizon. At a distance of 1e-10 from the critical curve
 * order 3 still has an error of 1e-11. At 1 - |a| = 1e-12 phi and delay lose up to six digits because the horizons
 * nearly meet. */
#ifndef KD_PHYSICS_NULL_NULL_GEODESIC_H
#define KD_PHYSICS_NULL_NULL_GEODESIC_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_NULL_ORDERS = 32 };

/* The ray. alpha, beta label the constants of motion, at any radius: with i the inclination, lambda = L/E = -alpha
 * sin i, eta = Q/E^2 = (alpha^2 - a^2) cos^2 i + beta^2; the sign of the arriving photon's p^theta is that of beta.
 * E > 0. */
struct kd_null_ray {
    struct kd_hole hole;
    double radius;    /* radius of the observer; outside the horizon, or INFINITY */
    double cos_theta; /* cos(theta) of the observer: [-1, 1], exact 0 and +-1 included */
    /* 0: computed from cos_theta. Within 1e-5 of the axis, cos_theta determines the sine to 1e-6 only. */
    double sin_theta;
    double alpha, beta;
    bool outward; /* finite radius only: the traced ray starts outwards, that is, the photon arrives moving inwards */
    int orders;   /* number of crossings wanted, 0 ... KD_NULL_ORDERS */
};

enum kd_null_status {
    KD_NULL_OK,
    KD_NULL_IN_PLANE,  /* the ray lies in the equatorial plane, and only fate and direction are given */
    KD_NULL_CRITICAL,  /* the ray is on the critical curve within rounding, so that fate, direction and late crossings
                          are uncertain */
    KD_NULL_NO_RAY,    /* no photon with these constants reaches the observer's radius */
    KD_NULL_BAD_INPUT, /* NaN, or outside the ranges above                                                         */
};

/* the traced ray ends in the past horizon, or at infinity */
enum kd_null_fate { KD_NULL_CAPTURED, KD_NULL_ESCAPED };

/* Crossing n = 0, 1, ... counts back from the observer; a start in the plane does not count.
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

/* sky_u, sky_phi: cos(theta) and azimuth, as phi above, of the direction of escape; NaN if captured. sky_error:
 * absolute error of each of the two. turned: the traced ray meets a radial turning point, which includes rays that
 * start outwards and are captured. doubtful: the number of crossings changes when the labels move by 1e-13 to 1e-11, at
 * the horizon or far out; kd_null_trace_fast does not set it. */
struct kd_null_path {
    enum kd_null_status status;
    enum kd_null_fate fate;
    bool turned, doubtful;
    int crossings;
    struct kd_null_crossing crossing[KD_NULL_ORDERS];
    double sky_u, sky_phi, sky_error;
};

/* With a status other than OK, IN_PLANE and CRITICAL there are no crossings and no direction. */
struct kd_null_path kd_null_trace(const struct kd_null_ray *ray);

/* Like kd_null_trace, but does not estimate errors and sets them to 0. It takes a quarter to a third of the time. */
struct kd_null_path kd_null_trace_fast(const struct kd_null_ray *ray);

/* Like kd_null_trace_fast, but does not compute phi, delay, sky_u and sky_phi, which are NaN. Fate, turn, and r and
 * sense of each crossing are the same to the bit. Takes a third of the time of kd_null_trace_fast. */
struct kd_null_path kd_null_trace_radii(const struct kd_null_ray *ray);

#endif
