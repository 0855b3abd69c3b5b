/* The critical curve of Kerr is where on an observer's sky light comes from the spherical photon orbits. Inside it a
 * ray traced back falls into the hole, outside it leaves; it is the edge of the shadow. Double precision; pure
 * functions, any thread. Units G = c = M = 1, angles in radians.
 *
 * An orbit of the photon shell with lambda, eta is seen by an observer at inclination i (u = cos i, s = sin i) at
 *
 *   alpha = -lambda/s        beta = +-sqrt(eta + (a^2 - alpha^2) u^2)
 *
 * where that is real (Bardeen 1973, in Black Holes). With photon_shell.h's letters alpha = (w/s)(y + y_P + 2N/(y
 * y_P)), which is regular on the axis, w = 0 = s, too. At any distance the curve is the same in (alpha, beta), which
 * label the constants of motion. An observer at a finite radius sees it in the directions
 *
 *   right, up, inwards = m: the components along e_phi, -e_theta and -e_r of the direction in which one looks,
 *
 * the axes of an unturned pinhole camera (render/view/camera.c). Orbits with r > r_observer are seen looking
 * outwards.
 *
 * The sky is described in polar coordinates (angle, rho) about a centre, on the line beta = 0 midway between the
 * curve's two ends: every angle meets the curve once. The angle is counted from the right, +alpha, over the top,
 * +beta.
 *   at infinity        rho = sqrt((alpha - centre)^2 + beta^2), in M;
 *   at a finite radius rho is the angle from the direction of the centre, which is `centre` to the right of -e_r.
 *
 * Measures (Johannsen & Psaltis 2010, ApJ 718, 446; Chan, Psaltis & Ozel 2013, ApJ 777, 13), there at infinity:
 *   displacement D = (alpha_max + alpha_min)/2, with its sign (theirs is |D|);
 *   mean radius  R = (1/2 pi) Int rho d(angle) about (D, 0);
 *   asymmetry    A = 2 sqrt((1/2 pi) Int (rho - R)^2 d(angle));
 *   area         (1/2) Int rho^2 d(angle).
 * At a finite radius the same of the angles; the area is then the solid angle, Int (1 - cos rho) d(angle).
 *
 * Accuracy: alpha and beta are within some 1e-15 M of the exact curve. (Not of the exact point on it; where the
 * curve is all but straight, near a = 1, `orbit` loses digits: it is y = r - 1 that is exact there.) */
#ifndef KD_PHYSICS_NULL_CRITICAL_H
#define KD_PHYSICS_NULL_CRITICAL_H

#include "physics/null/photon_shell.h"
#include "physics/spacetime/observer.h"

#include <stdbool.h>

struct kd_critical_observer {
    double spin;                      /* |spin| < 1                                                      */
    double radius;                    /* outside the horizon, the inner one of what falls; INFINITY      */
    double cos_theta;                 /* [-1, 1], exact 0 and +-1 included                               */
    double sin_theta;                 /* 0: taken from cos_theta, as in null_geodesic.h                  */
    struct kd_observer_motion motion; /* at a finite radius, where there is this observer */
};

enum kd_critical_status {
    KD_CRITICAL_OK,
    KD_CRITICAL_BAD_INPUT,   /* NaN, or outside the ranges above                  */
    KD_CRITICAL_NO_OBSERVER, /* there is none such there                          */
};

/* The curve of one observer. */
struct kd_critical {
    enum kd_critical_status status;
    struct kd_critical_observer observer;
    struct kd_shell shell;
    struct kd_tetrad tetrad; /* at a finite radius; where the observer moves along theta, of zero angular momentum */
    struct kd_tetrad skew;   /* the observer's own then; otherwise not set */
    bool is_skew;
    double sine;        /* of the inclination                          */
    double low, high;   /* places of the orbits at the left and right end, divided by `sine` where that is not 0 */
    double left, right; /* where the ends are: alpha, or the angle to the right of -e_r */
    double centre;
};

/* For an observer that moves along theta the lower half is not the mirror image of the upper one. `along`, angle,
 * rho, centre, left and right are then those of an observer of zero angular momentum at the same place, and only
 * right, up and inwards of a point are as seen. Measures are NaN.
 *
 * Check `status`: no other function takes a curve without OK. */
struct kd_critical kd_critical_of(const struct kd_critical_observer *observer);

struct kd_critical_point {
    struct kd_shell_orbit orbit;
    double alpha, beta;
    double angle, rho;         /* about the centre                                   */
    double right, up, inwards; /* direction, at a finite radius; at infinity 0, 0, 1 */
};

/* The point seen at `angle`, any real. Some two microseconds. */
struct kd_critical_point kd_critical_at(const struct kd_critical *curve, double angle);

/* A point of the upper half; the other half is its mirror image, and both are as seen once kd_critical_see has had
 * them. `along` goes from 0 at the left end to 1 at the right one, not evenly in any angle or length. No root is
 * sought: ten times as fast, for drawing the curve. At the ends `up` is good to some 1e-8 M. */
struct kd_critical_point kd_critical_upper(const struct kd_critical *curve, double along);

/* The same, with a smooth function of `along`: the orbits' radii are so by ln(r - 1), in which kd_critical_upper has
 * a bend. */
struct kd_critical_point kd_critical_round(const struct kd_critical *curve, double along);

/* Turns right, up and inwards of a point of kd_critical_upper, or of its mirror image, into those of an observer
 * that moves along theta; nothing for others. kd_critical_at has done so. */
void kd_critical_see(const struct kd_critical *curve, struct kd_critical_point *point);

/* Measures by the trapezoidal rule, which converges exponentially. `points` is how many it took to 1e-13, or 8192:
 * near a = 1 the curve bends all but suddenly, and some 1e-10 is left. */
struct kd_critical_measures {
    double area, mean_radius, displacement, asymmetry;
    double width,
        height; /* right - left; twice the largest rho sin(angle) (at a finite radius: in the plane of angles) */
    int points;
};
struct kd_critical_measures kd_critical_measure(const struct kd_critical *curve);

#endif
