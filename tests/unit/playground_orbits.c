/* Tests of orbits of the playground's bodies, compared with known results that share no equation with the stepping. */
#include "playground_support.h"

static void add(struct kd_playground *p, double mass, double x, double y, double vx, double vy)
{
    playground_put(p, (struct kd_playground_body) { .mass = mass, .x = { x, y, 0 }, .v = { vx, vy, 0 } });
}

/* A body takes a thousand turns of an ellipse round the hole; so does a bound pair. The error of the energy oscillates.
 * Its mean over the last tenth of the time equals that over the first tenth within a hundredth of the amplitude. */
static void energy_has_no_trend_over_a_thousand_orbits(void **state)
{
    (void)state;
    for (int pair = 0; pair < 2; pair++) {
        struct kd_playground_params params = playground_quiet();
        params.h_max = 1000;
        struct kd_playground *p = playground_make(params);
        double period;
        if (pair) { /* e = 0.5: at the wide end of a = 20, m = 1e-3 in all, far from the hole */
            const double v = sqrt(1e-3 / 20 * (1 - 0.5) / (1 + 0.5));
            add(p, 5e-4, 9e5, 15, 0.5 * v, 0);
            add(p, 5e-4, 9e5, -15, -0.5 * v, 0);
            period = 2 * M_PI * sqrt(8000 / 1e-3);
        } else { /* r goes from 30 to some 13 */
            add(p, 1e-6, 30, 0, 0, 0.7 * kd_playground_circular(30));
            period = 2 * M_PI * pow(22, 1.5);
        }
        const double e0 = kd_playground_totals(p).energy;
        double sum[10] = { 0 }, low = INFINITY, high = -INFINITY;
        const int pieces = 10000;
        for (int i = 0; i < pieces; i++) {
            playground_advance(p, 1000 * period / pieces);
            const double error = kd_playground_totals(p).energy / e0 - 1;
            sum[i * 10 / pieces] += error * 10 / pieces;
            low = fmin(low, error);
            high = fmax(high, error);
        }
        print_message("pair %d: swing %.3g, first %.6g, last %.6g, steps %llu\n", pair, high - low, sum[0], sum[9],
                      (unsigned long long)p->steps);
        assert_true(high - low < 2e-3);
        assert_true(fabs(sum[9] - sum[0]) < 0.01 * (high - low));
        kd_playground_destroy(p);
    }
}

/* B. Paczynski & P. Wiita 1980: the last stable orbit is at 6, the marginally bound one at 4. Pushed inwards by a
 * thousandth, a circle outside 6 oscillates and one inside plunges. */
static void circles_stay_outside_six_and_plunge_inside(void **state)
{
    (void)state;
    const double radii[] = { 5.9, 6.1 };
    for (int i = 0; i < 2; i++) {
        struct kd_playground *p = playground_make(playground_quiet());
        const double r = radii[i], v = kd_playground_circular(r);
        add(p, 1e-6, r, 0, i ? 0 : -1e-3 * v, v);
        double least = r, most = r;
        for (int k = 0; k < 1000 && p->n; k++) {
            playground_advance(p, 65);
            if (!p->n)
                break;
            least = fmin(least, kd_playground_radius(p->bodies[0].x));
            most = fmax(most, kd_playground_radius(p->bodies[0].x));
        }
        print_message("r = %g: %zu bodies, %.6g to %.6g, t = %g\n", r, p->n, least, most, p->t);
        assert_int_equal(p->n, i);
        if (i) {
            assert_true(least > 6.05 && most < 6.15);
        } else {
            assert_int_equal(kd_playground_event_at(&p->events, 1)->kind, KD_PLAYGROUND_CAPTURED);
        }
        kd_playground_destroy(p);
    }
}

/* A body starts far away with the energy of rest at infinity. The marginally bound circle has the angular momentum 4.
 * With 1.001 times this value the body turns back; with 0.999 times it falls in. */
static void the_marginally_bound_orbit_is_at_four(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct kd_playground *p = playground_make(playground_quiet());
        const double r = 1000, l = i ? 4.004 : 3.996, v2 = 2 / (r - 2), across = l / r;
        add(p, 1e-6, r, 0, -sqrt(v2 - across * across), across);
        double least = r;
        for (int k = 0; k < 60000 && p->n && p->t < 40000; k++) {
            playground_advance(p, 1);
            least = p->n ? fmin(least, kd_playground_radius(p->bodies[0].x)) : 0;
        }
        print_message("l = %g: %zu bodies, nearest %.6g\n", l, p->n, least);
        assert_int_equal(p->n, i);
        if (i)
            assert_true(least > 4 && least < 4.3);
        kd_playground_destroy(p);
    }
}

/* The result does not depend on how the time is divided into calls, to the last bit. This holds also for calls that a
 * budget stops. */
static void calls_do_not_matter(void **state)
{
    (void)state;
    struct kd_playground *p[2];
    struct kd_playground_progress progress;
    for (int i = 0; i < 2; i++) {
        p[i] = playground_make(playground_quiet());
        add(p[i], 1e-3, 12, 0, 0, 0.3);
        add(p[i], 1e-3, -15, 2, 0, -0.28);
    }
    playground_advance(p[0], 500);
    p[1]->params.budget = 7;
    unsigned slowed = 0;
    while (p[1]->t < p[0]->t) {
        kd_playground_advance(p[1], 1.7, &progress);
        slowed += progress.slowed;
    }
    assert_true(slowed > 0);
    while (p[0]->t < p[1]->t)
        playground_advance(p[0], 1e-9);
    assert_true(p[0]->t == p[1]->t);
    for (int k = 0; k < 2; k++) {
        assert_memory_equal(p[0]->bodies[k].x, p[1]->bodies[k].x, sizeof p[0]->bodies[k].x);
        assert_memory_equal(p[0]->bodies[k].v, p[1]->bodies[k].v, sizeof p[0]->bodies[k].v);
    }
    kd_playground_destroy(p[0]);
    kd_playground_destroy(p[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_has_no_trend_over_a_thousand_orbits),
        cmocka_unit_test(circles_stay_outside_six_and_plunge_inside),
        cmocka_unit_test(the_marginally_bound_orbit_is_at_four),
        cmocka_unit_test(calls_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
