/* Tests the kernel's figure of time spent waiting for a core, which is subtracted from the measured costs of passes.
 * In the test two threads that never sleep share one core, so that each waits half of the time. */
#include "base/cpu_pressure.h"

#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

static void *spin(void *user)
{
    struct timespec t = { 0 };
    while (t.tv_nsec < 100000000 && !t.tv_sec) /* runs until it has used 0.1 s of processor time */
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    pthread_barrier_wait(user); /* a thread that has ended is no longer counted */
    pthread_barrier_wait(user);
    return NULL;
}

static void shared_core(void **state)
{
    (void)state;
    cpu_set_t all, one;
    pthread_t threads[2];
    pthread_barrier_t done;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && !CPU_COUNT(&one); i++)
        if (CPU_ISSET(i, &all))
            CPU_SET(i, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    pthread_barrier_init(&done, NULL, 3);
    struct kd_cpu_pressure before = kd_cpu_pressure_now();
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, spin, &done), 0);
    pthread_barrier_wait(&done);
    double share = kd_cpu_pressure_share(&before);
    const struct kd_cpu_pressure after = kd_cpu_pressure_now();
    pthread_barrier_wait(&done);
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&done);
    if (!(after.ran_ns > 0)) {
        print_message("this kernel does not say how long threads wait\n");
        assert_true(share == 1);
        return;
    }
    assert_true(after.ran_ns - before.ran_ns > 1.9e8);
    assert_true(share > 0 && share < 0.7);
}

static void nothing_known(void **state)
{
    (void)state;
    /* earlier totals that exceed the current ones, as after the end of some threads */
    struct kd_cpu_pressure future = { 1e30, 1e30 };
    assert_true(kd_cpu_pressure_share(&future) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(shared_core), cmocka_unit_test(nothing_known) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
