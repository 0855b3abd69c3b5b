#include "quantity/define.h"

#include "physics/spacetime/epicyclic.h"
#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(theta_deg, .unit = "degrees", .typed = "90", .least = 0, .most = 180, \
      .help = "polar angle at which the ergosphere is given") \
    P(r, .unit = "M", .typed = "10", .least = 1, .most = 1e9, .words = "isco", .stands = INFINITY, \
      .help = "radius of the circular orbit whose frequencies are given")
#define OUTPUTS(O) \
    O(horizon, .unit = "M", .fixed = true, .help = "outer horizon r+") \
    O(inner_horizon, .unit = "M", .fixed = true, .help = "inner horizon r-") \
    O(horizon_omega, .unit = "1/M", .fixed = true, .help = "angular velocity of the horizon, a/(2 r+ - Q^2)") \
    O(ergosphere, .unit = "M", .fixed = true, .help = "static limit r_E at theta_deg") \
    O(photon_prograde, .unit = "M", .fixed = true, .help = "circular photon orbit that turns towards +phi") \
    O(photon_retrograde, .unit = "M", .fixed = true, .help = "circular photon orbit that turns towards -phi") \
    O(marginally_bound, .unit = "M", .fixed = true, .help = "circular orbit with E = 1, towards +phi") \
    O(marginally_bound_retrograde, .unit = "M", .fixed = true, .help = "circular orbit with E = 1, towards -phi") \
    O(isco, .unit = "M", .fixed = true, .help = "innermost stable circular orbit, towards +phi") \
    O(isco_retrograde, .unit = "M", .fixed = true, .help = "innermost stable circular orbit, towards -phi") \
    O(isco_energy, .unit = "1", .fixed = true, .help = "specific energy E at the ISCO") \
    O(isco_momentum, .unit = "M", .fixed = true, .help = "specific angular momentum L at the ISCO") \
    O(isco_omega, .unit = "1/M", .fixed = true, .help = "angular velocity Omega at the ISCO") \
    O(efficiency, .unit = "1", .fixed = true, .help = "1 - E at the ISCO") \
    O(energy, .unit = "1", .help = "specific energy E at r; null at and inside the photon orbit") \
    O(momentum, .unit = "M", .help = "specific angular momentum L at r; null at and inside the photon orbit") \
    O(omega_phi, .unit = "1/M", \
      .help = "orbital angular frequency Omega_phi at r, in coordinate time; null at and inside the photon orbit") \
    O(kappa, .unit = "1/M", .help = "radial epicyclic frequency at r; null inside the ISCO") \
    O(omega_theta, .unit = "1/M", .help = "vertical epicyclic frequency at r; null at and inside the photon orbit")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. M. Bardeen, W. H. Press & S. A. Teukolsky 1972, ApJ 178, 347, eqs 2.12-2.21",
    "A. T. Okazaki, S. Kato & J. Fukue 1987, PASJ 39, 457 (epicyclic frequencies)",
    "N. Dadhich & P. P. Kale 1977, J. Math. Phys. 18, 1727 (orbits of neutral matter about a charged hole)",
    NULL,
};
static const char *const approximations[] = { NULL };

static void fill_hole(const struct parameters *p, struct outputs *o)
{
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p), *turned = kd_hole_turned(hole, -1);
    o->horizon = hole->outer;
    o->inner_horizon = hole->inner;
    o->horizon_omega = hole->a / kd_hole_mass(hole, o->horizon);
    o->ergosphere = kd_kerr_ergosphere(hole, kd_cos_deg(p->theta_deg));
    o->photon_prograde = kd_kerr_photon_orbit(hole);
    o->photon_retrograde = kd_kerr_photon_orbit(turned);
    o->marginally_bound = kd_kerr_marginally_bound(hole);
    o->marginally_bound_retrograde = kd_kerr_marginally_bound(turned);
    o->isco = kd_kerr_isco(hole);
    o->isco_retrograde = kd_kerr_isco(turned);
    o->isco_energy = kd_kerr_energy(hole, o->isco);
    o->isco_momentum = kd_kerr_momentum(hole, o->isco);
    o->isco_omega = kd_kerr_omega(hole, o->isco);
    o->efficiency = kd_kerr_efficiency(hole);
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory;
    if (fresh && kd_hole_check(hole, error))
        return KD_EINVAL;
    if (fresh)
        fill_hole(p, o);
    double r = isinf(p->r) ? o->isco : p->r;
    bool orbit = r > o->photon_prograde;
    if (kd_quantity_outside_horizon(hole, r, error))
        return KD_EINVAL;
    o->energy = orbit ? kd_kerr_energy(hole, r) : NAN;
    o->momentum = orbit ? kd_kerr_momentum(hole, r) : NAN;
    o->omega_phi = orbit ? kd_kerr_omega(hole, r) : NAN;
    o->kappa = orbit ? kd_epicyclic_radial(hole, r) : NAN;
    o->omega_theta = orbit ? kd_epicyclic_vertical(hole, r) : NAN;
    return KD_OK;
}

KD_QUANTITY(kerr, "kerr", "radii, ISCO and frequencies of circular orbits of a Kerr hole", .along = 1, .point_us = 2,
            .fresh_us = 2)
