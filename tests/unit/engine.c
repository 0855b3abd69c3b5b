/* Requests for accuracy, and the engines chosen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "render/accuracy/table.h"
#include "render/accuracy/engine.h"
#include "scene/table.h"

#define NONE KD_WISH_NONE

static struct kd_setting settle(struct kd_wish wish, bool float64)
{
    struct kd_setting out;
    struct kd_error error = { 0 };
    if (kd_setting_of(&wish, kd_accuracy_built_in(), float64, &out, &error))
        fail_msg("%s", error.message);
    return out;
}

static void refuse(struct kd_wish wish, bool float64, const char *pointer, const char *part)
{
    struct kd_setting out;
    struct kd_error error = { 0 };
    assert_int_equal(kd_setting_of(&wish, kd_accuracy_built_in(), float64, &out, &error), KD_EINVAL);
    assert_string_equal(error.pointer, pointer);
    if (!strstr(error.message, part))
        fail_msg("\"%s\" is not in \"%s\"", part, error.message);
}

/* A scene's words and the engines are two lists in the same order. */
static void words_are_names(void **state)
{
    (void)state;
    const struct kd_field *engine = kd_field_find("accuracy", "engine"),
                          *precision = kd_field_find("accuracy", "precision");
    assert_int_equal(kd_field_word_count(engine), KD_ENGINE_COUNT + 1);
    for (int i = 0; i < KD_ENGINE_COUNT; i++)
        assert_int_equal(kd_field_word_index(engine, kd_engine_name((enum kd_engine)i)), i + 1);
    for (int i = 0; i < 2; i++)
        assert_int_equal(kd_field_word_index(precision, kd_precision_name((enum kd_precision)i)), i + 1);
    assert_int_equal(kd_field_word_index(engine, "auto"), 0);
    assert_int_equal(kd_field_word_index(precision, "auto"), 0);
    assert_true(kd_field_find("accuracy", "steps")->maximum == KD_STEPS_MAX);

    struct kd_scene scene;
    kd_scene_defaults(&scene);
    const struct kd_wish wish = kd_wish_of(&scene);
    assert_true(wish.profile == KD_PROFILE_BALANCED && wish.engine == -1 && wish.precision == -1 && !wish.steps);
    assert_true(isinf(wish.tolerance));
}

static void profiles(void **state)
{
    (void)state;
    uint32_t before = 0;
    for (int profile = KD_PROFILE_DRAFT; profile <= KD_PROFILE_HIGH; profile++) {
        struct kd_wish wish = NONE;
        wish.profile = profile;
        struct kd_setting s = settle(wish, true);
        assert_true(s.engine == KD_ENGINE_MINO_RKN6 && s.precision == KD_PRECISION_F32 && s.steps >= before);
        before = s.steps;
    }
    struct kd_wish wish = NONE;
    wish.profile = KD_PROFILE_REFERENCE;
    struct kd_setting fine = settle(wish, true), without = settle(wish, false);
    assert_true(fine.engine == KD_ENGINE_MINO_RKN6 && fine.precision == KD_PRECISION_F64 && fine.steps == 64);
    assert_true(without.engine == KD_ENGINE_CLOSED && without.precision == KD_PRECISION_F64 && without.steps == 0);
    wish.engine = KD_ENGINE_KS_RK4;
    wish.steps = 32;
    assert_int_equal(settle(wish, true).steps, 32);
    wish = (struct kd_wish)NONE;
    assert_int_equal(settle(wish, false).engine, KD_ENGINE_CLOSED);
    assert_false(kd_wish_needs_device(&wish));
    wish.tolerance = 1e-6;
    assert_true(kd_wish_needs_device(&wish));
}

/* A finer tolerance never gets a row with a larger error, nor a coarser one a slower row. */
static void tolerances(void **state)
{
    (void)state;
    const struct kd_accuracy_table *table = kd_accuracy_built_in();
    double slower = INFINITY;
    for (double tolerance = 1e-2; tolerance > 1e-12; tolerance /= 10) {
        struct kd_wish wish = NONE;
        struct kd_accuracy_choice choice;
        wish.tolerance = tolerance;
        struct kd_setting s = settle(wish, true);
        assert_true(s.holds <= tolerance && s.steps);
        assert_int_equal(kd_accuracy_choose(table, tolerance, NULL, &choice, NULL), KD_OK);
        assert_true(choice.rays_per_s <= slower && choice.engine == s.engine && choice.steps == s.steps);
        slower = choice.rays_per_s;
        wish.precision = KD_PRECISION_F64;
        assert_int_equal(settle(wish, true).precision, KD_PRECISION_F64);
    }
    struct kd_wish wish = NONE;
    wish.tolerance = 1e-5;
    assert_int_equal(settle(wish, false).precision, KD_PRECISION_F32);
    wish.engine = KD_ENGINE_KS_RK4;
    assert_int_equal(settle(wish, true).engine, KD_ENGINE_KS_RK4);
}

static void what_cannot_be(void **state)
{
    (void)state;
    struct kd_wish wish = NONE;
    wish.tolerance = 1e-15;
    refuse(wish, true, "/accuracy/tolerance", "stands in for this device's, was measured to hold");
    wish.tolerance = 1e-9;
    assert_int_equal(settle(wish, false).engine, KD_ENGINE_CLOSED); /* needs no device */
    wish.precision = KD_PRECISION_F32;
    refuse(wish, false, "/accuracy/tolerance", "stands in for this device's, was measured to hold");
    wish.precision = -1;
    wish.steps = 8;
    refuse(wish, true, "/accuracy/steps", "beside a tolerance");
    wish.steps = 0;
    wish.engine = KD_ENGINE_CLOSED;
    refuse(wish, true, "/accuracy/tolerance", "closed");
    wish = (struct kd_wish)NONE;
    wish.steps = 8;
    refuse(wish, true, "/accuracy/steps", "takes no steps");
    wish.engine = KD_ENGINE_MINO_RKN6;
    wish.steps = 6;
    refuse(wish, true, "/accuracy/steps", "a multiple of 4");
    wish.steps = 8;
    wish.precision = KD_PRECISION_F64;
    refuse(wish, false, "/accuracy/precision", "f64");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_names),
        cmocka_unit_test(profiles),
        cmocka_unit_test(tolerances),
        cmocka_unit_test(what_cannot_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
