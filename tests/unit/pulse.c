/* Tests of kd_pulse, which tells a thread that hangs from a thread that works, and from a process that was stopped for
 * a while. */
#include "server/render/pulse.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define DEADLINE_MS 20u /* deadline of a submission: the longest allowed time between two calls of kd_pulse */

static void sleep_ms(double ms) { nanosleep(&(struct timespec) { .tv_nsec = (long)(1e6 * ms) }, NULL); }

/* Checks every 2 ms until `ms` have passed, which is long enough for a busy machine. Returns the seconds that were
 * reported last. */
static double look(struct kd_pulse *pulse, double ms, bool beats)
{
    double s = 0;
    for (double end = kd_clock_ms() + ms; !s && kd_clock_ms() < end; sleep_ms(2)) {
        if (beats)
            kd_pulse_beat(pulse);
        s = kd_pulse_missing_s(pulse, DEADLINE_MS);
    }
    return s;
}

static void a_thread_that_rests_or_works_does_not_hang(void **state)
{
    (void)state;
    struct kd_pulse pulse = { 0 };
    assert_true(look(&pulse, 20 * DEADLINE_MS, false) == 0);
    assert_true(look(&pulse, 20 * DEADLINE_MS, true) == 0);
    kd_pulse_rest(&pulse);
    assert_true(look(&pulse, 20 * DEADLINE_MS, false) == 0);
}

static void a_thread_without_a_beat_hangs(void **state)
{
    (void)state;
    struct kd_pulse pulse = { 0 };
    kd_pulse_beat(&pulse);
    const double since = kd_clock_ms(), s = look(&pulse, 60e3, false);
    assert_true(s > 1e-3 * KD_PULSE_DEADLINES * DEADLINE_MS);
    assert_true(kd_clock_ms() - since > KD_PULSE_DEADLINES * DEADLINE_MS - 2);
    kd_pulse_beat(&pulse); /* the thread has returned */
    assert_true(kd_pulse_missing_s(&pulse, DEADLINE_MS) == 0);
}

static void a_process_that_was_stopped_does_not_hang(void **state)
{
    (void)state;
    struct kd_pulse pulse = { 0 };
    kd_pulse_beat(&pulse);
    assert_true(kd_pulse_missing_s(&pulse, DEADLINE_MS) == 0);
    for (int i = 0; i < KD_PULSE_DEADLINES - 1; i++) { /* each pause is longer than a thread may be silent */
        sleep_ms(i ? 2 * DEADLINE_MS : 2.0 * KD_PULSE_DEADLINES * DEADLINE_MS);
        assert_true(kd_pulse_missing_s(&pulse, DEADLINE_MS) == 0);
    }
    assert_true(look(&pulse, 60e3, false) > 0); /* a thread that stays silent afterwards is reported */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thread_that_rests_or_works_does_not_hang),
        cmocka_unit_test(a_thread_without_a_beat_hangs),
        cmocka_unit_test(a_process_that_was_stopped_does_not_hang),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
