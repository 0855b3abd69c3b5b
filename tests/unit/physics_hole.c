/* Tests of the struct of a hole's constants and of the metric, compared with the same formulas in long double. */
#include "physics/spacetime/hole.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static const double spins[] = {
    0, 1e-120, 1e-9, -0.3, 0.5, -0.9, 0.998, 1 - 1e-9, -1 + 1e-12, 1 - 1e-15, 1 - DBL_EPSILON / 2,
};

static void close_to(const char *what, double a, double r, double got, long double want, double relative)
{
    if (!(fabsl(got - want) <= relative * fabsl(want)))
        fail_msg("%s at a = %.17g, r = %.17g: %.17g, not %.17Lg, allowed %.2g", what, a, r, got, want, relative);
}

static void horizons(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(spins); i++) {
        const double a = spins[i];
        const struct kd_hole hole = kd_hole_of(a);
        const long double root = sqrtl((1 - (long double)a) * (1 + (long double)a));
        assert_true(hole.a == a && hole.q == 0);
        close_to("root", a, 0, hole.root, root, 4e-16);
        close_to("outer", a, 0, hole.outer, 1 + root, 4e-16);
        close_to("inner", a, 0, hole.inner, (long double)a * a / (1 + root), 1e-15);
        const struct kd_hole turned = kd_hole_turned_of(&hole, -1);
        assert_true(turned.a == -a && turned.outer == hole.outer && turned.inner == hole.inner);
    }
    assert_true(isnan(kd_hole_of(1.5).outer) && isnan(kd_hole_of(-1.5).inner));
}

/* 1 - a^2 - q^2 exactly, for multiples of 2^-53. */
__extension__ typedef __int128 wide;
static long double exact_root2(double a, double q)
{
    const wide x = (wide)ldexp(fabs(a), 53), y = (wide)ldexp(fabs(q), 53);
    return ldexpl((long double)(((wide)1 << 106) - x * x - y * y), -106);
}

/* The same for charged holes, up to a^2 + q^2 = 1 - 1e-12. */
static void charged(void **state)
{
    (void)state;
    static const double left[] = { 0.9, 0.5, 1e-3, 1e-6, 1e-9, 1e-12 };
    for (size_t i = 0; i < COUNT(left); i++)
        for (int k = 0; k <= 20; k++) {
            const double turn = k * (M_PI / 20), size = sqrt(1 - left[i]);
            const double a = ldexp(rint(ldexp(size * cos(turn), 53)), -53),
                         q = ldexp(rint(ldexp(size * sin(turn), 53)), -53);
            const struct kd_hole hole = kd_hole_charged(a, q);
            const long double a2 = (long double)a * a, q2 = (long double)q * q, root2 = exact_root2(a, q);
            assert_true(hole.a == a && hole.q == q && kd_hole_exists(&hole));
            close_to("root", a, 0, hole.root, sqrtl(root2), 4e-16);
            close_to("outer", a, 0, hole.outer, 1 + sqrtl(root2), 4e-16);
            close_to("inner", a, 0, hole.inner, (a2 + q2) / (1 + sqrtl(root2)), 1e-15);
            const double r = 1.5 * hole.outer;
            const struct kd_metric_scalars m = kd_metric_at(&hole, r, 0.3);
            const long double delta = (long double)r * r - 2 * (long double)r + a2 + q2, w = (long double)r * r + a2,
                              area = w * w - a2 * delta * (1 - 0.3L) * (1 + 0.3L);
            close_to("Delta", a, r, m.delta, delta, 1e-14);
            close_to("Delta/r^2", a, r, kd_hole_delta_w(&hole, 1 / r), delta / ((long double)r * r), 1e-14);
            close_to("omega", a, r, m.omega, a * (2 * (long double)r - q2) / area, 1e-14);
        }
    for (size_t i = 0; i < COUNT(spins); i++) {
        const struct kd_hole least = kd_hole_charged(spins[i], 1e-300), none = kd_hole_of(spins[i]);
        assert_true(least.root == none.root && least.outer == none.outer && least.inner == none.inner);
    }
    assert_true(isnan(kd_hole_charged(0.8, 0.7).outer) && isnan(kd_hole_charged(0, 1.1).root));
    assert_false(kd_hole_exists(&(struct kd_hole) { 0 }) || kd_hole_exists(kd_hole(1)) || kd_hole_exists(kd_hole(NAN)));
}

/* Bounds: Delta is a product of two differences, and r - r+ has the error of r+ (half an ulp or one) divided by r -
 * r+. Sigma, A and omega are sums that do not cancel. */
static void metric(void **state)
{
    (void)state;
    static const double gaps[] = { 1e-12, 1e-9, 1e-6, 1e-3, 0.5, 1, 10, 1e6 }, cosines[] = { 0, 0.3, -0.8, 1 };
    for (size_t i = 0; i < COUNT(spins); i++)
        for (size_t j = 0; j < COUNT(gaps); j++)
            for (size_t k = 0; k < COUNT(cosines); k++) {
                const struct kd_hole hole = kd_hole_of(spins[i]);
                const double r = hole.outer * (1 + gaps[j]), u = cosines[k];
                const struct kd_metric_scalars m = kd_metric_at(&hole, r, u);
                const long double a = hole.a, x = r - 1.0L, root2 = (1 - a) * (1 + a), root = sqrtl(root2),
                                  delta = (x - root) * (x + root), sigma = (long double)r * r + a * a * u * u,
                                  w = (long double)r * r + a * a,
                                  area = w * w - a * a * delta * (1 - (long double)u * u);
                const double near = 2e-15 + 4 * DBL_EPSILON / gaps[j];
                close_to("Sigma", hole.a, r, m.sigma, sigma, 1e-15);
                close_to("Delta", hole.a, r, m.delta, delta, near);
                close_to("A", hole.a, r, m.area, area, 2e-15);
                close_to("omega", hole.a, r, m.omega, 2 * a * r / area, 3e-15);
                close_to("lapse^2", hole.a, r, m.lapse2, sigma * delta / area, near + 3e-15);
            }
}

/* Delta/r^2 as a function of w = 1/r. Its relative error is that of h = root w, an ulp or two, over 1 - w r+. The form
 * 1 - 2w + a^2 w^2 would have an error of 1e-16 over Delta/r^2; for the last spins here Delta/r^2 is smaller than
 * 1e-16. */
static void metric_of_the_inverse_radius(void **state)
{
    (void)state;
    static const double gaps[] = { 1e-12, 1e-9, 1e-6, 1e-3, 0.5, 1, 10, 1e6 };
    for (size_t i = 0; i < COUNT(spins); i++)
        for (size_t j = 0; j < COUNT(gaps); j++) {
            const struct kd_hole hole = kd_hole_of(spins[i]);
            const double w = 1 / (hole.outer * (1 + gaps[j]));
            const long double a = hole.a, root = sqrtl((1 - a) * (1 + a)), d = 1.0L - w, h = root * w;
            const double near = 1e-15 + 2 * DBL_EPSILON * (double)(h / (d - h));
            close_to("Delta/r^2", hole.a, 1 / w, kd_hole_delta_w(&hole, w), (d - h) * (d + h), near);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(horizons), cmocka_unit_test(charged), cmocka_unit_test(metric),
                                        cmocka_unit_test(metric_of_the_inverse_radius) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
