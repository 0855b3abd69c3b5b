/* Tests of the plunge from the ISCO. The closed forms are compared with quadratures from the metric
 * (tests/oracle/plunge_reference.py), published formulas, and conserved quantities. */
#include "physics/orbit/plunge.h"

#include "physics/spacetime/kerr.h"

#include "plunge_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static double within(const char *what, double a, double r, double got, double want, double bound)
{
    double off = fabs(got / want - 1);
    if (!(off <= bound))
        fail_msg("%s at a = %.17g, r = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, r, got, want, off,
                 bound);
    return off;
}

/* Near a = 1 the ISCO and the horizons draw together, so that their distances have fewer digits. */
static void from_the_metric(void **state)
{
    (void)state;
    static const char *const what[] = { "t", "phi", "u^t", "u^phi", "u^r" };
    double worst[2][5] = { 0 };
    for (size_t i = 0; i < COUNT(plunge_reference); i++) {
        const struct plunge_reference *p = &plunge_reference[i];
        struct kd_plunge plunge = kd_plunge_of(kd_hole(p->a));
        struct kd_plunge_event from = kd_plunge_at(&plunge, p->r0), to = kd_plunge_at(&plunge, p->r);
        struct kd_plunge_velocity u = kd_plunge_velocity(&plunge, p->r);
        const double pairs[][2] = { { to.t - from.t, p->t },
                                    { to.phi - from.phi, p->phi },
                                    { u.ut, p->ut },
                                    { u.uphi, p->uphi },
                                    { u.ur, p->ur } };
        bool fast = p->a > 0.999;
        for (int k = 0; k < 5; k++) {
            double off = within(what[k], p->a, p->r, pairs[k][0], pairs[k][1], fast ? 1e-11 : 4e-13);
            worst[fast][k] = fmax(worst[fast][k], off);
        }
    }
    for (int fast = 0; fast < 2; fast++)
        for (int k = 0; k < 5; k++)
            printf("%s %.2g%s", what[k], worst[fast][k], k < 4 ? ", " : fast ? " at a = 0.9999\n" : ";  ");
}

/* Without spin r = 6/(1 + 12/phi^2) (Mummery & Balbus 2022), phi < 0, down to the singularity. */
static void without_spin(void **state)
{
    (void)state;
    struct kd_plunge plunge = kd_plunge_of(kd_hole(0));
    for (double r = 2.01; r < 5.95; r += 0.1) {
        double phi = kd_plunge_at(&plunge, r).phi;
        within("r", 0, r, 6 / (1 + 12 / (phi * phi)), r, 1e-14);
    }
}

/* The slopes of t and phi, by differences, are those of a body with u.u = -1 and the ISCO's E and L. */
static void conserved(void **state)
{
    (void)state;
    for (double a = -0.995; a < 1; a += 0.07) {
        struct kd_plunge plunge = kd_plunge_of(kd_hole(a));
        double isco = kd_kerr_isco(kd_hole(a)), gap = isco - kd_hole(a)->outer;
        for (double x = 0.02; x < 0.99; x += 0.02) {
            double r = isco - x * gap, h = 1e-3 * gap * fmin(x, 1 - x), ur = kd_plunge_velocity(&plunge, r).ur, ut = 0,
                   up = 0;
            for (int k = -2; k <= 2; k++) { /* a difference of fourth order */
                static const double weights[] = { 1 / 12.0, -2 / 3.0, 0, 2 / 3.0, -1 / 12.0 };
                struct kd_plunge_event e = kd_plunge_at(&plunge, r + k * h);
                ut += weights[k + 2] * e.t / h * ur;
                up += weights[k + 2] * e.phi / h * ur;
            }
            double tt = -1 + 2 / r, tp = -2 * a / r, pp = r * r + a * a + 2 * a * a / r,
                   rr = r * r / (r * r - 2 * r + a * a);
            double norm = tt * ut * ut + 2 * tp * ut * up + pp * up * up + rr * ur * ur;
            double size = fabs(tt * ut * ut) + fabs(2 * tp * ut * up) + pp * up * up + rr * ur * ur;
            within("u.u", a, r, norm + size, size - 1, 1e-9);
            within("E", a, r, -(tt * ut + tp * up) + ut, kd_kerr_energy(kd_hole(a), isco) + ut, 1e-9);
            within("L", a, r, tp * ut + pp * up + ut, kd_kerr_momentum(kd_hole(a), isco) + ut, 1e-9);
        }
    }
}

/* Next to the ISCO the body turns as fast as the circular orbit. */
static void leaves_the_circle(void **state)
{
    (void)state;
    for (double a = -0.9; a < 1; a += 0.3) {
        struct kd_plunge plunge = kd_plunge_of(kd_hole(a));
        double isco = kd_kerr_isco(kd_hole(a));
        struct kd_plunge_event one = kd_plunge_at(&plunge, isco * (1 - 1e-8)),
                               two = kd_plunge_at(&plunge, isco * (1 - 2e-8));
        struct kd_plunge_velocity u = kd_plunge_velocity(&plunge, isco);
        within("dphi/dt", a, isco, (two.phi - one.phi) / (two.t - one.t), kd_kerr_omega(kd_hole(a), isco), 1e-7);
        within("u^t", a, isco, u.ut, kd_kerr_ut(kd_hole(a), isco), 1e-12);
        assert_true(u.ur == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(from_the_metric), cmocka_unit_test(without_spin),
                                        cmocka_unit_test(conserved), cmocka_unit_test(leaves_the_circle) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
