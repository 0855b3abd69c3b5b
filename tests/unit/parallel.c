/* Tests that kd_parallel processes each item exactly once, for any number of items, also in nested calls. */
#include "base/cores.h"
#include "base/parallel.h"

#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { ITEMS = 1000 };

static void count(void *user, size_t item)
{
    atomic_uint *done = user;
    atomic_fetch_add(&done[item], 1);
}

static void test_each_once(void **state)
{
    static atomic_uint done[ITEMS];
    static const size_t numbers[] = { 0, 1, 2, 3, 17, ITEMS };
    (void)state;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        memset(done, 0, sizeof done);
        kd_parallel(numbers[k], count, done);
        for (size_t i = 0; i < ITEMS; i++)
            assert_int_equal(atomic_load(&done[i]), i < numbers[k]);
    }
}

static void count_ten(void *user, size_t item)
{
    atomic_uint *done = user;
    kd_parallel(10, count, done + 10 * item);
}

static void test_nested(void **state)
{
    static atomic_uint done[ITEMS];
    (void)state;
    kd_parallel(ITEMS / 10, count_ten, done);
    for (size_t i = 0; i < ITEMS; i++)
        assert_int_equal(atomic_load(&done[i]), 1);
}

static void test_idle_each_once(void **state)
{
    static atomic_uint done[ITEMS];
    static const unsigned threads[] = { 0, 1, 2, 3, 7, KD_PARALLEL_THREADS, 100 };
    (void)state;
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
        memset(done, 0, sizeof done);
        kd_parallel_threads = threads[k];
        kd_parallel_idle(ITEMS, count, done);
        for (size_t i = 0; i < ITEMS; i++)
            assert_int_equal(atomic_load(&done[i]), 1);
    }
    kd_parallel_threads = 0;
}

/* Each item ends only when another has begun, which shows that as many threads run at once as were requested. */
static atomic_uint begun;

static void meet(void *user, size_t item)
{
    (void)item;
    atomic_fetch_add(&begun, 1);
    while (atomic_load(&begun) < *(unsigned *)user)
        sched_yield();
}

static void test_threads_as_asked(void **state)
{
    unsigned threads = 5;
    (void)state;
    kd_parallel_threads = threads;
    kd_parallel_idle(threads, meet, &threads);
    kd_parallel_threads = 0;
    assert_int_equal(atomic_load(&begun), threads);
}

static void test_idle_cores(void **state)
{
    (void)state;
    assert_true(kd_cores_idle() < (int)kd_cores());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_once),      cmocka_unit_test(test_nested),
        cmocka_unit_test(test_idle_each_once), cmocka_unit_test(test_threads_as_asked),
        cmocka_unit_test(test_idle_cores),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
