/* Tests of quasi-normal modes, compared with Teukolsky's equation solved by another method
 * (tests/oracle/qnm_reference.py), with published numbers, and with properties that all modes have. */
#include "physics/spacetime/hole.h"
#include "physics/waves/qnm.h"
#include "physics/waves/ringdown.h"

#include "qnm_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static struct kd_qnm found(int l, int m, int n, double a)
{
    struct kd_qnm mode;
    if (!kd_qnm_find(l, m, n, kd_hole(a), &mode))
        fail_msg("l = %d, m = %d, n = %d, a = %.17g: no mode", l, m, n, a);
    return mode;
}

static void close_to(const char *what, int l, int m, int n, double a, double complex got, double complex want,
                     double relative)
{
    if (!(cabs(got - want) <= relative * cabs(want)))
        fail_msg("%s at l = %d, m = %d, n = %d, a = %.17g: %.17g %+.17gi, not %.17g %+.17gi", what, l, m, n, a,
                 creal(got), cimag(got), creal(want), cimag(want));
}

/* The header states an error of 1e-13 up to a = 0.99 and 1e-12 beyond. */
static void another_method(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(qnm_reference); i++) {
        const struct qnm_reference *q = &qnm_reference[i];
        double relative = q->a <= 0.99 ? 1e-13 : 1e-12;
        struct kd_qnm mode = found(q->l, q->m, q->n, q->a);
        close_to("omega", q->l, q->m, q->n, q->a, mode.omega, q->re + I * q->im, relative);
        close_to("A", q->l, q->m, q->n, q->a, mode.separation, q->separation_re + I * q->separation_im, relative);
    }
}

/* Leaver 1985, table 1 (2M = 1): six decimals. */
static void leaver_schwarzschild(void **state)
{
    (void)state;
    static const struct {
        int l, n;
        double re, im;
    } printed[] = {
        { 2, 0, 0.747343, -0.177925 }, { 2, 1, 0.693422, -0.547830 }, { 2, 2, 0.602107, -0.956554 },
        { 2, 3, 0.503010, -1.410296 }, { 3, 0, 1.198887, -0.185406 }, { 3, 1, 1.165288, -0.562596 },
    };
    for (size_t i = 0; i < COUNT(printed); i++) {
        double complex omega = 2 * found(printed[i].l, 0, printed[i].n, 0).omega;
        if (!(fabs(creal(omega) - printed[i].re) < 6e-7 && fabs(cimag(omega) - printed[i].im) < 6e-7))
            fail_msg("l = %d, n = %d: %.8g %+.8gi, printed %.6f %+.6fi", printed[i].l, printed[i].n, creal(omega),
                     cimag(omega), printed[i].re, printed[i].im);
    }
}

/* Leaver 1985, l = 2, m = 0, fundamental (2M = 1; a in his units, half of ours), as LALSuite's lalsim-bh-qnmode
 * reprints it. */
static void leaver_kerr(void **state)
{
    (void)state;
    static const double printed[][5] = {
        { 0.1, 3.99722, 0.00139, 0.750248, -0.177401 },  { 0.2, 3.98856, 0.00560, 0.759363, -0.175653 },
        { 0.3, 3.97297, 0.01262, 0.776108, -0.171989 },  { 0.4, 3.94800, 0.02226, 0.803835, -0.164313 },
        { 0.45, 3.93038, 0.02763, 0.824009, -0.156965 }, { 0.49, 3.91269, 0.03152, 0.844509, -0.147065 },
    };
    for (size_t i = 0; i < COUNT(printed); i++) {
        const double *p = printed[i];
        struct kd_qnm mode = found(2, 0, 0, 2 * p[0]);
        double off = fmax(fabs(2 * creal(mode.omega) - p[3]), fabs(2 * cimag(mode.omega) - p[4]));
        double off_a = fmax(fabs(creal(mode.separation) - p[1]), fabs(cimag(mode.separation) - p[2]));
        if (!(off < 6e-7 && off_a < 6e-6))
            fail_msg("a = %g: omega off by %.2g, A by %.2g", p[0], off, off_a);
    }
}

/* More digits: Berti's public tables (s2l2.dat, 2M = 1) at a = 0, and the example in the manual of Stein's qnm
 * (2019, J. Open Source Softw. 4, 1683). */
static void public_tables(void **state)
{
    (void)state;
    static const double complex berti[] = { 0.7473433688360838 - 0.1779246313778714 * I,
                                            0.6934219937583268 - 0.5478297505824697 * I,
                                            0.6021069092247328 - 0.9565539664461437 * I,
                                            0.5030099243711814 - 1.4102964048669913 * I };
    for (int n = 0; n < 4; n++)
        for (int m = -2; m <= 2; m++)
            close_to("omega", 2, m, n, 0, 2 * found(2, m, n, 0).omega, berti[n], 1e-13);
    close_to("omega", 2, 2, 0, 0.68, found(2, 2, 0, 0.68).omega, 0.5239751042900845 - 0.08151262363119974 * I, 1e-13);
}

/* In the whole domain each mode is one curve, without a jump to a neighbouring one. The spin is increased in steps so
 * small that the mode cannot change to another curve. Every value on the way equals the one that kd_qnm finds
 * individually, and the way back ends at the start. Most neighbouring modes are 1e-2 away. */
static void one_branch(void **state)
{
    (void)state;
    for (int l = 2; l <= KD_QNM_L_MAX; l++)
        for (int m = -l; m <= l; m++)
            for (int n = 0; n <= KD_QNM_N_MAX; n++) {
                struct kd_qnm_branch fine;
                assert_true(kd_qnm_start(&fine, l, m, n));
                double step = l == 2 ? 0.02 : 0.06;
                for (int k = 1; k * step < 9.21; k++) {
                    double a = -expm1(-k * step);
                    assert_true(kd_qnm_move(&fine, kd_hole(a)));
                    if (k % 6 == 0)
                        close_to("the fine walk", l, m, n, a, fine.at.omega, found(l, m, n, a).omega, 1e-9);
                }
                assert_true(kd_qnm_move(&fine, kd_hole(0.3)));
                close_to("the walk back", l, m, n, 0.3, fine.at.omega, found(l, m, n, 0.3).omega, 1e-11);
                assert_true(creal(fine.at.omega) > 0 && cimag(fine.at.omega) < 0);
            }
}

/* Hod 2008, Phys. Rev. D 78, 084035: for l = m the modes tend to omega = m Omega_H - i 2 pi T (n + 1/2), with 2 pi T
 * = sqrt(1 - a^2)/(2 r+). The difference is of the order of 1 - r+. */
static void nearly_extremal(void **state)
{
    (void)state;
    double a = 0.9999, root = sqrt((1 - a) * (1 + a));
    for (int n = 0; n <= KD_QNM_N_MAX; n++) {
        double im = cimag(found(2, 2, n, a).omega), want = -root / (2 * (1 + root)) * (n + 0.5);
        if (!(fabs(im / want - 1) < 2 * root))
            fail_msg("n = %d: Im(omega) = %g, not %g", n, im, want);
    }
}

static void symmetry_and_domain(void **state)
{
    (void)state;
    struct kd_qnm mode;
    assert_true(found(2, 1, 0, -0.6).omega == found(2, -1, 0, 0.6).omega);
    static const struct {
        int l, m, n;
        double a;
    } outside[] = { { 1, 0, 0, 0 }, { 5, 0, 0, 0 }, { 2, 3, 0, 0 },       { 2, -3, 0, 0 }, { 2, 2, -1, 0 },
                    { 2, 2, 4, 0 }, { 2, 2, 0, 1 }, { 2, 2, 0, 0.99991 }, { 2, 2, 0, -1 }, { 2, 2, 0, NAN } };
    for (size_t i = 0; i < COUNT(outside); i++) {
        assert_false(kd_qnm_find(outside[i].l, outside[i].m, outside[i].n, kd_hole(outside[i].a), &mode));
        assert_true(isnan(creal(mode.omega)) && isnan(creal(mode.separation)));
    }
}

/* The errors of the fits are those that the header states, within a tenth; for n = 0 Berti, Cardoso & Will state
 * 1.85 and 0.88 %. */
static void fits(void **state)
{
    (void)state;
    static const double most[3][2] = { { 1.85e-2, 0.88e-2 }, { 1.56e-2, 1.69e-2 }, { 1.91e-2, 2.52e-2 } };
    for (int n = 0; n < 3; n++) {
        struct kd_qnm_branch b;
        assert_true(kd_qnm_start(&b, 2, 2, n));
        double worst[2] = { 0, 0 };
        for (int k = 0; k <= 99; k++) {
            assert_true(kd_qnm_move(&b, kd_hole(k / 100.0)));
            struct kd_ringdown_fit fit = kd_ringdown_fit(n, kd_hole(b.a));
            worst[0] = fmax(worst[0], fabs(fit.omega_re / creal(b.at.omega) - 1));
            worst[1] = fmax(worst[1], fabs(fit.quality / kd_ringdown_quality(b.at.omega) - 1));
        }
        for (int i = 0; i < 2; i++)
            if (!(fabs(worst[i] - most[n][i]) < 5e-5))
                fail_msg("n = %d: %s off by up to %.3g", n, i ? "Q" : "Re(omega)", worst[i]);
    }
    assert_true(isnan(kd_ringdown_fit(3, kd_hole(0.5)).quality) && isnan(kd_ringdown_fit(0, kd_hole(1)).quality));
    static const double cubic[][2] = { { 0, 0 }, { 0.5, 0.30 }, { 0.8, 1.035 }, { 0.999, -0.705 } };
    for (size_t i = 0; i < COUNT(cubic); i++) {
        double a = cubic[i][0],
               off = kd_ringdown_quality_cubic(kd_hole(a)) / kd_ringdown_quality(found(2, 2, 0, a).omega) - 1;
        if (!(fabs(off - cubic[i][1]) < 6e-3))
            fail_msg("a = %g: the cubic is off by %g", a, off);
    }
}

/* The wave solves h'' - 2 Im h' + |omega|^2 h = 0; differences of fourth order have an error of h^4. */
static void damped_oscillation(void **state)
{
    (void)state;
    double complex w = found(2, 2, 0, 0.7).omega;
    assert_true(kd_ringdown_wave(w, 0) == 1);
    for (double t = 1; t < 40; t += 0.7) {
        double s = 0.02, h[5];
        for (int k = 0; k < 5; k++)
            h[k] = kd_ringdown_wave(w, t + (k - 2) * s);
        double d1 = (h[0] - 8 * h[1] + 8 * h[3] - h[4]) / (12 * s);
        double d2 = (-h[0] + 16 * h[1] - 30 * h[2] + 16 * h[3] - h[4]) / (12 * s * s);
        double rest = d2 - 2 * cimag(w) * d1 + creal(w * conj(w)) * h[2];
        if (!(fabs(rest) < 1e-8 * exp(cimag(w) * t)))
            fail_msg("t = %g: %g left", t, rest);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_method),      cmocka_unit_test(leaver_schwarzschild),
        cmocka_unit_test(leaver_kerr),         cmocka_unit_test(public_tables),
        cmocka_unit_test(one_branch),          cmocka_unit_test(nearly_extremal),
        cmocka_unit_test(symmetry_and_domain), cmocka_unit_test(fits),
        cmocka_unit_test(damped_oscillation),
    };
    return cmocka_run_group_tests_name("physics_qnm", tests, NULL, NULL);
}
