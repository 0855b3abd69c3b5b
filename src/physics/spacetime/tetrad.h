/* Orthonormal frames in which observers and neutral bodies measure about a hole. Double precision, pure functions, any
 * thread. Units G = c = M = 1; Boyer-Lindquist coordinates.
 *
 * A frame is four covectors: the legs e_t, e_r, e_theta, e_phi with their indices lowered. Minus e_t, applied to a
 * displacement, is the time of a clock at rest in the frame. The vector with local components x = (x_t, x_r, x_theta,
 * x_phi) has the covector sum of x_i e_i. For a photon of local energy 1 along the unit vector m, x is (1, m). For a
 * body of velocity v, x is gamma (1, v).
 *
 * A covector p is stored as the four numbers with which kernels start. All four are finite on the axis and at a
 * horizon: E = -p_t, L/sin(theta) = p_phi/sin(theta), p_theta, and Delta p_r = Sigma p^r, the velocity dr/dlambda in
 * Mino time. */
#ifndef KD_PHYSICS_SPACETIME_TETRAD_H
#define KD_PHYSICS_SPACETIME_TETRAD_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

struct kd_covector { double energy, momentum, polar, radial; /* E, L/sin(theta), p_theta, and Delta p_r */ };

/* Position of a frame: the hole; radius; cosine and sine of the polar angle, one of which may be 0. */
struct kd_vantage {
    struct kd_hole hole;
    double r, u, s;
};

/* A frame. falls: true if the frame is regular at a horizon. past_rain: velocity of the frame relative to rain
 * (observer.c), as gamma, and gamma v along e_r, e_theta, e_phi. */
struct kd_tetrad {
    struct kd_vantage at;
    struct kd_covector t, r, theta, phi;
    bool falls;
    double past_rain[4];
};

/* kd_tetrad_covector: the covector with the local components x. kd_tetrad_components: the local components of a
 * covector. At a horizon, where E, L and Delta p_r are not independent, kd_tetrad_components gives NaN or infinity. */
struct kd_covector kd_tetrad_covector(const struct kd_tetrad *frame, const double x[4]);
void kd_tetrad_components(const struct kd_tetrad *frame, const struct kd_covector *p, double x[4]);

/* The frame of an observer that moves relative to the given frame. x: the observer's velocity in the given frame, x[0]
 * = gamma, x[i] = gamma v_i. Its legs are those of this frame, boosted without rotation: e'_t = x, e'_i = e_i + x_i e_t
 * + x_i x_j e_j/(1 + gamma). */
struct kd_tetrad kd_tetrad_boosted(const struct kd_tetrad *frame, const double x[4]);

/* True if the frame is symmetric under reflection at the equatorial plane: e_theta has only a p_theta, and no other leg
 * has one. */
int kd_tetrad_is_level(const struct kd_tetrad *frame);

/* Direction in which an arriving photon is seen, as a unit vector. right: along +phi. up: along -theta. inwards: along
 * -r. A photon that flies along m is seen in the direction -m. energy: ratio of the photon's E to its energy measured
 * in the frame. */
struct kd_look { double right, up, inwards, energy; };
struct kd_look kd_tetrad_look(const struct kd_tetrad *frame, const struct kd_covector *photon);

/* kd_tetrad_look for a frame that falls and for light that moves inwards (radial <= 0). This function is also valid at
 * a horizon. polar2: the square of p_theta, which may be negative where it is continued beyond the visible directions;
 * `up` is computed from the photon's own p_theta. kd_tetrad_look calls this function where it is needed. */
struct kd_look kd_tetrad_look_inwards(const struct kd_tetrad *frame, const struct kd_covector *photon, double polar2);

/* kd_tetrad_look for a frame that falls, from the components x = (1, m) of a photon in the rain frame. It is regular at
 * a horizon for light in any direction. */
struct kd_look kd_tetrad_look_past_rain(const struct kd_tetrad *frame, double energy, const double x[4]);

/* The photon with E = 1 and the labels alpha, beta of null_geodesic.h that passes the place `at` outwards. If there is
 * no such photon, the member radial is 0. */
struct kd_covector kd_tetrad_outgoing(const struct kd_vantage *at, double alpha, double beta);

#endif
