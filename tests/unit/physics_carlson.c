/* Tests of Carlson's and Legendre's integrals, compared with quadratures of their definitions to 40 digits
 * (tests/oracle/null_reference.py). Jacobi's functions are compared with the integrals that they invert. */
#include "physics/math/carlson.h"
#include "physics/math/elliptic.h"

#include "carlson_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void close_to(const char *what, double x, double y, double got, double want, double relative)
{
    if (got == want)
        return;
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s(%.17g, %.17g, ...): %.17g, not %.17g: off by %.2g, allowed %.2g", what, x, y, got, want,
                 fabs(got / want - 1), relative);
}

/* Each integral takes some five steps with a few roundings each, and all terms are positive. The bound is therefore
 * 2e-15. */
static void symmetric(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(carlson_reference); i++) {
        const struct carlson_reference *c = &carlson_reference[i];
        close_to("R_F", c->x, c->y, kd_carlson_rf(c->x, c->y, c->z), c->rf, 2e-15);
        close_to("R_F", c->z, c->x, kd_carlson_rf(c->z, c->x, c->y), c->rf, 2e-15);
        close_to("R_D", c->x, c->y, kd_carlson_rd(c->x, c->y, c->z), c->rd, 2e-15);
        close_to("R_J", c->x, c->y, kd_carlson_rj(c->x, c->y, c->z, c->p), c->rj, 2e-15);
        close_to("R_J", c->z, c->x, kd_carlson_rj(c->z, c->x, c->y, c->p), c->rj, 2e-15);
    }
}

/* For z = y + iv, computes sqrt(z) + sqrt(conj z) = 2 Re sqrt(z), and |z|, without cancellation for either sign of y.
 * */
static struct kd_carlson_arg conjugate(double x, double y, double v)
{
    double root = hypot(y, v);
    return (struct kd_carlson_arg) { sqrt(x), sqrt(2 * (y > 0 ? root + y : v * v / (root - y))), root };
}

static void conjugates(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(carlson_pairs); i++) {
        struct kd_carlson_arg arg = conjugate(carlson_pairs[i].x, carlson_pairs[i].y, carlson_pairs[i].v);
        double p = carlson_pairs[i].p;
        close_to("R_F pair", arg.first, arg.sum, kd_carlson_rf_arg(arg), carlson_pairs[i].rf, 2e-15);
        close_to("R_J pair", arg.first, p, kd_carlson_rj_arg(arg, p), carlson_pairs[i].rj, 4e-15);
        close_to("R_D pair", arg.first, arg.sum, kd_carlson_rd_arg(arg), carlson_pairs[i].rd, 4e-15);
    }
}

static void complex_p(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(carlson_complex); i++) {
        double y = carlson_complex[i].y, z = carlson_complex[i].z;
        struct kd_carlson_arg arg = { sqrt(carlson_complex[i].x), sqrt(y) + sqrt(z), sqrt(y * z) };
        double complex got = kd_carlson_rj_complex(arg, carlson_complex[i].q + I * carlson_complex[i].v);
        double complex want = carlson_complex[i].re + I * carlson_complex[i].im;
        if (!(cabs(got - want) <= 4e-15 * cabs(want)))
            fail_msg("R_J complex %zu: off by %.2g", i, cabs(got / want - 1));
    }
}

/* Published values: Carlson 1995, section 3. */
static void published(void **state)
{
    (void)state;
    close_to("R_C", 0, 0.25, kd_carlson_rc(0, 0.25), M_PI, 1e-15);
    close_to("R_C", 2.25, 2, kd_carlson_rc(2.25, 2), M_LN2, 1e-15);
    close_to("R_C", 0.25, -2, kd_carlson_rc(0.25, -2), M_LN2 / 3, 1e-15);
    close_to("R_J", 2, 3, kd_carlson_rj(2, 3, 4, -0.5), 0.24723819703052, 1e-13);
    close_to("R_J", 2, 3, kd_carlson_rj(2, 3, 4, -5), -0.12711230042964, 1e-13);
    double complex j = kd_carlson_rj_complex((struct kd_carlson_arg) { sqrt(2), sqrt(3) + 2, sqrt(12) }, -1 + I);
    assert_true(isnan(creal(j))); /* the real part of p must be positive */
}

static void domain(void **state)
{
    (void)state;
    assert_true(isnan(kd_carlson_rf(-1, 1, 2)));
    assert_true(isinf(kd_carlson_rf(0, 0, 2)));
    assert_true(isnan(kd_carlson_rc(-1, 1)));
    assert_true(isinf(kd_carlson_rc(1, 0)));
    assert_true(isnan(kd_carlson_rj(1, NAN, 2, 3)));
    assert_true(isinf(kd_carlson_rj(1, 2, 3, 0)));
    assert_true(isinf(kd_carlson_rd(1, 2, 0)));
    assert_true(isnan(kd_carlson_rd(1, -2, 1)));
}

static void legendre(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(legendre_reference); i++) {
        double n = legendre_reference[i].n, phi = legendre_reference[i].phi, m = legendre_reference[i].m;
        close_to("F", phi, m, kd_elliptic_f(phi, m), legendre_reference[i].f, 1e-14);
        close_to("E", phi, m, kd_elliptic_e(phi, m), legendre_reference[i].e, 1e-14);
        close_to("Pi", phi, m, kd_elliptic_pi(n, phi, m), legendre_reference[i].pi, 1e-14);
    }
    /* Legendre's relation connects the complete integrals. */
    for (double m = 0.0625; m < 1; m += 0.0625) {
        double k = kd_elliptic_k(m), k1 = kd_elliptic_k(1 - m), e = kd_elliptic_e_complete(m),
               e1 = kd_elliptic_e_complete(1 - m);
        close_to("Legendre", m, 0, e * k1 + e1 * k - k * k1, 0.5 * M_PI, 4e-15);
    }
}

/* Tests F(am(u)|m) = u down to 1 - m = 1e-15. There K is 19, so that a small error in the modulus would be visible. The
 * rounding of K contributes K/u times the machine epsilon, relative to u. */
static void jacobi(void **state)
{
    (void)state;
    static const double complement[] = { 1, 0.75, 0.5, 0.1, 1e-3, 1e-8, 1e-15, 1e-40 };
    for (size_t i = 0; i < COUNT(complement); i++) {
        double m1 = complement[i], m = 1 - m1, k = kd_carlson_rf(0, m1, 1);
        for (double x = 0.0625; x < 1; x += 0.0625) {
            double u = x * k;
            struct kd_jacobi j = kd_jacobi(u, m, m1);
            double back = j.sn * kd_carlson_rf(j.cn * j.cn, m1 + m * j.cn * j.cn, 1);
            close_to("F(am(u))", u, m, back, u, 4e-15 + 4e-16 * k / u);
            close_to("sn^2 + cn^2", u, m, j.sn * j.sn + j.cn * j.cn, 1, 1e-15);
            close_to("am", u, m, sin(kd_jacobi_am(u, m, m1)), j.sn, 1e-15);
        }
    }
    struct kd_jacobi j = kd_jacobi(0.75, 1, 0);
    close_to("sn", 0.75, 1, j.sn, tanh(0.75), 1e-15);
    close_to("cn", 0.75, 1, j.cn, 1 / cosh(0.75), 1e-15);
    assert_true(isnan(kd_jacobi(1, -1, 2).sn));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(symmetric), cmocka_unit_test(conjugates), cmocka_unit_test(complex_p),
        cmocka_unit_test(published), cmocka_unit_test(domain),     cmocka_unit_test(legendre),
        cmocka_unit_test(jacobi),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
