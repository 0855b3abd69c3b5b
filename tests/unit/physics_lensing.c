/* Tests of lensing bands, compared with quadratures in 60 digits (tests/oracle/critical_reference.py), with published
 * intervals, and with rays traced in closed form. Also tests the demagnification from order to order. */
#include "physics/null/lensing.h"

#include "physics/math/root.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include "critical_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static struct kd_critical curve_of(double spin, double cos_theta)
{
    struct kd_critical_observer o = { .hole = kd_hole_of(spin), .radius = INFINITY, .cos_theta = cos_theta };
    return kd_critical_of(&o);
}

static void against_the_oracle(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(band_reference); i++) {
        const struct band_reference *e = &band_reference[i];
        struct kd_critical c = curve_of(e->spin, e->cos_theta);
        struct kd_critical_point p = kd_critical_at(&c, e->angle * M_PI / 180);
        double d = kd_lensing_edge(&c, &p, e->order, e->source);
        if (!(fabs(d / e->distance - 1) < 4e-14 + 1e-16 / sqrt(1 - e->spin)))
            fail_msg("row %zu: %.17g, not %.17g", i, d, e->distance);
        /* kd_lensing_source must invert d. |d ln r/d ln d| is at most about 10, except at infinity and at the
         * horizon */
        double r = kd_lensing_source(&c, &p, e->order, d);
        if (e->source == 6 && !(fabs(r / 6 - 1) < 1e-12))
            fail_msg("row %zu: source at %.17g", i, r);
    }
}

/* Gralla, Holz & Wald 2019, arXiv:1906.00873, section III: face on without spin, the lensing ring is 5.02 < b
 * < 6.17, the photon ring 5.19 < b < 5.23. */
static void the_rings_of_gralla_holz_wald(void **state)
{
    (void)state;
    const double published[2][2] = { { 5.02, 6.17 }, { 5.19, 5.23 } };
    struct kd_critical c = curve_of(0, 1);
    struct kd_critical_point p = kd_critical_at(&c, 0.5);
    for (int n = 1; n <= 2; n++) {
        double low = p.rho * (1 + kd_lensing_edge(&c, &p, n, 2)),
               high = p.rho * (1 + kd_lensing_edge(&c, &p, n, INFINITY));
        assert_true(fabs(low - published[n - 1][0]) <= 0.005 && fabs(high - published[n - 1][1]) <= 0.005);
    }
}

/* The same edges are found by rays in closed form, as long as alpha and beta can resolve the distance from the critical
 * curve. Just inside an edge the source is nearer. */
static void rays_agree(void **state)
{
    (void)state;
    const double spins[] = { 0, 0.5, 0.9, -0.9, 0.998 }, cosines[] = { 1, 0.5, 0.1, -0.7 },
                 sources[] = { 1.9999, 3, 6, 40 };
    for (int k = 0; k < 5 * 4 * 4 * 3 * 5; k++) {
        double a = spins[k % 5], u = cosines[k / 5 % 4], source = sources[k / 20 % 4], angle = 0.7 + 2 * (k / 80 % 3);
        int n = 1 + k / 240;
        struct kd_critical c = curve_of(a, u);
        struct kd_critical_point p = kd_critical_at(&c, angle);
        if (source <= kd_hole(a)->outer)
            continue;
        double d = kd_lensing_edge(&c, &p, n, source);
        if (isnan(d)) {
            if (n > 1 || fabs(u) > 0.3) /* the ray is on the other side of the centre */
                fail_msg("a = %g, u = %g, angle %g, n = %d, source %g: no edge", a, u, angle, n, source);
            continue;
        }
        struct kd_null_ray ray = { .hole = kd_hole_of(a), .radius = INFINITY, .cos_theta = u, .orders = n + 1 };
        ray.alpha = p.alpha + d * (p.alpha - c.centre), ray.beta = p.beta + d * p.beta;
        struct kd_null_path path = kd_null_trace(&ray);
        assert_true(path.crossings > n);
        /* the rounding of d, which is a difference of values of alpha and beta, times d ln r/d ln d */
        double r = path.crossing[n].r, allowed = 1e-12 + 100 * 1e-15 / fabs(d);
        if (!(fabs(r / source - 1) < allowed))
            fail_msg("a = %g, u = %g, angle %g, n = %d, source %g: d = %g sees %.15g, off by %.2g, allowed %.2g", a, u,
                     angle, n, source, d, r, r / source - 1, allowed);
    }
}

/* From order to order d falls by a factor that tends to e^-gamma, at any source radius. The difference from the limit
 * falls by about the same factor, or is of order d. The test goes to n = 30, where d is 1e-41 at a = 0 and still has
 * all its digits. Near a = 1 the limit is reached only at high orders. */
static void demagnification(void **state)
{
    (void)state;
    const double spins[] = { 0, 0.5, 0.9, 0.998, 1 - 1e-6 }, cosines[] = { 1, 0.5, 0.1736 };
    for (int k = 0; k < 5 * 3 * 4 * 3; k++) {
        double a = spins[k % 5], u = cosines[k / 5 % 3], angle = -2.9 + 1.9 * (k / 15 % 4);
        double source = k / 60 == 0 ? kd_hole(a)->outer : k / 60 == 1 ? 8 : INFINITY;
        struct kd_critical c = curve_of(a, u);
        struct kd_critical_point p = kd_critical_at(&c, angle);
        double gamma = kd_shell_exponents(&p.orbit).gamma, last = NAN, last_off = 1, floor = 1e-13 / sqrt(1 - a);
        for (int n = 2; n <= 30; n++) {
            double d = kd_lensing_edge(&c, &p, n, source), off = d / last * exp(gamma) - 1;
            assert_true(d < 0 ? source < 2.1 : source > 2.1);
            if (n > 2) {
                if (!(fabs(off) < fmax(1.7 * last_off * exp(-gamma), 100 * fabs(last)) + floor) && n > 4 && a < 0.999)
                    fail_msg("a = %.17g, u = %g, angle %g, source %g, n = %d: d = %g, ratio %.15g, not %.15g "
                             "(%g, before %g)",
                             a, u, angle, source, n, d, d / last, exp(-gamma), off, last_off);
                last_off = fabs(off);
            }
            last = d;
        }
        if (!(last_off < 1e4 * fabs(last) + floor))
            fail_msg("a = %.17g, u = %g, angle %g, source %g: d = %g, still off by %g", a, u, angle, source, last,
                     last_off);
    }
}

static void where_there_is_none(void **state)
{
    (void)state;
    struct kd_critical c = curve_of(0.9, 0.5);
    struct kd_critical_point p = kd_critical_at(&c, 1);
    assert_true(isnan(kd_lensing_edge(&c, &p, 0, 6)) && isnan(kd_lensing_edge(&c, &p, 1, 1)) &&
                isnan(kd_lensing_edge(&c, &p, 1, NAN)));
    assert_true(isinf(kd_lensing_source(&c, &p, 2, 0.5)) && kd_lensing_source(&c, &p, 2, -0.5) == 0);
    struct kd_critical flat = curve_of(0.9, 0); /* seen from the plane */
    struct kd_critical_point end = kd_critical_at(&flat, 0);
    assert_true(isnan(kd_lensing_edge(&flat, &end, 2, 6)));
}

static double cubic(const void *root, double x)
{
    double y = x - *(const double *)root;
    return y * y * y;
}

static double step(const void *root, double x) { return x < *(const double *)root ? -1 : 1; }

static void roots(void **state)
{
    (void)state;
    const double at[] = { 0.1, -3.7, 1e-9, 5 };
    for (size_t i = 0; i < COUNT(at); i++) {
        assert_true(fabs(kd_root(step, &at[i], -4, 5) - at[i]) < 1e-14);
        assert_true(fabs(kd_root(step, &at[i], 5, -4) - at[i]) < 1e-14);
        assert_true(fabs(kd_root(cubic, &at[i], -4, 5) - at[i]) < 1e-5);
    }
    assert_true(isnan(kd_root(step, &at[0], 1, 2)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_the_oracle),  cmocka_unit_test(the_rings_of_gralla_holz_wald),
        cmocka_unit_test(rays_agree),          cmocka_unit_test(demagnification),
        cmocka_unit_test(where_there_is_none), cmocka_unit_test(roots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
