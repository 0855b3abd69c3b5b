/* Tests of the thin disk. It is compared with quadrature of the integral that defines its flux
 * (tests/oracle/disk_reference.py) and with energy conservation; the redshift is compared with a contraction with the
 * metric. */
#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"

#include "contraction.h"
#include "disk_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void close_to(const char *what, double a, double r, double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s at a = %.17g, r = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, r, got, want,
                 fabs(got / want - 1), relative);
}

/* The bound is that of the header; the smallest radius here is 0.001 r_isco outside the ISCO. */
static void flux_is_the_integral(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(flux_reference); i++) {
        const struct flux_reference *f = &flux_reference[i];
        double gap = f->r - kd_kerr_isco(kd_hole(f->a)), bound = 1e-11 + 4e-14 / (gap * gap);
        close_to("flux", f->a, f->r, kd_disk_flux_page_thorne(kd_hole(f->a), f->r), f->flux, bound);
    }
}

typedef double (*function)(const struct kd_hole *hole, double r);

/* Integral of 4 pi r F(r) weight(r) from the ISCO to infinity, by Simpson's rule in y = sqrt(r_isco/r). In y the
 * integrand is a power series that starts with y. */
static double luminosity(function flux, function weight, double a)
{
    const int n = 20000;
    double isco = kd_kerr_isco(kd_hole(a)), sum = 0;
    for (int i = 1; i < n; i++) {
        double y = (double)i / n, r = isco / (y * y);
        sum += (i % 2 ? 4 : 2) * 4 * M_PI * r * flux(kd_hole(a), r) * weight(kd_hole(a), r) * 2 * isco / (y * y * y);
    }
    return sum / (3.0 * n); /* both ends are zero: F at the ISCO, y at infinity */
}

static double one(const struct kd_hole *hole, double r) { return (void)hole, (void)r, 1; }

/* The energy radiated by both faces, E times the energy in the gas's frame, is what the gas loses on its way in: 1 -
 * E(ISCO) (Page & Thorne 1974, eq. 10b). The bound is the quadrature's error: at a = 0.9999 the flux rises within 0.1
 * of the ISCO. By the virial theorem the Newtonian disk releases 1/(2 r_in). */
static void luminosity_is_the_efficiency(void **state)
{
    (void)state;
    const double spins[] = { -0.9999, -0.9, -0.5, 0, 1e-9, 0.3, 0.5, 0.9, 0.99, 0.998, 0.9999 };
    for (size_t i = 0; i < COUNT(spins); i++) {
        double a = spins[i];
        close_to("luminosity", a, 0, luminosity(kd_disk_flux_page_thorne, kd_kerr_energy, a),
                 kd_kerr_efficiency(kd_hole(a)), 1e-8);
        close_to("Newtonian luminosity", a, 0, luminosity(kd_disk_flux_shakura_sunyaev, one, a),
                 0.5 / kd_kerr_isco(kd_hole(a)), 1e-8);
    }
}

static void nothing_inside_the_isco(void **state)
{
    (void)state;
    for (int n = -999; n < 1000; n += 3) {
        double a = n / 1000.0, isco = kd_kerr_isco(kd_hole(a));
        const function models[] = { kd_disk_flux_page_thorne, kd_disk_flux_shakura_sunyaev };
        for (int i = 0; i < 2; i++) {
            assert_true(models[i](kd_hole(a), isco) == 0);
            assert_true(models[i](kd_hole(a), 0.99 * isco) == 0);
            assert_true(models[i](kd_hole(a), 1) == 0);
            assert_true(models[i](kd_hole(a), 1.001 * isco) > 0);
            assert_true(models[i](kd_hole(a), 1e7) > 0);
        }
    }
}

/* Far away both fluxes fall as 3/(8 pi r^3) (1 - C/sqrt(r)), where C is below 5. */
static void far_away_it_is_newtonian(void **state)
{
    (void)state;
    for (double a = -0.99; a < 1; a += 0.11) {
        double newton = 3 / (8 * M_PI * 1e24);
        close_to("far flux", a, 1e8, kd_disk_flux_page_thorne(kd_hole(a), 1e8), newton, 5e-4);
        close_to("far Newtonian flux", a, 1e8, kd_disk_flux_shakura_sunyaev(kd_hole(a), 1e8), newton, 5e-4);
    }
}

/* The radius of the peak in the table is where the slope of the flux vanishes, by differences with 30 digits. For the
 * Newtonian disk the test shows that values nearby are smaller, as far as rounding allows. */
static void peak_of_the_flux(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(peak_reference); i++) {
        const struct peak_reference *p = &peak_reference[i];
        double r = kd_disk_peak_page_thorne(kd_hole(p->a));
        close_to("peak radius", p->a, r, r, p->r, 1e-13);
        close_to("peak flux", p->a, r, kd_disk_flux_page_thorne(kd_hole(p->a), r), p->flux, 1e-10);
        r = kd_disk_peak_shakura_sunyaev(kd_hole(p->a));
        double top = kd_disk_flux_shakura_sunyaev(kd_hole(p->a), r);
        assert_true(top > kd_disk_flux_shakura_sunyaev(kd_hole(p->a), r * (1 + 1e-6)) &&
                    top > kd_disk_flux_shakura_sunyaev(kd_hole(p->a), r * (1 - 1e-6)));
    }
}

/* Luminet 1979, eq. 19, with lambda = -b sin(phi) sin(i): 1 + z = (1 - 3/r)^(-1/2) (1 - lambda r^(-3/2)). */
static void redshift_without_spin(void **state)
{
    (void)state;
    for (double r = 6; r < 1e5; r *= 1.3)
        for (double lambda = -5; lambda <= 5; lambda += 0.5)
            close_to("g", 0, r, kd_disk_redshift(kd_hole(0), r, lambda), sqrt(1 - 3 / r) / (1 - lambda / (r * sqrt(r))),
                     1e-14);
}

/* g = 1/(-k.u) with k_t = -1, k_phi = lambda and u = u^t (1, 0, 0, Omega): Omega is where the r-derivative of u.g.u
 * vanishes, u^t follows from u.g.u = -1, all in the equatorial plane. */
static double redshift_by_contraction(double a, double r, double lambda)
{
    double tt = -1 + 2 / r, tp = -2 * a / r, pp = r * r + a * a + 2 * a * a / r;
    double dtt = -2 / (r * r), dtp = 2 * a / (r * r), dpp = 2 * r - 2 * a * a / (r * r);
    double omega = (-dtp + sqrt(dtp * dtp - dtt * dpp)) / dpp;
    double ut = 1 / sqrt(-(tt + 2 * tp * omega + pp * omega * omega));
    return 1 / (ut * (1 - omega * lambda));
}

/* The contraction loses digits by cancellation towards the photon orbit. At a = 0.998 the difference is 0.02 of its
 * terms, whose rounding is about 1e-15. */
static void redshift_with_spin(void **state)
{
    (void)state;
    const double spins[] = { -0.998, -0.9, -0.3, 1e-9, 0.3, 0.9, 0.998 };
    for (size_t i = 0; i < COUNT(spins); i++)
        for (double r = kd_kerr_isco(kd_hole(spins[i])); r < 1e5; r *= 1.3)
            for (double lambda = -6; lambda <= 1.5; lambda += 0.5)
                close_to("g", spins[i], r, kd_disk_redshift(kd_hole(spins[i]), r, lambda),
                         redshift_by_contraction(spins[i], r, lambda), 1e-12);
}

/* The contraction loses digits in energy2 - 1 at the ISCO, where it vanishes to third order, and in 1/Delta at the
 * horizon. The test therefore covers 1.05 r+ to 0.9 r_isco, with photons that can be there. */
static void redshift_of_plunging_gas(void **state)
{
    (void)state;
    const double holes[][2] = { { -0.998, 0 }, { -0.9, 0 },  { -0.3, 0 },  { 0, 0 },      { 0.3, 0 },   { 0.9, 0 },
                                { 0.99, 0 },   { 0, 0.999 }, { 0.5, 0.6 }, { -0.9, 0.4 }, { 0.6, 0.79 } };
    int tried = 0;
    for (size_t i = 0; i < COUNT(holes); i++) {
        const struct kd_hole hole = kd_hole_charged(holes[i][0], holes[i][1]);
        const struct plunge_by_metric gas = plunge_by_metric(holes[i][0], holes[i][1]);
        for (double r = 1.05 * hole.outer; r < 0.9 * kd_kerr_isco(&hole); r *= 1.07)
            for (double lambda = -6; lambda <= 6; lambda += 0.5)
                for (double eta = 0.01; eta < 40; eta *= 2) {
                    double a = hole.a, p = r * r + a * a - a * lambda, delta = kd_hole_delta(&hole, r);
                    if (p < 0 || p * p - delta * (eta + (lambda - a) * (lambda - a)) < 1e-3)
                        continue;
                    close_to("g outwards", a, r, kd_disk_redshift_plunging(&hole, r, lambda, eta, true),
                             redshift_of_plunge(&gas, r, lambda, eta, 1), 1e-10);
                    close_to("g inwards", a, r, kd_disk_redshift_plunging(&hole, r, lambda, eta, false),
                             redshift_of_plunge(&gas, r, lambda, eta, -1), 1e-10);
                    tried++;
                }
    }
    assert_true(tried > 5000);
}

/* The redshift of plunging gas continues that of circular orbits; towards the horizon it goes to zero for light that
 * leaves outwards and stays regular for light that leaves inwards. */
static void plunging_at_both_ends(void **state)
{
    (void)state;
    const double spins[] = { -0.998, -0.5, 0, 0.5, 0.9, 0.998 };
    for (size_t i = 0; i < COUNT(spins); i++) {
        double a = spins[i], isco = kd_kerr_isco(kd_hole(a)), h = kd_hole(a)->outer;
        for (int out = 0; out < 2; out++) {
            double g = kd_disk_redshift_plunging(kd_hole(a), isco, -1, 2, out);
            close_to("g at the ISCO", a, isco, g, kd_disk_redshift(kd_hole(a), isco, -1), 1e-9);
        }
        double g = kd_disk_redshift_plunging(kd_hole(a), h * (1 + 1e-9), 0, 2, true);
        assert_true(g > 0 && g < 1e-6);
        g = kd_disk_redshift_plunging(kd_hole(a), h * (1 + 1e-9), 0, 2, false);
        close_to("g inwards at the horizon", a, h, g, kd_disk_redshift_plunging(kd_hole(a), h, 0, 2, false), 1e-6);
        assert_true(g > 0.01 && g < 1);
    }
}

/* The reference has the same physics in grams, with Newton's G, which is known to 2.2e-5. T is proportional to
 * M^(-1/4). The fourth root of the flux adds no error. */
static void temperature_in_kelvin(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(temperature_reference); i++) {
        const struct temperature_reference *t = &temperature_reference[i];
        double flux = kd_disk_flux_page_thorne(kd_hole(t->a), t->r);
        double got = kd_disk_temperature(flux, kd_hole(t->a), t->mass_msun, t->mdot_edd);
        close_to("temperature", t->a, t->r, got, t->kelvin, 1e-5);
        close_to("sixteen times the mass", t->a, t->r,
                 kd_disk_temperature(flux, kd_hole(t->a), 16 * t->mass_msun, t->mdot_edd), got / 2, 1e-14);
        close_to("sixteen times the rate", t->a, t->r,
                 kd_disk_temperature(flux, kd_hole(t->a), t->mass_msun, 16 * t->mdot_edd), got * 2, 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flux_is_the_integral),    cmocka_unit_test(luminosity_is_the_efficiency),
        cmocka_unit_test(nothing_inside_the_isco), cmocka_unit_test(far_away_it_is_newtonian),
        cmocka_unit_test(peak_of_the_flux),        cmocka_unit_test(redshift_without_spin),
        cmocka_unit_test(redshift_with_spin),      cmocka_unit_test(redshift_of_plunging_gas),
        cmocka_unit_test(plunging_at_both_ends),   cmocka_unit_test(temperature_in_kelvin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
