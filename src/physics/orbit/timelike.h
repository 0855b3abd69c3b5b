/* Timelike geodesics of Kerr, with or without charge: constants of motion, turning points and fate. Double precision,
 * pure functions, any thread. Units G = c = M = 1, unit rest mass; Boyer-Lindquist coordinates. The spin a is signed;
 * the orbit goes in the sense of its L.
 *
 * Let w = 1/r, u = cos(theta), K = Q + (L - aE)^2 and b = 1 - E^2. In Mino time (dtau_proper = Sigma dlambda) the
 * equations of motion are
 *
 *   w'^2 = W(w) = -b + 2w - (a^2 b + L^2 + Q + q^2) w^2 + 2K w^3 - (a^2 Q + q^2 K) w^4
 *   u'^2 = Q - (Q + L^2 + a^2 b) u^2 + a^2 b u^4
 *
 * (Carter 1968, Phys. Rev. 174, 1559, with the charge q of the hole; Mino 2003, gr-qc/0302075). The particle is
 * neutral. Q is Carter's constant, Q = 0 in the equatorial plane. */
#ifndef KD_PHYSICS_ORBIT_TIMELIKE_H
#define KD_PHYSICS_ORBIT_TIMELIKE_H

#include "base/error.h"
#include "physics/spacetime/hole.h"
#include "physics/spacetime/observer.h"

#include <stdbool.h>

enum kd_orbit_fate { KD_ORBIT_BOUND, KD_ORBIT_PLUNGE, KD_ORBIT_ESCAPE };
const char *kd_orbit_fate_name(enum kd_orbit_fate fate); /* The name of a fate: "bound", "plunge" or "escape". */

struct kd_orbit {
    struct kd_hole hole;
    double energy, binding;  /* energy: E. binding: 1 - E^2, stored too because E may be close to 1 */
    double momentum, carter; /* L and Q */
    double k, total;         /* k: K. total: L^2 + Q */
    double w[5];             /* coefficients of W(w), in ascending powers */
    /* Numbers of the rates of azimuth and time by Mino time. The rate of azimuth is a (2E r - drag)/Delta + L/sin^2
     * theta. The rate of time is E (r^2 + 2r + four + a^2 u^2) + (near r - 4 a^2 E - nearer)/Delta. */
    double drag, four, near, nearer;
    /* Polar motion: u'^2 = (z - u^2)(n - a^2 b u^2), with z n = Q. u oscillates between -sqrt(z) and sqrt(z). For Q < 0
     * the motion stays on one side of the equator. */
    double z, n, axis_gap; /* axis_gap: 1 - z */
    enum kd_orbit_fate fate;
    /* The range of 1/r of the motion. An end is a turning point if there is one; otherwise w_low is 0 (infinity), and
     * w_high is 1/r+ (the horizon). */
    double w_low, w_high;
    bool turns_out, turns_in; /* turns_out: w_low is a turning point. turns_in: w_high is one */
    /* true if r is constant, so that both ends coincide; fate is PLUNGE if such an orbit is unstable */
    bool circular;
};

/* Start of a motion: position, and rates in Mino time. */
struct kd_orbit_state { double w, w_rate, u, u_rate; };

/* The bound orbit between the radii p/(1+e) and p/(1-e), 0 <= e < 1. x is the cosine of its inclination to the
 * equatorial plane, |x| <= 1; x < 0 is retrograde (towards -phi). The formulas are those of W. Schmidt 2002,
 * gr-qc/0202090, appendix B, regrouped (orbit_shape.c). Returns KD_EINVAL, with the pointer "/p", "/e" or "", if there
 * is no such orbit. Only a circular orbit may be unstable. */
enum kd_status kd_orbit_from_shape(const struct kd_hole *hole, double p, double e, double x, struct kd_orbit *orbit,
                                   struct kd_error *error);

/* The separatrix: the smallest p of a stable orbit with this eccentricity e and inclination cosine x. For e = 0 it is
 * the radius of the innermost stable circular or spherical orbit. */
double kd_orbit_separatrix(const struct kd_hole *hole, double e, double x);
/* Radius of the photon orbit with the inclination cosine x. Circular and spherical orbits of bodies, stable or not,
 * exist only outside it. */
double kd_orbit_least_circle(const struct kd_hole *hole, double x);

/* Orbit with given constants; Q must be >= 0. r: radius of a point of the orbit, or NAN for the outermost range that
 * the constants allow. Returns KD_EINVAL, with the pointer "/energy", "/carter" or "/r", if there is no such motion
 * outside the horizon. */
enum kd_status kd_orbit_from_constants(const struct kd_hole *hole, double energy, double momentum, double carter,
                                       double r, struct kd_orbit *orbit, struct kd_error *error);

/* Orbit through a place outside the horizon. The velocity has the components (r, theta, phi), |v| < 1, and is measured
 * by an observer of the given kind at that place. Returns KD_EINVAL, with the pointer "/position/r", "/velocity" and so
 * on, if there is no such orbit. */
enum kd_status kd_orbit_from_state(const struct kd_hole *hole, double r, double theta_deg, enum kd_observer frame,
                                   const double v[3], struct kd_orbit *orbit, struct kd_orbit_state *start,
                                   struct kd_error *error);

/* The start of the motion, at the ascending node. outward: true if it starts outwards. r: radius of the start, or NAN
 * for the periastron or, if there is none, for the outer end of the range. If r is within 1e-14 of a turning point, the
 * body starts at rest there. For an orbit from infinity r must be given. A body on an unstable circle leaves it
 * inwards: it starts one ulp of 1/r inside the circle. */
struct kd_orbit_state kd_orbit_start(const struct kd_orbit *orbit, double r, bool outward);

/* A whirl is a long stay near an unstable circular orbit that the constants nearly describe. Returns the factor by
 * which a relative error of the constants is amplified in the length of the coming whirl. The factor is the size of the
 * terms of W divided by W, at the minimum of W. The time until the motion passes the minimum, or turns there, grows as
 * the logarithm of this factor. Returns 0 if no such minimum lies ahead, and for an unstable circular orbit itself. *r:
 * radius of the whirl; r may be NULL. */
double kd_orbit_whirl(const struct kd_orbit *orbit, const struct kd_orbit_state *start, double *r);

/* kd_orbit_radial: W(w). kd_orbit_radial_slope: dW/dw. kd_orbit_radial_by_energy: derivative of W by E at fixed L and
 * Q, which converts a residual of W to a residual of E. */
double kd_orbit_radial(const struct kd_orbit *orbit, double w);
double kd_orbit_radial_slope(const struct kd_orbit *orbit, double w);
double kd_orbit_radial_by_energy(const struct kd_orbit *orbit, double w);

/* Only for files of this folder: sets all members that depend only on the hole, E, b, L and Q. */
void kd_orbit_set_constants(struct kd_orbit *orbit);

/* Divides W by its two turning points: W = (w - w_low)(w_high - w)(g[0] + g[1] w + g[2] w^2). Both ends of the range
 * must be turning points. */
void kd_orbit_factor(const struct kd_orbit *orbit, double g[3]);

#endif
