/* Local frames of observers in Kerr, for light. Double precision, pure functions, any thread. Units G = c = M = 1.
 *
 * A photon of local energy 1 that flies along the unit vector m = (m_r, m_theta, m_phi) of the frame has
 *
 *   E = e0 + e1 m_phi      L/sin(theta) = l0 + l1 m_phi      p_theta = p m_theta      |p_r| Delta = p sqrt(Delta) |m_r|
 *
 * Source: Bardeen, Press & Teukolsky 1972, ApJ 178, 347, sections II and III. */
#ifndef KD_PHYSICS_TETRAD_H
#define KD_PHYSICS_TETRAD_H

struct kd_tetrad {
    double e0, e1, l0, l1, p;
    double root_delta; /* sqrt(r^2 - 2r + a^2) */
};

/* The frame of an observer of zero angular momentum; r > r+. u = cos(theta), s = sin(theta). */
struct kd_tetrad kd_tetrad_zamo(double a, double r, double u, double s);

/* The frame of an observer at rest with respect to infinity; outside the ergosphere, else NaN. */
struct kd_tetrad kd_tetrad_static(double a, double r, double u, double s);

/* Where the photon with the labels alpha, beta of null_geodesic.h is seen that arrives moving outwards: a unit vector, right along
 * +phi, up along -theta, inwards along -r; what flies along m is seen along -m. energy: at infinity, over the one measured. */
struct kd_look { double right, up, inwards, energy; };
struct kd_look kd_tetrad_look(const struct kd_tetrad *frame, double alpha, double beta);

#endif
