/* Returning radiation: the hole bends some light of a thin disk so strongly that it falls on the disk again. Double
 * precision; any thread. The functions are pure, except the one that makes the table. G = c = M = 1.
 *
 * A photon's E and L at infinity are constant. Gas on a circular orbit measures the photon's energy e = u^t (E - Omega
 * L). The element r dr dphi dt is a comoving area times proper time. So a ring at r receives, per comoving area and
 * proper time,
 *
 *   F_ret(r) = Int g^4 (F(r_e)/pi) f(mu_e) mu dOmega      g = e(r)/e(r_e)
 *
 * The integral is over the directions, in the rest frame of the ring's gas, from which light of the disk arrives. r_e
 * is the radius at which this light left the disk. f is the law of limb darkening (limb.h). The integral is taken in
 * the frame of zero angular momentum, in polar coordinates (rho, chi) about the direction to the hole. Along each chi,
 * r_e grows with rho to infinity, from the edge of the dark disk round the hole outwards. Each ray is followed in
 * closed form (null_geodesic.h). Light of E <= 0 in the ergosphere is followed by Taylor series (null_plane.h).
 *
 * The gas absorbs the light that returns, with its angular momentum, and radiates the energy again. Conservation of
 * energy and angular momentum (C. T. Cunningham 1976, ApJ 208, 534; L.-X. Li et al. 2005, ApJS 157, 335, section 3)
 * gives
 *
 *   F = F_0 + F_ret + F_t      F_t = -Omega'/(r (E - Omega L)^2) Int (l - L F_ret) (E - Omega L) r dr
 *
 * F_0 is the flux of Page & Thorne 1974 (thin_disk.h). The integral is from the ISCO to r. E and L are the gas's energy
 * and angular momentum. l is the angular momentum that the light brings per comoving area and proper time. F_t is the
 * flux due to the work of the stress that carries the difference L F_ret - l away. The equation is solved by iteration.
 * Each step adds one more scattering or reemission.
 *
 * The disk ends at the ISCO and has no outer edge. Between the ISCO and the hole nothing stops light. E. Agol & J. H.
 * Krolik 2000, ApJ 528, 161, and J. D. Schnittman & J. H. Krolik 2009, ApJ 701, 1175, compute the same shares. */
#ifndef KD_PHYSICS_DISK_RETURNING_H
#define KD_PHYSICS_DISK_RETURNING_H

#include "physics/disk/limb.h"
#include "physics/spacetime/hole.h"

enum { KD_RETURNING_RINGS = 24 };

/* Shares of light by destination, whose sum is 1. */
struct kd_returning_shares { double returns, falls_in, escapes; };

/* Destinations of the light of a ring at r >= ISCO, when it leaves the disk for the first time. photons: shares of the
 * photons. energy: shares of the photons' energy at infinity. error: largest deviation of the two sums of shares from
 * 1. Takes some 4 ms. */
struct kd_returning_ring {
    struct kd_returning_shares photons, energy;
    double error;
};
struct kd_returning_ring kd_returning_ring(const struct kd_hole *hole, enum kd_limb limb, double r);

/* A ray of light that returns to the upper face of a ring at r. energy, momentum, polar: E, L and |p_theta| of a photon
 * with the energy 1 in the frame of zero angular momentum at r. */
struct kd_returning_ray {
    double from; /* radius at which the light leaves the disk */
    double energy, momentum, polar;
    /* number of crossings of the plane within the ISCO; if it is odd, the ray leaves from the lower face */
    int order;
    int leaves, arrives; /* sign of p^r where the ray leaves the disk; sign of p^r where it arrives */
    double solid;        /* the ray's share of the integral of mu dOmega, in the frame of zero angular momentum */
};

/* Calls each(user, ray) for the rays of the integral over a ring's sky. Rays with E < 1e-3 are left out. Among them are
 * the rays with E <= 0, which are seen within the ergosphere. */
void kd_returning_rays(const struct kd_hole *hole, double r,
                       void (*each)(void *user, const struct kd_returning_ray *ray), void *user);

/* Table of the converged disk of one hole. */
struct kd_returning {
    struct kd_hole hole;
    enum kd_limb limb;
    double isco;
    /* s: nodes in sqrt(r_isco/r). more: r^3 (F - F_0) at the nodes. back: r^3 F_ret at the nodes. Fluxes are divided by
     * Mdot, as in thin_disk.h. */
    double s[KD_RETURNING_RINGS], more[KD_RETURNING_RINGS], back[KD_RETURNING_RINGS];
    /* Light that returns for the first time, at the nodes. once: r^3 F_ret. lacks: r^3 s (L F_ret - l), the deficit of
     * angular momentum. */
    double once[KD_RETURNING_RINGS], lacks[KD_RETURNING_RINGS];
    struct kd_returning_list { double returns[KD_RETURNING_RINGS], falls_in[KD_RETURNING_RINGS]; } photons, energy;
    /* shares of Page & Thorne's luminosity, by the first destination of the light */
    struct kd_returning_shares first;
    /* shares of the same luminosity, by the final destination of the light; `returns` is 0 */
    struct kd_returning_shares lastly;
    double hottest, largest; /* hottest: radius at which F is largest. largest: F/Mdot there */
    /* Matrices for kd_reflection_init. Both give r^3 Int g^5 F T/pi f(mu_e) mu dOmega at the nodes, where F and T are
     * the flux and the temperature of the light that rings emit. warmth_of is multiplied by r^(15/4) F T at the nodes,
     * and echo_of by r^3 F T. */
    double warmth_of[KD_RETURNING_RINGS][KD_RETURNING_RINGS], echo_of[KD_RETURNING_RINGS][KD_RETURNING_RINGS];
    /* largest deviation from 1 of two numbers: energy that arrives divided by energy that returns, and the sum of
     * `lastly` */
    double error;
    int steps; /* number of iterations until the change is below 1e-12 */
};

/* Largest error of a table for which answers are given. Larger errors occur where 1 - |a| is about 1e-9. */
#define KD_RETURNING_WRONG 1e-2

/* Makes a table, or copies it from the cache, which holds the 8 tables that were used last. Making it takes 0.1 to 0.3
 * s of one core, and less time if other cores are idle. */
void kd_returning_init(struct kd_returning *table, const struct kd_hole *hole, enum kd_limb limb);
/* The member `largest` of the table that kd_returning_init would make. The values of the last 256 tables are cached. */
double kd_returning_largest(const struct kd_hole *hole, enum kd_limb limb);

/* kd_returning_flux: F at r >= ISCO. kd_returning_at: the value of one of the table's arrays, interpolated at r and
 * divided by r^3. */
double kd_returning_flux(const struct kd_returning *table, double r);
double kd_returning_at(const struct kd_returning *table, const double list[KD_RETURNING_RINGS], double r);

/* The shares of kd_returning_ring, interpolated in table->photons or table->energy with an error below 1e-4. */
struct kd_returning_shares kd_returning_shares_at(const struct kd_returning *table,
                                                  const struct kd_returning_list *list, double r);

/* Light of a disk that reflects the share A, `albedo`, of the light that returns, and absorbs the rest. Reflected light
 * leaves by the angular law of the disk's own light, so it carries away L of the gas. Therefore F is the same as for a
 * disk that absorbs all light, and only the spectrum differs. Reflected light keeps the spectrum with which it arrived.
 * This spectrum is taken as a dilute black body of temperature T_c, the mean temperature of its sources, weighted by
 * flux, as the gas sees it:
 *
 *   T_c(r) F_ret(r) = Int g^5 (F_th T_th + F_r T_c)/pi f(mu_e) mu dOmega      F_th = F - F_r,  F_r = A F_ret
 *
 * Where this F_th would be negative, F_th is 0 and F_r is F. This happens next to the ISCO for A near 1, where
 * returning light takes away more angular momentum than the gas has to lose. */
struct kd_reflection {
    double albedo;
    double warm[KD_RETURNING_RINGS]; /* T_c at the nodes; its unit is such that F/Mdot = T^4 */
};
void kd_reflection_init(struct kd_reflection *reflection, const struct kd_returning *table, double albedo);

/* F_th, F_r and T_c at r >= ISCO. Both fluxes are divided by Mdot. */
struct kd_reflected { double absorbed, flux, warm; };
struct kd_reflected kd_reflection_at(const struct kd_reflection *reflection, const struct kd_returning *table,
                                     double r);

#endif
