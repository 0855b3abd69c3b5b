/* A star that comes close to the hole loses mass to its tide. Pure functions, any thread; units G = c = M = 1.
 *
 * The tide is as strong as the star's own gravity at r_t = R (1/m)^(1/3). What a pass with pericentre r_p has taken
 * depends on its depth r_t/r_p as hydrodynamics says for a polytrope of index 5/3: nothing at 0.5, all at 0.9 (J.
 * Guillochon & E. Ramirez-Ruiz 2013, ApJ 767, 25, fit C_5/3 of appendix A). A star that sinks has lost, at r, what a
 * pass that went no deeper takes in all: it sheds before it is torn apart, and in the end as much as the fit says.
 * The energies of what it sheds lie evenly within R/r_t^2 of its own, whatever the depth (N. Stone, R. Sari & A.
 * Loeb 2013, MNRAS 435, 1809). */
#ifndef KD_PLAYGROUND_TIDE_H
#define KD_PLAYGROUND_TIDE_H

#define KD_TIDE_BEGINS 0.5
#define KD_TIDE_WHOLE 0.9
#define KD_TIDE_OVER 0.4 /* a pass ends where the star is so far out again */

double kd_tide_radius(double mass, double radius);
double kd_tide_spread(double mass, double radius);
/* The share of the mass that is gone at this depth, 0 to 1. */
double kd_tide_share(double depth);

#endif
