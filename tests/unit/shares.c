/* Tests of shares of the device with a simulated clock: the order in which sharers are served, and the time that each
 * gets. */
#include "server/http/shares.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define SLICE 40.0

struct work {
    struct kd_claim claim; /* must be the first member */
    double left, came, began, ended, served;
    bool here, barred;
};

struct bench {
    struct kd_shares shares;
    struct work works[600];
    unsigned n;
    double now;
};

static struct work *come(struct bench *b, const char *client, enum kd_class class, double ms)
{
    struct work *w = &b->works[b->n++];
    *w = (struct work) {
        .claim = { .class = class, .left_ms = ms }, .left = ms, .came = b->now, .began = NAN, .ended = NAN, .here = true
    };
    snprintf(w->claim.client, sizeof w->claim.client, "%s", client);
    kd_shares_add(&b->shares, &w->claim);
    return w;
}

static bool may(const struct kd_claim *claim, void *user)
{
    (void)user;
    return !((const struct work *)claim)->barred;
}

/* Serves one turn: a short piece of work is done completely, others for a slice. NULL: idle. */
static struct work *turn(struct bench *b)
{
    struct work *w = (struct work *)kd_shares_next(&b->shares, may, NULL);
    if (!w)
        return NULL;
    double ms = fmin(w->left, w->left <= 100 ? 100 : SLICE);
    if (isnan(w->began))
        w->began = b->now;
    b->now += ms;
    w->left -= ms;
    w->served += ms;
    kd_shares_charge(&b->shares, &w->claim, ms);
    if (w->left <= 0) {
        w->ended = b->now;
        w->here = false;
        kd_shares_remove(&b->shares, &w->claim);
    }
    return w;
}

static void run(struct bench *b, double until)
{
    while (b->now < until && turn(b))
        ;
}

/* A client with less work than its share waits for at most one slice of each other client, whatever the others
 * request. */
static void a_small_one_beside_any_load(void **state)
{
    (void)state;
    static struct bench b;
    for (unsigned others = 1; others <= 3; others++)
        for (unsigned each = 1; each <= 40; each *= 3) {
            char name[16];
            memset(&b, 0, sizeof b);
            for (unsigned i = 0; i < others; i++)
                for (unsigned k = 0; k < each; k++) {
                    snprintf(name, sizeof name, "other %u", i);
                    come(&b, name, k % KD_N_CLASSES, 60000);
                }
            run(&b, 100000);
            struct work *small = come(&b, "small", KD_CLASS_PICTURE, 60);
            run(&b, b.now + 1000);
            if (!(small->ended - small->came <= 60 + others * SLICE))
                fail_msg("%u clients with %u works each: %g ms", others, each, small->ended - small->came);
        }
}

/* Two clients get half each, whether they have one piece of work or thirty; three get a third each. */
static void shares_are_by_client(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *one = come(&b, "one", KD_CLASS_PICTURE, 1e9);
    for (int i = 0; i < 30; i++)
        come(&b, "many", KD_CLASS_PICTURE, 1e9);
    run(&b, 100000);
    assert_true(fabs(one->served - 50000) <= 2 * SLICE);
    struct work *third = come(&b, "third", KD_CLASS_JOB, 1e9);
    run(&b, 160000);
    assert_true(fabs(third->served - 20000) <= 2 * SLICE);
}

/* Weights of the classes, from the table in shares.h. */
static const double weight[KD_N_CLASSES] = { 64, 8, 4, 4, 2, 0.1, 0.1 };

/* The classes of one client share by their weights. */
static void classes_of_a_client(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *w[KD_N_CLASSES];
    for (unsigned i = 0; i < KD_N_CLASSES; i++)
        w[i] = come(&b, "one", i, 1e9);
    run(&b, 822000);
    for (unsigned i = 0; i < KD_N_CLASSES; i++)
        assert_true(fabs(w[i]->served - 10000 * weight[i]) <= 8 * SLICE);
}

/* A probe of a pixel is served after the slice that is being computed, whatever else the same client has requested. */
static void a_pixel_is_next(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    come(&b, "one", KD_CLASS_PICTURE, 1e9);
    come(&b, "one", KD_CLASS_JOB, 1e9);
    come(&b, "one", KD_CLASS_LIVE, 1e9);
    for (int i = 0; i < 20; i++) {
        run(&b, b.now + 700);
        struct work *pixel = come(&b, "one", KD_CLASS_PIXEL, 80);
        assert_ptr_equal(turn(&b), pixel);
        assert_false(pixel->here);
    }
}

/* A film goes before a view of the same client that moves by itself or is refined. Such a view still gets a twentieth
 * of the time. */
static void a_film_beside_an_idle_view(void **state)
{
    (void)state;
    static const enum kd_class idle[] = { KD_CLASS_IDLE, KD_CLASS_REFINEMENT };
    static struct bench b;
    for (int i = 0; i < 2; i++) {
        memset(&b, 0, sizeof b);
        struct work *film = come(&b, "one", KD_CLASS_JOB, 1e9), *view = come(&b, "one", idle[i], 1e9);
        run(&b, 100000);
        assert_true(film->served >= 94000 && view->served >= 4000);
    }
}

/* Beside two live sessions that would use all the time, a picture of the same client gets its turns, and the sessions
 * continue. */
static void a_picture_beside_living_sessions(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *live[2] = { NULL, NULL }, *long_one = NULL;
    unsigned frames = 0, pictures = 0;
    double worst = 0, live_worst = 0;
    for (unsigned i = 0; i < 200; i++) {
        for (int k = 0; k < 2; k++)
            if (!live[k] || !live[k]->here) {
                if (live[k]) {
                    frames++;
                    live_worst = fmax(live_worst, live[k]->ended - live[k]->came);
                    live[k]->here = false;
                }
                live[k] = come(&b, "one", KD_CLASS_LIVE, 33);
            }
        if (!long_one || !long_one->here) {
            if (long_one) {
                pictures++;
                worst = fmax(worst, long_one->ended - long_one->came);
            }
            long_one = come(&b, "one", KD_CLASS_PICTURE, 60);
        }
        assert_non_null(turn(&b));
    }
    assert_true(pictures > 20 && frames > 100);
    assert_true(worst <= 300 && live_worst <= 200);
}

/* Within one client and class, short pieces of work go before long ones, but long ones do not wait for ever. */
static void short_first(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *long_one = come(&b, "one", KD_CLASS_PICTURE, 5000), *short_one = come(&b, "one", KD_CLASS_PICTURE, 50);
    run(&b, 50);
    assert_true(short_one->ended <= 50);
    /* three short pieces are always waiting, which is more than there is time for */
    while (b.n < 590 && isnan(long_one->began)) {
        while (b.n - 2 < 2 + b.now / 50)
            come(&b, "one", KD_CLASS_PICTURE, 50);
        turn(&b);
    }
    assert_false(isnan(long_one->began));
    /* the long piece must not begin before its own length has passed, nor end after four times its length */
    assert_true(long_one->began >= 5000 && long_one->began <= 4 * 5000);
}

/* A client cannot save up time while it is away or blocked, and does not pay later for time that it used while
 * alone. */
static void no_savings_and_no_debts(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *alone = come(&b, "alone", KD_CLASS_PICTURE, 1e9), *barred = come(&b, "barred", KD_CLASS_PICTURE, 1e9);
    barred->barred = true;
    run(&b, 600000);
    struct work *late = come(&b, "late", KD_CLASS_PICTURE, 1e9);
    double before = alone->served;
    run(&b, 602000);
    assert_true(fabs(late->served - 1000) <= 2 * SLICE && fabs(alone->served - before - 1000) <= 2 * SLICE);
    barred->barred = false;
    before = late->served;
    run(&b, 605000);
    assert_true(barred->served <= 1000 + 200 + 2 * SLICE); /* tests that it catches up by at most 200 ms */
    assert_true(late->served - before >= 1000 - 200 - 2 * SLICE);
}

/* A class of a client's work that was blocked catches up by at most 200 ms of the device, whatever its weight. */
static void a_class_that_was_barred(void **state)
{
    (void)state;
    static struct bench b;
    for (unsigned i = 0; i < KD_N_CLASSES; i++)
        for (unsigned k = 0; k < KD_N_CLASSES; k++) {
            if (i == k)
                continue;
            memset(&b, 0, sizeof b);
            struct work *barred = come(&b, "one", i, 1e9), *other = come(&b, "one", k, 1e9);
            barred->barred = true;
            run(&b, 60000);
            barred->barred = false;
            const double before = other->served, waited = b.now;
            while (other->served <= before)
                assert_non_null(turn(&b));
            /* The bound is a sum of four times: 200 ms; the time until the class's own share is due between two slices
             * of the other class; a slice of the other class in progress; and the rounding to one slice. */
            assert_true(b.now - waited <= 200 + SLICE * (weight[i] / weight[k]) + 3 * SLICE);
        }
}

/* A client that disconnects and returns with new work each time gets no more than its share. */
static void coming_and_going(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *steady = come(&b, "steady", KD_CLASS_PICTURE, 1e9), *w = NULL;
    double taken = 0;
    while (b.now < 20000) {
        if (!w || !w->here) {
            b.n = 1;
            w = come(&b, "fickle", KD_CLASS_LIVE, 90);
        }
        double before = b.now;
        if (turn(&b) == w)
            taken += b.now - before;
    }
    assert_true(taken <= 10000 + 100 && steady->served >= 10000 - 100);
}

/* If there are more clients than table entries, some clients share an entry, and all are served. */
static void more_clients_than_places(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    for (unsigned i = 0; i < 3 * KD_SHARE_CLIENTS; i++) {
        char name[16];
        snprintf(name, sizeof name, "%u", i);
        come(&b, name, i % KD_N_CLASSES, 30);
    }
    run(&b, 1e9);
    for (unsigned i = 0; i < b.n; i++)
        assert_false(b.works[i].here);
    assert_true(fabs(b.now - 30.0 * b.n) < 1e-6);
}

/* Wrong estimates change the order, not the shares. */
static void wrong_estimates(void **state)
{
    (void)state;
    static struct bench b;
    memset(&b, 0, sizeof b);
    struct work *liar = come(&b, "liar", KD_CLASS_PICTURE, 1), *honest = come(&b, "honest", KD_CLASS_PICTURE, 1e9);
    liar->left = 1e9;
    run(&b, 10000);
    assert_true(fabs(liar->served - honest->served) <= 2 * SLICE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_small_one_beside_any_load),
        cmocka_unit_test(shares_are_by_client),
        cmocka_unit_test(classes_of_a_client),
        cmocka_unit_test(a_pixel_is_next),
        cmocka_unit_test(a_film_beside_an_idle_view),
        cmocka_unit_test(a_picture_beside_living_sessions),
        cmocka_unit_test(short_first),
        cmocka_unit_test(no_savings_and_no_debts),
        cmocka_unit_test(a_class_that_was_barred),
        cmocka_unit_test(coming_and_going),
        cmocka_unit_test(more_clients_than_places),
        cmocka_unit_test(wrong_estimates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
