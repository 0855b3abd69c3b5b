/* Tests of the torus of Fishbone & Moncrief, compared with the equation of motion of gas that pressure supports, d ln h
 * = g_ab,r u^a u^b dr/2, integrated from the inner edge. */
#include "physics/disk/torus.h"
#include "physics/spacetime/hole.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* g_tt, g_tphi, g_phiphi in the plane. */
static void metric(double a, double r, double g[3])
{
    g[0] = -(1 - 2 / r);
    g[1] = -2 * a / r;
    g[2] = r * r + a * a + 2 * a * a / r;
}

/* The angular velocity at which u^t u_phi is l, by bisection between the limits for matter. */
static double turns(const double g[3], double l, double *time)
{
    const double omega = -g[1] / g[2], reach = sqrt(g[1] * g[1] - g[0] * g[2]) / g[2];
    double low = omega - reach, high = omega + reach;
    for (int i = 0; i < 200; i++) {
        const double w = 0.5 * (low + high), t2 = -1 / (g[0] + 2 * w * g[1] + w * w * g[2]);
        *(t2 * (g[1] + w * g[2]) < l ? &low : &high) = w;
        *time = sqrt(t2);
    }
    return 0.5 * (low + high);
}

static double slope(double a, double l, double r)
{
    const double step = 2e-5 * r;
    double g[3], up[3], down[3], time;
    metric(a, r, g);
    metric(a, r + step, up);
    metric(a, r - step, down);
    const double w = turns(g, l, &time);
    return 0.5 * time * time * ((up[0] - down[0]) + 2 * w * (up[1] - down[1]) + w * w * (up[2] - down[2])) / (2 * step);
}

static void enthalpy_holds_the_gas(void **state)
{
    (void)state;
    static const double cases[][3] = { { 0.9375, 6, 12 }, { 0, 6, 12 }, { 0.5, 10, 20 }, { -0.7, 9, 16 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double a = cases[i][0], inner = cases[i][1], most = cases[i][2];
        const struct kd_torus t = kd_torus_of(kd_hole(a), inner, most);
        enum { PARTS = 400 };
        double sum = 0, h = (most - inner) / PARTS;
        for (int k = 0; k < PARTS; k++)
            sum += h / 6 *
                   (slope(a, t.l, inner + k * h) + 4 * slope(a, t.l, inner + (k + 0.5) * h) +
                    slope(a, t.l, inner + (k + 1) * h));
        if (!(fabs(sum / t.log_most - 1) < 1e-6))
            fail_msg("a = %g, from %g to %g M: ln h = %.9g, integrated %.9g", a, inner, most, t.log_most, sum);
        /* ln h is largest at the pressure maximum, where the gas moves freely. */
        assert_true(fabs(slope(a, t.l, most)) < 1e-6 && slope(a, t.l, 0.9 * most) > 0 && slope(a, t.l, 1.1 * most) < 0);
        assert_true(t.outer > most && fabs(kd_torus_log_enthalpy(&t, kd_hole(a), t.outer, 0)) < 1e-9);
        assert_true(t.height > 0.1 && t.height < 0.95);
        printf("a = %g: ln h %.6g, outer edge %.6g M, |cos| up to %.4g\n", a, t.log_most, t.outer, t.height);
    }
    assert_true(isinf(kd_torus_of(kd_hole(0.9375), 6, 40).outer));
}

/* ln h in long double, with Delta as a product of its factors. */
static long double exact(long double a, long double l, long double r, long double u)
{
    const long double root = sqrtl((1 - a) * (1 + a)), delta = (r - 1 - root) * (r - 1 + root), w = r * r + a * a,
                      sigma = r * r + a * a * u * u, s2 = (1 - u) * (1 + u), big = w * w - a * a * delta * s2,
                      lapse2 = sigma * delta / big,
                      u2 = 0.5L * (sqrtl(1 + 4 * l * l * lapse2 * sigma / (big * s2)) - 1);
    return 0.5L * (log1pl(u2) - logl(lapse2)) - u2 - 2 * a * r / big * l;
}

/* ln h contains half the logarithm of Delta. Next to the horizon its error is therefore the rounding of r+ over r - r+,
 * at any spin. When Delta was computed as r^2 - 2r + a^2, which cancels, the error was 700 times that at a =
 * 0.999999. */
static void enthalpy_holds_beside_the_horizon(void **state)
{
    (void)state;
    static const double spins[] = { 0, 0.5, -0.9375, 0.998, 0.999999 };
    const struct kd_torus torus = { .l = 3 };
    for (size_t i = 0; i < sizeof spins / sizeof *spins; i++)
        for (int e = 3; e <= 12; e++)
            for (int k = 0; k < 100; k++) {
                const struct kd_hole hole = kd_hole_of(spins[i]);
                const double gap = pow(10, -e) * (1 + 0.01 * k), r = hole.outer * (1 + gap);
                const double got = kd_torus_log_enthalpy(&torus, &hole, r, 0.3);
                const double off = (double)fabsl(got - exact(hole.a, 3, r, 0.3));
                if (!(off < 2e-14 + 2.3e-16 / gap))
                    fail_msg("a = %g, %g of r+ outside it: ln h is off by %.2g", hole.a, gap, off);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(enthalpy_holds_the_gas),
                                        cmocka_unit_test(enthalpy_holds_beside_the_horizon) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
