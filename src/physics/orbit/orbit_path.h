/* Integrates timelike geodesics of Kerr, with or without charge. Double precision, any thread; a path belongs to one
 * thread at a time.
 *
 * In Mino time, with b = 1 - E^2, w = 1/r and y = cos(theta)/sqrt(z), -1 <= y <= 1 (timelike.h),
 *
 *   w'' = W'(w)/2        y'' = -(L^2 + Q + a^2 b) y + 2 a^2 b z y^3
 *
 * These are two separate oscillators with polynomial forces, those of Binet and Duffing. An orbit in the equatorial
 * plane has a fictitious y. The rates of proper time, t and phi depend on the place alone. They are treated as further
 * momenta, so that each method integrates them to its own order. The azimuth has no pole at the axis: with N = Q/z, cc
 * = |L|/(N - a^2 b), nu = -a^2 b cc^2
 *
 *   |L|/(1 - u^2) = d/dlambda atan2(cc y (N - a^2 b u^2), y') - a^2 b cc (1 - y^2)/(1 - nu y^2)
 *
 * (null_polar.h has the same for light; tests/unit/physics_orbit.c checks it by quadrature). E and L of the orbit are
 * parameters. L is not part of any momentum, and is conserved exactly.
 *
 *   KD_ORBIT_YOSHIDA6  H. Yoshida 1990, Phys. Lett. A 150, 262, solution A: seven leapfrogs a step. In their drifts y
 *                      moves as the harmonic oscillator that it is for a = 0. Where relativity is a small disturbance
 *                      (periastron above some 12 M), w moves as on Kepler's ellipse, after J. Wisdom & M. Holman 1991,
 *                      AJ 102, 1528. Symplectic: the errors of the first integrals stay bounded. All sums are
 *                      compensated, so that rounding does not accumulate either.
 *   KD_ORBIT_RKN6      J. Albrecht 1955, ZAMM 35, 100: Nystroem's method of order 6 in five stages
 *
 * t and phi diverge at the horizon. A plunging path uses ingoing coordinates once its fall is final. Its t and phi
 * are derived from those, and are accurate up to the horizon itself, where they are infinite and given as NAN. */
#ifndef KD_PHYSICS_ORBIT_ORBIT_PATH_H
#define KD_PHYSICS_ORBIT_ORBIT_PATH_H

#include "physics/orbit/orbit_bound.h"

#include <stdint.h>

enum kd_orbit_method { KD_ORBIT_YOSHIDA6, KD_ORBIT_RKN6 };

/* A number and its rounding error. */
struct kd_exact { double value, rest; };

enum { KD_PATH_W, KD_PATH_Y, KD_PATH_PLACES };
enum { KD_PATH_PROPER = KD_PATH_PLACES, KD_PATH_T, KD_PATH_CHI, KD_PATH_RATES };

/* The linear part of a force, -strength (q - centre). Its motion is computed exactly. Its rotations in the drifts of a
 * step are stored as shears. */
struct kd_spring {
    double strength, centre;
    struct { double kick, drift; } turn[4];
};

struct kd_orbit_path {
    /* for callers only; the integrator does not read it */
    struct kd_orbit orbit;
    enum kd_orbit_method method;
    bool factored, ingoing;
    double g[3];
    struct kd_spring spring[KD_PATH_PLACES];
    double stiff;                /* rate at which y grows if its linear force is repulsive */
    double cc, nu, twist, swing; /* cc, nu, twist: constants of the azimuth. swing: its fast part at the start */
    /* ingoing time minus t, and ingoing azimuth minus phi, where the path changed to ingoing coordinates */
    double entry_t, entry_phi;
    struct kd_exact place[KD_PATH_PLACES]; /* 0: w. 1: y. */
    /* 0, 1: derivatives of w and y. 2: proper time. 3: t. 4: the smooth part of phi */
    struct kd_exact rate[KD_PATH_RATES];
    struct kd_exact mino;
    int half_turns;
    double turn_h; /* step h for which the springs' rotations were computed */
};

/* Begins a path. start: result of kd_orbit_start or kd_orbit_from_state. */
void kd_orbit_path_init(struct kd_orbit_path *path, const struct kd_orbit *orbit, const struct kd_orbit_state *start,
                        enum kd_orbit_method method);
void kd_orbit_path_step(struct kd_orbit_path *path, double h);
struct kd_orbit_place kd_orbit_path_place(const struct kd_orbit_path *path);

/* Errors of the first integrals at the present place. energy, mass: relative errors of E and of the rest mass; mass is
 * NAN within a hundredth of r+ from the horizon and a tenth from the axis, where it is 0/0. carter: residual of the
 * polar equation over L^2 + Q. binet, NAN unless a = 0: error of Binet's
 * C = (dw/dpsi)^2 + w^2 - 2w/l^2 - 2w^3 + q^2 w^2 (1/l^2 + w^2) = (E^2 - 1)/l^2, times l^2. Here l^2 = L^2 + Q, and
 * psi is the angle in the plane of the orbit. */
struct kd_orbit_drift { double energy, carter, mass, binet; };
struct kd_orbit_drift kd_orbit_path_drift(const struct kd_orbit_path *path);

/* The path moved to the place where its radial velocity vanishes. This place must be within a step of h. */
struct kd_orbit_path kd_orbit_path_to_apsis(const struct kd_orbit_path *path, double h);
/* kd_orbit_path_to_radius: the path moved to the radius 1/w, at the first passage or, after a turning point, at the
 * second. kd_orbit_path_to_time: the path moved to the time t. The radius or time must be reached within the step. */
struct kd_orbit_path kd_orbit_path_to_radius(const struct kd_orbit_path *path, double h, double w);
struct kd_orbit_path kd_orbit_path_to_time(const struct kd_orbit_path *path, double h, double t);

/* Only for files of this folder: Yoshida's weights w3, w2, w1, w0, and the function that computes a spring's rotations
 * in the drifts of a step h. */
extern const double kd_orbit_kicks[4];
void kd_orbit_set_turns(struct kd_spring *spring, double h);

#endif
