/* The critical curve: the points of an observer's sky where light arrives from the spherical photon orbits. A ray
 * traced back falls into the hole inside the curve and escapes outside it. The curve is the edge of the shadow. Double
 * precision; pure functions, any thread. Units G = c = M = 1, angles in radians.
 *
 * An observer at inclination i (u = cos i, s = sin i) sees an orbit of the photon shell with the constants lambda and
 * eta at
 *
 *   alpha = -lambda/s        beta = +-sqrt(eta + (a^2 - alpha^2) u^2)
 *
 * where beta is real (Bardeen 1973, in Black Holes). In the symbols of photon_shell.h, alpha = (w/s)(y + y_P + 2N/(y
 * y_P)), which is also regular for an observer on the axis, where w = 0 and s = 0. At any distance the curve is the
 * same in (alpha, beta), which label the constants of motion. An observer at a finite radius sees the curve in the
 * directions
 *
 *   right, up, inwards = m: the components of the line of sight along e_phi, -e_theta and -e_r,
 *
 * which are the axes of an unturned pinhole camera (render/view/camera.c). Orbits with r > r_observer are seen looking
 * outwards.
 *
 * The sky is described in polar coordinates (angle, rho) about a centre, on the line beta = 0 midway between the
 * curve's two ends: every angle meets the curve once. The angle is counted from the right, +alpha, over the top,
 * +beta.
 *   at infinity        rho = sqrt((alpha - centre)^2 + beta^2), in M;
 *   at a finite radius rho is the angle from the direction of the centre, which is `centre` to the right of -e_r.
 *
 * Measures (Johannsen & Psaltis 2010, ApJ 718, 446; Chan, Psaltis & Ozel 2013, ApJ 777, 13), defined there at
 * infinity:
 *   displacement D = (alpha_max + alpha_min)/2, with its sign (theirs is |D|);
 *   mean radius  R = (1/2 pi) Int rho d(angle) about (D, 0);
 *   asymmetry    A = 2 sqrt((1/2 pi) Int (rho - R)^2 d(angle));
 *   area         (1/2) Int rho^2 d(angle).
 * At a finite radius the measures are the same, in angles, and the area is the solid angle, Int (1 - cos rho) d(angle).
 *
 * Accuracy: alpha and beta are within some 1e-15 M of the exact curve. (The position along the curve is less accurate.
 * Where the curve is nearly straight, near a = 1, `orbit` loses digits, and only y = r - 1 is accurate.) */
#ifndef KD_PHYSICS_NULL_CRITICAL_H
#define KD_PHYSICS_NULL_CRITICAL_H

#include "physics/null/photon_shell.h"
#include "physics/spacetime/observer.h"

#include <stdbool.h>

struct kd_critical_observer {
    struct kd_hole hole;
    /* radius of the observer, outside the horizon or, if it falls, outside the inner horizon; may be INFINITY */
    double radius;
    double cos_theta;                 /* cos(theta) of the observer, in [-1, 1]; 0, 1 and -1 may be exact */
    double sin_theta;                 /* sin(theta); 0 if it is to be computed from cos_theta (null_geodesic.h) */
    struct kd_observer_motion motion; /* motion of an observer at a finite radius; it must be possible at the place */
};

enum kd_critical_status {
    KD_CRITICAL_OK,
    KD_CRITICAL_BAD_INPUT,   /* an input is NaN, or outside the ranges above */
    KD_CRITICAL_NO_OBSERVER, /* this kind of observer does not exist at the place */
};

/* The curve of one observer. */
struct kd_critical {
    enum kd_critical_status status;
    struct kd_critical_observer observer;
    struct kd_shell shell;
    /* for an observer at a finite radius: its tetrad or, if it moves along theta, the tetrad of zero angular
     * momentum */
    struct kd_tetrad tetrad;
    struct kd_tetrad skew; /* for an observer that moves along theta: its own tetrad; otherwise not set */
    bool is_skew;
    double sine; /* sine of the observer's inclination */
    /* places of the orbits at the left and the right end, divided by `sine` unless `sine` is 0 */
    double low, high;
    double left, right; /* alpha of each end; at a finite radius, angle to the right of -e_r */
    double centre;
};

/* For an observer that moves along theta the lower half of the curve is not the mirror image of the upper half. Then
 * `along`, angle, rho, centre, left and right refer to an observer of zero angular momentum at the same place. Only
 * right, up and inwards of a point are the components that this observer sees. Measures are NaN.
 *
 * Check `status`: all other functions require a curve with KD_CRITICAL_OK. */
struct kd_critical kd_critical_of(const struct kd_critical_observer *observer);

struct kd_critical_point {
    struct kd_shell_orbit orbit;
    double alpha, beta;
    double angle, rho;         /* polar coordinates of the point about the curve's centre                 */
    double right, up, inwards; /* direction of the point, for an observer at a finite radius; (0, 0, 1) at infinity */
};

/* The point of the curve at `angle`, which may be any real number. Takes some two microseconds. */
struct kd_critical_point kd_critical_at(const struct kd_critical *curve, double angle);

/* A point of the upper half of the curve. kd_critical_see converts this point, or its mirror image on the lower half,
 * to what the observer sees. `along` goes from 0 at the left end to 1 at the right end, but not evenly in angle or
 * length. No root is searched, so for drawing the curve this function is ten times as fast as kd_critical_at. At the
 * ends `up` is accurate to some 1e-8 M. */
struct kd_critical_point kd_critical_upper(const struct kd_critical *curve, double along);

/* Like kd_critical_upper, but the point is a smooth function of `along`, because the orbits are spaced evenly in ln(r -
 * 1). The result of kd_critical_upper has a kink as a function of `along`. */
struct kd_critical_point kd_critical_round(const struct kd_critical *curve, double along);

/* Converts right, up and inwards of a point of kd_critical_upper, or of its mirror image, to those of an observer that
 * moves along theta. For other observers it changes nothing. Results of kd_critical_at need no conversion. */
void kd_critical_see(const struct kd_critical *curve, struct kd_critical_point *point);

/* Measures of the curve by the trapezoidal rule, which converges exponentially. points: number of points needed for an
 * error of 1e-13, at most 8192. Near a = 1, where the curve bends almost abruptly, an error of some 1e-10 remains. */
struct kd_critical_measures {
    double area, mean_radius, displacement, asymmetry;
    double width,
        /* width: right - left. height: twice the largest rho sin(angle); at a finite radius these are angles */
        height;
    int points;
};
struct kd_critical_measures kd_critical_measure(const struct kd_critical *curve);

#endif
