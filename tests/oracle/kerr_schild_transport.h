/* An oracle for the direction of polarisation: vectors carried parallel to themselves along a ray, in Cartesian
 * ingoing Kerr-Schild coordinates g = eta + f l l, whose derivatives are differences of the metric. No constant of
 * motion, no separation, no tetrad in closed form; the direction at the source by projections alone. Runge and
 * Kutta's method in double precision, about 1e-7. */
#ifndef KD_TESTS_KERR_SCHILD_TRANSPORT_H
#define KD_TESTS_KERR_SCHILD_TRANSPORT_H

#include "kerr_schild_frame.h"

#include <stdbool.h>

/* A ray at the observer: place (t, x, y, z), wave vector of the arriving light, and the unit vectors to the right
 * and up across it. */
struct ks_screen { double a, x[4], k[4], right[4], up[4]; };

/* Those of the ray (alpha, beta) of an observer at infinity, at r = 1e6. */
struct ks_screen ks_screen_far(double a, double theta, double alpha, double beta);
/* Those of the direction look, of a camera whose upwards is up, both (r, theta, phi) in a frame there. */
struct ks_screen ks_screen_near(const struct ks_place *at, const struct ks_frame *frame, const double look[3],
                                const double up[3]);

enum ks_field { KS_TOROIDAL, KS_RADIAL, KS_VERTICAL };

/* The light's ray crossed the plane at this radius; angle: of its electric field there, across the field in the
 * frame of the gas that goes round on a circle, or falls from the ISCO at r_isco, seen from the observer: from `up`,
 * towards the left, in (-pi/2, pi/2]; cosine: |cos| of the angle of the light to the normal, in that frame; g:
 * frequency there over that at the observer, inverted. */
struct ks_polarized {
    bool there, falls;
    double r, angle, cosine, g;
};

/* At the crossing of the order `order`, going back in time. */
struct ks_polarized ks_polarization(const struct ks_screen *screen, int order, enum ks_field field, double r_isco);

/* A place of a ray that goes back in time from the screen, by the Cartesian coordinates; k: of the light, affine, by
 * the energy that the screen measures; right and up as carried there. step: of the affine parameter to the next one
 * that is told, 0 at the last. */
struct ks_carried { double a, r, x[4], k[4], right[4], up[4], g[4][4], step; };
typedef void ks_told(void *user, const struct ks_carried *at);

/* Tells the places of the ray from where it comes within outer to where it leaves the shell inner < r < outer; pairs
 * of steps are of one length. fine: steps as parts of r. */
void ks_carry(const struct ks_screen *screen, double inner, double outer, double fine, ks_told *told, void *user);
/* Gives a vector of Boyer and Lindquist's coordinates (t, r, theta, phi), whose components do not depend on phi, at
 * that place. */
void ks_carried_vector(const struct ks_carried *at, const double v[4], double out[4]);
double ks_carried_product(const struct ks_carried *at, const double p[4], const double q[4]);

#endif
