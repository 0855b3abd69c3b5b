#include "quantity/define.h"

#include "physics/disk/returning.h"
#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(limb, .typed = "isotropic", .kind = KD_KIND_WORD, .words = "isotropic|laor|haardt|scattering", \
      .help = "light of the disk's surface by the angle to its normal: the laws of /v1/spectrum") \
    P(r, .unit = "M", .typed = "10", .least = 1, .most = 1e6, .words = "isco", .stands = INFINITY, \
      .help = "radius in the disk, at least the ISCO")
#define OUTPUTS(O) \
    O(returns, .unit = "1", .help = "share of the photons of the ring at r that falls on the disk") \
    O(falls_in, .unit = "1", .help = "share of the ring's photons that falls into the hole") \
    O(escapes, .unit = "1", .help = "share of the ring's photons that escapes to infinity") \
    O(energy_returns, .unit = "1", .help = "share of the ring's light, by energy at infinity, that falls on the disk") \
    O(energy_falls_in, .unit = "1", \
      .help = "share of the ring's light, by energy at infinity, that falls into the hole") \
    O(energy_escapes, .unit = "1", .help = "share of the ring's light, by energy at infinity, that escapes") \
    O(page_thorne, .unit = "1/M^2", .help = "F/Mdot of one face without returning light") \
    O(flux, .unit = "1/M^2", .help = "F/Mdot of one face that absorbs the returning light and radiates it again") \
    O(received, .unit = "1/M^2", \
      .help = "F/Mdot of the light that returns; flux - page_thorne - received is the work of stresses") \
    O(temperature_ratio, .unit = "1", \
      .help = \
          "effective temperature with returning light over that without it; null at the ISCO, where the latter is 0") \
    O(isco, .unit = "M", .fixed = true, .help = "inner edge of the disk") \
    O(disk_returns, .unit = "1", .fixed = true, \
      .help = "share of the luminosity L of the whole disk, without returning light, that falls on the disk again") \
    O(disk_falls_in, .unit = "1", .fixed = true, .help = "share of L that falls into the hole directly") \
    O(disk_escapes, .unit = "1", .fixed = true, .help = "share of L that escapes directly") \
    O(ends_in_hole, .unit = "1", .fixed = true, \
      .help = "share of L that ends in the hole, directly or after any number of returns") \
    O(ends_escaped, .unit = "1", .fixed = true, \
      .help = "share of L that ends at infinity, directly or after any number of returns") \
    O(efficiency, .unit = "1", .fixed = true, .help = "1 - E at the ISCO") \
    O(efficiency_seen, .unit = "1", .fixed = true, .help = "efficiency times ends_escaped") \
    O(iterations, .unit = "1", .fixed = true, .help = "number of returns that are followed, to 1e-12") \
    O(error, .unit = "1", .fixed = true, \
      .help = "largest relative error of two checks: the energy that arrives over the energy that returns, and " \
              "ends_in_hole + ends_escaped; both should be 1")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "C. T. Cunningham 1976, ApJ 208, 534; L.-X. Li, E. R. Zimmerman, R. Narayan & J. E. McClintock 2005, ApJS 157, 335 "
    "(balance of energy and angular momentum)",
    "E. Agol & J. H. Krolik 2000, ApJ 528, 161; J. D. Schnittman & J. H. Krolik 2009, ApJ 701, 1175",
    "D. N. Page & K. S. Thorne 1974, ApJ 191, 499 (flux without returning light)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    NULL,
};
static const char *const approximations[] = {
    "the disk is thin and reaches from the ISCO to infinity; between the ISCO and the hole nothing stops light",
    "the disk absorbs all returning light, and radiates it again from the same place with the law of its own light",
    NULL,
};

struct memory { struct kd_returning table; };

static enum kd_status begin(const struct parameters *p, struct memory *m, struct outputs *o, struct kd_error *error)
{
    const struct kd_hole hole = kd_hole_in(p);
    const struct kd_hole_parameter largest = kd_hole_largest(&hole);
    if (kd_hole_check(&hole, error))
        return KD_EINVAL;
    kd_returning_init(&m->table, &hole, (enum kd_limb)p->limb);
    if (!(m->table.error < KD_RETURNING_WRONG))
        return kd_quantity_outside(error, largest.name, largest.value,
                                   ", so close to an extremal hole that the energy balance has an error of %.1g (limit "
                                   "%g); it must be smaller",
                                   m->table.error, KD_RETURNING_WRONG);
    o->isco = m->table.isco;
    o->disk_returns = m->table.first.returns, o->disk_falls_in = m->table.first.falls_in,
    o->disk_escapes = m->table.first.escapes;
    o->ends_in_hole = m->table.lastly.falls_in, o->ends_escaped = m->table.lastly.escapes;
    o->efficiency = kd_kerr_efficiency(&hole);
    o->efficiency_seen = o->efficiency * o->ends_escaped;
    o->iterations = m->table.steps, o->error = m->table.error;
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    const enum kd_status status = fresh ? begin(p, m, o, error) : KD_OK;
    if (status)
        return status;
    const double r = isinf(p->r) ? m->table.isco : p->r;
    if (r < m->table.isco)
        return kd_quantity_outside(error, "r", r, "; it must be at least %.9g M, the ISCO", m->table.isco);
    const struct kd_returning_shares photons = kd_returning_shares_at(&m->table, &m->table.photons, r),
                                     energy = kd_returning_shares_at(&m->table, &m->table.energy, r);
    o->returns = photons.returns, o->falls_in = photons.falls_in, o->escapes = photons.escapes;
    o->energy_returns = energy.returns, o->energy_falls_in = energy.falls_in, o->energy_escapes = energy.escapes;
    o->page_thorne = kd_disk_flux_page_thorne(&m->table.hole, r);
    o->flux = kd_returning_flux(&m->table, r);
    o->received = kd_returning_at(&m->table, m->table.back, r);
    o->temperature_ratio = o->page_thorne > 0 ? sqrt(sqrt(o->flux / o->page_thorne)) : NAN;
    return KD_OK;
}

KD_QUANTITY(returning, "returning", "light of a thin disk that returns to it, falls into the hole, or escapes",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 20, .fresh_us = 300000)
