/* Oracle for null geodesics: the Hamiltonian in ingoing Kerr-Schild coordinates, integrated in double precision by
 * Gragg-Bulirsch-Stoer extrapolation to about 1e-12 a step. It shares no equation with the code under test: no Mino
 * time, no separation of variables, no elliptic function, no Boyer-Lindquist motion.
 *
 * A ray traced back from an observer is a photon of the mirrored spacetime (t, phi) -> (-t, -phi), which is the same
 * Kerr spacetime. It flies away from the observer with the same E and L, and may fall through the future horizon, where
 * these coordinates are regular. The returned Boyer-Lindquist azimuths, source minus observer, are mirrored back. */
#ifndef KD_TESTS_KERR_SCHILD_H
#define KD_TESTS_KERR_SCHILD_H

#include "kerr_schild_frame.h"

#include <stdbool.h>

struct ks_photon {  /* A photon as it arrives at the observer, by its covariant Boyer-Lindquist components. */
    double a, r, u; /* spin; radius and cos(theta) of the observer */
    double energy, momentum, p_r, p_theta;
    double phi, delay; /* azimuth and delay of the path before a start that stands for infinity */
    double q;          /* charge of the hole */
};

enum ks_fate { KS_CAPTURED, KS_ESCAPED, KS_UNDECIDED };

struct ks_path {
    int crossings;
    double r[16], phi[16], delay[16]; /* at each crossing of the equatorial plane after the start */
    double momentum[16];              /* angular momentum about the axis at each crossing, as integrated */
    bool falls[16];                   /* true if the light moves inwards there; the path, traced back, goes outwards */
    /* |p_z| there, the component along a unit normal of the plane: at z = 0, where l_z = 0, the metric's zz component
     * is 1. */
    double p_z[16];
    enum ks_fate fate;
    double u, sky_phi; /* direction of escape */
};

/* The photon that reaches (alpha, beta) of an observer at infinity with cos(theta) = u, started at r = 1e6. */
struct ks_photon ks_from_infinity(double a, double u, double alpha, double beta);

struct ks_photon ks_from_infinity_charged(double a, double q, double u, double alpha, double beta);

/* The photon that reaches an observer at (r, theta), at rest (zamo: with zero angular momentum), from the direction
 * k = (k_r, k_theta, k_phi) of its local frame, with energy 1 there. The tetrad is orthonormalised numerically. */
struct ks_photon ks_from_camera(double a, double r, double theta, bool zamo, const double k[3]);
struct ks_photon ks_from_camera_charged(double a, double q, double r, double theta, bool zamo, const double k[3]);

struct ks_path ks_trace(struct ks_photon photon, int max_crossings);

/* The same in long double, with an error of about 1e-16 a step where long double has a 64-bit mantissa. It takes some
 * five times as long. */
struct ks_path ks_trace_long(struct ks_photon photon, int max_crossings);

/* Medium along a ray: light emitted and optical depth per unit of the affine parameter. `photon` is the arriving photon
 * at that place. r, u, p_r and p_theta are its values at the place, phi is the azimuth of the place minus the
 * observer's, and delay is the Boyer-Lindquist time of the light from the place. */
typedef void ks_medium(void *user, const struct ks_photon *photon, double r, double u, double light_and_depth[2]);

/* Light emitted and absorbed along the path back in time, between two radii, until it ends or first crosses the
 * equatorial plane. The Hamiltonian's own parameter is affine; each step is divided into 16 parts, Simpson's rule is
 * used in each, and the ends at the two radii are exact. */
struct ks_light { double light, depth, length; }; /* length in the affine parameter */
struct ks_light ks_along(struct ks_photon photon, double inner, double outer, bool to_plane, ks_medium *medium,
                         void *user);

/* Closest approaches of the path back in time to a place (r, cos(theta), azimuth: source minus observer). One is
 * reported each time that the path comes within `within` of the place, measured in these Cartesian coordinates. b:
 * distance of the approach, in M. It is the interval, by the metric at the place, between the ray's event and the event
 * at the place on the same wave front. It does not depend on the observer. delay: defined as for a crossing. */
struct ks_near { double b, delay; };
int ks_passes(struct ks_photon photon, double r, double u, double phi, double within, int most, struct ks_near *out);

/* Delays of light from places (r, cos(theta)) near the path back in time. For each place: the delay of the path's
 * closest point in these two coordinates, and its distance, M. */
#define KS_MOST_PLACES 512
void ks_delays(struct ks_photon photon, const double (*places)[2], int n, double *delay, double *off);

/* The path back in time of the photon p, a covector of ingoing Kerr-Schild coordinates (kerr_schild_frame.h), from a
 * place that may lie within the horizon. Light from outside came to that place through the outer horizon, where these
 * coordinates are regular. Azimuths are Boyer-Lindquist's of the source, minus the place's own in these coordinates;
 * both agree at infinity. A ray from the past horizon counts as captured. Crossings within the horizon count; their phi
 * is meaningless. No delays are computed. */
struct ks_path ks_follow(const struct ks_place *at, const double p[4], int max_crossings);

/* A neutral body of unit mass at (r, cos(theta)), of energy E, angular momentum L and the covariant Boyer-Lindquist
 * components p_r and p_theta, after a proper time in which it does not reach the horizon. t and phi: Boyer-Lindquist,
 * since the start; phi up to full turns. */
struct ks_body { double a, q, r, u, energy, momentum, p_r, p_theta; };
struct ks_body_place { double r, u, t, phi; };
struct ks_body_place ks_body_after(const struct ks_body *body, double proper);

#endif
