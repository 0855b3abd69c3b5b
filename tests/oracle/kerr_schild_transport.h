/* Oracle for the direction of polarisation: vectors transported parallelly along a ray, in Cartesian ingoing
 * Kerr-Schild coordinates g = eta + f l l, with derivatives from differences of the metric. It uses no constant of
 * motion, no separation and no tetrad in closed form; the direction at the source comes from projections only.
 * Runge-Kutta in double precision, accurate to about 1e-7. */
#ifndef KD_TESTS_KERR_SCHILD_TRANSPORT_H
#define KD_TESTS_KERR_SCHILD_TRANSPORT_H

#include "kerr_schild_frame.h"

#include <stdbool.h>

/* A ray at the observer: place (t, x, y, z), wave vector of the arriving light, and unit vectors to the right and
 * up, perpendicular to it. */
struct ks_screen { double a, q, x[4], k[4], right[4], up[4]; };

/* The screen of the ray (alpha, beta) for an observer at infinity, placed at r = 1e6. */
struct ks_screen ks_screen_far(double a, double q, double theta, double alpha, double beta);
/* The hole is uncharged. The screen for the direction `look` of a camera whose upward direction is `up`, both (r,
 * theta, phi) in a local frame. */
struct ks_screen ks_screen_near(const struct ks_place *at, const struct ks_frame *frame, const double look[3],
                                const double up[3]);

enum ks_field { KS_TOROIDAL, KS_RADIAL, KS_VERTICAL };

/* The crossing of the plane by a ray. The gas there moves on a circle or, within r_isco, falls from the ISCO. angle:
 * direction of the electric field that is perpendicular to the magnetic field in the gas's frame, as the observer sees
 * it: from `up` towards the left, in (-pi/2, pi/2]. cosine: |cos| of the angle between the light and the normal in that
 * frame. g: frequency in that frame over the frequency at the observer. */
struct ks_polarized {
    bool there, falls;
    double r, angle, cosine, g;
};

/* The crossing of this order, counted back in time. */
struct ks_polarized ks_polarization(const struct ks_screen *screen, int order, enum ks_field field, double r_isco);

/* A place on a ray that is followed back in time from the screen, in Cartesian coordinates. k: wave vector of the
 * light, affine, divided by the energy that the screen measures. right and up: the screen's vectors transported to the
 * place. step: of the affine parameter to the next reported place, 0 at the last. */
struct ks_carried { double a, q, r, x[4], k[4], right[4], up[4], g[4][4], step; };
typedef void ks_told(void *user, const struct ks_carried *at);

/* Reports the places of the ray within the shell inner < r < outer, from where it enters `outer` to where it leaves the
 * shell. The steps of a pair are of equal length. fine: step over r. */
void ks_carry(const struct ks_screen *screen, double inner, double outer, double fine, ks_told *told, void *user);
/* Converts a vector in Boyer-Lindquist coordinates (t, r, theta, phi), whose components do not depend on phi, to
 * Cartesian coordinates at this place. */
void ks_carried_vector(const struct ks_carried *at, const double v[4], double out[4]);
double ks_carried_product(const struct ks_carried *at, const double p[4], const double q[4]);

#endif
