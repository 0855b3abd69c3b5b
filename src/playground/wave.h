/* Gravitational-wave losses of two bodies in orbit, with Peters' averages over an orbit. Pure functions, any thread;
 * G = c = 1.
 *
 * Let m = m1 + m2, eta = m1 m2/m^2, x = r n the relative position and v the relative velocity. The relative
 * acceleration at 2.5 post-Newtonian order is a = (8/5) eta (m^2/r^3) [r' n (3 v^2 + 17 m/(3 r)) - v (v^2 + 3 m/r)] (T.
 * Damour & N. Deruelle 1981, Phys. Lett. A 87, 81; L. Blanchet 2014, Living Rev. Relativ. 17, 2, eq. 203). On a Kepler
 * orbit its averages are those of P. C. Peters 1964, Phys. Rev. 136, B1224. */
#ifndef KD_PLAYGROUND_WAVE_H
#define KD_PLAYGROUND_WAVE_H

#include <stdbool.h>
#include <stddef.h>

#define KD_WAVE_PAIRS_MAX \
    256 /* largest number of bodies that are searched for pairs; if there are more, each radiates with the hole alone \
         */

struct kd_playground_body;

/* Sets *a to the relative acceleration times `amplification`, limited to a tenth of m/r^2. Returns true if the limit
 * was applied. */
bool kd_wave_reaction(double m1, double m2, const double x[3], const double v[3], double amplification, double a[3]);

/* The same acceleration for a body of mass m at x that orbits the fixed hole. In the hole's potential (hole.h) a
 * circular orbit has v^2 = r/(r - 2)^2 instead of 1/r. Therefore speeds and the force are scaled by (r - 2)/r. A
 * circular orbit then radiates the power that Peters gives for radius r and masses 1 and m. Such an orbit shrinks
 * faster than Peters' orbit by the factor (r - 2)^3/(r^2 (r - 6)), which is 1.3 at r = 10. The reason is that its
 * energy, (4 - r)/(2 (r - 2)^2), depends less on r than -1/(2 r) does. */
bool kd_wave_reaction_hole(double m, const double x[3], const double v[3], double amplification, double a[3]);

/* Finds, for each of n bodies, the index of its partner: the body that attracts it most. The index is n if a third body
 * attracts the partner more, or if the two are not bound to each other. */
void kd_wave_partners(const struct kd_playground_body *bodies, size_t n, double softening, size_t *partners);

#endif
