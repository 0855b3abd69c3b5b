/* Tests of the table of lessons. The test sets the times in the table back. */
#include "base/clock.h"
#include "server/lesson/lesson.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static struct kd_lessons *all;
static struct kd_lesson *one;

static int begin(void **state)
{
    struct kd_error error;
    bool quota;
    (void)state;
    all = kd_lessons_create(KD_LESSONS);
    return !all || kd_lesson_open(all, "client", &quota, &one, &error);
}

static int end(void **state)
{
    (void)state;
    kd_lessons_destroy(all);
    return 0;
}

static struct kd_pupil *pupil(unsigned n)
{
    char key[KD_SECRET_ID];
    snprintf(key, sizeof key, "%016x", n);
    return kd_lesson_pupil(one, key);
}

static void test_who_has_answered_stays(void **state)
{
    const double gone = 1e3 * KD_LESSON_PRESENT_S + 1e3;
    (void)state;
    one->question.number = 2;
    for (unsigned i = 0; i < KD_LESSON_PUPILS; i++)
        assert_non_null(pupil(i));
    assert_null(pupil(100));
    pupil(3)->answered = 2; /* the vote counts */
    pupil(4)->answered = 1; /* an earlier question */
    for (unsigned i = 3; i <= 5; i++)
        pupil(i)->seen_ms -= gone + 10 * (6 - i); /* pupil 3 has been away for longest, then 4, then 5 */
    assert_ptr_equal(pupil(100), &one->pupils[4]);
    assert_ptr_equal(pupil(101), &one->pupils[5]);
    assert_int_equal(one->pupils[3].answered, 2);
    assert_ptr_equal(pupil(102), &one->pupils[3]); /* the last entry whose pupil is absent */
    assert_int_equal(one->pupils[3].answered, 0);
    assert_null(pupil(103));
}

static void test_an_idle_lesson_is_swept(void **state)
{
    char id[KD_SECRET_ID];
    (void)state;
    memcpy(id, one->id, sizeof id);
    one->used_ms = kd_clock_ms() - 1e3 * KD_LESSON_IDLE_S + 60e3;
    kd_lessons_sweep(all);
    assert_ptr_equal(kd_lesson_find(all, id), one);
    one->used_ms -= 61e3;
    kd_lessons_sweep(all);
    assert_null(kd_lesson_find(all, id));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_who_has_answered_stays, begin, end),
        cmocka_unit_test_setup_teardown(test_an_idle_lesson_is_swept, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
