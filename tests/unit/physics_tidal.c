/* Tests of tidal disruption: comparison with published numbers, and consistency of the functions with each other. */
#include "physics/waves/tidal.h"
#include "physics/spacetime/kerr.h"
#include "physics/math/quadrature.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

/* In metres: G M_sun/c^2 and the sun's radius, IAU 2015. */
static const double sun = 1476.6250380501247, sun_radius = 6.957e8, metre_s = 1 / 299792458.0;

static struct kd_tidal million(void) { return (struct kd_tidal) { 1e6 * sun, sun, sun_radius }; }

static void close_to(const char *what, double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s: %.17g, not %.17g: off by %.2g", what, got, want, fabs(got / want - 1));
}

/* Published numbers: 3.5e6 s (Stone, Sari & Loeb 2013, section 2); r_t = 47 M for the sun and 1e6 solar masses, and
 * Hills's mass about 1e8 (Rees 1988), or 1.1e8 for the horizon of Schwarzschild (e.g. Stone et al. 2019, Gen. Relativ.
 * Gravit. 51, 30). */
static void in_print(void **state)
{
    (void)state;
    struct kd_tidal t = million();
    close_to("r_t/M", kd_tidal_radius(t) / t.hole, 47.1, 1e-3);
    close_to("fallback", kd_tidal_fallback_time(t) * metre_s, 3.5e6, 0.02);
    close_to("in days", kd_tidal_fallback_time(t) * metre_s / 86400, 41, 0.01);
    close_to("Hills", kd_tidal_hills_mass(t, kd_hole(0)) / sun, 1.1e8, 0.05);
    /* the rate at its peak is 2.97 solar masses a year, which is a third of a solar mass in 41 days */
    close_to("peak", kd_tidal_fallback_rate(t, kd_tidal_fallback_time(t)) / sun * 3.15576e7 / metre_s, 2.97, 0.01);
    close_to("beta", kd_tidal_penetration(t, kd_tidal_radius(t) / 2), 2, 1e-15);
}

/* The substitution t = t_fb/x^3 maps the tail of the integral to (0, 1). */
static double arrival(double x, double y, const void *context)
{
    const struct kd_tidal *t = context;
    double first = kd_tidal_fallback_time(*t);
    (void)y;
    return kd_tidal_fallback_rate(*t, first / (x * x * x)) * 3 * first / pow(x, 4);
}

/* Half of the star's mass returns. */
static void half_the_star(void **state)
{
    (void)state;
    struct kd_tidal t = million();
    close_to("all of it", kd_quadrature(arrival, &t), t.mass / 2, 1e-12);
    double first = kd_tidal_fallback_time(t);
    assert_true(kd_tidal_fallback_rate(t, first * (1 - 1e-9)) == 0);
    for (double x = 1; x < 1e4; x *= 3) {
        double slope = log(kd_tidal_fallback_rate(t, 2 * x * first) / kd_tidal_fallback_rate(t, x * first)) / log(2);
        close_to("slope", slope, -5.0 / 3, 1e-13);
    }
}

/* The spread is the difference of the hole's potential across the star at r_t: M/(r_t - R) - M/r_t to first order in
 * R/r_t. */
static void the_tide_across_the_star(void **state)
{
    (void)state;
    for (double ratio = 1e4; ratio < 1e13; ratio *= 100) {
        struct kd_tidal t = { ratio, 1, 1e5 };
        double r = kd_tidal_radius(t);
        close_to("spread", kd_tidal_energy_spread(t), t.hole / (r - t.radius) - t.hole / r, 1.2 * t.radius / r + 1e-11);
        /* at r_t the tide equals the star's own gravity */
        close_to("r_t", t.hole * t.radius / (r * r * r), t.mass / (t.radius * t.radius), 1e-14);
    }
}

/* At the largest mass r_t is at the orbit in question; prograde spin raises that mass, a retrograde orbit lowers it. */
static void heaviest(void **state)
{
    (void)state;
    struct kd_tidal t = million();
    double last = 0;
    for (double a = -0.99; a < 1; a += 0.03) {
        t.hole = kd_tidal_capture_mass(t, kd_hole(a));
        close_to("capture", kd_tidal_radius(t), kd_kerr_marginally_bound(kd_hole(a)) * t.hole, 1e-14);
        assert_true(t.hole > last && kd_tidal_hills_mass(t, kd_hole(a)) > t.hole);
        last = t.hole;
    }
    close_to("4M against 2M", kd_tidal_hills_mass(t, kd_hole(0)) / kd_tidal_capture_mass(t, kd_hole(0)), sqrt(8),
             1e-14);
}

static void outside_the_domain(void **state)
{
    (void)state;
    struct kd_tidal none = { 0, 1, 1 };
    assert_true(isnan(kd_tidal_radius(none)) && isnan(kd_tidal_fallback_time(none)));
    assert_true(isnan(kd_tidal_fallback_rate(none, 1)) && isnan(kd_tidal_penetration(million(), 0)));
    assert_true(isnan(kd_tidal_capture_mass(million(), kd_hole(1.1))));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_print), cmocka_unit_test(half_the_star),      cmocka_unit_test(the_tide_across_the_star),
        cmocka_unit_test(heaviest), cmocka_unit_test(outside_the_domain),
    };
    return cmocka_run_group_tests_name("physics_tidal", tests, NULL, NULL);
}
