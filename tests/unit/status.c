/* Tests of sequences of steps that can fail. Each step is executed at most once, and no step after a failed one.
 * Resources are released in both cases. */
#include "base/error.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define N_STEPS 3

struct walk {
    int fails;          /* the step that fails; N_STEPS: none */
    int taken[N_STEPS]; /* number of times that each step was executed */
    int unref;
};

static enum kd_status step(struct walk *walk, int i)
{
    walk->taken[i]++;
    return i == walk->fails ? KD_EIO : KD_OK;
}

static enum kd_status steps(struct walk *walk)
{
    enum kd_status status = KD_EBUSY; /* set to a wrong value, because KD_TRY must ignore the former value */
    for (int i = 0; i < N_STEPS; i++)
        if (i % 2) /* the macro is one statement, so that the else belongs to this if */
            KD_TRY(step(walk, i));
        else
            KD_TRY(step(walk, i));
done:
    walk->unref++;
    return status;
}

static void each_once_until_one_fails(void **state)
{
    (void)state;
    for (int fails = 0; fails <= N_STEPS; fails++) {
        struct walk walk = { .fails = fails };
        assert_int_equal(steps(&walk), fails < N_STEPS ? KD_EIO : KD_OK);
        assert_int_equal(walk.unref, 1);
        for (int i = 0; i < N_STEPS; i++)
            assert_int_equal(walk.taken[i], i <= fails);
    }
}

/* Quoted text may be anything, and a message may be cut in the middle of a character. */
static void errors_can_be_shown(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    char long_text[600];
    kd_error_field(&error, "/\xff\x01", "a\nb\t\x1b[31m \xc3\xa9 \xc3( \xed\xa0\x80 \xf0\x9f\x98\x80 \x7f \xc2\x9b");
    assert_string_equal(error.pointer, "/?\x01");
    assert_string_equal(error.message, "a b ?[31m \xc3\xa9 ?( ??? \xf0\x9f\x98\x80 ? ??");
    memset(long_text, 'a', sizeof long_text);
    long_text[sizeof error.message - 2] = '\xc3';
    long_text[sizeof error.message - 1] = '\xa9';
    long_text[sizeof long_text - 1] = 0;
    kd_error_set(&error, KD_EINVAL, "%s", long_text);
    assert_int_equal(strlen(error.message), sizeof error.message - 1);
    assert_int_equal(error.message[sizeof error.message - 2], '?');
}

/* A pointer names a place, with the escapes of RFC 6901. If the pointer is cut, it is not cut within an escape. */
static void pointers_are_cut_between_escapes(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    char tildes[200] = "/", cut[400];
    for (size_t i = 1; i + 2 < sizeof tildes; i += 2)
        memcpy(tildes + i, "~0", 3);
    for (size_t prefix = 0; prefix < 5; prefix++) {
        memcpy(cut, "/abcd" + 5 - prefix, prefix);
        strcpy(cut + prefix, tildes);
        kd_error_field(&error, cut, "cut");
        assert_in_range(strlen(error.pointer), sizeof error.pointer - 2, sizeof error.pointer - 1);
        assert_int_equal(error.pointer[strlen(error.pointer) - 1], '0');
        assert_memory_equal(error.pointer, cut, strlen(error.pointer));
        kd_error_inside(&error, "/scenes/0");
        assert_memory_equal(error.pointer, "/scenes/0", 9);
        assert_memory_equal(error.pointer + 9, cut, strlen(error.pointer) - 9);
        assert_int_equal(error.pointer[strlen(error.pointer) - 1], '0');
    }
    kd_error_field(&error, "/r", "r is -1");
    kd_error_inside(&error, "/orbits/3");
    assert_string_equal(error.pointer, "/orbits/3/r");
    kd_error_inside(NULL, "/orbits/3");
}

static void without_an_error_to_fill(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    assert_int_equal(kd_error_set(NULL, KD_EFULL, "%d", 1), KD_EFULL);
    assert_int_equal(kd_error_field(NULL, "/disk", "%d", 1), KD_EINVAL);
    assert_int_equal(kd_error_field(&error, "/disk", "%d is too many", 2), KD_EINVAL);
    assert_int_equal(error.status, KD_EINVAL);
    assert_string_equal(error.pointer, "/disk");
    assert_string_equal(error.message, "2 is too many");
    assert_int_equal(kd_error_set(&error, KD_EFULL, "full"), KD_EFULL);
    assert_string_equal(error.pointer, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_once_until_one_fails),
        cmocka_unit_test(errors_can_be_shown),
        cmocka_unit_test(pointers_are_cut_between_escapes),
        cmocka_unit_test(without_an_error_to_fill),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
