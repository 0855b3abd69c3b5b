/* Tidal disruption of a star by a black hole. Double precision, pure functions, any thread. G = c = 1; all masses,
 * lengths and times in one unit, which may be the hole's M or a metre.
 *
 * Newtonian estimates for a parabolic orbit, which agree with simulations within a factor of two. The hole's spin
 * enters through the capture orbit only.
 *
 * Sources: J. G. Hills 1975, Nature 254, 295; M. J. Rees 1988, Nature 333, 523; E. S. Phinney 1989, IAU Symp. 136, 543;
 * N. Stone, R. Sari & A. Loeb 2013, MNRAS 435, 1809 [S]; M. Kesden 2012, Phys. Rev. D 85, 024037 (capture). Results are
 * NaN for arguments <= 0. */
#ifndef KD_PHYSICS_WAVES_TIDAL_H
#define KD_PHYSICS_WAVES_TIDAL_H

#include "physics/spacetime/hole.h"

struct kd_tidal { double hole, mass, radius; /* hole: mass of the hole. mass, radius: mass and radius of the star */ };

/* Tidal radius r_t = R (M/m)^(1/3) [Hills 1975; Rees 1988]. Inside it the hole's tide exceeds the star's gravity. */
double kd_tidal_radius(struct kd_tidal t);

/* beta = r_t/r_p for a pericentre r_p. If it is above 1, the star is disrupted. */
double kd_tidal_penetration(struct kd_tidal t, double pericentre);

/* Half width of the debris' range of specific orbital energies, M R/r_t^2. The width is determined where the star
 * passes r_t, and does not depend on the pericentre [S]. Rees used r_p instead of r_t, which gives beta^2 times more.
 * */
double kd_tidal_energy_spread(struct kd_tidal t);

/* Time after which the first debris returns: the Kepler period at the binding energy kd_tidal_energy_spread, 2 pi M/(2
 * energy)^(3/2) [S]. It is 41 days for the sun and a hole of 1e6 solar masses. */
double kd_tidal_fallback_time(struct kd_tidal t);

/* Rate at which mass returns at a time t after the disruption, for debris spread evenly in energy [Phinney 1989]: m/(3
 * t_fb) (t/t_fb)^(-5/3), and 0 before t_fb. Its integral is half the star's mass. Its peak is at t_fb. */
double kd_tidal_fallback_rate(struct kd_tidal t, double time);

/* Mass of the heaviest hole of spin a, |a| < 1, that disrupts the star instead of capturing it whole; t.hole is
 * ignored. The hole captures a star on a parabolic orbit within the marginally bound orbit, so the limit is r_t =
 * r_mb(a) [Kesden 2012], which is 4M at a = 0. If a < 0, the orbit is against the hole's spin. */
double kd_tidal_capture_mass(struct kd_tidal t, const struct kd_hole *hole);
/* Hills's mass: the same mass with the horizon in place of the capture orbit, r_t = r+(a). It is 1.1e8 solar masses for
 * the sun at a = 0. */
double kd_tidal_hills_mass(struct kd_tidal t, const struct kd_hole *hole);

#endif
