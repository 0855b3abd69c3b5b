/* Self-test of radii of circular orbits, of other bound orbits, and of the disk's flux, in double precision on the
 * CPU. */
#include "render/selftest/parts.h"

#include "physics/disk/thin_disk.h"
#include "physics/orbit/orbit_bound.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* physics/spacetime/kerr.h promises a relative error of a few ulp, 1e-14 for the ISCO. */
#define ORBIT_BOUND 1e-14

static enum kd_status radius(const struct kd_selftest *test, const char *what, double (*of)(const struct kd_hole *),
                             size_t at)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "Bardeen, Press & Teukolsky 1972; from the metric, 50 digits", "closed f64",
                      "%s (relative)", what);
    for (size_t i = 0; i < test->reference->n_orbits; i++) {
        const struct kd_selftest_orbit *o = &test->reference->orbits[i];
        double known = *(const double *)((const char *)o + at);
        kd_selftest_compare(&row, of(kd_hole(o->spin)) / known - 1, ORBIT_BOUND);
    }
    return kd_selftest_end(test, &row);
}

static enum kd_status shape(const struct kd_selftest *test, double spin, double p, double e, double x,
                            struct kd_orbit_bound *out)
{
    struct kd_orbit orbit;
    enum kd_status status = kd_orbit_from_shape(kd_hole(spin), p, e, x, &orbit, test->error);
    if (!status) {
        const struct kd_orbit_state start = kd_orbit_start(&orbit, NAN, true);
        *out = kd_orbit_bound_of(&orbit, &start);
    }
    return status;
}

/* The bound: some tens of operations of 1.1e-16 each, amplified up to a hundredfold by orbits this far from the
 * separatrix. */
static enum kd_status bound_orbits(const struct kd_selftest *test)
{
    static const char source[] = "Carter's equations by quadrature, 40 digits";
    struct kd_selftest_row constants, frequencies;
    kd_selftest_begin(&constants, source, "closed f64", "bound orbits: E, L, Q (relative, to 1 + their size)");
    kd_selftest_begin(&frequencies, source, "closed f64",
                      "bound orbits: r, theta, phi, t, tau per Mino time (relative)");
    for (size_t i = 0; i < test->reference->n_bounds; i++) {
        const struct kd_selftest_bound *b = &test->reference->bounds[i];
        struct kd_orbit_bound found;
        enum kd_status status = shape(test, b->spin, b->p, b->e, b->x, &found);
        if (status)
            return status;
        const struct kd_orbit_frequencies f = kd_orbit_frequencies_of(&found);
        const double pairs[][2] = {
            { found.orbit.energy, b->energy }, { found.orbit.momentum, b->momentum }, { found.orbit.carter, b->carter },
            { f.mino_r, b->mino_r },           { f.mino_theta, b->mino_theta },       { f.mino_phi, b->mino_phi },
            { f.mino_t, b->mino_t },           { f.mino_proper, b->mino_proper },
        };
        for (int k = 0; k < 8; k++)
            if (k < 3)
                kd_selftest_compare(&constants, (pairs[k][0] - pairs[k][1]) / (1 + fabs(pairs[k][1])), 1e-13);
            else
                kd_selftest_compare(&frequencies, pairs[k][0] / pairs[k][1] - 1, 1e-12);
    }
    enum kd_status status = kd_selftest_end(test, &constants);
    return status ? status : kd_selftest_end(test, &frequencies);
}

/* Mercury: semi-major axis 57.90908e9 m, e = 0.20563, 87.9693 days, and the sun's GM/c^2 = 1476.625 m. The published
 * advance has four digits. */
static enum kd_status mercury(const struct kd_selftest *test)
{
    struct kd_selftest_row row;
    struct kd_orbit_bound orbit;
    const double e = 0.20563, p = 57.90908e9 / 1476.625 * (1 - e * e), orbits = 36525 / 87.9693;
    kd_selftest_begin(&row, "Will 2014, Living Rev. Relativ. 17, 4: 42.98", "closed f64",
                      "Mercury's perihelion (arc seconds a century)");
    enum kd_status status = shape(test, 0, p, e, 1, &orbit);
    if (status)
        return status;
    kd_selftest_compare(&row, kd_orbit_periastron_advance(&orbit) * orbits * (180 * 3600 / M_PI) - 42.98, 0.005);
    return kd_selftest_end(test, &row);
}

/* The bound is the relative error that physics/disk/thin_disk.h states: 1e-11 + 4e-14/(r - r_isco)^2. */
static enum kd_status flux(const struct kd_selftest *test)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "Page & Thorne 1974, eq. 12 by quadrature", "closed f64", "flux of the disk (relative)");
    for (size_t i = 0; i < test->reference->n_fluxes; i++) {
        const struct kd_selftest_flux *f = &test->reference->fluxes[i];
        double gap = f->r - kd_kerr_isco(kd_hole(f->spin));
        kd_selftest_compare(&row, kd_disk_flux_page_thorne(kd_hole(f->spin), f->r) / f->flux - 1,
                            1e-11 + 4e-14 / (gap * gap));
    }
    return kd_selftest_end(test, &row);
}

static double horizon(const struct kd_hole *hole) { return hole->outer; }

enum kd_status kd_selftest_orbits(const struct kd_selftest *test)
{
    static const struct {
        const char *what;
        double (*of)(const struct kd_hole *);
        size_t at;
    } list[] = {
        { "horizon", horizon, offsetof(struct kd_selftest_orbit, horizon) },
        { "photon orbit", kd_kerr_photon_orbit, offsetof(struct kd_selftest_orbit, photon) },
        { "marginally bound orbit", kd_kerr_marginally_bound, offsetof(struct kd_selftest_orbit, bound) },
        { "ISCO", kd_kerr_isco, offsetof(struct kd_selftest_orbit, isco) },
        { "efficiency, 1 - E(ISCO)", kd_kerr_efficiency, offsetof(struct kd_selftest_orbit, efficiency) },
    };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        KD_TRY(radius(test, list[i].what, list[i].of, list[i].at));
    KD_TRY(bound_orbits(test));
    KD_TRY(mercury(test));
    KD_TRY(flux(test));
done:
    return status;
}
