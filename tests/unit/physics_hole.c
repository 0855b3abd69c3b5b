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

/* Delta is a product of two differences: r - r+ has the error of r+, half an ulp or one, over r - r+. Sigma, A and
 * omega are sums that do not cancel. */
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

/* Delta/r^2 of w = 1/r: the error is that of h = root w, an ulp or two, over 1 - w r+. 1 - 2w + a^2 w^2 would have one
 * of 1e-16 over Delta/r^2, which is smaller than that for the last spins here. */
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
    const struct CMUnitTest tests[] = { cmocka_unit_test(horizons), cmocka_unit_test(metric),
                                        cmocka_unit_test(metric_of_the_inverse_radius) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
