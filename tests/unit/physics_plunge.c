/* Tests of the plunge from the ISCO. The closed forms are compared with quadratures from the metric
 * (tests/oracle/plunge_reference.py), published formulas, conserved quantities, and the Hamiltonian in Kerr-Schild
 * coordinates. */
#include "physics/orbit/plunge.h"

#include "physics/spacetime/kerr.h"

#include "kerr_schild.h"
#include "plunge_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static double within(const char *what, const struct kd_hole *hole, double r, double got, double want, double bound)
{
    double off = fabs(got / want - 1);
    if (!(off <= bound))
        fail_msg("%s at a = %.17g, q = %.17g, r = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, hole->a,
                 hole->q, r, got, want, off, bound);
    return off;
}

/* Near a = 1 the ISCO and the horizons are close to each other, so that the distances between them have fewer
 * digits. */
static void from_the_metric(void **state)
{
    (void)state;
    static const char *const what[] = { "t", "phi", "u^t", "u^phi", "u^r" };
    double worst[2][5] = { 0 };
    for (size_t i = 0; i < COUNT(plunge_reference); i++) {
        const struct plunge_reference *p = &plunge_reference[i];
        const struct kd_hole hole = kd_hole_charged(p->a, p->q);
        struct kd_plunge plunge = kd_plunge_of(&hole);
        struct kd_plunge_event from = kd_plunge_at(&plunge, p->r0), to = kd_plunge_at(&plunge, p->r);
        struct kd_plunge_velocity u = kd_plunge_velocity(&plunge, p->r);
        const double pairs[][2] = { { to.t - from.t, p->t },
                                    { to.phi - from.phi, p->phi },
                                    { u.ut, p->ut },
                                    { u.uphi, p->uphi },
                                    { u.ur, p->ur } };
        bool fast = hole.root < 0.06;
        for (int k = 0; k < 5; k++) {
            double off = within(what[k], &hole, p->r, pairs[k][0], pairs[k][1], fast ? 1e-11 : 4e-13);
            worst[fast][k] = fmax(worst[fast][k], off);
        }
    }
    for (int fast = 0; fast < 2; fast++)
        for (int k = 0; k < 5; k++)
            printf("%s %.2g%s", what[k], worst[fast][k], k < 4 ? ", " : fast ? " next to an extremal hole\n" : ";  ");
}

/* Without spin r = 6/(1 + 12/phi^2) (Mummery & Balbus 2022), phi < 0, down to the singularity. */
static void without_spin(void **state)
{
    (void)state;
    struct kd_plunge plunge = kd_plunge_of(kd_hole(0));
    for (double r = 2.01; r < 5.95; r += 0.1) {
        double phi = kd_plunge_at(&plunge, r).phi;
        within("r", kd_hole(0), r, 6 / (1 + 12 / (phi * phi)), r, 1e-14);
    }
}

/* The slopes of t and phi, by differences, are those of a body with u.u = -1 and the ISCO's E and L. */
static void conserved(void **state)
{
    (void)state;
    for (int i = 0; i < 58; i++) {
        const double a = -0.995 + 0.07 * (i / 2), q = i % 2 ? 0.9 * sqrt(1 - a * a) : 0;
        const struct kd_hole hole = kd_hole_charged(a, q);
        struct kd_plunge plunge = kd_plunge_of(&hole);
        double isco = kd_kerr_isco(&hole), gap = isco - hole.outer;
        for (double x = 0.02; x < 0.99; x += 0.02) {
            double r = isco - x * gap, h = 1e-3 * gap * fmin(x, 1 - x), ur = kd_plunge_velocity(&plunge, r).ur, ut = 0,
                   up = 0;
            for (int k = -2; k <= 2; k++) { /* a difference of fourth order */
                static const double weights[] = { 1 / 12.0, -2 / 3.0, 0, 2 / 3.0, -1 / 12.0 };
                struct kd_plunge_event e = kd_plunge_at(&plunge, r + k * h);
                ut += weights[k + 2] * e.t / h * ur;
                up += weights[k + 2] * e.phi / h * ur;
            }
            double f = 2 / r - q * q / (r * r), tt = -1 + f, tp = -a * f, pp = r * r + a * a + a * a * f,
                   rr = r * r / (r * r - 2 * r + a * a + q * q);
            double norm = tt * ut * ut + 2 * tp * ut * up + pp * up * up + rr * ur * ur;
            double size = fabs(tt * ut * ut) + fabs(2 * tp * ut * up) + pp * up * up + rr * ur * ur;
            within("u.u", &hole, r, norm + size, size - 1, 1e-9);
            within("E", &hole, r, -(tt * ut + tp * up) + ut, kd_kerr_energy(&hole, isco) + ut, 1e-9);
            within("L", &hole, r, tp * ut + pp * up + ut, kd_kerr_momentum(&hole, isco) + ut, 1e-9);
        }
    }
}

/* Next to the ISCO the body has the angular velocity of the circular orbit. */
static void leaves_the_circle(void **state)
{
    (void)state;
    for (int i = 0; i < 14; i++) {
        const double a = -0.9 + 0.3 * (i / 2);
        const struct kd_hole hole = kd_hole_charged(a, i % 2 ? 0.9 * sqrt(1 - a * a) : 0);
        struct kd_plunge plunge = kd_plunge_of(&hole);
        double isco = kd_kerr_isco(&hole);
        struct kd_plunge_event one = kd_plunge_at(&plunge, isco * (1 - 1e-8)),
                               two = kd_plunge_at(&plunge, isco * (1 - 2e-8));
        struct kd_plunge_velocity u = kd_plunge_velocity(&plunge, isco);
        within("dphi/dt", &hole, isco, (two.phi - one.phi) / (two.t - one.t), kd_kerr_omega(&hole, isco), 1e-7);
        within("u^t", &hole, isco, u.ut, kd_kerr_ut(&hole, isco), 1e-12);
        assert_true(u.ur == 0);
    }
}

/* A body that starts on the curve, with the curve's velocity, stays on it. */
static void hamiltonian(void **state)
{
    (void)state;
    static const double holes[][2] = { { 0, 0 },     { 0.9, 0 },    { 0, 0.7 },     { 0, 0.999 },   { 0.5, 0.6 },
                                       { 0.9, 0.4 }, { -0.9, 0.4 }, { 0.3, 0.953 }, { 0.7, 0.713 }, { 1e-6, 1e-6 } };
    double worst = 0;
    int compared = 0;
    for (size_t i = 0; i < COUNT(holes); i++) {
        const struct kd_hole hole = kd_hole_charged(holes[i][0], holes[i][1]);
        const struct kd_plunge plunge = kd_plunge_of(&hole);
        const double gap = plunge.isco - hole.outer, from = plunge.isco - gap / 8;
        const struct kd_plunge_event start = kd_plunge_at(&plunge, from);
        const struct ks_body body = { hole.a,
                                      hole.q,
                                      from,
                                      0,
                                      plunge.energy,
                                      plunge.momentum,
                                      kd_plunge_velocity(&plunge, from).ur * from * from / kd_hole_delta(&hole, from),
                                      0 };
        for (double proper = 4 * gap; proper > 0; proper -= gap) {
            const struct ks_body_place at = ks_body_after(&body, proper);
            if (!(at.r < from && at.r > hole.outer + gap / 64))
                continue;
            const struct kd_plunge_event end = kd_plunge_at(&plunge, at.r);
            compared++;
            worst = fmax(worst, within("t", &hole, at.r, end.t - start.t, at.t, 2e-10));
            const double turned = end.phi - start.phi;
            worst =
                fmax(worst, within("phi", &hole, at.r, turned + remainder(at.phi - turned, 2 * M_PI), turned, 2e-10));
        }
    }
    printf("%d places: off the Hamiltonian's path by %.2g\n", compared, worst);
    assert_true(compared > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(from_the_metric), cmocka_unit_test(without_spin),
                                        cmocka_unit_test(conserved), cmocka_unit_test(leaves_the_circle),
                                        cmocka_unit_test(hamiltonian) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
