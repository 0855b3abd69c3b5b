/* Observers and bodies in Kerr measure in these orthonormal frames. Double precision, pure functions, any thread.
 * Units G = c = M = 1; Boyer-Lindquist coordinates.
 *
 * A frame is four covectors: the legs e_t (minus this is what a clock at rest in the frame reads along a motion),
 * e_r, e_theta, e_phi with their indices lowered. What has the local components x = (x_t, x_r, x_theta, x_phi) is
 * the covector sum of x_i e_i: for a photon of local energy 1 that flies along the unit vector m, x = (1, m), for a
 * body of velocity v, x = gamma (1, v).
 *
 * Each covector p is held by its covariant components in the form that kernels start from and that stays finite on
 * the axis and at a horizon: E = -p_t, L/sin(theta) = p_phi/sin(theta), p_theta, and Delta p_r = Sigma p^r, the
 * velocity dr/dlambda in Mino time. */
#ifndef KD_PHYSICS_SPACETIME_TETRAD_H
#define KD_PHYSICS_SPACETIME_TETRAD_H

#include <stdbool.h>

struct kd_covector { double energy, momentum, polar, radial; /* E, L/sin(theta), p_theta, Delta p_r */ };

/* Where a frame is: spin, |spin| < 1; radius; cosine and sine of the polar angle, one of which may be 0. */
struct kd_vantage { double spin, r, u, s; };

/* falls: the frame is regular at a horizon; past_rain: gamma and gamma v by e_r, e_theta, e_phi of its velocity past
 * rain (observer.c). */
struct kd_tetrad {
    struct kd_vantage at;
    struct kd_covector t, r, theta, phi;
    bool falls;
    double past_rain[4];
};

/* The covector of the components x, and the components of a covector; the latter not at a horizon itself, where E, L
 * and Delta p_r say one thing less (NaN or infinity). */
struct kd_covector kd_tetrad_covector(const struct kd_tetrad *frame, const double x[4]);
void kd_tetrad_components(const struct kd_tetrad *frame, const struct kd_covector *p, double x[4]);

/* The frame of one who has the velocity of a body in this one: its components x[0] = gamma, x[i] = gamma v_i. Its
 * legs are those of this frame by a boost that turns nothing: e'_t = x, e'_i = e_i + x_i e_t + x_i x_j e_j/(1 +
 * gamma). */
struct kd_tetrad kd_tetrad_boosted(const struct kd_tetrad *frame, const double x[4]);

/* Whether left and right, in and out are alike above and below: only e_theta has a p_theta, and it has nothing else. */
int kd_tetrad_is_level(const struct kd_tetrad *frame);

/* Where a photon is seen that arrives: a unit vector, right along +phi, up along -theta, inwards along -r; what
 * flies along m is seen along -m. energy: its E over what is measured in the frame. */
struct kd_look { double right, up, inwards, energy; };
struct kd_look kd_tetrad_look(const struct kd_tetrad *frame, const struct kd_covector *photon);

/* The same of light that goes inwards (radial <= 0), in a frame that falls, at a horizon too; polar2: the square of
 * p_theta, which may be below 0 where it is continued beyond what is seen, and `up` is then that of the photon's own
 * p_theta. kd_tetrad_look does so by itself. */
struct kd_look kd_tetrad_look_inwards(const struct kd_tetrad *frame, const struct kd_covector *photon, double polar2);

/* The same from the components x = (1, m) of a photon in the frame of rain: for a frame that falls, regular at a
 * horizon whichever way light goes. */
struct kd_look kd_tetrad_look_past_rain(const struct kd_tetrad *frame, double energy, const double x[4]);

/* The photon with the labels alpha, beta of null_geodesic.h, E = 1, that passes `at` outwards; radial is 0 where
 * there is none. */
struct kd_covector kd_tetrad_outgoing(const struct kd_vantage *at, double alpha, double beta);

#endif
