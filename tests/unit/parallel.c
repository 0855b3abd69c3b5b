/* kd_parallel does each item once, whatever their number, and from within itself too. */
#include "base/parallel.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_each_once), cmocka_unit_test(test_nested) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
