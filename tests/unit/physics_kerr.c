/* Tests of circular orbits of Kerr, compared with numbers computed from the metric alone
 * (tests/oracle/kerr_reference.py), and with properties that hold at any spin. */
#include "physics/spacetime/kerr.h"

#include "kerr_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void close_to(const char *what, double a, double r, double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s at a = %.17g, r = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, r, got, want,
                 fabs(got / want - 1), relative);
}

/* The header promises 1e-14 for the ISCO and a few ulp for the horizon. The other radii are one or two elementary
 * functions of a, well conditioned in a and 1 - a, so their errors are a few ulp; the bound is 1e-14. */
static void special_radii(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(kerr_reference); i++) {
        const struct kerr_reference *k = &kerr_reference[i];
        close_to("horizon", k->a, 0, kd_hole(k->a)->outer, k->horizon, 1e-15);
        close_to("photon orbit", k->a, 0, kd_kerr_photon_orbit(kd_hole(k->a)), k->photon, 1e-14);
        close_to("marginally bound", k->a, 0, kd_kerr_marginally_bound(kd_hole(k->a)), k->bound, 1e-14);
        close_to("ISCO", k->a, 0, kd_kerr_isco(kd_hole(k->a)), k->isco, 1e-14);
    }
}

/* E and L are flat at the ISCO, so the rounding of its radius costs nothing, and the bound 1e-12 holds up to 1 - a =
 * 1e-12. There r - 1 is 1.6e-4, and 1 - 3/r + 2a r^-3/2 as written would lose half of the digits. 1 - E loses a
 * factor of 26 at a = -1. */
static void the_isco_orbit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(kerr_reference); i++) {
        const struct kerr_reference *k = &kerr_reference[i];
        double r = kd_kerr_isco(kd_hole(k->a));
        close_to("E(ISCO)", k->a, r, kd_kerr_energy(kd_hole(k->a), r), k->isco_energy, 1e-12);
        close_to("L(ISCO)", k->a, r, kd_kerr_momentum(kd_hole(k->a), r), k->isco_momentum, 1e-12);
        close_to("Omega(ISCO)", k->a, r, kd_kerr_omega(kd_hole(k->a), r), k->isco_omega, 1e-14);
        close_to("efficiency", k->a, r, kd_kerr_efficiency(kd_hole(k->a)), 1 - k->isco_energy, 2e-12);
    }
}

/* Orbits between the photon orbit and the ISCO, just outside it, near and far. The radii in the table are exact
 * doubles. Halfway to the photon orbit at 1 - a = 1e-12, r - 1 is 8e-5, and the rounding of sqrt(r) alone causes an
 * error of 1e-12. */
static void any_orbit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++) {
        const struct orbit_reference *o = &orbit_reference[i];
        close_to("Omega", o->a, o->r, kd_kerr_omega(kd_hole(o->a), o->r), o->omega, 1e-14);
        close_to("E", o->a, o->r, kd_kerr_energy(kd_hole(o->a), o->r), o->energy, 1e-11);
        close_to("L", o->a, o->r, kd_kerr_momentum(kd_hole(o->a), o->r), o->momentum, 1e-11);
        close_to("u^t", o->a, o->r, kd_kerr_ut(kd_hole(o->a), o->r), o->ut, 1e-11);
    }
}

/* Published round numbers: Bardeen, Press & Teukolsky 1972, section II (a = 0: 2, 3, 4, 6; |a| = 1: 1, 4, 3 + 2 sqrt
 * 2, 9; binding energies 5.72 %, 3.77 %), Thorne 1974 (a = 0.998: efficiency 0.321 for the ISCO at 1.237). */
static void numbers_in_print(void **state)
{
    (void)state;
    assert_true(kd_hole(0)->outer == 2 && kd_hole(0)->inner == 0);
    close_to("photon orbit", 0, 0, kd_kerr_photon_orbit(kd_hole(0)), 3, 1e-15);
    assert_true(kd_kerr_marginally_bound(kd_hole(0)) == 4);
    close_to("ISCO", 0, 0, kd_kerr_isco(kd_hole(0)), 6, 1e-15);
    close_to("efficiency", 0, 0, kd_kerr_efficiency(kd_hole(0)), 1 - sqrt(8.0 / 9), 1e-14);
    close_to("L(ISCO)", 0, 6, kd_kerr_momentum(kd_hole(0), 6), sqrt(12), 1e-15);
    const double retrograde = -1 + 1e-15;
    close_to("ISCO", retrograde, 0, kd_kerr_isco(kd_hole(retrograde)), 9, 1e-14);
    close_to("photon orbit", retrograde, 0, kd_kerr_photon_orbit(kd_hole(retrograde)), 4, 1e-14);
    close_to("marginally bound", retrograde, 0, kd_kerr_marginally_bound(kd_hole(retrograde)), 3 + 2 * sqrt(2), 1e-14);
    close_to("efficiency", retrograde, 0, kd_kerr_efficiency(kd_hole(retrograde)), 1 - 5 / sqrt(27), 1e-13);
    close_to("ISCO", 0.998, 0, kd_kerr_isco(kd_hole(0.998)), 1.237, 5e-4 / 1.237); /* published to three decimals */
    close_to("efficiency", 0.998, 0, kd_kerr_efficiency(kd_hole(0.998)), 0.321, 5e-4 / 0.321);
}

/* E and L of circular orbits both have their minimum at the ISCO. At 5 % of the distance to the photon orbit on either
 * side, E and L differ from the minimum by a hundred thousand ulp. The slope there is a symmetric difference of step h,
 * whose error is h^2 times the third derivative. */
static void the_isco_is_the_minimum(void **state)
{
    (void)state;
    for (int n = -1999; n < 2000; n++) {
        double a = n / 2000.0;
        double r = kd_kerr_isco(kd_hole(a)), gap = r - kd_kerr_photon_orbit(kd_hole(a)), step = 0.05 * gap;
        double (*const functions[])(const struct kd_hole *, double) = { kd_kerr_energy, kd_kerr_momentum };
        for (int i = 0; i < 2; i++) {
            double at = functions[i](kd_hole(a), r), left = functions[i](kd_hole(a), r - step),
                   right = functions[i](kd_hole(a), r + step);
            if (!(left > at && right > at))
                fail_msg("a = %g: no minimum of %s at the ISCO", a, i ? "L" : "E");
            double h = 1e-3 * gap,
                   slope = (functions[i](kd_hole(a), r + h) - functions[i](kd_hole(a), r - h)) / (2 * h);
            double bend = (left + right - 2 * at) / (step * step);
            /* slope/(bend * gap): offset of the minimum from the ISCO, as a fraction of the gap */
            if (!(fabs(slope) < 1e-5 * bend * gap))
                fail_msg("a = %g: the slope of %s at the ISCO is %g", a, i ? "L" : "E", slope);
        }
    }
}

/* The ISCO from the quartic that its header gives, solved in powers of a: 6 - 4 sqrt(2/3) a - 7/18 a^2, with an
 * error below a^3. */
static void hardly_any_spin(void **state)
{
    (void)state;
    for (double a = 1e-5; a > 1e-320; a *= a > 1e-12 ? 0.997 : 0.01)
        for (int sign = -1; sign <= 1; sign += 2)
            close_to("ISCO", sign * a, 0, kd_kerr_isco(kd_hole(sign * a)),
                     6 - sign * a * 4 * sqrt(2. / 3) - 7. / 18 * a * a, 1e-15);
}

/* 2000 spins, denser towards +-1: the radii are continuous, ordered and monotone. */
static void order_of_the_radii(void **state)
{
    (void)state;
    double last = 9.01;
    for (int i = -1000; i <= 1000; i++) {
        double a = copysign(-expm1(-abs(i) * 0.0276), i); /* |a| up to 1 - 1e-12 */
        double horizon = kd_hole(a)->outer, photon = kd_kerr_photon_orbit(kd_hole(a)),
               bound = kd_kerr_marginally_bound(kd_hole(a));
        double isco = kd_kerr_isco(kd_hole(a));
        if (!(horizon <= photon && photon < bound && bound < isco && isco < last))
            fail_msg("a = %.17g: %g, %g, %g, %g after %g", a, horizon, photon, bound, isco, last);
        last = isco;
        double product = kd_hole(a)->inner * horizon; /* r+ r- = a^2 */
        close_to("inner horizon", a, 0, product, a * a, 1e-15);
    }
}

static void outside_the_domain(void **state)
{
    (void)state;
    for (double a = -1.5; a <= 1.5; a += 3) {
        assert_true(isnan(kd_hole(a)->outer));
        assert_true(isnan(kd_kerr_isco(kd_hole(a))));
        assert_true(isnan(kd_kerr_photon_orbit(kd_hole(a))));
        assert_true(isnan(kd_kerr_marginally_bound(kd_hole(a))));
        assert_true(isnan(kd_kerr_efficiency(kd_hole(a))));
    }
}

/* -g_tphi/g_phiphi and g_tt from the Boyer-Lindquist line element as it is written in Misner, Thorne &
 * Wheeler (33.2): ds^2 = -(Delta/rho^2)(dt - a sin^2 dphi)^2 + (sin^2/rho^2)((r^2 + a^2) dphi - a dt)^2 + ...
 */
static void frame_dragging_and_ergosphere(void **state)
{
    (void)state;
    for (int n = -5; n <= 5; n++) {
        double a = 0.19 * n;
        for (double u = -0.9; u <= 0.91; u += 0.3) {
            for (double r = kd_hole(a)->outer * 1.01; r < 1000; r *= 1.7) {
                double rho2 = r * r + a * a * u * u, delta = r * r - 2 * r + a * a, s2 = 1 - u * u;
                double tphi = (delta * a * s2 - s2 * (r * r + a * a) * a) / rho2;
                double phiphi = (s2 * pow(r * r + a * a, 2) - delta * a * a * s2 * s2) / rho2;
                /* here g_tphi is the difference of two terms, each r/2 times as large as it */
                close_to("dragging", a, r, kd_kerr_dragging(kd_hole(a), r, u), -tphi / phiphi, 1e-15 * (10 + 4 * r));
            }
            double e = kd_kerr_ergosphere(kd_hole(a), u); /* g_tt = 0 */
            double tt = (-(e * e - 2 * e + a * a) + a * a * (1 - u * u)) / (e * e + a * a * u * u);
            if (!(fabs(tt) < 1e-14))
                fail_msg("a = %g, u = %g: g_tt = %g at the static limit", a, u, tt);
        }
        /* on the horizon zero-angular-momentum observers rotate with a/(2 r+) */
        double horizon = kd_hole(a)->outer;
        close_to("dragging", a, horizon, kd_kerr_dragging(kd_hole(a), horizon, 0.3), a / (2 * horizon), 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_radii),
        cmocka_unit_test(the_isco_orbit),
        cmocka_unit_test(any_orbit),
        cmocka_unit_test(numbers_in_print),
        cmocka_unit_test(the_isco_is_the_minimum),
        cmocka_unit_test(hardly_any_spin),
        cmocka_unit_test(order_of_the_radii),
        cmocka_unit_test(outside_the_domain),
        cmocka_unit_test(frame_dragging_and_ergosphere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
