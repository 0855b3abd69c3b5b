/* Tests of governors of sessions that share a device: each session yields to the others, and recovers when they
 * stop. */
#include "shared_device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* 640 x 360 dragged in front of a sky, as measured on two cores (governor_recorded.h): 80 ms as requested, 27 at 400
 * x 225. */
static const struct truth sky = { .traced = 62, .reused = 14, .pixels = 5, .fixed = 2.4, .hidden = 0.6 };

static struct truth noisy(struct truth truth)
{
    truth.noise = 0.15;
    truth.spikes = 0.02;
    truth.spike = 4;
    return truth;
}

static struct sharer sharers[MOST];

static void drag_together(struct device *d, int n, struct truth truth, double pause)
{
    open_device(d, sharers, n);
    for (int i = 0; i < n; i++)
        join(d, i, "one", truth, pause, 10.0 * i, INFINITY);
}

static double rate(const struct sharer *s, double ms) { return 1e3 * (double)s->moved / ms; }

static uint32_t rung(const struct sharer *s) { return s->sim.governor.paces[1].rung; }

/* A session is served as if it were alone if all other sessions are at rest. */
static void alone_is_as_it_was(void **state)
{
    (void)state;
    for (int with_others = 0; with_others < 2; with_others++) {
        struct device d;
        uint32_t rungs[2][300];
        for (int told = 0; told < 2; told++) {
            seed = 7;
            open_device(&d, sharers, 3);
            d.alone = !told;
            join(&d, 0, "one", noisy(sky), 8, 0, INFINITY);
            for (int i = 1; i < 3; i++) { /* these sessions requested their last frames long ago */
                join(&d, i, i == 1 ? "one" : "another", sky, 8, -1, with_others ? -0.5 : -1);
                d.sharers[i].due = with_others ? -1 : INFINITY;
            }
            d.now = -1;
            go_on(&d, 1);
            for (int k = 0; k < 300; k++) {
                go_on(&d, 100);
                rungs[told][k] = rung(&d.sharers[0]);
                assert_true(!told || d.sharers[0].sim.governor.share == 1 || d.now < 1000);
            }
        }
        assert_memory_equal(rungs[0], rungs[1], sizeof rungs[0]);
    }
}

struct summary {
    double least, most, gap, used;
    uint64_t seen, hasty;
};

static struct summary look_at(const struct device *d, int first, int n, double ms)
{
    struct summary sum = { .least = INFINITY };
    for (int i = first; i < first + n; i++) {
        const struct sharer *s = &d->sharers[i];
        sum.least = fmin(sum.least, rate(s, ms));
        sum.most = fmax(sum.most, rate(s, ms));
        sum.gap = fmax(sum.gap, s->gap);
        sum.used += s->used / ms;
        sum.seen += s->seen;
        sum.hasty += s->hasty;
    }
    return sum;
}

static void tell(const char *what, int n, const struct device *d, const struct summary *sum)
{
    print_message("%s %d: %.1f to %.1f frames/s, %.0f ms apart at most, scale %g, device %.0f %%, %llu changes seen\n",
                  what, n, sum->least, sum->most, sum->gap, d->sharers[0].sim.last.scale, 100 * sum->used,
                  (unsigned long long)sum->seen);
}

/* A session without knowledge of its share keeps a picture that takes 30 ms. With eight sessions, each then gets only 4
 * frames a second. If sessions know their shares, all have the same rate (at least 12 a second with eight sessions),
 * and quality is stable. */
static void many_keep_moving(void **state)
{
    (void)state;
    static const double least[] = { 25, 24, 18, 16, 9 }, scale[] = { 0.625, 0.5, 0.375, 0.25, 0.25 };
    struct device d;
    for (int told = 0; told < 2; told++)
        for (int k = 0; k < 5; k++) {
            int n = 1 << k;
            drag_together(&d, n, sky, 10);
            d.alone = !told;
            go_on(&d, 5000);
            count_anew(&d);
            go_on(&d, 60e3);
            struct summary sum = look_at(&d, 0, n, 60e3);
            tell(told ? "sharing" : "knowing nothing", n, &d, &sum);
            assert_true(sum.seen == 0 && sum.most <= 1.02 * sum.least);
            assert_true(!told || sum.hasty == 0);
            assert_true(told ? sum.least >= least[k] : sum.least <= 1.02 * 34 / n);
            assert_true(sharers[0].sim.last.scale == (told ? scale[k] : scale[0]));
        }
}

/* All sessions keep moving, also with noise of 15 % and with spikes. */
static void noise_divides_nobody(void **state)
{
    (void)state;
    struct device d;
    for (int n = 2; n <= 16; n *= 2) {
        drag_together(&d, n, noisy(sky), 10);
        go_on(&d, 5000);
        count_anew(&d);
        go_on(&d, 120e3);
        struct summary sum = look_at(&d, 0, n, 120e3);
        tell("noisy", n, &d, &sum);
        assert_true(sum.most <= 1.1 * sum.least && sum.seen <= (unsigned)n);
        assert_true(n > 8 || sum.least >= 15);
    }
}

/* On any machine, with any pause, each session gets its share, and comes as close to its target as it would alone. */
static void parts_are_equal_on_any_machine(void **state)
{
    (void)state;
    struct device d;
    uint64_t seen = 0;
    int reached = 0;
    for (int k = 0; k < 200; k++) {
        int n = 2 + (int)(7 * uniform());
        struct truth truth = some_truth();
        truth.fixed = fmin(truth.fixed, 5);
        drag_together(&d, n, truth, 20 * uniform());
        go_on(&d, 30e3);
        count_anew(&d);
        go_on(&d, 30e3);
        struct summary sum = look_at(&d, 0, n, 30e3);
        seen += sum.seen;
        const struct sharer *s = &d.sharers[0];
        double share = s->sim.governor.share, period = fmax(33, fmin(33 / sqrt(share), 60)),
               cost = s->used / (double)s->moved;
        for (int i = 0; i < n; i++)
            assert_true(d.sharers[i].sim.governor.share >= 0.999 / n);
        if (rung(s) + 1 < s->sim.governor.ladder.n_rungs &&
            sum.used > 0.9) { /* excluded: the machine is too slow even for the lowest rung, or it is idle */
            assert_true(cost <= 1.1001 * may_take(period * share, truth.fixed));
            assert_true(sum.most <= 1.25 * sum.least);
            reached++;
        }
    }
    print_message("%d of 200 reached, %llu changes seen\n", reached, (unsigned long long)seen);
    assert_true(reached > 60 && seen <= 40);
}

/* A session whose frame waits long for other sessions does not count as one at rest. */
static void who_waits_is_not_taken_for_resting(void **state)
{
    (void)state;
    struct truth slow = sky;
    slow.traced *= 4;
    for (int told = 0; told < 2; told++) {
        struct device d;
        drag_together(&d, 16, slow, 10);
        d.alone = !told;
        go_on(&d, 20e3);
        struct summary sum = look_at(&d, 0, 16, 20e3);
        assert_true(sum.gap > 150 && sum.hasty == 0);
    }
}

/* Tests of one governor that knows its share. */

static void with_share(struct simulation *s, double share, enum pattern pattern, double ms)
{
    kd_governor_share(&s->governor, share);
    run(s, pattern, ms);
}

/* Frames that were slow with an eighth of the device do not limit the quality once the session has the whole device. */
static void a_ceiling_of_less_is_none(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 640, 360, (struct truth) { .traced = 14, .pixels = 6 });
    with_share(&s, 0.125, DRAG, 1000);
    assert_true(s.last.scale <= 0.5);
    with_share(&s, 1, DRAG, 1200);
    assert_true(s.last.final);
}

/* A climb that ends because other sessions come does not count as failed, however often they come. The wait before the
 * next climb does not grow. */
static void climbs_that_others_end_are_not_in_vain(void **state)
{
    (void)state;
    struct simulation s;
    begin(&s, kd_governor_params(), 640, 360, sky);
    for (int k = 0; k < 50; k++) {
        with_share(&s, 1, DRAG, 3000);
        uint32_t alone = s.governor.paces[1].rung;
        with_share(&s, 0.125, DRAG, 3000);
        assert_true(s.governor.paces[1].rung > alone);
    }
    assert_true(s.governor.paces[1].retry_ms <= 6000);
}

/* Tracing the lens map at the end of a drag delays all sessions. */
static void a_stall_is_shared(void **state)
{
    (void)state;
    for (int n = 1; n <= 8; n *= 2) {
        struct simulation s;
        double longest = 0;
        begin(&s, kd_governor_params(), 1280, 720, (struct truth) { .traced = 400, .reused = 4, .pixels = 1 });
        with_share(&s, 1.0 / n, DRAG, 20e3);
        for (double end = s.now + 10e3; s.now < end;) {
            double before = s.now;
            with_share(&s, 1.0 / n, PLAY, 1);
            longest = fmax(longest, s.now - before);
        }
        print_message("a stall of %.0f ms where %d share\n", longest, n);
        assert_true(longest <= 1.1 * 500 / n);
    }
}

/* Coming and going */

/* When the other sessions leave, a session regains within two and a half seconds the quality that it had alone. In the
 * seconds after other sessions come, all sessions receive their frames. */
static void others_come_and_go(void **state)
{
    (void)state;
    for (int others = 1; others < 16; others = 2 * others + 1)
        for (int noise = 0; noise < 2; noise++) {
            struct device d;
            struct truth truth = noise ? noisy(sky) : sky;
            open_device(&d, sharers, others + 1);
            join(&d, 0, "one", truth, 10, 0, INFINITY);
            for (int i = 1; i <= others; i++)
                join(&d, i, "one", truth, 10, 10e3 + 3 * i, 20e3);
            go_on(&d, 9.9e3);
            uint32_t before = rung(&d.sharers[0]);
            go_on(&d, 1.6e3);
            count_anew(&d);
            go_on(&d, 8.4e3);
            struct summary sum = look_at(&d, 0, others + 1, 8.4e3);
            tell("beside", others, &d, &sum);
            assert_true(others > 7 || sum.least >= 14);
            assert_true(rung(&d.sharers[0]) > before);
            go_on(&d, 2.6e3);
            assert_int_equal(rung(&d.sharers[0]), before);
            count_anew(&d);
            go_on(&d, 60e3);
            assert_true(d.sharers[0].seen <= (noise ? 2u : 0u) && d.sharers[0].sim.governor.share == 1);
        }
}

/* If another session pauses for less than two seconds within a gesture, its share is not given to the others, so
 * that their rates do not fluctuate. */
static void strokes_of_another_are_not_seen(void **state)
{
    (void)state;
    for (double lift = 60; lift <= 1900; lift *= 1.3)
        for (double stroke = 150; stroke <= 3200; stroke *= 1.3) {
            struct device d;
            open_device(&d, sharers, 2);
            join(&d, 0, "one", sky, 10, 0, INFINITY);
            struct sharer *s = join(&d, 1, "one", sky, 10, 0, INFINITY);
            s->stroke = stroke;
            s->lift = lift;
            go_on(&d, 20e3);
            count_anew(&d);
            go_on(&d, 60e3);
            assert_true(d.sharers[0].seen == 0);
        }
}

/* Unused time is lent */

/* A session with a small demand takes no more than this demand from the other sessions, whatever its rate of
 * requests. */
static void who_asks_for_little_gets_little(void **state)
{
    (void)state;
    for (double pause = 50; pause <= 6400; pause *= 2) {
        struct device d;
        open_device(&d, sharers, 2);
        join(&d, 0, "one", sky, 10, 0, INFINITY);
        join(&d, 1, "one", sky, pause, 0, INFINITY);
        go_on(&d, 20e3);
        count_anew(&d);
        go_on(&d, 60e3);
        const struct sharer *one = &d.sharers[0];
        print_message("another asks after %.0f ms: %.1f and %.1f frames/s, a share of %.2f, scale %g\n", pause,
                      rate(one, 60e3), rate(&d.sharers[1], 60e3), one->sim.governor.share, one->sim.last.scale);
        assert_true(rate(one, 60e3) > 22 && one->seen <= 2 && one->sim.governor.share > 0.55);
        assert_true(pause < 200 || one->sim.last.scale == 0.625); /* this session has the same rate as alone */
    }
}

/* Clients have equal shares, however many sessions each has. */
static void clients_share_before_sessions(void **state)
{
    (void)state;
    struct device d;
    open_device(&d, sharers, 8);
    join(&d, 0, "one", sky, 3, 0, INFINITY);
    for (int i = 1; i < 8; i++)
        join(&d, i, "other", sky, 3, 0, INFINITY);
    go_on(&d, 5e3);
    count_anew(&d);
    go_on(&d, 60e3);
    struct summary one = look_at(&d, 0, 1, 60e3), others = look_at(&d, 1, 7, 60e3);
    tell("one session of one client", 1, &d, &one);
    tell("beside another one's", 7, &d, &others);
    assert_true(d.sharers[0].sim.governor.share == 0.5);
    for (int i = 1; i < 8; i++)
        assert_true(fabs(d.sharers[i].sim.governor.share - 1.0 / 14) < 1e-9);
    assert_true(rung(&d.sharers[0]) < rung(&d.sharers[1]));
    assert_true(one.least >= 20);
}

/* Refinement */

/* A picture that takes long to refine yields to moving ones. If both belong to one client, it gets a fifth of that
 * client's time. If two clients own them, each client gets half of the time. */
static void refinement_makes_way(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct device d;
        open_device(&d, sharers, 9);
        for (int i = 0; i < 8; i++)
            join(&d, i, "one", sky, 10, 10.0 * i, INFINITY);
        struct truth slow = sky;
        slow.traced *= 50;
        struct sharer *s = join(&d, 8, k ? "another" : "one", slow, 10, 5e3, 5.1e3);
        s->sim.asked.image.samples = 4;
        go_on(&d, 5.5e3);
        count_anew(&d);
        go_on(&d, 4e3);
        struct summary sum = look_at(&d, 0, 8, 4e3);
        tell(k ? "beside a refinement of another client" : "beside a refinement", 8, &d, &sum);
        assert_true(sum.least > (k ? 8 : 13));
        go_on(&d, 600e3);
        assert_true(s->refined > 0 && s->turn.quality.final);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alone_is_as_it_was),
        cmocka_unit_test(many_keep_moving),
        cmocka_unit_test(noise_divides_nobody),
        cmocka_unit_test(parts_are_equal_on_any_machine),
        cmocka_unit_test(who_waits_is_not_taken_for_resting),
        cmocka_unit_test(a_ceiling_of_less_is_none),
        cmocka_unit_test(climbs_that_others_end_are_not_in_vain),
        cmocka_unit_test(a_stall_is_shared),
        cmocka_unit_test(others_come_and_go),
        cmocka_unit_test(strokes_of_another_are_not_seen),
        cmocka_unit_test(who_asks_for_little_gets_little),
        cmocka_unit_test(clients_share_before_sessions),
        cmocka_unit_test(refinement_makes_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
