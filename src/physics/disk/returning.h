/* Returning radiation: light of a thin disk that falls on the disk again, because the hole bends it. Double precision;
 * pure except for making the table, any thread. G = c = M = 1.
 *
 * A photon keeps E and L at infinity; gas on a circular orbit sees it with the energy e = u^t (E - Omega L). The
 * element r dr dphi dt is a comoving area times proper time, so a ring at r receives from the ring at r_e, per comoving
 * area and proper time,
 *
 *   F_ret(r) = Int g^4 (F(r_e)/pi) f(mu_e) mu dOmega      g = e(r)/e(r_e)
 *
 * over the directions in its rest frame from which light of the disk arrives. f is the law of limb darkening (limb.h).
 * The integral is taken in the frame of zero angular momentum, in polar coordinates (rho, chi) about the direction to
 * the hole: along each chi the radius r_e grows with rho from the edge of the hole's dark disk to infinity. Each ray is
 * followed in closed form (null_geodesic.h); light of E <= 0 in the ergosphere by Taylor series (null_plane.h).
 *
 * The gas absorbs the light that returns, with its angular momentum, and radiates it again. Conservation of energy and
 * angular momentum (C. T. Cunningham 1976, ApJ 208, 534; L.-X. Li et al. 2005, ApJS 157, 335, section 3) gives
 *
 *   F = F_0 + F_ret + F_t      F_t = -Omega'/(r (E - Omega L)^2) Int (l - L F_ret) (E - Omega L) r dr
 *
 * with F_0 of Page & Thorne 1974 (thin_disk.h), the integral from the ISCO to r, E and L of the gas, and l the angular
 * momentum that the light brings per comoving area and proper time: F_t is the work of the stress that carries the
 * difference away. It is solved by iteration: one scattering or reemission more in each step.
 *
 * The disk ends at the ISCO and has no outer edge. Between the ISCO and the hole nothing stops light (E. Agol & J. H.
 * Krolik 2000, ApJ 528, 161, and J. D. Schnittman & J. H. Krolik 2009, ApJ 701, 1175, compute the same fractions). */
#ifndef KD_PHYSICS_DISK_RETURNING_H
#define KD_PHYSICS_DISK_RETURNING_H

#include "physics/disk/limb.h"
#include "physics/spacetime/hole.h"

enum { KD_RETURNING_RINGS = 24 };

/* Shares of a ring's light. The sum of each kind is 1. */
struct kd_returning_shares { double returns, falls_in, escapes; };

/* Where the light of a ring at r >= ISCO goes when it leaves the disk for the first time: shares of the photons, and of
 * their energy at infinity. `error`: how far the sums of the integrals are from 1. Some 4 ms. */
struct kd_returning_ring {
    struct kd_returning_shares photons, energy;
    double error;
};
struct kd_returning_ring kd_returning_ring(const struct kd_hole *hole, enum kd_limb limb, double r);

/* A ray of light that returns to a ring at r, for the upper face. E, L and |p_theta| for the energy 1 in the frame of
 * zero angular momentum at r. */
struct kd_returning_ray {
    double from; /* radius at which it leaves the disk */
    double energy, momentum, polar;
    int order;           /* number of crossings within the ISCO: odd: it leaves the lower face */
    int leaves, arrives; /* signs of p^r */
    double solid;        /* its part of the integral of mu dOmega there */
};

/* The rays of the integral over a ring's sky. Light of E <= 0, which is seen within the ergosphere, is left out. */
void kd_returning_rays(const struct kd_hole *hole, double r,
                       void (*each)(void *user, const struct kd_returning_ray *ray), void *user);

/* The converged disk of one hole. */
struct kd_returning {
    struct kd_hole hole;
    enum kd_limb limb;
    double isco;
    /* Nodes in s = sqrt(r_isco/r), and r^3 (F - F_0) and r^3 F_ret at them. The two fluxes over Mdot, as in
     * thin_disk.h. */
    double s[KD_RETURNING_RINGS], more[KD_RETURNING_RINGS], back[KD_RETURNING_RINGS];
    /* The same of light that returns for the first time: F_ret, and s (L F_ret - l), what its angular momentum lacks.
     */
    double once[KD_RETURNING_RINGS], lacks[KD_RETURNING_RINGS];
    struct kd_returning_list { double returns[KD_RETURNING_RINGS], falls_in[KD_RETURNING_RINGS]; } photons, energy;
    struct kd_returning_shares first;  /* of the luminosity of the disk of Page & Thorne: where its light goes first */
    struct kd_returning_shares lastly; /* of the same luminosity: where it ends at last; `returns` is 0 */
    double hottest, largest;           /* the radius of the largest F, and this F, over Mdot */
    /* r^3 times the flux of light that returns, times the factor g of its photons' energies, as a matrix: over r^(15/4)
     * and over r^3 times the flux that rings emit. */
    double warmth_of[KD_RETURNING_RINGS][KD_RETURNING_RINGS], echo_of[KD_RETURNING_RINGS][KD_RETURNING_RINGS];
    double error; /* relative: of the energy that arrives, against that which returns; or of the
                   * sum of `lastly`, if larger */
    int steps;    /* of the iteration, to 1e-12 */
};

/* Error of the energy balance from which answers are refused: at 1 - |a| of some 1e-9. */
#define KD_RETURNING_WRONG 1e-2

/* Takes 0.1 to 0.3 s on one core; idle cores help. The 8 that were used last are kept and copied. */
void kd_returning_init(struct kd_returning *table, const struct kd_hole *hole, enum kd_limb limb);
/* The member `largest` of that table. The values of the last 256 tables are kept, and take no time. */
double kd_returning_largest(const struct kd_hole *hole, enum kd_limb limb);

/* F at r >= ISCO; and one of the table's lists at r, divided by r^3. */
double kd_returning_flux(const struct kd_returning *table, double r);
double kd_returning_at(const struct kd_returning *table, const double list[KD_RETURNING_RINGS], double r);

/* The shares of kd_returning_ring, from table->photons or table->energy: within 1e-4 of them. */
struct kd_returning_shares kd_returning_shares_at(const struct kd_returning *table,
                                                  const struct kd_returning_list *list, double r);

/* Light of a disk that reflects the share `albedo` of the light that returns, and absorbs the rest. Reflected light
 * leaves with the law of the disk's own light, so it carries away L of the gas, and F is that of a disk that absorbs
 * all: only the spectrum differs. It keeps the spectrum with which it came, which is taken as a dilute black body of
 * the mean temperature of its photons' sources, by flux and as seen by the gas:
 *
 *   T_c(r) F_ret(r) = Int g^5 (F_th T_th + F_r T_c)/pi f(mu_e) mu dOmega      F_th = F - F_r,  F_r = A F_ret
 *
 * Where F_th would be negative (next to the ISCO and for A near 1, where returning light takes away more angular
 * momentum than the gas has to lose), F_th is 0 and F_r is F. */
struct kd_reflection {
    double albedo;
    double warm[KD_RETURNING_RINGS]; /* T_c at the nodes, with F = T^4 over Mdot */
};
void kd_reflection_init(struct kd_reflection *reflection, const struct kd_returning *table, double albedo);

/* F_th, F_r and T_c at r >= ISCO; both fluxes over Mdot. */
struct kd_reflected { double absorbed, flux, warm; };
struct kd_reflected kd_reflection_at(const struct kd_reflection *reflection, const struct kd_returning *table,
                                     double r);

#endif
