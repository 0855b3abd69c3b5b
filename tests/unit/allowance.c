/* Tests of a client's long-term allowance of device time, with a simulated clock. */
#include "server/http/allowance.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#define NOW 1e6
#define NEAR 1e-6

static struct kd_allowance all;

static int fresh(void **state)
{
    (void)state;
    all = (struct kd_allowance) { .seconds = 30 };
    return 0;
}

static void test_no_limit(void **state)
{
    (void)state;
    all.seconds = 0;
    kd_allowance_charge(&all, "a", 1e9, NOW);
    assert_true(isinf(kd_allowance_left_ms(&all, "a", NOW)));
    assert_true(kd_allowance_may(&all, "a", true, NOW));
    assert_float_equal(kd_allowance_wait_ms(&all, "a", 1e9, NOW), 0, 0);
}

static void test_it_fills_at_its_rate_and_no_further(void **state)
{
    (void)state;
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW), 30e3, NEAR);
    kd_allowance_charge(&all, "a", 20e3, NOW);
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW), 10e3, NEAR);
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW + 10e3), 15e3, NEAR);
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW + 1e9), 30e3, NEAR);
    assert_float_equal(kd_allowance_left_ms(&all, "b", NOW), 30e3, NEAR);
    kd_allowance_charge(&all, "a", 5e3, NOW + 1e9);
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW + 1e9), 25e3, NEAR);
}

static void test_what_is_owed_is_waited_for(void **state)
{
    (void)state;
    kd_allowance_charge(&all, "a", 630e3, NOW); /* ten minutes of work leave a debt of ten minutes */
    assert_float_equal(kd_allowance_left_ms(&all, "a", NOW), -600e3, NEAR);
    const double wait = kd_allowance_wait_ms(&all, "a", 0, NOW);
    assert_float_equal(wait, 1200e3, 10);
    assert_true(kd_allowance_wait_ms(&all, "a", 0, NOW + wait - 10) > 0);
    assert_float_equal(kd_allowance_wait_ms(&all, "a", 0, NOW + wait), 0, 0);
    assert_float_equal(kd_allowance_wait_ms(&all, "b", 29e3, NOW), 0, 0);
    assert_float_equal(kd_allowance_wait_ms(&all, "b", 40e3, NOW), 20e3, 10);
}

static void test_patient_work_leaves_a_half(void **state)
{
    (void)state;
    kd_allowance_charge(&all, "a", 14e3, NOW);
    assert_true(kd_allowance_may(&all, "a", true, NOW));
    kd_allowance_charge(&all, "a", 2e3, NOW);
    assert_false(kd_allowance_may(&all, "a", true, NOW));
    assert_true(kd_allowance_may(&all, "a", false, NOW));
    kd_allowance_charge(&all, "a", 15e3, NOW);
    assert_false(kd_allowance_may(&all, "a", false, NOW));
    assert_true(kd_allowance_may(&all, "b", true, NOW));
}

/* The debt of a client is kept while other clients come and go. */
static void test_the_fullest_gives_way(void **state)
{
    (void)state;
    kd_allowance_charge(&all, "debtor", 100e3, NOW);
    for (unsigned i = 0; i < 4 * KD_ALLOWANCE_CLIENTS; i++) {
        char name[20];
        snprintf(name, sizeof name, "c%u", i);
        kd_allowance_charge(&all, name, 10 + i, NOW + 1);
    }
    assert_true(kd_allowance_left_ms(&all, "debtor", NOW) < -69e3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_no_limit, fresh),
        cmocka_unit_test_setup(test_it_fills_at_its_rate_and_no_further, fresh),
        cmocka_unit_test_setup(test_what_is_owed_is_waited_for, fresh),
        cmocka_unit_test_setup(test_patient_work_leaves_a_half, fresh),
        cmocka_unit_test_setup(test_the_fullest_gives_way, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
