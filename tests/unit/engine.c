/* Tests requests for accuracy, and the engines that are chosen for them. */
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

static struct kd_setting settle(struct kd_accuracy_request asked_accuracy, bool float64)
{
    struct kd_setting out;
    struct kd_error error = { 0 };
    if (kd_setting_of(&asked_accuracy, kd_accuracy_built_in(), float64, &out, &error))
        fail_msg("%s", error.message);
    return out;
}

static void refuse(struct kd_accuracy_request asked_accuracy, bool float64, const char *pointer, const char *part)
{
    struct kd_setting out;
    struct kd_error error = { 0 };
    assert_int_equal(kd_setting_of(&asked_accuracy, kd_accuracy_built_in(), float64, &out, &error), KD_EINVAL);
    assert_string_equal(error.pointer, pointer);
    if (!strstr(error.message, part))
        fail_msg("\"%s\" is not in \"%s\"", part, error.message);
}

/* The scene's words for engines and the list of engines have the same order. */
static void words_are_names(void **state)
{
    (void)state;
    const struct kd_row *engine = kd_field_find("accuracy", "engine"),
                        *precision = kd_field_find("accuracy", "precision");
    assert_int_equal(kd_word_count(engine->words), KD_ENGINE_COUNT + 1);
    for (int i = 0; i < KD_ENGINE_COUNT; i++)
        assert_int_equal(kd_word_index(engine->words, kd_engine_name((enum kd_engine)i)), i + 1);
    for (int i = 0; i < 2; i++)
        assert_int_equal(kd_word_index(precision->words, kd_precision_name((enum kd_precision)i)), i + 1);
    assert_int_equal(kd_word_index(engine->words, "auto"), 0);
    assert_int_equal(kd_word_index(precision->words, "auto"), 0);
    assert_true(kd_field_find("accuracy", "steps")->most == KD_STEPS_MAX);

    struct kd_scene scene;
    kd_scene_defaults(&scene);
    const struct kd_accuracy_request asked_accuracy = kd_accuracy_request_of(&scene);
    assert_true(asked_accuracy.profile == KD_PROFILE_BALANCED && asked_accuracy.engine == -1 &&
                asked_accuracy.precision == -1 && !asked_accuracy.steps);
    assert_true(isinf(asked_accuracy.tolerance));
}

static void profiles(void **state)
{
    (void)state;
    uint32_t before = 0;
    for (int profile = KD_PROFILE_DRAFT; profile <= KD_PROFILE_HIGH; profile++) {
        struct kd_accuracy_request asked_accuracy = NONE;
        asked_accuracy.profile = profile;
        struct kd_setting s = settle(asked_accuracy, true);
        assert_true(s.engine == KD_ENGINE_MINO_RKN6 && s.precision == KD_PRECISION_F32 && s.steps >= before);
        before = s.steps;
    }
    struct kd_accuracy_request asked_accuracy = NONE;
    asked_accuracy.profile = KD_PROFILE_REFERENCE;
    struct kd_setting fine = settle(asked_accuracy, true), without = settle(asked_accuracy, false);
    assert_true(fine.engine == KD_ENGINE_MINO_RKN6 && fine.precision == KD_PRECISION_F64 && fine.steps == 64);
    assert_true(without.engine == KD_ENGINE_CLOSED && without.precision == KD_PRECISION_F64 && without.steps == 0);
    asked_accuracy.engine = KD_ENGINE_KS_RK4;
    asked_accuracy.steps = 32;
    assert_int_equal(settle(asked_accuracy, true).steps, 32);
    asked_accuracy = (struct kd_accuracy_request)NONE;
    assert_int_equal(settle(asked_accuracy, false).engine, KD_ENGINE_CLOSED);
    assert_false(kd_accuracy_request_needs_device(&asked_accuracy));
    asked_accuracy.tolerance = 1e-6;
    assert_true(kd_accuracy_request_needs_device(&asked_accuracy));
}

/* A finer tolerance never selects a row with a larger error, and a coarser tolerance never selects a slower row. */
static void tolerances(void **state)
{
    (void)state;
    const struct kd_accuracy_table *table = kd_accuracy_built_in();
    double slower = INFINITY;
    for (double tolerance = 1e-2; tolerance > 1e-12; tolerance /= 10) {
        struct kd_accuracy_request asked_accuracy = NONE;
        struct kd_accuracy_choice choice;
        asked_accuracy.tolerance = tolerance;
        struct kd_setting s = settle(asked_accuracy, true);
        assert_true(s.holds <= tolerance && s.steps);
        assert_int_equal(kd_accuracy_choose(table, tolerance, NULL, &choice, NULL), KD_OK);
        assert_true(choice.rays_per_s <= slower && choice.engine == s.engine && choice.steps == s.steps);
        slower = choice.rays_per_s;
        asked_accuracy.precision = KD_PRECISION_F64;
        assert_int_equal(settle(asked_accuracy, true).precision, KD_PRECISION_F64);
    }
    struct kd_accuracy_request asked_accuracy = NONE;
    asked_accuracy.tolerance = 1e-5;
    assert_int_equal(settle(asked_accuracy, false).precision, KD_PRECISION_F32);
    asked_accuracy.engine = KD_ENGINE_KS_RK4;
    assert_int_equal(settle(asked_accuracy, true).engine, KD_ENGINE_KS_RK4);
}

static void what_cannot_be(void **state)
{
    (void)state;
    struct kd_accuracy_request asked_accuracy = NONE;
    asked_accuracy.tolerance = 1e-15;
    refuse(asked_accuracy, true, "/accuracy/tolerance",
           "whose table replaces the missing table of this device, reaches");
    asked_accuracy.tolerance = 1e-9;
    assert_int_equal(settle(asked_accuracy, false).engine, KD_ENGINE_CLOSED); /* needs no device */
    asked_accuracy.precision = KD_PRECISION_F32;
    refuse(asked_accuracy, false, "/accuracy/tolerance",
           "whose table replaces the missing table of this device, reaches");
    asked_accuracy.precision = -1;
    asked_accuracy.steps = 8;
    refuse(asked_accuracy, true, "/accuracy/steps", "with a tolerance");
    asked_accuracy.steps = 0;
    asked_accuracy.engine = KD_ENGINE_CLOSED;
    refuse(asked_accuracy, true, "/accuracy/tolerance", "closed");
    asked_accuracy = (struct kd_accuracy_request)NONE;
    asked_accuracy.steps = 8;
    refuse(asked_accuracy, true, "/accuracy/steps", "that engine takes no steps");
    asked_accuracy.engine = KD_ENGINE_MINO_RKN6;
    asked_accuracy.steps = 6;
    refuse(asked_accuracy, true, "/accuracy/steps", "a multiple of 4");
    asked_accuracy.steps = 8;
    asked_accuracy.precision = KD_PRECISION_F64;
    refuse(asked_accuracy, false, "/accuracy/precision", "f64");
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
