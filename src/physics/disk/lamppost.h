/* Illumination of a thin disk by a point source on the axis of a Kerr hole (lamppost). Double precision; pure except
 * for the table, any thread. G = c = M = 1.
 *
 * The source rests on the axis at r = h and shines isotropically, with a photon power law N(E) ~ E^-Gamma. Light
 * that leaves it at an angle delta from the direction to the hole meets the disk at r(delta), which is found in
 * closed form (null_geodesic.h: such a ray has no angular momentum, and K = sin^2 delta (h^2 + a^2)^2/Delta(h)).
 * For one photon per time and energy of the source, the gas receives, per comoving area, per time and per energy in its
 * own frame,
 *
 *   epsilon(r) = |d cos delta/dr| g^Gamma/(4 pi r u^t)        g = u^t sqrt(Delta(h)/(h^2 + a^2))
 *
 * photons, because r dr dphi dt is the comoving area times proper time of the disk. Dauser, Garcia, Wilms et al. 2013,
 * MNRAS 430, 1694, eqs 9 to 18; Martocchia & Matt 1996, MNRAS 282, L53. Far away, and for a = 0, epsilon is h/(4 pi
 * (r^2 + h^2)^(3/2)). */
#ifndef KD_PHYSICS_DISK_LAMPPOST_H
#define KD_PHYSICS_DISK_LAMPPOST_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_LAMPPOST_RINGS = 120 };

struct kd_lamppost {
    double first, step; /* nodes in ln r */
    double log_epsilon[KD_LAMPPOST_RINGS];
};

/* height: beyond the horizon. The table covers the radii from inner, which is the ISCO or larger, to outer. Returns
 * false if light does not reach a ring, which has not been observed. */
bool kd_lamppost_init(struct kd_lamppost *lamp, const struct kd_hole *hole, double height, double photon_index,
                      double inner, double outer);

double kd_lamppost_at(const struct kd_lamppost *lamp, double r);

/* Radius at which light that leaves the source at delta meets the plane; 0: captured by the hole; INFINITY: it
 * escapes. */
double kd_lamppost_reach(const struct kd_hole *hole, double height, double delta);

#endif
