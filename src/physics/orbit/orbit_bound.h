/* Bound timelike geodesics of Kerr, with or without charge, in closed form: place and time at any Mino time, and the
 * fundamental frequencies. Double precision, pure functions, any thread. Units G = c = M = 1.
 *
 * R. Fujita & W. Hikida 2009, arXiv:0906.1420 give r, theta, t and phi by elliptic functions, and the frequencies that
 * S. Drasco & S. A. Hughes 2004, astro-ph/0308479, define. Their integrals of the third kind are written with Carlson's
 * R_J, so that circular and equatorial orbits, and those through the axis, are no special cases. */
#ifndef KD_PHYSICS_ORBIT_ORBIT_BOUND_H
#define KD_PHYSICS_ORBIT_ORBIT_BOUND_H

#include "physics/orbit/timelike.h"

/* Increases of proper time, t and phi over a part of an orbit. */
struct kd_orbit_sums { double proper, t, phi; };

struct kd_orbit_bound {
    struct kd_orbit orbit;
    double r[4]; /* roots of R, with r[0] >= r[1] > r[2] >= r[3]; r[0] and r[1] are the turning points */
    /* r is a function of sn^2(pace_r lambda | k_r), where lambda is Mino time. quarter_r: K(k_r). k1_r: 1 - k_r */
    double pace_r, k_r, k1_r, quarter_r;
    /* equal to pace_r, except for a circle: there unit_r and quarter_r are 1, and half_r holds rates */
    double unit_r;
    double beyond[2]; /* distances r[1] - r+ and r[1] - r- */
    double h, h_plus, h_minus;
    double pace_z, k_z, k1_z, quarter_z; /* u = sqrt(z) sn(pace_z lambda | k_z) */
    /* half_r: increases from periastron to apastron. half_z: increases from the equator to a turning point of theta */
    struct kd_orbit_sums half_r, half_z;
    /* phases at the start. phase_r: pace_r times Mino time since periastron. phase_z: pace_z times Mino time since the
     * ascending node */
    double phase_r, phase_z;
    struct kd_orbit_sums start_r, start_z;
};

/* Makes the closed form. orbit.fate must be BOUND. start: the result of kd_orbit_start, or any other point of the
 * orbit. */
struct kd_orbit_bound kd_orbit_bound_of(const struct kd_orbit *orbit, const struct kd_orbit_state *start);

struct kd_orbit_frequencies {
    /* per Mino time: frequencies Upsilon_r, Upsilon_theta and Upsilon_phi; rates of t (Gamma) and of proper time */
    double mino_r, mino_theta, mino_phi, mino_t, mino_proper;
    double r, theta, phi; /* frequencies per coordinate time */
};
struct kd_orbit_frequencies kd_orbit_frequencies_of(const struct kd_orbit_bound *bound);

/* Advances: azimuths gained beyond a full turn. kd_orbit_periastron_advance: from one periastron to the next, 2 pi
 * (|Upsilon_phi| / Upsilon_r - 1). kd_orbit_nodal_advance: from one ascending node to the next. For a = 0 the advance
 * of the periastron is computed without cancellation, however wide the orbit is. */
double kd_orbit_periastron_advance(const struct kd_orbit_bound *bound);
double kd_orbit_nodal_advance(const struct kd_orbit_bound *bound);

struct kd_orbit_place { double mino, proper, t, r, theta, phi; };
/* The place at Mino time `mino` since the start, where phi, t and proper time are 0. */
struct kd_orbit_place kd_orbit_bound_at(const struct kd_orbit_bound *bound, double mino);

#endif
