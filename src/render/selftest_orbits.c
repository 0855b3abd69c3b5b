/* Radii of circular orbits and the flux of the disk, in double precision on the CPU. */
#include "render/selftest_parts.h"

#include "physics/disk.h"
#include "physics/kerr.h"

/* physics/kerr.h promises a few ulp, 1e-14 for the ISCO: relative. */
#define ORBIT_BOUND 1e-14

static enum kd_status radius(const struct kd_selftest *test, const char *what, double (*of)(double), size_t at)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "Bardeen, Press & Teukolsky 1972; from the metric, 50 digits", "closed f64", "%s (relative)", what);
    for (size_t i = 0; i < test->reference->n_orbits; i++) {
        const struct kd_selftest_orbit *o = &test->reference->orbits[i];
        double known = *(const double *)((const char *)o + at);
        kd_selftest_compare(&row, of(o->spin) / known - 1, ORBIT_BOUND);
    }
    return kd_selftest_end(test, &row);
}

/* physics/disk.h: 1e-11 and 4e-14/(r - r_isco)^2, relative. */
static enum kd_status flux(const struct kd_selftest *test)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "Page & Thorne 1974, eq. 12 by quadrature", "closed f64", "flux of the disk (relative)");
    for (size_t i = 0; i < test->reference->n_fluxes; i++) {
        const struct kd_selftest_flux *f = &test->reference->fluxes[i];
        double gap = f->r - kd_kerr_isco(f->spin);
        kd_selftest_compare(&row, kd_disk_flux_page_thorne(f->spin, f->r) / f->flux - 1, 1e-11 + 4e-14 / (gap * gap));
    }
    return kd_selftest_end(test, &row);
}

enum kd_status kd_selftest_orbits(const struct kd_selftest *test)
{
    static const struct { const char *what; double (*of)(double); size_t at; } list[] = {
        { "horizon", kd_kerr_horizon, offsetof(struct kd_selftest_orbit, horizon) },
        { "photon orbit", kd_kerr_photon_orbit, offsetof(struct kd_selftest_orbit, photon) },
        { "marginally bound orbit", kd_kerr_marginally_bound, offsetof(struct kd_selftest_orbit, bound) },
        { "ISCO", kd_kerr_isco, offsetof(struct kd_selftest_orbit, isco) },
        { "efficiency, 1 - E(ISCO)", kd_kerr_efficiency, offsetof(struct kd_selftest_orbit, efficiency) },
    };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof list / sizeof *list && !status; i++)
        status = radius(test, list[i].what, list[i].of, list[i].at);
    return status ? status : flux(test);
}
