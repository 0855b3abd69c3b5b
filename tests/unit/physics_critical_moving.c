/* Tests of the critical curve of observers inside the horizon, and of observers that move in latitude. Light a
 * microradian to either side of the curve is traced back in Kerr-Schild coordinates, from frames computed in these
 * coordinates. On one side it must come from the sky, on the other side from the hole. */
#include "kerr_schild.h"
#include "physics/null/critical.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define FALL INFINITY, INFINITY, 0
static const struct seer {
    double spin, theta_deg, r;
    struct kd_observer_motion motion;
    double energy;
    double charge;
} seers[] = {
    { 0, 75, 1, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1 },
    { 0, 75, 2, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1 },
    { 0.9, 75, 1.43, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1 },
    { 0.9, 120, 0.8, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1 },
    { -0.7, 40, 1.2, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1 },
    { 0.9, 80, 1.3, { KD_OBSERVER_INFALL, { 0 }, INFINITY, 0.9, 1.2 }, 0.9 },
    { 0.9, 75, 6, { KD_OBSERVER_VELOCITY, { 0, 0.6, 0 }, FALL }, 0 },
    { 0.9, 60, 3, { KD_OBSERVER_VELOCITY, { -0.4, -0.5, 0.3 }, FALL }, 0 },
    { -0.5, 110, 15, { KD_OBSERVER_VELOCITY, { 0.3, 0.8, -0.2 }, FALL }, 0 },
    { 0, 75, 0.9, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1, 0.95 },
    { 0.4, 75, 1.1, { KD_OBSERVER_INFALL, { 0 }, FALL }, 1, 0.85 },
    { 0.5, 80, 1.2, { KD_OBSERVER_INFALL, { 0 }, INFINITY, 0.9, 1.2 }, 0.9, 0.7 },
    { 0.6, 60, 3, { KD_OBSERVER_VELOCITY, { -0.4, -0.5, 0.3 }, FALL }, 0, 0.7 },
    { -0.5, 110, 5, { KD_OBSERVER_VELOCITY, { 0.3, 0.6, -0.2 }, FALL }, 0, 0.8 },
};

static struct ks_frame frame_of(const struct seer *seer, const struct ks_place *at)
{
    const double *v = seer->motion.velocity, gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])),
                 x[4] = { 1, v[0], v[1], v[2] };
    const bool falls = seer->motion.observer == KD_OBSERVER_INFALL;
    const struct ks_frame base = falls ? ks_rain(at) : ks_zamo(at);
    double u[4] = { 0 };
    if (falls)
        ks_inwards(at, 1, seer->energy, seer->motion.fall_momentum, 0, u);
    for (int i = 0; i < 4 && !falls; i++)
        for (int k = 0; k < 4; k++)
            u[k] += gamma * x[i] * base.e[i][k];
    return ks_boost(at, &base, u);
}

static void direction(const struct kd_critical *c, double angle, double m[3])
{
    const struct kd_critical_point p = kd_critical_at(c, angle);
    m[0] = p.right, m[1] = p.up, m[2] = p.inwards;
}

static bool comes_from_the_sky(const struct ks_place *at, const struct ks_frame *f, const double m[3])
{
    const double n = 1 / sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), k[3] = { -m[2] * n, -m[1] * n, m[0] * n };
    double p[4];
    ks_seen(f, k, p);
    const struct ks_path path = ks_follow(at, p, 16);
    assert_int_not_equal(path.fate, KS_UNDECIDED);
    return path.fate == KS_ESCAPED;
}

static void the_edge_is_where_it_is_seen(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof seers / sizeof *seers; i++) {
        const struct seer *s = &seers[i];
        const struct ks_place at = { s->spin, s->r, s->theta_deg * (M_PI / 180), s->charge };
        const struct ks_frame frame = frame_of(s, &at);
        const struct kd_critical_observer observer = { kd_hole_charged(s->spin, s->charge), s->r, cos(at.theta),
                                                       sin(at.theta), s->motion };
        const struct kd_critical curve = kd_critical_of(&observer);
        assert_int_equal(curve.status, KD_CRITICAL_OK);
        assert_int_equal(curve.is_skew, s->motion.observer == KD_OBSERVER_VELOCITY);
        for (int k = 0; k < 24; k++) {
            const double angle = 0.1 + k * (2 * M_PI / 24), delta = 1e-6;
            double m[3], before[3], after[3], across[3], length = 0;
            direction(&curve, angle, m);
            direction(&curve, angle - 1e-4, before);
            direction(&curve, angle + 1e-4, after);
            /* the cross product of the counterclockwise tangent and the direction points away from the dark side */
            for (int j = 0; j < 3; j++) {
                const int a = (j + 1) % 3, b = (j + 2) % 3;
                across[j] = (after[a] - before[a]) * m[b] - (after[b] - before[b]) * m[a];
                length += across[j] * across[j];
            }
            for (int side = -1; side <= 1; side += 2) {
                double to[3];
                for (int j = 0; j < 3; j++)
                    to[j] = m[j] + side * delta * across[j] / sqrt(length);
                if (comes_from_the_sky(&at, &frame, to) != (side > 0))
                    fail_msg("a = %g, q = %g, r = %g, observer %d, angle %g: the edge is not there, side %d", s->spin,
                             s->charge, s->r, (int)s->motion.observer, angle, side);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_edge_is_where_it_is_seen) };
    return cmocka_run_group_tests_name("critical curve of those that move", tests, NULL, NULL);
}
