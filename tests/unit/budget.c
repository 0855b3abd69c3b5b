/* Tests of the shares of the device's time, with a simulated clock. The shares are compared with another algorithm. */
#include "server/session/budget.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 20 };

static uint64_t seed = 1;
static double uniform(void) /* in [0, 1) */
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

struct bench {
    struct kd_budget budget;
    struct kd_budget_entry entries[MOST];
    double now;
};

static struct kd_budget_entry *enter(struct bench *b, int i, int client)
{
    b->entries[i] = (struct kd_budget_entry) { 0 };
    snprintf(b->entries[i].client, sizeof b->entries[i].client, "client %d", client);
    kd_budget_enter(&b->budget, &b->entries[i]);
    return &b->entries[i];
}

/* A frame that waits for other clients and uses the device for `ms`; then a pause. */
static void frame(struct bench *b, struct kd_budget_entry *e, double waits, double ms, double pause)
{
    kd_budget_ask(e, b->now);
    b->now += waits + ms;
    kd_budget_end(e, b->now, ms);
    b->now += pause;
}

static void want(struct bench *b, struct kd_budget_entry *e, double demand)
{
    const double ms = 10, pause = demand > 0 ? ms / demand - ms : 0;
    for (int k = 0; k < 2 && demand > 0; k++) {
        kd_budget_ask(e, b->now);
        kd_budget_end(e, b->now, ms);
        b->now += k ? 0 : pause;
    }
    kd_budget_ask(e, b->now + (demand > 0 ? pause : 0)); /* from now on the frame waits for as long as necessary */
}

static void who_is_alone_has_everything(void **state)
{
    (void)state;
    struct bench b = { 0 };
    struct kd_budget_entry *one = enter(&b, 0, 0), *other = enter(&b, 1, 0), *stranger = enter(&b, 2, 1);
    assert_true(kd_budget_share(&b.budget, one, b.now) == 1);
    for (int k = 0; k < 10; k++) {
        frame(&b, one, 0, 30, 5);
        assert_true(kd_budget_share(&b.budget, one, b.now) == 1);
    }
    for (int k = 0; k < 10; k++) /* the work of other clients counts for 400 ms */
        frame(&b, k % 2 ? other : stranger, 0, 20, 5);
    assert_true(kd_budget_share(&b.budget, one, b.now + 300) < 0.5);
    assert_true(kd_budget_share(&b.budget, one, b.now + 450) == 1);
}

/* Demand */

static void waiting_for_others_is_no_lack_of_eagerness(void **state)
{
    (void)state;
    for (double waits = 0; waits < 1e4; waits = 3 * waits + 10) {
        struct bench b = { 0 };
        struct kd_budget_entry *e = enter(&b, 0, 0);
        assert_true(kd_budget_demand(e, b.now) == 0);
        frame(&b, e, waits, 20, 60);
        assert_true(kd_budget_demand(e, b.now) == 0); /* a rate needs more than one frame */
        frame(&b, e, waits, 20, 60);
        assert_true(fabs(kd_budget_demand(e, b.now) - 0.25) < 1e-9);
        kd_budget_ask(e, b.now);
        assert_true(fabs(kd_budget_demand(e, b.now + 1e6) - 0.25) < 1e-9);
    }
}

static void a_single_pause_or_a_slow_frame_says_little(void **state)
{
    (void)state;
    struct bench b = { 0 };
    struct kd_budget_entry *e = enter(&b, 0, 0);
    for (int k = 0; k < 8; k++)
        frame(&b, e, 0, 20, 10);
    frame(&b, e, 0, 20, 390);
    assert_true(kd_budget_demand(e, b.now) > 0.66);
    frame(&b, e, 0, 20, 1e5); /* a long pause */
    assert_true(kd_budget_demand(e, b.now) == 0);
    kd_budget_ask(e, b.now); /* the request counts immediately */
    assert_true(kd_budget_demand(e, b.now) > 0.66);
    kd_budget_end(e, b.now, 100);
    assert_true(kd_budget_demand(e, b.now) < 0.81);
    for (int k = 0; k < 9; k++) /* rare and regular requests are a small demand */
        frame(&b, e, 0, 20, 380);
    assert_true(fabs(kd_budget_demand(e, b.now) - 0.05) < 1e-9);
}

static void frames_that_are_given_up_measure_nothing(void **state)
{
    (void)state;
    struct bench b = { 0 };
    struct kd_budget_entry *e = enter(&b, 0, 0);
    for (int k = 0; k < 4; k++)
        frame(&b, e, 0, 20, 20);
    kd_budget_ask(e, b.now);
    kd_budget_end(e, b.now + 5, 0);
    assert_true(fabs(kd_budget_demand(e, b.now + 10) - 0.5) < 1e-9);
    assert_true(kd_budget_demand(e, b.now + 1e3) == 0); /* from now on the entry does not wait */
}

/* Pauses between the hold time and 2 s belong to the same gesture. */
static void pauses_of_one_hand_are_bridged(void **state)
{
    (void)state;
    for (double pause = 100; pause < 4000; pause += 300) {
        struct bench b = { 0 };
        struct kd_budget_entry *e = enter(&b, 0, 0);
        for (int stroke = 0; stroke < 3; stroke++) {
            for (int k = 0; k < 8; k++)
                frame(&b, e, 0, 20, 10);
            b.now += pause - 10;
        }
        for (int k = 0; k < 4; k++)
            frame(&b, e, 0, 20, 10);
        double at = b.now - 10;
        assert_true(kd_budget_demand(e, at) > 0.66);
        assert_true(kd_budget_demand(e, at + 399) == kd_budget_demand(e, at));
        if (pause > 400 && pause < 2000)
            assert_true(kd_budget_demand(e, at + pause) == kd_budget_demand(e, at));
        else
            assert_true(kd_budget_demand(e, at + 401) == 0);
        assert_true(kd_budget_demand(e, at + 2001) == 0);
    }
}

/* Division */

static void all_have_the_same_part(void **state)
{
    (void)state;
    struct bench b = { 0 };
    for (int n = 1; n <= MOST; n++) {
        want(&b, enter(&b, n - 1, 0), 0.999);
        for (int i = 0; i < n; i++)
            assert_true(fabs(kd_budget_share(&b.budget, &b.entries[i], b.now) * n - 1) < 0.05);
    }
    for (int n = MOST; n > 1; n--) {
        assert_true(fabs(kd_budget_share(&b.budget, &b.entries[0], b.now) * n - 1) < 0.05);
        kd_budget_leave(&b.budget, &b.entries[n - 1]);
    }
    assert_true(kd_budget_share(&b.budget, &b.entries[0], b.now) == 1);
}

static void clients_come_before_their_sessions(void **state)
{
    (void)state;
    struct bench b = { 0 };
    for (int i = 0; i < 8; i++)
        want(&b, enter(&b, i, i > 0), 0.99);
    assert_true(fabs(kd_budget_share(&b.budget, &b.entries[0], b.now) - 1.0 / 2) < 1e-9);
    for (int i = 1; i < 8; i++)
        assert_true(fabs(kd_budget_share(&b.budget, &b.entries[i], b.now) - 1.0 / 14) < 1e-9);
}

/* Computes the share by another algorithm. It gives out the time in small drops. Each drop goes to the demand that has
 * received least so far and is not yet met. Entry n has unlimited demand. The time that it has received is the result.
 * */
static double pour(const double *sizes, int n, double whole)
{
    static const double drop = 1e-4;
    double has[MOST + 1] = { 0 };
    for (double left = whole; left > 0; left -= drop) {
        int least = n;
        for (int i = 0; i < n; i++)
            if (has[i] + drop / 2 < sizes[i] && has[i] < has[least])
                least = i;
        has[least] += drop;
    }
    return has[n];
}

static void what_is_left_by_some_is_had_by_others(void **state)
{
    (void)state;
    for (int round = 0; round < 300; round++) {
        struct bench b = { 0 };
        int n = 1 + (int)(8 * uniform()), clients = 1 + (int)(4 * uniform()), of[MOST];
        double demands[MOST], whole[MOST] = { 0 }, rivals[MOST];
        for (int i = 0; i < n; i++) {
            of[i] = (int)(clients * uniform());
            demands[i] = uniform() < 0.2 ? 0 : uniform() * uniform();
            struct kd_budget_entry *e = enter(&b, i, of[i]);
            want(&b, e, demands[i]);
            assert_true(fabs(kd_budget_demand(e, b.now) - demands[i]) < 1e-9);
            whole[of[i]] += demands[i];
        }
        for (int i = 0; i < n; i++) {
            int m = 0;
            for (int c = 0; c < clients; c++)
                if (c != of[i])
                    rivals[m++] = whole[c];
            double part = pour(rivals, m, 1);
            m = 0;
            for (int j = 0; j < n; j++)
                if (j != i && of[j] == of[i])
                    rivals[m++] = demands[j];
            part = pour(rivals, m, part);
            assert_true(fabs(kd_budget_share(&b.budget, &b.entries[i], b.now) - part) < 2e-3);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_is_alone_has_everything),
        cmocka_unit_test(waiting_for_others_is_no_lack_of_eagerness),
        cmocka_unit_test(a_single_pause_or_a_slow_frame_says_little),
        cmocka_unit_test(frames_that_are_given_up_measure_nothing),
        cmocka_unit_test(pauses_of_one_hand_are_bridged),
        cmocka_unit_test(all_have_the_same_part),
        cmocka_unit_test(clients_come_before_their_sessions),
        cmocka_unit_test(what_is_left_by_some_is_had_by_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
