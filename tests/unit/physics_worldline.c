/* Tests of observers that move with their proper time. They are compared with Hamilton's equations in ingoing
 * Kerr-Schild coordinates, integrated through the horizon by Runge and Kutta's method of fourth order, with derivatives
 * of the metric by differences. This uses no separation of variables, and no integral over r. */
#include "kerr_schild_frame.h"
#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/worldline.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { T, R, THETA, PHI, P_R, P_THETA, STATE };

struct body { double a, energy, momentum, q; };

static double norm(const struct body *b, double r, double theta, double p_r, double p_theta)
{
    const struct ks_place at = { b->a, r, theta, b->q };
    const double p[4] = { -b->energy, p_r, p_theta, b->momentum };
    return ks_product(&at, p, p);
}

/* A derivative by differences of fourth order. */
static double slope(const struct body *b, const double *y, double dr, double dtheta)
{
    double f[4];
    for (int i = 0; i < 4; i++) {
        double k = i < 2 ? i - 2 : i - 1;
        f[i] = norm(b, y[R] + k * dr, y[THETA] + k * dtheta, y[P_R], y[P_THETA]);
    }
    return (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * (dr + dtheta));
}

static void derivative(const struct body *b, const double *y, double *d)
{
    const struct ks_place at = { b->a, y[R], y[THETA], b->q };
    const double p[4] = { -b->energy, y[P_R], y[P_THETA], b->momentum };
    for (int i = 0; i < 4; i++) {
        const double unit[4] = { i == 0, i == 1, i == 2, i == 3 };
        d[i] = ks_product(&at, unit, p);
    }
    d[P_R] = -0.5 * slope(b, y, 3e-4 * y[R], 0);
    d[P_THETA] = -0.5 * slope(b, y, 0, 3e-4);
}

static void step(const struct body *b, double h, double *y)
{
    double k[4][STATE], z[STATE];
    derivative(b, y, k[0]);
    for (int i = 1; i < 4; i++) {
        for (int j = 0; j < STATE; j++)
            z[j] = y[j] + (i < 3 ? 0.5 : 1) * h * k[i - 1][j];
        derivative(b, z, k[i]);
    }
    for (int j = 0; j < STATE; j++)
        y[j] += h / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
}

static const struct fall {
    double a, theta_deg, r, from, energy, momentum; /* from, energy: INFINITY as in kd_observer_motion */
    double q;
} falls[] = {
    { 0, 90, 8, INFINITY, INFINITY, 0 },     { 0, 30, 5, 9, INFINITY, 0 },
    { 0.7, 82, 6, INFINITY, INFINITY, 0 },   { -0.9, 40, 5, INFINITY, INFINITY, 0 },
    { 0.9, 90, 5, 5.5, INFINITY, 1.2 },      { 0.6, 90, 6, INFINITY, 1.3, -2.5 },
    { 0.95, 0, 4, INFINITY, 1.1, 0 },        { 0.5, 90, 1.7, INFINITY, 0.4, 0.3 },
    { 0, 30, 5, 9, INFINITY, 0, 0.9 },       { 0.5, 50, 6, INFINITY, INFINITY, 0, 0.8 },
    { -0.6, 90, 5, 6, INFINITY, -1.1, 0.7 }, { 0.4, 0, 4, INFINITY, 1.1, 0, 0.85 },
};

static struct kd_observer_motion motion_of(const struct fall *f)
{
    struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
    m.fall_from = f->from, m.fall_energy = f->energy, m.fall_momentum = f->momentum;
    return m;
}

static void near(const char *what, const struct fall *f, double proper_time, double got, double wanted, double bound)
{
    if (!(fabs(got - wanted) <= bound * fmax(1, fabs(wanted))))
        fail_msg("spin %g, charge %g from %g M, after %g M: %s %.15g, wanted %.15g", f->a, f->q, f->r, proper_time,
                 what, got, wanted);
}

/* The reference is accurate to about 1e-10. Near r = 0 its steps are too long, so it stops halfway between its last
 * accurate place and the end. */
static void what_falls_is_where_its_clock_says(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof falls / sizeof *falls; i++) {
        const struct fall *f = &falls[i];
        const struct kd_observer_motion m = motion_of(f);
        const double theta = f->theta_deg * (M_PI / 180);
        const struct kd_vantage at = { kd_hole_charged(f->a, f->q), f->r, f->theta_deg == 90 ? 0 : cos(theta),
                                       f->theta_deg == 0 ? 0 : sin(theta) };
        const struct body body = { f->a, kd_observer_energy(&m, &at), f->momentum, f->q };
        const struct ks_place place = { f->a, f->r, fmax(theta, 1e-7), f->q };
        double y[STATE] = { [R] = f->r, [THETA] = place.theta }, p[4];
        ks_inwards(&place, 1, body.energy, body.momentum, 0, p);
        y[P_R] = p[1];
        const double horizon = at.hole.outer,
                     all = kd_infall_proper_time(&m, &at, fmin(0.7 * horizon + 0.3 * at.hole.inner, f->r));
        assert_true(kd_worldline_is_known(&m, &at));
        enum { STEPS = 4000, LOOKS = 8 };
        for (int n = 1; n <= STEPS; n++) {
            step(&body, all / STEPS, y);
            if (n % (STEPS / LOOKS))
                continue;
            const double proper_time = all * n / STEPS;
            const struct kd_worldline_place got = kd_worldline_after(&m, &at, proper_time);
            near("r", f, proper_time, got.r, y[R], 3e-9);
            near("time", f, proper_time, got.time, y[T], 1e-8);
            near("latitude", f, proper_time, place.theta, y[THETA], 1e-8);
            if (f->theta_deg > 0) /* on the axis the azimuth is defined only as a limit */
                near("azimuth", f, proper_time, got.azimuth, y[PHI], 1e-8);
            assert_false(got.ended);
        }
        assert_true(y[R] < horizon);
    }
}

/* On the axis Kerr-Schild azimuths still change: the value is the limit of small angles. */
static void azimuth_on_the_axis_is_the_limit(void **state)
{
    (void)state;
    const struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
    const struct kd_vantage axis = { kd_hole_of(0.9), 6, 1, 0 }, beside = { kd_hole_of(0.9), 6, sqrt(1 - 1e-10), 1e-5 };
    const struct kd_worldline_place on = kd_worldline_after(&m, &axis, 4), off = kd_worldline_after(&m, &beside, 4);
    assert_true(fabs(on.azimuth - off.azimuth) < 1e-9 && fabs(on.azimuth) > 0.01);
}

/* Rain in Schwarzschild: r^(3/2) falls evenly, and with x = sqrt(r/2) the ingoing null coordinate grows by 4 (x^3/3
 * - x^2/2 + x - ln(1 + x)). */
static double advanced(double r)
{
    double x = sqrt(r / 2);
    return 4 * (x * x * x / 3 - x * x / 2 + x - log1p(x));
}

/* t of Boyer and Lindquist, by dt/dr = -sqrt(r/2)/(1 - 2/r) (Misner, Thorne & Wheeler 1973, exercise 25.11). */
static double far_time(double r)
{
    double x = sqrt(r / 2);
    return 2 * (-x * x * x * 2 / 3 - 2 * x + log((x + 1) / (x - 1)));
}

static void rain_in_schwarzschild(void **state)
{
    (void)state;
    const struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
    const struct kd_vantage at = { kd_hole_of(0), 20, 0.3, sqrt(1 - 0.09) };
    const double whole = sqrt(2) / 3 * pow(20, 1.5);
    for (double left = whole; left > 1e-3; left *= 0.8) {
        const struct kd_worldline_place got = kd_worldline_after(&m, &at, whole - left);
        const double r = pow(3 / sqrt(2) * left, 2. / 3);
        const struct fall rain = { 0, 0, 20, 0, 0, 0 };
        /* tolerance: the remaining time is a small difference of two large numbers */
        near("r", &rain, whole - left, got.r / r, 1, 1e-12 + 1e-14 * whole / left);
        near("time", &rain, whole - left, got.time, advanced(20) - advanced(r) - r + 20, 1e-11);
        near("azimuth", &rain, whole - left, got.azimuth, 0, 0);
        if (r > 2.001)
            near("far time", &rain, whole - left, got.far_time, far_time(r) - far_time(20), 1e-10);
        else
            assert_true(r > 2 || isinf(got.far_time));
    }
}

static void it_ends_where_a_camera_can_be_at_last(void **state)
{
    (void)state;
    static const double spins[] = { 0, 1e-6, 0.1, -0.7, 0.9, 0.998, -0.999999, 0.999999999999 };
    for (size_t i = 0; i < sizeof spins / sizeof *spins; i++) {
        const struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
        struct kd_vantage at = { kd_hole_of(spins[i]), 10, 0.5, sqrt(0.75) };
        struct kd_worldline_place got = kd_worldline_after(&m, &at, 1e5);
        assert_true(got.ended && got.r == kd_infall_last(kd_hole(spins[i])) && isfinite(got.azimuth) &&
                    isfinite(got.time));
        assert_true(got.r > kd_hole(spins[i])->inner && got.r < kd_hole(spins[i])->outer && got.r >= 0.01);
        assert_true(kd_worldline_goes_on(&m, &at));
        at.r = got.r;
        assert_false(kd_worldline_goes_on(&m, &at));
        got = kd_worldline_after(&m, &at, 1);
        assert_true(got.ended && got.r == at.r && got.azimuth == 0 && got.time == 0);
        at.r = 10;
        got = kd_worldline_after(&m, &at, 0);
        assert_true(!got.ended && got.r == 10 && got.time == 0);
    }
}

/* Observers that stay at one radius: the rate of their proper time is compared with the metric. Other properties of
 * each kind are tested too. */
static void others_stay_and_go_round(void **state)
{
    (void)state;
    static const enum kd_observer kinds[] = { KD_OBSERVER_STATIC, KD_OBSERVER_ZAMO, KD_OBSERVER_KEPLERIAN,
                                              KD_OBSERVER_RETROGRADE };
    for (double a = -0.9; a < 1; a += 0.45)
        for (double r = 5; r < 100; r *= 3)
            for (int i = 0; i < 8; i++) {
                const struct kd_observer_motion m = kd_observer_motion_of(kinds[i / 2]);
                const double u = i % 2 ? 0.4 : 0, s2 = 1 - u * u, sigma = r * r + a * a * u * u;
                const struct kd_vantage at = { kd_hole_of(a), r, u, sqrt(s2) };
                const bool known = u == 0 || i / 2 < 2;
                assert_int_equal(kd_worldline_is_known(&m, &at), known);
                if (!known)
                    continue;
                const struct kd_worldline_place got = kd_worldline_after(&m, &at, 3);
                const double tt = -1 + 2 * r / sigma, tp = -2 * a * r * s2 / sigma,
                             pp = (r * r + a * a) * s2 - a * s2 * tp, t = got.time, p = got.azimuth;
                const double turning[] = { p, tp * t + pp * p, p / t * (pow(r, 1.5) + a) - 1,
                                           p / t * (pow(r, 1.5) - a) + 1 };
                assert_true(fabs(tt * t * t + 2 * tp * t * p + pp * p * p + 9) < 1e-11 && t > 3);
                assert_true(fabs(turning[i / 2]) < 1e-11);
                assert_true(got.r == r && got.far_time == got.time && !got.ended);
            }
}

/* Falls with E = 1 and L = 2/a next to the inner horizon of fast holes. The reference is a quadrature in 40 digits of
 * the same doubles. P = r^2 + a^2 - 2 almost vanishes at r = 1. Its size elsewhere is about the distance between the
 * horizons, and its absolute error is 4e-16. The bound is 100 times the ratio of this error to this size. */
static void falls_between_horizons_that_almost_coincide(void **state)
{
    (void)state;
    static const struct {
        double a, part, azimuth;
    } known[] = { { 0.9, 0.2, 6.7976364618799078 },      { 0.9, 0.0002, 21.296837279412556 },
                  { 0.998, 0.2, 37.67376143323219 },     { 0.998, 0.0002, 147.65085766506501 },
                  { 1 - 1e-6, 0.2, 1595.8660183148368 }, { 1 - 1e-6, 0.02, 3254.8716199818742 } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const struct kd_hole hole = kd_hole_of(known[i].a);
        const struct kd_vantage at = { hole, hole.outer * (1 - 1e-3 * hole.root), 0, 1 };
        struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
        m.fall_energy = 1, m.fall_momentum = 2 / hole.a;
        const double got = kd_infall_way(&m, &at, hole.inner + known[i].part * hole.root).azimuth;
        const double bound = 100 * 4e-16 / (known[i].part < 0.01 ? known[i].part : hole.root);
        if (!(fabs(got / known[i].azimuth - 1) <= bound))
            fail_msg("a = %.17g, part %g: %.17g, wanted %.17g", hole.a, known[i].part, got, known[i].azimuth);
    }
}

static void some_have_no_path_that_is_known(void **state)
{
    (void)state;
    struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_VELOCITY);
    struct kd_vantage at = { kd_hole_of(0.5), 10, 0, 1 };
    assert_false(kd_worldline_is_known(&m, &at));
    m = kd_observer_motion_of(KD_OBSERVER_INFALL);
    assert_true(kd_worldline_is_known(&m, &at));
    m.fall_from = 20;
    at.u = 0.6, at.s = 0.8;
    assert_false(kd_worldline_is_known(&m, &at));
    at.hole = kd_hole_of(0);
    assert_true(kd_worldline_is_known(&m, &at));
    at.r = INFINITY;
    assert_false(kd_worldline_is_known(&m, &at));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_falls_is_where_its_clock_says),
        cmocka_unit_test(azimuth_on_the_axis_is_the_limit),
        cmocka_unit_test(rain_in_schwarzschild),
        cmocka_unit_test(it_ends_where_a_camera_can_be_at_last),
        cmocka_unit_test(others_stay_and_go_round),
        cmocka_unit_test(falls_between_horizons_that_almost_coincide),
        cmocka_unit_test(some_have_no_path_that_is_known),
    };
    return cmocka_run_group_tests_name("observers that go on", tests, NULL, NULL);
}
