/* Tests that the number of items in a submission follows the measured time. A submission on a busy machine takes as
 * long as on an idle one. */
#include "render/device/slice_pace.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 100000 };
#define NS 1e5 /* ns of an item on an idle device: a submission has 400 items */

/* Runs submissions on a device that is slower than estimated. Returns the time of the last one. */
static double run(struct kd_slice_pace *pace, unsigned submissions, double slower, double ns)
{
    double now = 1000, ms = 0;
    for (unsigned i = 0; i < submissions; i++) {
        kd_slice_begin(pace, now);
        ms = kd_slice_items(pace, ns, MOST) * ns * 1e-6 * slower;
        now += ms;
        kd_slice_end(pace, now);
    }
    return ms;
}

static void an_idle_device(void **state)
{
    (void)state;
    struct kd_slice_pace pace = { 0 };
    assert_float_equal(run(&pace, 1, 1, NS), KD_SLICE_MS, 0.2);
    /* the submission takes no longer than estimated */
    assert_float_equal(run(&pace, 100, 0.5, NS), KD_SLICE_MS / 2, 0.2);
    assert_int_equal(kd_slice_items(&pace, NS, 7), 7);
    assert_int_equal(kd_slice_items(&pace, 1e12, MOST), 1);
}

static void a_busy_machine(void **state)
{
    (void)state;
    for (double slower = 2; slower <= KD_SLOWEST; slower *= 2) {
        struct kd_slice_pace pace = { 0 };
        assert_float_equal(run(&pace, 1, slower, NS), slower * KD_SLICE_MS, 1);
        assert_in_range((uintmax_t)run(&pace, 7, slower, NS), 0.9 * KD_SLICE_MS, 1.2 * KD_SLICE_MS);
        run(&pace, 60, 1, NS); /* afterwards the machine is idle again */
        assert_true(run(&pace, 1, 1, NS) > 0.95 * KD_SLICE_MS);
    }
}

/* After one long submission, as when a kernel is compiled, the next few submissions are shorter, but not shorter than a
 * limit. */
static void one_that_is_long(void **state)
{
    (void)state;
    struct kd_slice_pace pace = { 0 };
    run(&pace, 1, 1e4, NS);
    assert_true(run(&pace, 1, 1, NS) >= KD_SLICE_MS / KD_SLOWEST);
    assert_true(run(&pace, 40, 1, NS) > 0.8 * KD_SLICE_MS);
}

/* Short work, and work whose time is unknown, must not change the measured speed of the device. */
static void what_says_nothing(void **state)
{
    (void)state;
    struct kd_slice_pace pace = { 0 };
    kd_slice_begin(&pace, 0);
    kd_slice_end(&pace, 1e4);
    assert_float_equal(pace.slowness, 0, 0);
    kd_slice_begin(&pace, 0);
    kd_slice_items(&pace, NS, 5); /* half a millisecond */
    kd_slice_end(&pace, 1e4);
    assert_float_equal(pace.slowness, 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_idle_device),
        cmocka_unit_test(a_busy_machine),
        cmocka_unit_test(one_that_is_long),
        cmocka_unit_test(what_says_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
