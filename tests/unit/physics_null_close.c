/* Tests of light about holes whose horizons are close to each other, where the integrals over 1/(r - r+) and 1/(r - r-)
 * agree in many digits. Their difference gives the integral over 1/Delta. The reference is a quadrature in 38
 * digits. */
#include "null_close.h"

#include "physics/math/carlson.h"
#include "physics/null/null_radial.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void slopes(void **state)
{
    (void)state;
    double worst[2] = { 0 };
    for (size_t i = 0; i < COUNT(carlson_slopes); i++) {
        const struct carlson_slope *c = &carlson_slopes[i];
        const double ry = sqrt(c->y), rz = sqrt(c->z);
        const struct kd_carlson_arg arg = { sqrt(c->x), ry + rz, ry * rz };
        worst[0] = fmax(worst[0], fabs(kd_carlson_rj_slope(arg, c->p, c->q) / c->rj - 1));
        worst[0] = fmax(worst[0], fabs(kd_carlson_rj_slope(arg, c->q, c->p) / c->rj - 1));
        worst[1] = fmax(worst[1], fabs(kd_carlson_rc_slope(c->p, c->q) / c->rc - 1));
        worst[1] = fmax(worst[1], fabs(kd_carlson_rc_slope(c->q, c->p) / c->rc - 1));
    }
    print_message("slopes of R_J off by at most %.1e, of R_C by %.1e\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-14 && worst[1] < 1e-14);
    const struct kd_carlson_arg arg = { 1, 2, 1 };
    assert_true(isnan(kd_carlson_rj_slope(arg, -1, 1)) && isnan(kd_carlson_rj_slope(arg, 1, 0)));
    assert_true(isnan(kd_carlson_rc_slope(-1, 1)) && isnan(kd_carlson_rc_slope(1, 0)));
}

/* Sum of the integrals from r to the reference. */
static struct kd_null_radial_sum from(const struct kd_null_motion *m, const struct kd_null_roots *roots, double r)
{
    if (roots->kind == KD_NULL_NO_REAL)
        return kd_null_radial_complex(m, roots, r);
    const struct kd_null_radial q =
        kd_null_radial_of(m, roots, kd_null_region_of(roots, r) == KD_NULL_INNER, KD_NULL_TAU_PHI_T);
    const struct kd_null_radius at = kd_null_radius_of(&q, r);
    return kd_null_radial_integrals(&q, &at);
}

/* The allowed errors are relative to the larger of the two integrals whose difference is tested. */
static void integrals(void **state)
{
    (void)state;
    static const char *const kinds[] = { "four real roots", "two", "none" };
    double worst[3][3] = { { 0 } };
    int count[3] = { 0 }, inner = 0;
    for (size_t i = 0; i < COUNT(null_close); i++) {
        const struct null_close *c = &null_close[i];
        const struct kd_hole hole = kd_hole_charged(c->a, c->q);
        const struct kd_null_motion m = kd_null_motion_of(&hole, c->cos_theta, 0, c->alpha, c->beta);
        const struct kd_null_roots roots = kd_null_roots_of(&m);
        const struct kd_null_radial_sum near = from(&m, &roots, c->r),
                                        far = c->end > 0 ? from(&m, &roots, c->end) : (struct kd_null_radial_sum) { 0 };
        const double off[3] = { (near.tau - far.tau) / c->tau - 1,
                                (near.phi - far.phi - c->phi) / fmax(1, fabs(c->phi)),
                                (near.t - far.t - c->t) / fmax(fabs(c->t), 100) };
        count[roots.kind]++;
        inner += c->end == 0;
        for (int k = 0; k < (roots.kind == KD_NULL_NO_REAL ? 2 : 3); k++)
            worst[roots.kind][k] = fmax(worst[roots.kind][k], fabs(off[k]));
    }
    for (int k = 0; k < 3; k++)
        print_message("%s: %d, tau off by at most %.1e, phi by %.1e, t by %.1e\n", kinds[k], count[k], worst[k][0],
                      worst[k][1], worst[k][2]);
    print_message("%d within the photon orbits\n", inner);
    for (int k = 0; k < 3; k++)
        assert_true(count[k] > 5 && worst[k][0] < 3e-14 && worst[k][1] < 3e-14 && worst[k][2] < 3e-14);
    assert_true(inner > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(slopes), cmocka_unit_test(integrals) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
