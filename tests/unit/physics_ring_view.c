/* Tests of rings seen by observers inside them, next to the hole and beyond the horizon. They are compared with rays
 * integrated in ingoing Kerr-Schild coordinates, from frames computed in these coordinates
 * (tests/oracle/kerr_schild.h). */
#include "physics/null/ring_view.h"
#include "physics/spacetime/kerr.h"

#include "kerr_schild.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
#define RADIAN (M_PI / 180)

static void within(const char *what, double a, double x, double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("%s at a = %.17g, %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, x, got, want,
                 fabs(got - want), bound);
}

static struct kd_vantage vantage(double a, double q, double i_deg, double r)
{
    return (struct kd_vantage) { kd_hole_charged(a, q), r, cos(i_deg * RADIAN), sin(i_deg * RADIAN) };
}

/* The frame of an observer, by the reference. */
static struct ks_frame oracle_frame(const struct kd_observer_motion *m, const struct kd_vantage *v)
{
    const struct ks_place at = { v->hole.a, v->r, atan2(v->s, v->u), v->hole.q };
    const struct ks_frame rain = ks_rain(&at);
    double u[4];
    if (m->observer == KD_OBSERVER_ZAMO)
        return ks_zamo(&at);
    ks_inwards(&at, 1, isfinite(m->fall_energy) ? m->fall_energy : 1, m->fall_momentum, 0, u);
    return ks_boost(&at, &rain, u);
}

/* Checks that light seen in this direction comes from the ring. magnified: the factor by which an error of the
 * direction grows on the way. It is about 25 for each half turn, and more for light that stays next to the horizon for
 * long. */
static void comes_from(const struct kd_observer_motion *m, const struct kd_vantage *v, double r, int order, double chi,
                       double magnified)
{
    const struct kd_ring_view view = kd_ring_view_of(m, v, r, order);
    const struct ks_place at = { v->hole.a, v->r, atan2(v->s, v->u), v->hole.q };
    const struct ks_frame frame = oracle_frame(m, v);
    struct kd_ring_view_point p;
    double photon[4], constants[4];
    if (!kd_ring_view_seen(&view, chi, &p))
        fail_msg("no image of order %d of a ring at %.17g, chi = %g, a = %g, from %.17g", order, r, chi, v->hole.a,
                 v->r);
    within("a unit vector", v->hole.a, r, hypot(hypot(p.look.right, p.look.up), p.look.inwards), 1, 1e-13);
    ks_seen(&frame, (double[]) { -p.look.inwards, -p.look.up, p.look.right }, photon);
    ks_constants(&at, photon, constants);
    within("energy", v->hole.a, r, p.look.energy, constants[0], 1e-12 * (1 + fabs(constants[0])));
    const struct ks_path path = ks_follow(&at, photon, order + 1);
    assert_int_equal(path.crossings, order + 1);
    within("r", v->hole.a, v->r, path.r[order], r, 1e-10 * magnified * r);
}

static const double rings[][5] = {
    /* rows of a, i, the observer's radius, the ring's radius, and q if there is a charge */
    { 0, 60, 1.2, 3 },        { 0, 75, 2, 6 },          { 0, 30, 2.5, 3 },        { 0, 120, 1.9, 40 },
    { 0.9, 60, 1.3, 1.5578 }, { 0.9, 60, 1.436, 2.32 }, { 0.9, 20, 0.8, 3.91 },   { 0.9, 80, 1.2, 2 },
    { 0.5, 80, 2.2, 6 },      { 0.9, 60, 6, 20 },       { 0.998, 85, 1.05, 1.2 }, { 0.998, 70, 1.5, 2 },
    { -0.7, 45, 1.5, 10 },    { 0.9, 3, 1.4, 100 },     { 0.7, 100, 3, 3.01 },    { 0.3, 60, 40, 6 },
    { 0.9, 70, 1000, 2.5 },   { 0.9, 70, 1.6, 1e4 },    { 0, 60, 0.9, 3, 0.95 },  { 0.4, 75, 1.2, 2, 0.85 },
    { -0.5, 100, 6, 9, 0.8 },
};

static void from_free_fall(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT(rings); k++)
        for (int order = 0; order < 2; order++)
            for (int chi = 0; chi < 8; chi++)
                for (int fast = 0; fast < 2; fast++) {
                    const double *c = rings[k];
                    const struct kd_vantage v = vantage(c[0], c[4], c[1], c[2]);
                    struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
                    if (fast)
                        m.fall_energy = 1.7, m.fall_momentum = 0.8;
                    comes_from(&m, &v, c[3], order, (13 + 45 * chi) * RADIAN, 1e4);
                }
}

/* Observers that do not fall, outside the horizon, where the reference has azimuths and times too. */
static void from_nearby(void **state)
{
    static const double cases[][6] = {
        /* rows of a, i, the observer's r, the ring's r, chi, and q if there is a charge */
        { 0.9, 60, 20, 6, 90 },       { 0.9, 60, 6, 20, 200 },        { 0.9, 60, 12, 2.5, 20 },
        { 0.998, 80, 30, 1.5, 300 },  { -0.7, 30, 9, 22, 150 },       { 0.5, 85, 3.2, 22, 5 },
        { 0.99, 10, 2.5, 3, 250 },    { 0.3, 70, 500, 100, 181 },     { 0, 45, 2.8, 18.7, 33 },
        { 0.999, 84, 74.1, 9.26, 1 }, { 0.7, 98, 26, 22, 271 },       { 0.9, 3, 15, 9, 77 },
        { 0, 60, 9, 6, 40, 0.95 },    { 0.6, 80, 12, 2.5, 20, 0.75 },
    };
    (void)state;
    for (size_t k = 0; k < 2 * COUNT(cases); k++)
        for (int order = 0; order < 2; order++) {
            const double *c = cases[k / 2];
            const bool zamo = k % 2;
            const struct kd_vantage v = vantage(c[0], c[5], c[1], c[2]);
            const struct kd_observer_motion m = kd_observer_motion_of(zamo ? KD_OBSERVER_ZAMO : KD_OBSERVER_STATIC);
            const struct kd_ring_view view = kd_ring_view_of(&m, &v, c[3], order);
            struct kd_ring_view_point p;
            if (!kd_ring_view_seen(&view, c[4] * RADIAN, &p))
                fail_msg("no image of order %d of a ring at %g, direction %g, a = %g, i = %g, from %g", order, c[3],
                         c[4], c[0], c[1], c[2]);
            const struct ks_photon photon = ks_from_camera_charged(
                c[0], c[5], c[2], c[1] * RADIAN, zamo, (double[]) { -p.look.inwards, -p.look.up, p.look.right });
            const struct ks_path path = ks_trace(photon, order + 1);
            const double bound = 1e-10 * (order ? 1e3 : 30);
            assert_int_equal(path.crossings, order + 1);
            within("energy", c[0], c[3], p.look.energy, photon.energy, 1e-12);
            within("r", c[0], c[3], path.r[order], c[3], bound * c[3]);
            within("phi", c[0], c[3], remainder(path.phi[order] - p.phi, 2 * M_PI), 0, bound);
            within("delay", c[0], c[3], path.delay[order], p.delay, bound * fmax(c[2], c[3]));
        }
}

/* An infalling observer sees every ring outside the horizon, from anywhere. No azimuth and time are given where none
 * exist. */
static void everywhere(void **state)
{
    static const double spins[] = { 0, 0.5, -0.9, 0.998 }, inclinations[] = { 0, 60, 89, 130 };
    (void)state;
    for (size_t s = 0; s < COUNT(spins); s++)
        for (size_t i = 0; i < COUNT(inclinations); i++)
            for (double from = 0.05; from < 1e4; from *= 3)
                for (double out = 1.01; out < 1e4; out *= 5) {
                    const double a = spins[s], inner = kd_hole(a)->inner, plus = kd_hole(a)->outer;
                    const struct kd_vantage v = vantage(a, 0, inclinations[i], inner + from);
                    const struct kd_observer_motion m = kd_observer_motion_of(KD_OBSERVER_INFALL);
                    for (int order = 0; order < 2; order++)
                        for (double chi = 0.1; chi < 6.3; chi += 2.1) {
                            const struct kd_ring_view view = kd_ring_view_of(&m, &v, plus * out, order);
                            struct kd_ring_view_point p;
                            if (!kd_ring_view_seen(&view, chi, &p))
                                fail_msg("order %d, a = %g, i = %g, ring at %g, from %.17g, chi = %g: off by %g", order,
                                         a, inclinations[i], plus * out, v.r, chi, p.residual);
                            assert_true(isfinite(p.look.right + p.look.up + p.look.inwards));
                            assert_true(isfinite(p.phi) == (v.r > plus && p.look.energy > 0));
                        }
                }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(from_free_fall), cmocka_unit_test(from_nearby),
                                        cmocka_unit_test(everywhere) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
