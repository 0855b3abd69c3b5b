#include "orbit/cases.h"

#include "physics/orbit/timelike.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

double kd_orbit_case_mass_msun(enum kd_orbit_case which) { return which == KD_CASE_MERCURY ? 1 : NAN; }

/* Orbit of Mercury. Semi-major axis and eccentricity are from NASA's planetary fact sheet, and GM of the Sun is the
 * nominal value of IAU 2015. */
static struct kd_orbit_spec mercury(struct kd_hole_given given)
{
    const double axis_m = 57.909e9, e = 0.20563, gm_m = 1.3271244e20 / (299792458. * 299792458.);
    return (struct kd_orbit_spec) {
        .form = KD_ORBIT_SHAPE,
        KD_HOLE_FROM(&given),
        .e = e,
        .p = axis_m * (1 - e * e) / gm_m,
    };
}

struct kd_orbit_spec kd_orbit_case_spec(enum kd_orbit_case which, struct kd_hole_given given)
{
    if (isnan(given.spin))
        given.spin = which == KD_CASE_MERCURY ? 0 : 0.9;
    if (which == KD_CASE_MERCURY)
        return mercury(given);
    struct kd_orbit_spec spec = { .form = KD_ORBIT_SHAPE, KD_HOLE_FROM(&given) };
    const struct kd_hole hole = kd_hole_from(given);
    if (!kd_hole_exists(&hole)) /* a hole that cannot exist is refused later */
        return spec;
    switch (which) {
    /* p exceeds the separatrix by 1e-4 of its value, so that the orbit whirls several turns in each radial period */
    case KD_CASE_ZOOM_WHIRL:
        spec.e = 0.8;
        spec.p = 1.0001 * kd_orbit_separatrix(&hole, spec.e, 1);
        return spec;
    case KD_CASE_PLUNGE: /* tangential velocity too small to stay in orbit */
        spec.form = KD_ORBIT_STATE;
        spec.place_r = 2 * kd_kerr_isco(&hole);
        spec.theta_deg = 90;
        spec.frame = KD_OBSERVER_ZAMO;
        spec.v[2] = 0.2;
        return spec;
    case KD_CASE_ISCO: spec.p = kd_kerr_isco(&hole); return spec;
    case KD_CASE_SPHERICAL:
        spec.inclination_deg = 60;
        spec.p = 1.5 * kd_orbit_separatrix(&hole, 0, 0.5);
        return spec;
    case KD_CASE_MERCURY:
    case KD_CASES: break;
    }
    return spec;
}
