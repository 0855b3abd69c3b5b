/* Tests of the bending of light, compared with quadrature from the metric (tests/oracle/deflection_reference.py), with
 * published numbers, and with its limits of weak and strong fields. */
#include "physics/math/quadrature.h"
#include "physics/null/deflection.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/potential.h"

#include "deflection_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void close_to(const char *what, double a, double b, double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s at a = %.17g, b = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, b, got, want,
                 fabs(got / want - 1), relative);
}

static void critical(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(critical_reference); i++) {
        double a = critical_reference[i].a;
        close_to("critical", a, 0, kd_deflection_critical(kd_hole(a)), critical_reference[i].b, 1e-15);
    }
    close_to("critical", 0, 0, kd_deflection_critical(kd_hole(0)), sqrt(27), 1e-15);
    /* the edges of the extremal hole's shadow (Bardeen 1973) */
    double most = 1 - 1e-15;
    close_to("critical", 1, 0, kd_deflection_critical(kd_hole(most)), 2, 1e-7); /* 2 + sqrt(3) sqrt(2 (1 - a)) */
    close_to("critical", -1, 0, kd_deflection_critical(kd_hole(-most)), 7, 1e-14);
}

/* The errors are within those of the header. The closest approach is a root that becomes double on the critical ray.
 * Near that ray its error is therefore a square root of the rounding. */
static void angles(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(bending_reference); i++) {
        const struct bending_reference *x = &bending_reference[i];
        double digit = x->a > 0.99 ? 1e-14 : 1e-15;
        close_to("angle", x->a, x->b, kd_deflection(kd_hole(x->a), x->b), x->angle, 1e-14 + digit / x->excess);
        close_to("closest", x->a, x->b, kd_deflection_closest(kd_hole(x->a), x->b), x->closest,
                 1e-15 + digit / sqrt(x->excess));
    }
}

/* Light turns where V = 1/b, with the effective potential of Bardeen, Press & Teukolsky, which does not use the
 * roots of R; for a = 0 the radius is also the middle root of r^3 - b^2 r + 2 b^2 = 0, by Vieta's formula. */
static void farthest(void **state)
{
    (void)state;
    for (double a = -0.96; a < 1; a += 0.24)
        for (double x = 0.01; x < 1e4; x *= 7) {
            double critical = kd_deflection_critical(kd_hole(a)), b = critical * (1 + x),
                   r = kd_deflection_farthest(kd_hole(a), b);
            /* already at the horizon the potential is above 1/b: no turning point */
            if (kd_potential(kd_hole(a), 1, 0, kd_hole(a)->outer) > 1 / b) {
                assert_true(isnan(r));
                continue;
            }
            if (!(r < kd_kerr_photon_orbit(kd_hole(a)) && r >= kd_hole(a)->outer))
                fail_msg("a = %g, b = %g: farthest %g", a, b, r);
            close_to("1/V there", a, b, 1 / kd_potential(kd_hole(a), 1, 0, r), b, 1e-12 * (1 + x));
        }
    for (double b = 5.3; b < 1e3; b *= 3) {
        double vieta = 2 * b / sqrt(3) * cos(acos(-sqrt(27) / b) / 3 - 2 * M_PI / 3);
        close_to("farthest", 0, b, kd_deflection_farthest(kd_hole(0), b), vieta, 1e-15 * b * b);
    }
    assert_true(isnan(kd_deflection_farthest(kd_hole(0), 5)));
}

/* 1.75 seconds of arc at the limb of the sun (Einstein 1916; here with M/R = 1476.625 m / 6.957e8 m, b = R to 1e-5). */
static void the_sun(void **state)
{
    (void)state;
    double b = 6.957e8 / 1476.625, arcsec = M_PI / 648000;
    close_to("the sun", 0, b, kd_deflection(kd_hole(0), b) / arcsec, 1.7512, 1e-4);
}

/* The two methods of computing the angle agree at b = 20, where the code changes between them. The angle falls with b,
 * and is larger for a hole that rotates against the light. */
static void smooth_and_monotone(void **state)
{
    (void)state;
    for (int k = -10; k <= 10; k++) {
        double a = 0.0999 * k, last = INFINITY;
        close_to("the seam", a, 20, kd_deflection(kd_hole(a), 20), kd_deflection(kd_hole(a), nextafter(20, 21)), 2e-14);
        for (double x = -8; x < 8; x += 0.25) {
            double b = kd_deflection_critical(kd_hole(a)) * (1 + pow(10, x)), angle = kd_deflection(kd_hole(a), b);
            if (!(angle < last && angle > 0))
                fail_msg("a = %g, b = %g: %g after %g", a, b, angle, last);
            if (k < 10 && b > kd_deflection_critical(kd_hole(a - 0.0999)) &&
                !(kd_deflection(kd_hole(a - 0.0999), b) > angle))
                fail_msg("a = %g, b = %g: not more against the spin", a, b);
            last = angle;
        }
    }
}

/* The error of the weak-field formula is of the next order, with the coefficients of Iyer & Hioki 2009: (128/3 - 10
 * pi a + 4 a^2)/b^3. */
static void weak_field(void **state)
{
    (void)state;
    for (double a = -0.9; a < 1; a += 0.3)
        for (double b = 1e3; b < 2e5; b *= 10) {
            double angle = kd_deflection(kd_hole(a), b);
            close_to("first order", a, b, (angle - kd_deflection_weak(b)) * b * b, 15 * M_PI / 4 - 4 * a, 100 / b);
            double third = (angle - kd_deflection_weak_second(kd_hole(a), b)) * b * b * b;
            close_to("second order", a, b, third, 128.0 / 3 - 10 * M_PI * a + 4 * a * a, 30 / b + 1e-16 * b * b);
        }
}

/* Bozza 2002 gives a rate of 1 and an offset of -0.40023 at a = 0. At other spins the error of the limit must fall
 * as delta ln(delta). */
static void strong_limit(void **state)
{
    (void)state;
    struct kd_deflection_strong s = kd_deflection_strong(kd_hole(0));
    close_to("rate", 0, 0, s.rate, 1, 1e-14);
    close_to("offset", 0, 0, s.offset, log(216 * (7 - 4 * sqrt(3))) - M_PI, 1e-13);
    for (double a = -0.98; a < 1; a += 0.14) {
        s = kd_deflection_strong(kd_hole(a));
        for (double x = -6; x < -3.5; x += 0.5) {
            double delta = pow(10, x),
                   exact = kd_deflection(kd_hole(a), kd_deflection_critical(kd_hole(a)) * (1 + delta));
            double off = fabs(exact - (s.offset - s.rate * log(delta)));
            /* the coefficient grows towards the extremal hole, where the photon orbit meets the horizon */
            if (!(off < 3 * s.rate * s.rate * s.rate * delta * fabs(log(delta)) + 1e-14 / delta * s.rate))
                fail_msg("a = %g, delta = %g: off by %g", a, delta, off);
        }
    }
}

static void outside_the_domain(void **state)
{
    (void)state;
    assert_true(isnan(kd_deflection(kd_hole(0), 5)) && isnan(kd_deflection_closest(kd_hole(0), 5)));
    assert_true(isnan(kd_deflection(kd_hole(1), 30)) && isnan(kd_deflection(kd_hole(0), NAN)) &&
                isnan(kd_deflection_critical(kd_hole(1))));
    assert_true(isnan(kd_deflection_strong(kd_hole(-1.5)).rate));
    assert_true(isnan(kd_deflection(kd_hole(0.5), -30)));
}

/* x^p y^q, whose integral is Euler's beta function. It has an integrable singularity at either end. */
static double power(double x, double y, const void *context)
{
    const double *p = context;
    return pow(x, p[0]) * pow(y, p[1]);
}

static double rough(double x, double y, const void *context)
{
    (void)context, (void)y;
    return fmod(x * 977, 1) < 0.5 ? 1e6 * x : 0;
}

static void quadrature(void **state)
{
    (void)state;
    for (double p = -0.75; p < 3; p += 0.375)
        for (double q = -0.75; q < 3; q += 0.375) {
            double want = tgamma(p + 1) * tgamma(q + 1) / tgamma(p + q + 2);
            close_to("beta", p, q, kd_quadrature(power, (double[]) { p, q }), want, 1e-13);
        }
    assert_true(isnan(kd_quadrature(rough, NULL)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(critical),
        cmocka_unit_test(angles),
        cmocka_unit_test(farthest),
        cmocka_unit_test(the_sun),
        cmocka_unit_test(weak_field),
        cmocka_unit_test(strong_limit),
        cmocka_unit_test(smooth_and_monotone),
        cmocka_unit_test(quadrature),
        cmocka_unit_test(outside_the_domain),
    };
    return cmocka_run_group_tests_name("physics_deflection", tests, NULL, NULL);
}
