/* Tests of epicyclic frequencies, effective potentials and frame dragging, compared with numbers computed from the
 * metric and Carter's potentials (tests/oracle/equator_reference.py). */
#include "physics/orbit/orbit_bound.h"
#include "physics/spacetime/epicyclic.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/potential.h"

#include "equator_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void within(const char *what, double a, double x, double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("%s at a = %.17g, %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, x, got, want,
                 fabs(got - want), bound);
}

/* The errors are a few ulp. kappa^2 vanishes at the ISCO, so that a sixteenth of the radius away from it the relative
 * error is ten times larger. At 1 - a = 1e-12, where r - 1 is 1e-4 and the rounding of r 1e-16, it is 1e4 times larger.
 */
static void frequencies(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(epicyclic_reference); i++) {
        const struct epicyclic_reference *e = &epicyclic_reference[i];
        double isco = kd_kerr_isco(kd_hole(e->a)), loss = 2e-15 * (e->r / (e->r - isco));
        within("kappa", e->a, e->r, kd_epicyclic_radial(kd_hole(e->a), e->r), e->radial, (1e-14 + loss) * e->radial);
        within("Omega_theta", e->a, e->r, kd_epicyclic_vertical(kd_hole(e->a), e->r), e->vertical, 1e-14 * e->vertical);
    }
    for (double a = -0.99; a < 1; a += 0.09) {
        double isco = kd_kerr_isco(kd_hole(a));
        assert_true(kd_epicyclic_radial(kd_hole(a), isco) == 0);
        assert_true(isnan(kd_epicyclic_radial(kd_hole(a), isco * (1 - 1e-9))));
        assert_true(kd_epicyclic_radial(kd_hole(a), isco * (1 + 1e-9)) > 0);
    }
    for (double r = 6.5; r < 1e6; r *= 3) /* Schwarzschild: kappa = Omega sqrt(1 - 6/r) */
        within("kappa", 0, r, kd_epicyclic_radial(kd_hole(0), r), sqrt(1 - 6 / r) / (r * sqrt(r)),
               1e-14 * pow(r, -1.5));
}

/* The reference is geodesics of small eccentricity by elliptic functions. Because of the shear their azimuth deviates
 * from uniform motion. The orbit starts at periastron, r = r0 (1 - e cos kappa t), so that phi lags by shear r0 e
 * sin(kappa t)/kappa. This holds to first order in e over the distance to the ISCO. */
static void shear(void **state)
{
    (void)state;
    const double e = 1e-6;
    for (double a = -0.9; a < 1; a += 0.19)
        for (double r = 1.1 * kd_kerr_isco(kd_hole(a)); r < 300; r *= 1.7) {
            struct kd_orbit orbit;
            struct kd_error error = { 0 };
            assert_int_equal(kd_orbit_from_shape(kd_hole(a), r, e, 1, &orbit, &error), KD_OK);
            struct kd_orbit_state start = kd_orbit_start(&orbit, NAN, true);
            struct kd_orbit_bound bound = kd_orbit_bound_of(&orbit, &start);
            struct kd_orbit_frequencies f = kd_orbit_frequencies_of(&bound);
            within("kappa of a geodesic", a, r, kd_epicyclic_radial(kd_hole(a), r), f.r, 1e-9 * f.r);
            double swing = -kd_epicyclic_shear(kd_hole(a), r) * r * e / f.r;
            for (double phase = 0.3; phase < 12; phase += 0.7) {
                struct kd_orbit_place at = kd_orbit_bound_at(&bound, phase / f.mino_r);
                within("swing of phi", a, r, at.phi - f.phi * at.t, swing * sin(f.r * at.t), 1e-4 * fabs(swing));
            }
        }
    for (double a = 0; a < 0.9985; a += 0.002) /* the whole range of spins that a disk may have */
        assert_true(kd_epicyclic_radial(kd_hole(a), kd_kerr_isco(kd_hole(a))) == 0);
}

static void potentials(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(potential_reference); i++) {
        const struct potential_reference *p = &potential_reference[i];
        /* If a L < 0, two terms cancel, and the error is relative to their size. Next to the horizon the error of r -
         * r+ is 1e-16 of r+. */
        double near = 1e-15 / (p->r - kd_hole(p->a)->outer),
               drag = fabs(kd_kerr_dragging(kd_hole(p->a), p->r, 0) * p->l);
        double loss = 2e-15 + fmin(near, 1e-9);
        within("V of matter", p->a, p->r, kd_potential(kd_hole(p->a), p->l, 1, p->r), p->matter,
               loss * (2 * drag + fabs(p->matter)));
        within("V of light", p->a, p->r, kd_potential(kd_hole(p->a), p->l, 0, p->r), p->light,
               loss * (2 * drag + fabs(p->light)));
    }
}

/* V is flat at its extrema, so the error of their radii is that of L(r) alone: 1e-13 except near the ISCO. */
static void turning_points(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(extrema_reference); i++) {
        const struct extrema_reference *e = &extrema_reference[i];
        struct kd_potential_extrema m = kd_potential_of_matter(kd_hole(e->a), e->l),
                                    f = kd_potential_of_light(kd_hole(e->a), e->l);
        double s = 1e-13;
        within("r_max", e->a, e->l, m.r_max, e->r_max, s * e->r_max);
        within("r_min", e->a, e->l, m.r_min, e->r_min, s * e->r_min);
        within("V_max", e->a, e->l, m.v_max, e->v_max, 1e-14 * e->v_max);
        within("V_min", e->a, e->l, m.v_min, e->v_min, 1e-14 * e->v_min);
        within("r of light", e->a, e->l, f.r_max, e->r_light, 1e-14 * e->r_light);
        within("V of light", e->a, e->l, f.v_max, e->v_light, 1e-14 * e->v_light);
    }
}

static void no_orbit(void **state)
{
    (void)state;
    for (double a = -0.95; a < 1; a += 0.1) {
        double least = kd_kerr_momentum(kd_hole(a), kd_kerr_isco(kd_hole(a)));
        assert_true(isnan(kd_potential_of_matter(kd_hole(a), least * (1 - 1e-9)).r_max));
        struct kd_potential_extrema above = kd_potential_of_matter(kd_hole(a), least * (1 + 1e-9));
        assert_true(above.r_max < kd_kerr_isco(kd_hole(a)) && above.r_min > kd_kerr_isco(kd_hole(a)) &&
                    above.v_max > above.v_min);
        assert_true(isnan(kd_potential_of_light(kd_hole(a), 0).r_max) &&
                    isnan(kd_potential_of_light(kd_hole(a), 3).r_min));
    }
    assert_true(isnan(kd_potential_of_matter(kd_hole(0), 0).r_max));
}

static void dragging(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(rotation_reference); i++) {
        const struct rotation_reference *d = &rotation_reference[i];
        double s = sqrt((1 - d->u) * (1 + d->u));
        within("omega", d->a, d->r, kd_kerr_dragging(kd_hole(d->a), d->r, d->u), d->omega, 2e-15 * fabs(d->omega));
        within("reach", d->a, d->r, kd_kerr_rotation_reach(kd_hole(d->a), d->r, d->u, s), d->reach, 2e-15 * d->reach);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(frequencies), cmocka_unit_test(shear),
                                        cmocka_unit_test(potentials),  cmocka_unit_test(turning_points),
                                        cmocka_unit_test(no_orbit),    cmocka_unit_test(dragging) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
