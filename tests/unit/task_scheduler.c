/* Tests of jobs that take turns: a job that computes for a long time lets others go first in the middle of its turn. */
#include "server/http/task_scheduler.h"

#include "base/clock.h"
#include "base/cores.h"
#include "base/pause.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

#define PATIENCE_MS 60e3
enum { LONG = 40, PIECES = 20, WORKERS = 4 };

static _Atomic bool over, destroyed, stopped_without_reason;
static _Atomic unsigned dones, begun, at_once, most_at_once, computing;

static void count_done(struct kd_scheduler_job *job)
{
    (void)job;
    atomic_fetch_add(&dones, 1);
}

/* Computes until another job has had its turn. */
static enum kd_slice_result compute(struct kd_scheduler_job *job)
{
    (void)job;
    atomic_fetch_add(&computing, 1);
    for (const double since = kd_clock_ms(); !atomic_load(&over) && kd_clock_ms() - since < PATIENCE_MS;)
        if (kd_pause())
            atomic_store(&stopped_without_reason, true);
    return KD_SLICE_LAST;
}

static enum kd_slice_result end_all(struct kd_scheduler_job *job)
{
    (void)job;
    atomic_store(&over, true);
    return KD_SLICE_LAST;
}

/* A piece of a shared job: some 40 ms. */
static enum kd_slice_result piece(struct kd_scheduler_job *job)
{
    (void)job;
    const unsigned own = atomic_fetch_add(&begun, 1);
    if (own >= PIECES)
        return KD_SLICE_LAST;
    const unsigned n = atomic_fetch_add(&at_once, 1) + 1;
    if (n > atomic_load(&most_at_once))
        atomic_store(&most_at_once, n);
    for (const double since = kd_clock_ms(); kd_clock_ms() - since < 40;)
        kd_pause();
    atomic_fetch_sub(&at_once, 1);
    return own + 1 == PIECES ? KD_SLICE_LAST : KD_SLICE_MORE;
}

static void wait_for(unsigned n)
{
    for (const double since = kd_clock_ms(); atomic_load(&dones) < n && kd_clock_ms() - since < 2 * PATIENCE_MS;)
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    assert_int_equal(atomic_load(&dones), n);
}

static struct kd_scheduler *begin(void)
{
    struct kd_scheduler *scheduler = NULL;
    struct kd_error error;
    atomic_store(&over, false);
    atomic_store(&dones, 0);
    assert_int_equal(kd_scheduler_create(LONG + 1, LONG + 1, &scheduler, &error), KD_OK);
    return scheduler;
}

/* There are more long turns than workers, and the short turn comes last. */
static void test_a_short_turn_comes_between_long_ones(void **state)
{
    (void)state;
    struct kd_scheduler *scheduler = begin();
    static struct kd_scheduler_job jobs[LONG], last;
    for (int i = 0; i < LONG; i++) {
        jobs[i] = (struct kd_scheduler_job) { .turn = compute, .done = count_done };
        kd_scheduler_push(scheduler, &jobs[i]);
    }
    const double since = kd_clock_ms();
    last = (struct kd_scheduler_job) { .turn = end_all, .done = count_done };
    kd_scheduler_push(scheduler, &last);
    wait_for(LONG + 1);
    assert_true(kd_clock_ms() - since < PATIENCE_MS);
    assert_true(atomic_load(&over));
    while (kd_scheduler_unfinished(scheduler))
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    kd_scheduler_destroy(scheduler);
}

/* While a short turn waits, a job that several workers share begins at most one turn for each worker. */
static void test_a_shared_job_does_not_begin_all_its_turns(void **state)
{
    (void)state;
    struct kd_scheduler *scheduler = begin();
    static struct kd_scheduler_job shared, others[4];
    atomic_store(&begun, 0);
    shared = (struct kd_scheduler_job) { .turn = piece, .done = count_done, .shared = true };
    kd_scheduler_push(scheduler, &shared);
    for (int i = 0; i < 4; i++) {
        others[i] = (struct kd_scheduler_job) { .turn = compute, .done = count_done };
        kd_scheduler_push(scheduler, &others[i]);
    }
    wait_for(1);
    static struct kd_scheduler_job last;
    last = (struct kd_scheduler_job) { .turn = end_all, .done = count_done };
    kd_scheduler_push(scheduler, &last);
    wait_for(6);
    assert_true(atomic_load(&begun) >= PIECES);
    assert_in_range(atomic_load(&most_at_once), 1, kd_cores());
    while (kd_scheduler_unfinished(scheduler))
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    kd_scheduler_destroy(scheduler);
}

static void *destroy(void *scheduler)
{
    kd_scheduler_destroy(scheduler);
    atomic_store(&destroyed, true);
    return NULL;
}

/* A paused turn ends when the queue is destroyed, as a running one does. */
static void test_a_queue_is_destroyed_while_turns_are_paused(void **state)
{
    (void)state;
    struct kd_scheduler *scheduler = begin();
    static struct kd_scheduler_job jobs[LONG];
    pthread_t thread;
    atomic_store(&computing, 0);
    for (int i = 0; i < LONG; i++) {
        jobs[i] = (struct kd_scheduler_job) { .turn = compute, .done = count_done };
        kd_scheduler_push(scheduler, &jobs[i]);
    }
    while (atomic_load(&computing) <= kd_cores()) /* waits until at least one turn has paused */
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    assert_int_equal(pthread_create(&thread, NULL, destroy, scheduler), 0);
    /* now the queue is being closed while turns are in progress */
    nanosleep(&(struct timespec) { .tv_nsec = 50000000 }, NULL);
    atomic_store(&over, true);
    for (const double since = kd_clock_ms(); !atomic_load(&destroyed) && kd_clock_ms() - since < PATIENCE_MS;)
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    assert_true(atomic_load(&destroyed));
    pthread_join(thread, NULL);
}

static _Atomic bool client_left, was_told, was_told_again;

static bool has_left(struct kd_scheduler_job *job)
{
    (void)job;
    return atomic_load(&client_left);
}

/* Computes until nobody waits for it any more. */
static enum kd_slice_result compute_for_a_client(struct kd_scheduler_job *job)
{
    (void)job;
    atomic_fetch_add(&computing, 1);
    bool told = false;
    for (const double since = kd_clock_ms(); !told && kd_clock_ms() - since < PATIENCE_MS;)
        told = kd_pause();
    atomic_store(&was_told, told);
    atomic_store(&was_told_again, kd_pause() && kd_pause_every(0, 7) && !kd_pause_every(1, 7));
    return KD_SLICE_LAST;
}

/* If a job's client has left, the job's next pause and all later ones report this. Pauses of later jobs on the same
 * threads, and of jobs without a client, do not. */
static void test_a_turn_that_nobody_waits_for_ends(void **state)
{
    (void)state;
    struct kd_scheduler *scheduler = begin();
    static struct kd_scheduler_job jobs[WORKERS], last[WORKERS];
    atomic_store(&client_left, false);
    atomic_store(&computing, 0);
    for (int i = 0; i < WORKERS; i++) {
        jobs[i] = (struct kd_scheduler_job) { .turn = compute_for_a_client, .done = count_done, .unwanted = has_left };
        kd_scheduler_push(scheduler, &jobs[i]);
    }
    while (atomic_load(&computing) < WORKERS)
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    atomic_store(&client_left, true);
    wait_for(WORKERS);
    assert_true(atomic_load(&was_told));
    assert_true(atomic_load(&was_told_again));
    for (int i = 0; i < WORKERS; i++) {
        last[i] = (struct kd_scheduler_job) { .turn = compute, .done = count_done };
        kd_scheduler_push(scheduler, &last[i]);
    }
    while (atomic_load(&computing) < 2 * WORKERS)
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    assert_int_equal(atomic_load(&dones), WORKERS);
    atomic_store(&over, true);
    wait_for(2 * WORKERS);
    assert_false(atomic_load(&stopped_without_reason));
    kd_scheduler_destroy(scheduler);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_a_short_turn_comes_between_long_ones),
                                        cmocka_unit_test(test_a_shared_job_does_not_begin_all_its_turns),
                                        cmocka_unit_test(test_a_queue_is_destroyed_while_turns_are_paused),
                                        cmocka_unit_test(test_a_turn_that_nobody_waits_for_ends) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
