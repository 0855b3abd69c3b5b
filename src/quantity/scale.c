#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/math/constants.h"
#include "physics/null/critical.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/scale.h"

#define PARAMETERS(P) \
    P(hole, .typed = "m87", .kind = KD_KIND_WORD, .words = "m87|sgra|none", \
      .help = "a hole whose ring has been measured: M87*, Sgr A*") \
    P(spin, .unit = "M", .typed = "0", .least = -1, .most = 1, .open = KD_OPEN, .help = "spin parameter a") \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "0", .least = 0, .most = 180, \
      .help = "polar angle of the observer, for the shadow of a hole with spin") \
    P(mass_msun, .unit = "solar masses", .typed = "hole", .least = 1e-3, .most = 1e12, .words = "hole", \
      .stands = INFINITY, .help = "mass of the hole") \
    P(distance_pc, .unit = "pc", .typed = "hole", .least = 1e-3, .most = 1e11, .words = "hole", .stands = INFINITY, \
      .help = "angular diameter distance of the hole")
#define OUTPUTS(O) \
    O(mass, .unit = "solar masses", .help = "as used") \
    O(distance, .unit = "pc", .help = "as used") \
    O(m_km, .unit = "km", .help = "M as a length, G m/c^2") \
    O(m_s, .unit = "s", .help = "M as a time, G m/c^3") \
    O(m_uas, .unit = "microarcseconds", .help = "angle of M on the sky") \
    O(shadow_uas, .unit = "microarcseconds", \
      .help = "mean diameter of the shadow for this hole and inclination; 2 sqrt(27) M for a = Q = 0") \
    O(ring_uas, .unit = "microarcseconds", .help = "measured diameter of the ring; null if hole is none") \
    O(ring_error_uas, .unit = "microarcseconds", .help = "error of the measured diameter, one sigma") \
    O(ring_over_shadow, .unit = "1", .help = "ratio of measured to computed diameter") \
    O(horizon_km, .unit = "km", .help = "radius of the horizon r+") \
    O(horizon_au, .unit = "au", .help = "radius of the horizon r+") \
    O(light_crossing_s, .unit = "s", .help = "light-crossing time of the horizon, 2 r+/c") \
    O(isco_period_s, .unit = "s", .help = "period of the ISCO for an observer far away") \
    O(photon_period_s, .unit = "s", \
      .help = "period of the circular photon orbit towards +phi, for an observer far away") \
    O(fall_s, .unit = "s", \
      .help = "proper time from horizon to singularity of a fall from rest at infinity, a = Q = 0: 4/3 M; null " \
              "with charge") \
    O(fall_longest_s, .unit = "s", \
      .help = "longest proper time from horizon to singularity, a = Q = 0: pi M; null with charge")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "M87*: Event Horizon Telescope Collaboration 2019, ApJL 875, L1: 42 +- 3 microarcseconds, 6.5e9 solar masses, 16.8 "
    "Mpc",
    "Sgr A*: EHT Collaboration 2022, ApJL 930, L12: 51.8 +- 2.3 microarcseconds; GRAVITY Collaboration 2022, A&A 657, "
    "L12: 4.297e6 solar masses, 8277 pc",
    "critical curve: J. M. Bardeen 1973, in Black Holes (Les Houches), p. 215",
    "constants: CODATA 2018, IAU 2012 B2, IAU 2015 B2 and B3",
    NULL,
};
static const char *const approximations[] = {
    "the measured ring is the ring of emission, which is some per cent larger than the edge of the shadow",
    "times of fall are those of a = Q = 0",
    NULL,
};

struct memory { double shadow; }; /* mean radius of the hole's shadow, M */

static double shadow_of(const struct parameters *p)
{
    struct kd_critical curve = kd_critical_of(&(struct kd_critical_observer) {
        .hole = *KD_QUANTITY_HOLE(p),
        .radius = INFINITY,
        .cos_theta = kd_cos_deg(p->inclination_deg),
        .sin_theta = kd_sin_deg(p->inclination_deg),
    });
    return curve.status ? NAN : kd_critical_measure(&curve).mean_radius;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    const struct kd_hole *const black = KD_QUANTITY_HOLE(p);
    if (fresh && kd_hole_check(black, error))
        return KD_EINVAL;
    if (fresh)
        m->shadow = shadow_of(p);
    const struct kd_scale_hole *hole = p->hole < KD_SCALE_HOLES ? &kd_scale_holes[(int)p->hole] : NULL;
    if (!hole && isinf(p->mass_msun))
        return kd_error_field(
            error, "/mass_msun",
            "mass_msun is \"hole\" with hole \"none\"; it must be a number, or hole must be a known one");
    if (!hole && isinf(p->distance_pc))
        return kd_error_field(
            error, "/distance_pc",
            "distance_pc is \"hole\" with hole \"none\"; it must be a number, or hole must be a known one");
    o->mass = isinf(p->mass_msun) ? hole->mass_msun : p->mass_msun;
    o->distance = isinf(p->distance_pc) ? hole->distance_pc : p->distance_pc;
    o->m_km = kd_scale_metres(o->mass) * 1e-3;
    o->m_s = kd_scale_seconds(o->mass);
    o->m_uas = kd_scale_microarcseconds(o->mass, o->distance);
    o->shadow_uas = 2 * m->shadow * o->m_uas;
    o->ring_uas = hole ? hole->ring_uas : NAN;
    o->ring_error_uas = hole ? hole->ring_error_uas : NAN;
    o->ring_over_shadow = o->ring_uas / o->shadow_uas;
    const double horizon = black->outer;
    o->horizon_km = horizon * o->m_km;
    o->horizon_au = o->horizon_km * 1e3 / KD_AU_M;
    o->light_crossing_s = 2 * horizon * o->m_s;
    o->isco_period_s = 2 * M_PI / kd_kerr_omega(black, kd_kerr_isco(black)) * o->m_s;
    o->photon_period_s = 2 * M_PI / kd_kerr_omega(black, kd_kerr_photon_orbit(black)) * o->m_s;
    /* NAN with charge, because neutral matter turns back within a charged hole */
    const double falls = kd_hole_is_kerr(black) ? 1 : NAN;
    o->fall_s = falls * KD_SCALE_FALL * o->m_s;
    o->fall_longest_s = falls * KD_SCALE_FALL_LONGEST * o->m_s;
    return KD_OK;
}

KD_QUANTITY(scale, "scale", "scales of a hole in kilometres, seconds and microarcseconds, with the measured rings",
            .memory_size = sizeof(struct memory), .along = 2, .point_us = 3, .fresh_us = 1000)
