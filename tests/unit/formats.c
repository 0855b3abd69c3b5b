/* Tests that a format is found by its name, media type, file extension and first bytes, and that a new row in the table
 * is sufficient to add a format. */
#include "image/webp.h"
#include "fake_formats.h"

#include "render/accuracy/table.h"
#include "render/output/curve.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void found_by_name(void **state)
{
    (void)state;
    assert_ptr_equal(kd_format_named("png"), &kd_format_png);
    assert_ptr_equal(kd_format_named("fake"), &fake_format);
    const char *const none[] = { "", "PNG", "pn", "pngs", "row", "json" };
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_null(kd_format_named(none[i]));
}

static void found_by_bytes(void **state)
{
    (void)state;
    assert_ptr_equal(kd_format_of_bytes("\x89PNG\r\n\x1a\n", 8), &kd_format_png);
    assert_ptr_equal(kd_format_of_bytes("FAKE", 4), &fake_format);
    assert_null(kd_format_of_bytes("FAK", 3));
    assert_null(kd_format_of_bytes("{\"camera\":{}}", 13));
    assert_null(kd_format_of_bytes("", 0));
    assert_ptr_equal(kd_format_live(), &kd_format_png);
}

static uint8_t pixels[3 * 4 * 2];
static const struct kd_frame frame = {
    .width = 4, .height = 2, .layers = { { "rgb", 3, KD_LAYER_U8, pixels } }, .n_layers = 1
};

static struct kd_buffer encoded(const struct kd_format *format, const struct kd_scene *scene, enum kd_effort effort,
                                struct kd_encoder *encoder)
{
    const struct kd_plan plan = { 0 };
    const struct kd_picture picture = { &frame, scene, &plan, "none", 7 };
    struct kd_buffer file = { 0 };
    struct kd_error error = { 0 };
    if (kd_encode(format, &picture, effort, encoder, &file, &error))
        fail_msg("%s", error.message);
    return file;
}

/* An encoder keeps the memory of the format that it used last. */
static void memory_is_kept_and_forgotten(void **state)
{
    (void)state;
    struct kd_encoder encoder = { 0 };
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    const struct {
        const struct kd_format *format;
        enum kd_effort effort;
        const char *begins;
        int memories;
    } steps[] = {
        { &fake_format, KD_EFFORT_QUICK, "FAKE 4x2 effort=1 number=7 file=1 ", 1 },
        { &fake_format, KD_EFFORT_KEEP, "FAKE 4x2 effort=2 number=7 file=2 ", 1 },
        { &kd_format_png, KD_EFFORT_LIVE, "\x89PNG", 0 },
        { &kd_format_png, KD_EFFORT_LIVE, "\x89PNG", 0 },
        { &fake_format, KD_EFFORT_QUICK, "FAKE 4x2 effort=1 number=7 file=1 ", 1 },
    };
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        struct kd_buffer file = encoded(steps[i].format, &scene, steps[i].effort, &encoder);
        assert_true(file.size > strlen(steps[i].begins));
        assert_memory_equal(file.data, steps[i].begins, strlen(steps[i].begins));
        assert_int_equal(fake_memories, steps[i].memories);
        kd_buffer_finish(&file);
    }
    kd_encoder_finish(&encoder);
    assert_int_equal(fake_memories, 0);
    struct kd_buffer file = encoded(&fake_format, &scene, KD_EFFORT_KEEP, NULL);
    kd_buffer_finish(&file);
    assert_int_equal(fake_memories, 0);
}

static void a_scene_comes_back_from_any_format(void **state)
{
    (void)state;
    for (size_t i = 0; i < kd_n_formats; i++) {
        struct kd_scene scene, back;
        struct kd_error error = { 0 };
        kd_scene_defaults(&scene);
        kd_scene_defaults(&back);
        scene.spacetime.spin = 0.25;
        struct kd_buffer file = encoded(kd_formats[i], &scene, KD_EFFORT_QUICK, NULL);
        if (kd_format_scene(file.data, file.size, &back, &error))
            fail_msg("%s", error.message);
        assert_true(back.spacetime.spin == 0.25);
        kd_buffer_finish(&file);
    }
}

static struct kd_plan planned(const struct kd_format *format, struct kd_scene *scene)
{
    const struct kd_capacity capacity = { .max_binding_bytes = 128u << 20,
                                          .memory_bytes = 1u << 30,
                                          .accuracy = kd_accuracy_built_in() };
    struct kd_plan plan;
    struct kd_error error = { 0 };
    if (kd_format_plan(format, scene, &capacity, &plan, &error))
        fail_msg("%s", error.message);
    return plan;
}

/* Admission of a request counts the memory that the encoder of WebP needs. */
static void memory_of_an_encoder_is_counted(void **state)
{
    struct kd_scene scene;
    (void)state;
    kd_scene_smooth(&scene);
    const struct kd_plan png = planned(&kd_format_png, &scene), webp = planned(&kd_format_webp, &scene);
    assert_int_equal(webp.cost.host_bytes - png.cost.host_bytes,
                     kd_webp_bytes((uint32_t)scene.image.width, (uint32_t)scene.image.height));
}

/* Number of the plan's passes that are needed only for a picture. */
static int shows(const struct kd_plan *plan)
{
    int n = 0;
    for (size_t i = 0; i < plan->cost.n_passes; i++)
        for (int k = 0; k < 3; k++)
            n += !strcmp(plan->cost.passes[i].name, (const char *[]) { "expose", "post", "readback" }[k]);
    return n;
}

/* A plan for a picture exposes, renders and reads back, and does not measure light. A plan for light alone measures and
 * makes no picture. */
static void a_plan_is_for_what_is_carried(void **state)
{
    (void)state;
    const struct kd_format *const light[] = { &fake_format, kd_light_curve.frame };
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    assert_true(isinf(scene.style.exposure)); /* "auto" */
    struct kd_plan plan = planned(&kd_format_png, &scene);
    assert_true(shows(&plan) == 3 && !plan.light.photometry && plan.cost.host_bytes && isinf(scene.style.exposure));
    for (size_t i = 0; i < 2; i++) {
        kd_scene_defaults(&scene);
        plan = planned(light[i], &scene);
        assert_true(!shows(&plan) && plan.light.photometry && !plan.cost.host_bytes && scene.style.exposure == 0);
    }
}

static void series_are_found_by_name(void **state)
{
    (void)state;
    assert_string_equal(kd_series_all[0]->name, "pictures");
    assert_ptr_equal(kd_series_named("light-curve"), &kd_light_curve);
    assert_null(kd_series_named("light curve"));
    assert_string_equal(kd_series_table(&kd_light_curve, "csv")->media_type, "text/csv");
    assert_null(kd_series_table(&kd_light_curve, "png"));
    for (size_t i = 0; i < kd_n_series; i++)
        assert_true(!kd_series_all[i]->row_bytes == !kd_series_all[i]->n_tables);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_of_an_encoder_is_counted),
        cmocka_unit_test(found_by_name),
        cmocka_unit_test(found_by_bytes),
        cmocka_unit_test(memory_is_kept_and_forgotten),
        cmocka_unit_test(a_scene_comes_back_from_any_format),
        cmocka_unit_test(a_plan_is_for_what_is_carried),
        cmocka_unit_test(series_are_found_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
