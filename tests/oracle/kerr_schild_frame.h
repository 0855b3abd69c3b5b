/* Observers' frames in ingoing Kerr-Schild coordinates (t, r, theta, phi), which are regular at the outer horizon:
 *   ds^2 = -dt^2 + dr^2 + Sigma dtheta^2 + (r^2 + a^2) sin^2 dphi^2 - 2a sin^2 dr dphi + (2r/Sigma) (dt + dr - a
 *     sin^2 dphi)^2.
 * All numbers are computed by contraction with the inverse of that metric. This code shares no formula with
 * src/physics: no tetrad in closed form, no Boyer-Lindquist coordinates, no component formula of a boost. Double
 * precision. */
#ifndef KD_TESTS_KERR_SCHILD_FRAME_H
#define KD_TESTS_KERR_SCHILD_FRAME_H

struct ks_place { double a, r, theta, q; /* q: charge */ };

/* Four covectors, the legs along t, r, theta, phi, with components p_t, p_r, p_theta, p_phi. */
struct ks_frame { double e[4][4]; };

double ks_product(const struct ks_place *at, const double p[4], const double q[4]);

/* The covector with this E, L and p_theta that moves inwards, like a body that falls through the horizon. mass: 1 for a
 * body, 0 for light. */
void ks_inwards(const struct ks_place *at, double mass, double energy, double momentum, double p_theta, double p[4]);

/* Frames of zero angular momentum, which exist outside the horizon, and of rain (a fall from rest at infinity), which
 * exist anywhere. */
struct ks_frame ks_zamo(const struct ks_place *at);
struct ks_frame ks_rain(const struct ks_place *at);

/* The frame with four-velocity u (a covector) whose legs are those of `from`, boosted from its velocity to u. */
struct ks_frame ks_boost(const struct ks_place *at, const struct ks_frame *from, const double u[4]);

/* The photon seen, with energy 1, in the viewing direction k = (k_r, k_theta, k_phi) of the frame. */
void ks_seen(const struct ks_frame *f, const double k[3], double p[4]);

/* E, L, p_theta and Sigma dr/dlambda of a covector. */
void ks_constants(const struct ks_place *at, const double p[4], double out[4]);

#endif
