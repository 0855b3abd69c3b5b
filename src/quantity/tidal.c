#include "quantity/define.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/scale.h"
#include "physics/waves/tidal.h"

#define PARAMETERS(P) \
    P(spin, .unit = "M", .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, \
      .help = "spin parameter a; a < 0: the star's orbit is against the hole's spin") \
    P(mass_msun, .unit = "solar masses", .typed = "1e6", .least = 1e-3, .most = 1e12, .help = "mass of the hole") \
    P(star_mass_msun, .unit = "solar masses", .typed = "1", .least = 1e-3, .most = 1e3, .help = "mass of the star") \
    P(star_radius_rsun, .unit = "solar radii", .typed = "1", .least = 1e-6, .most = 1e4, .help = "radius of the star") \
    P(penetration, .unit = "1", .typed = "1", .least = 0.1, .most = 100, \
      .help = "tidal radius over pericentre of its parabolic orbit") \
    P(time_days, .unit = "days", .typed = "fallback", .least = 0, .most = 1e9, .words = "fallback", \
      .stands = INFINITY, \
      .help = "time after the disruption, for the rate of fallback; \"fallback\": when the first debris returns")
#define OUTPUTS(O) \
    O(tidal_radius, .unit = "M", .fixed = true, .help = "r_t = R (M/m)^(1/3)") \
    O(tidal_radius_km, .unit = "km", .fixed = true, .help = "r_t") \
    O(horizon, .unit = "M", .fixed = true, .help = "outer horizon") \
    O(marginally_bound, .unit = "M", .fixed = true, .help = "parabolic orbits with a smaller pericentre are captured") \
    O(hills_msun, .unit = "solar masses", .fixed = true, \
      .help = "mass of a hole whose horizon is at r_t of this star (Hills)") \
    O(capture_msun, .unit = "solar masses", .fixed = true, \
      .help = "mass of a hole whose marginally bound orbit is at r_t: the heaviest that tears this star") \
    O(energy_spread, .unit = "c^2", .fixed = true, \
      .help = "half the range of specific energy in the debris, M R/r_t^2") \
    O(fallback_s, .unit = "s", .fixed = true, .help = "time t_fb until the first debris returns") \
    O(fallback_days, .unit = "days", .fixed = true, .help = "t_fb in days") \
    O(peak_msun_yr, .unit = "solar masses a year", .fixed = true, .help = "largest rate of fallback, m/(3 t_fb)") \
    O(peak_eddington, .unit = "Eddington rates", .fixed = true, \
      .help = "largest rate of fallback in units of the Eddington rate, with the efficiency of this spin") \
    O(above_eddington_days, .unit = "days", .fixed = true, \
      .help = "time until the rate falls to the Eddington rate; null if it never exceeds that") \
    O(pericentre, .unit = "M", .help = "r_t over penetration") \
    O(pericentre_over_capture, .unit = "1", \
      .help = "pericentre over marginally_bound; below 1 the star is captured whole") \
    O(rate_msun_yr, .unit = "solar masses a year", \
      .help = "rate of fallback at time_days, as t^(-5/3) after t_fb, 0 before")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. G. Hills 1975, Nature 254, 295; M. J. Rees 1988, Nature 333, 523; E. S. Phinney 1989, IAU Symp. 136, 543",
    "N. Stone, R. Sari & A. Loeb 2013, MNRAS 435, 1809 (energy spread at r_t, whatever the pericentre)",
    "M. Kesden 2012, Phys. Rev. D 85, 024037 (capture)",
    "constants: CODATA 2018; the sun: IAU 2015 resolution B3",
    NULL,
};
static const char *const approximations[] = {
    "the tide is Newtonian, on a star without structure and spin on a parabolic orbit; the hole's spin affects only "
    "the horizon and the capture",
    "energies of the debris are uniformly distributed, and half of the debris is bound; simulations differ by factors "
    "of two, and their rate rises smoothly to the peak",
    NULL,
};

static const double day = 86400;

/* mass and radius of the star, with lengths in units of M of the hole */
static struct kd_tidal in_m(const struct parameters *p)
{
    return (struct kd_tidal) { 1, p->star_mass_msun / p->mass_msun,
                               p->star_radius_rsun * KD_R_SUN_M / kd_scale_metres(p->mass_msun) };
}

static void fill_star(const struct parameters *p, struct kd_tidal t, struct outputs *o)
{
    double unit_s = kd_scale_seconds(p->mass_msun), m_sun_kg = KD_GM_SUN_SI / KD_G_SI;
    double to_msun_yr = p->mass_msun * KD_YEAR_S / unit_s, fallback = kd_tidal_fallback_time(t);
    o->tidal_radius = kd_tidal_radius(t);
    o->tidal_radius_km = o->tidal_radius * kd_scale_metres(p->mass_msun) * 1e-3;
    o->horizon = kd_hole(p->spin)->outer;
    o->marginally_bound = kd_kerr_marginally_bound(kd_hole(p->spin));
    o->hills_msun = kd_tidal_hills_mass(t, kd_hole(p->spin)) * p->mass_msun;
    o->capture_msun = kd_tidal_capture_mass(t, kd_hole(p->spin)) * p->mass_msun;
    o->energy_spread = kd_tidal_energy_spread(t);
    o->fallback_s = fallback * unit_s;
    o->fallback_days = o->fallback_s / day;
    o->peak_msun_yr = kd_tidal_fallback_rate(t, fallback) * to_msun_yr;
    o->peak_eddington = o->peak_msun_yr / (kd_disk_rate(kd_hole(p->spin), p->mass_msun, 1) * KD_YEAR_S / m_sun_kg);
    o->above_eddington_days = o->peak_eddington > 1 ? o->fallback_days * pow(o->peak_eddington, 0.6) : NAN;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct kd_tidal t = in_m(p);
    double unit_s = kd_scale_seconds(p->mass_msun);
    (void)memory, (void)error;
    if (fresh)
        fill_star(p, t, o);
    o->pericentre = o->tidal_radius / p->penetration;
    o->pericentre_over_capture = o->pericentre / o->marginally_bound;
    double time = isinf(p->time_days) ? kd_tidal_fallback_time(t) : p->time_days * day / unit_s;
    o->rate_msun_yr = kd_tidal_fallback_rate(t, time) * p->mass_msun * KD_YEAR_S / unit_s;
    return KD_OK;
}

KD_QUANTITY(tidal, "tidal",
            "tidal disruption of a star: tidal radius, fallback, and the heaviest hole that disrupts it", .along = 2,
            .point_us = 1, .fresh_us = 1)
