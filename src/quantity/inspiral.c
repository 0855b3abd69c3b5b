#include "quantity/define.h"

#include "physics/math/constants.h"
#include "physics/spacetime/scale.h"
#include "physics/waves/inspiral.h"

#define PARAMETERS(P) \
    P(mass1_msun, .unit = "solar masses", .typed = "1.4398", .least = 1e-10, .most = 1e12, .help = "mass of one body") \
    P(mass2_msun, .unit = "solar masses", .typed = "1.3886", .least = 1e-10, .most = 1e12, \
      .help = "mass of the other body") \
    P(period_s, .unit = "s", .typed = "27906.979587", .least = 1e-9, .most = 1e20, .help = "orbital period now") \
    P(eccentricity, .unit = "1", .typed = "0.6171334", .least = 0, .most = 0.999999, .help = "eccentricity now") \
    P(eccentricity_later, .unit = "1", .typed = "0", .least = 0, .most = 0.999999, \
      .help = "smaller eccentricity of the same orbit at a later time") \
    P(distance_pc, .unit = "pc", .typed = "6400", .least = 1e-3, .most = 1e11, \
      .help = "distance (luminosity distance, with redshifted masses and times)") \
    P(before_s, .unit = "s", .typed = "1", .least = 1e-9, .most = 1e20, \
      .help = "time before coalescence, for the chirp of a circular orbit of these masses")
#define OUTPUTS(O) \
    O(chirp_mass, .unit = "solar masses", .fixed = true, .help = "(m1 m2)^(3/5)/(m1 + m2)^(1/5)") \
    O(eta, .unit = "1", .fixed = true, .help = "m1 m2/(m1 + m2)^2") \
    O(axis_km, .unit = "km", .fixed = true, .help = "semi-major axis a, by Kepler's law") \
    O(axis, .unit = "M", .fixed = true, .help = "semi-major axis a, in units of the total mass M") \
    O(enhancement, .unit = "1", .fixed = true, \
      .help = "radiated power over the power of a circular orbit with the same a") \
    O(power_w, .unit = "W", .fixed = true, .help = "radiated power") \
    O(axis_rate, .unit = "m/yr", .fixed = true, .help = "da/dt") \
    O(eccentricity_rate, .unit = "1/yr", .fixed = true, .help = "de/dt") \
    O(period_rate, .unit = "1", .fixed = true, .help = "dP/dt") \
    O(time_s, .unit = "s", .fixed = true, .help = "time to coalescence") \
    O(time_yr, .unit = "yr", .fixed = true, .help = "time to coalescence") \
    O(isco_hz, .unit = "Hz", .fixed = true, .help = "wave frequency at a = 6 M, where the chirp is cut") \
    O(isco_before_s, .unit = "s", .fixed = true, .help = "time before coalescence at a = 6 M") \
    O(axis_later_km, .unit = "km", \
      .help = "a at the time when the eccentricity is eccentricity_later; null if eccentricity_later is larger than " \
              "the present eccentricity") \
    O(time_later_yr, .unit = "yr", \
      .help = \
          "time until the eccentricity is eccentricity_later; null if that is larger than the present eccentricity") \
    O(chirp_hz, .unit = "Hz", \
      .help = "wave frequency of a circular orbit before_s before coalescence; null inside a = 6 M") \
    O(chirp_axis, .unit = "M", \
      .help = "semi-major axis of a circular orbit before_s before coalescence; null inside a = 6 M") \
    O(chirp_strain, .unit = "1", \
      .help = "amplitude of h+ and hx of this circular orbit, seen along the axis; null inside a = 6 M")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "P. C. Peters & J. Mathews 1963, Phys. Rev. 131, 435; P. C. Peters 1964, Phys. Rev. 136, B1224",
    "M. Maggiore 2008, Gravitational Waves 1, section 4.1 (chirp, strain)",
    "defaults: PSR B1913+16, J. M. Weisberg, D. J. Nice & J. H. Taylor 2010, ApJ 722, 1030",
    NULL,
};
static const char *const approximations[] = {
    "radiation is of leading order: that of the quadrupole of a Kepler ellipse, averaged over an orbit; the masses "
    "have no spin and no size",
    "the relative error is of the order of M/a; the chirp is cut at a = 6 M, the ISCO of a hole of the total mass",
    NULL,
};

/* total: mass in solar masses. unit_s, unit_m: M for this mass, in seconds and in metres */
struct orbit { double total, unit_s, unit_m; };

static struct orbit orbit_of(const struct parameters *p)
{
    double total = p->mass1_msun + p->mass2_msun;
    return (struct orbit) { total, kd_scale_seconds(total), kd_scale_metres(total) };
}

static enum kd_status fill_now(const struct parameters *p, const struct orbit *k, struct outputs *o,
                               struct kd_error *error)
{
    double e = p->eccentricity, eta = kd_inspiral_eta(p->mass2_msun / p->mass1_msun), turn = p->period_s / k->unit_s;
    double a = cbrt(turn * turn / (4 * M_PI * M_PI));
    if (!(a * (1 - e) > 6))
        return kd_quantity_outside(
            error, "period_s", p->period_s,
            ", for which a = %.6g M and the orbit comes inside 6 M, where these formulas fail; it must be longer", a);
    o->eta = eta;
    o->chirp_mass = kd_inspiral_chirp_mass(eta) * k->total;
    o->axis = a, o->axis_km = a * k->unit_m * 1e-3;
    o->enhancement = kd_inspiral_enhancement(e);
    o->power_w = kd_inspiral_power(eta, a, e) * pow(KD_C_M_S, 5) / KD_G_SI;
    o->axis_rate = kd_inspiral_axis_rate(eta, a, e) * KD_C_M_S * KD_YEAR_S;
    o->eccentricity_rate = kd_inspiral_eccentricity_rate(eta, a, e) * KD_YEAR_S / k->unit_s;
    o->period_rate = kd_inspiral_period_rate(eta, a, e);
    o->time_s = kd_inspiral_time(eta, a, e) * k->unit_s;
    o->time_yr = o->time_s / KD_YEAR_S;
    o->isco_hz = kd_inspiral_frequency_isco() / k->unit_s;
    o->isco_before_s = kd_inspiral_time(eta, 6, 0) * k->unit_s;
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct orbit k = orbit_of(p);
    (void)memory;
    if (fresh && fill_now(p, &k, o, error))
        return KD_EINVAL;
    bool later = p->eccentricity_later <= p->eccentricity && p->eccentricity > 0;
    double a = later ? kd_inspiral_axis(o->axis, p->eccentricity, p->eccentricity_later) : NAN;
    o->axis_later_km = a * k.unit_m * 1e-3;
    double left = a == 0 ? 0 : kd_inspiral_time(o->eta, a, p->eccentricity_later) * k.unit_s;
    o->time_later_yr = (o->time_s - left) / KD_YEAR_S;
    double f = kd_inspiral_frequency(o->eta, p->before_s / k.unit_s);
    o->chirp_hz = f / k.unit_s;
    o->chirp_axis = cbrt(1 / (M_PI * M_PI * f * f));
    o->chirp_strain = kd_inspiral_strain(o->eta, f, p->distance_pc * KD_PARSEC_M / k.unit_m);
    return KD_OK;
}

KD_QUANTITY(inspiral, "inspiral", "decay of a binary under gravitational radiation, and its chirp", .along = 3,
            .point_us = 10, .fresh_us = 10)
