#include "quantity/define.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    KD_PARAMETER_MASS(P) \
    P(mdot_edd, .unit = "Eddington rates", .typed = "0.1", .least = 1e-12, .most = 1e3, \
      .help = "accretion rate as luminosity over the Eddington luminosity, with the efficiency of this spin") \
    P(r, .unit = "M", .typed = "20", .least = 1, .most = 1e9, .help = "radius in the disk")
#define OUTPUTS(O) \
    O(page_thorne, .unit = "1/M^2", .help = "F/Mdot of one face; zero at and inside the ISCO") \
    O(shakura_sunyaev, .unit = "1/M^2", .help = "F/Mdot of one face in Newton's gravity, cut at the ISCO") \
    O(page_thorne_w_m2, .unit = "W/m^2", .help = "F") \
    O(shakura_sunyaev_w_m2, .unit = "W/m^2", .help = "F in Newton's gravity for the same accretion rate") \
    O(t_eff_k, .unit = "K", .help = "effective temperature, Page-Thorne") \
    O(t_eff_newton_k, .unit = "K", .help = "effective temperature, Shakura-Sunyaev") \
    O(inner, .unit = "M", .fixed = true, .help = "inner edge, the ISCO") \
    O(r_peak, .unit = "M", .fixed = true, .help = "radius of the largest Page-Thorne flux") \
    O(t_peak_k, .unit = "K", .fixed = true, .help = "effective temperature at r_peak") \
    O(efficiency, .unit = "1", .fixed = true, .help = "luminosity over Mdot c^2, 1 - E at the ISCO") \
    O(efficiency_newton, .unit = "1", .fixed = true, \
      .help = "luminosity over Mdot c^2 of the Newtonian disk, 1/(2 r_isco)") \
    O(mdot_kg_s, .unit = "kg/s", .fixed = true, .help = "accretion rate") \
    O(mdot_msun_yr, .unit = "solar masses a year", .fixed = true, .help = "accretion rate") \
    O(luminosity_w, .unit = "W", .fixed = true, .help = "efficiency times Mdot c^2") \
    O(luminosity_lsun, .unit = "solar luminosities", .fixed = true, .help = "efficiency times Mdot c^2")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "D. N. Page & K. S. Thorne 1974, ApJ 191, 499, eqs 11b, 12, 15n",
    "N. I. Shakura & R. A. Sunyaev 1973, A&A 24, 337",
    "constants: CODATA 2018; the sun: IAU 2015 resolution B3",
    NULL,
};
static const char *const approximations[] = {
    "the disk is thin, ends at the ISCO without torque, and radiates locally",
    "the luminosity ignores the light that the hole captures and the light that returns to the disk",
    "shakura_sunyaev is the Newtonian disk, with its inner edge at the ISCO",
    NULL,
};

static void fill_disk(const struct parameters *p, struct outputs *o)
{
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    double m_sun_kg = KD_GM_SUN_SI / KD_G_SI;
    o->inner = kd_kerr_isco(hole);
    o->r_peak = kd_disk_peak_page_thorne(hole);
    o->t_peak_k = kd_disk_temperature(kd_disk_flux_page_thorne(hole, o->r_peak), hole, p->mass_msun, p->mdot_edd);
    o->efficiency = kd_kerr_efficiency(hole);
    o->efficiency_newton = 1 / (2 * o->inner);
    o->mdot_kg_s = kd_disk_rate(hole, p->mass_msun, p->mdot_edd);
    o->mdot_msun_yr = o->mdot_kg_s * KD_YEAR_S / m_sun_kg;
    o->luminosity_w = o->efficiency * o->mdot_kg_s * KD_C_M_S * KD_C_M_S;
    o->luminosity_lsun = o->luminosity_w / KD_L_SUN_W;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    const struct kd_hole *hole = KD_QUANTITY_HOLE(p);
    struct outputs *o = KD_QUANTITY_OUT(out);
    (void)memory;
    if (kd_hole_check(hole, error) || kd_quantity_outside_horizon(hole, p->r, error))
        return KD_EINVAL;
    if (fresh)
        fill_disk(p, o);
    o->page_thorne = kd_disk_flux_page_thorne(hole, p->r);
    o->shakura_sunyaev = kd_disk_flux_shakura_sunyaev(hole, p->r);
    o->page_thorne_w_m2 = kd_disk_flux_si(o->page_thorne, hole, p->mass_msun, p->mdot_edd);
    o->shakura_sunyaev_w_m2 = kd_disk_flux_si(o->shakura_sunyaev, hole, p->mass_msun, p->mdot_edd);
    o->t_eff_k = kd_disk_temperature(o->page_thorne, hole, p->mass_msun, p->mdot_edd);
    o->t_eff_newton_k = kd_disk_temperature(o->shakura_sunyaev, hole, p->mass_msun, p->mdot_edd);
    return KD_OK;
}

KD_QUANTITY(disk_flux, "disk-flux", "flux, temperature and luminosity of a thin accretion disk", .along = 1,
            .point_us = 2, .fresh_us = 30)
