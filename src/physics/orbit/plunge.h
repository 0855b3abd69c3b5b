/* Plunge of neutral matter from the ISCO of Kerr, with or without charge: the equatorial geodesic with the energy and
 * angular momentum of the innermost stable circular orbit. The matter leaves that orbit infinitely slowly and falls
 * into the horizon. Its radial potential has a triple root, so that proper time, azimuth and coordinate time are
 * elementary functions of r. Double precision, pure, any thread. G = c = M = 1; spin signed as in
 * physics/spacetime/kerr.h.
 *
 * Sources: A. Mummery & S. Balbus 2022, Phys. Rev. Lett. 129, 161101, arXiv:2209.03579 (u^r and phi); C. Dyson & M. van
 * de Meent 2023, arXiv:2302.03704 (t too); with charge see plunge.c. From a thirtieth to 0.999 of the way from the ISCO
 * to the horizon, the relative error is below 4e-13 for sqrt(1 - a^2 - q^2) > 0.06, and below 1e-11 for sqrt(1 - a^2 -
 * q^2) = 0.014. */
#ifndef KD_PHYSICS_ORBIT_PLUNGE_H
#define KD_PHYSICS_ORBIT_PLUNGE_H

#include "physics/spacetime/hole.h"

struct kd_plunge {
    struct kd_hole hole;
    double isco;
    double energy, momentum; /* E and L of the orbit at the ISCO */
    /* (u^r)^2 = 2/(3 isco) gap^3 (stretch - bend gap) with gap = isco/r - 1. Without charge stretch is 1 and bend is
     * 0. */
    double stretch, bend;
    double shift; /* bend/stretch */
    /* Partial fractions of t and phi in z = sqrt(r/(isco - r) - shift), for the outer and for the inner horizon. pole:
     * position of the pole. t, phi: coefficients of artanh(pole/z)/pole in t and phi, without the factor isco/(isco -
     * r_horizon). */
    struct kd_plunge_pole { double pole, t, phi; } outer, inner;
    double t_rate, phi_rate; /* dt/dz and dphi/dz in the limit z -> infinity */
};
struct kd_plunge kd_plunge_of(const struct kd_hole *hole);

/* Coordinate time and azimuth at horizon < r < isco, up to arbitrary constants. Both go to -infinity at the ISCO, where
 * the body moves with the Omega of the orbit. t diverges at the horizon, and so does phi unless a = 0. */
struct kd_plunge_event { double t, phi; };
struct kd_plunge_event kd_plunge_at(const struct kd_plunge *plunge, double r);

/* Derivatives of r, t and phi by proper time. ut and uphi diverge at the horizon. */
struct kd_plunge_velocity { double ur, ut, uphi; };
struct kd_plunge_velocity kd_plunge_velocity(const struct kd_plunge *plunge, double r);

#endif
