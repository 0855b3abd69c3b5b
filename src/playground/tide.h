/* Tidal mass loss of a star that comes close to the hole. Pure functions, any thread; units G = c = M = 1.
 *
 * The tide equals the star's own gravity at r_t = R (1/m)^(1/3). The mass lost in a pass with pericentre r_p depends on
 * the depth r_t/r_p of the pass. Nothing is lost at a depth of 0.5, and everything at 0.9, as in hydrodynamic
 * simulations of a polytrope of index 5/3 (J. Guillochon & E. Ramirez-Ruiz 2013, ApJ 767, 25, fit C_5/3 of appendix A).
 * When an approaching star is at r, it has lost the mass that a complete pass with pericentre r loses. So the star
 * sheds gradually, and the total agrees with the fit. The energies of the debris are spread evenly within R/r_t^2 of
 * the star's own, whatever the depth (N. Stone, R. Sari & A. Loeb 2013, MNRAS 435, 1809). */
#ifndef KD_PLAYGROUND_TIDE_H
#define KD_PLAYGROUND_TIDE_H

#define KD_TIDE_BEGINS 0.5
#define KD_TIDE_WHOLE 0.9
#define KD_TIDE_OVER 0.4 /* a tidal pass ends when r_t/r falls below this */

double kd_tide_radius(double mass, double radius);
double kd_tide_spread(double mass, double radius);
/* Fraction of the mass, 0 to 1, that is lost at a depth. */
double kd_tide_share(double depth);

#endif
