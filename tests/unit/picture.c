/* Tests that a picture can be rendered again from its own file, in which the scene and the settings of its processing
 * are stored. */
#include "image/png.h"
#include "render/output/png.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void encode_as(const struct kd_scene *scene, const struct kd_plan *plan, const char *hash,
                      struct kd_buffer *file)
{
    static uint16_t pixels[3 * 4 * 2] = { 1, 2, 3, 65535 };
    const struct kd_frame frame = {
        .width = 4, .height = 2, .layers = { { "rgb", 3, KD_LAYER_U16, pixels } }, .n_layers = 1
    };
    struct kd_error error = { 0 };
    const struct kd_picture picture = { &frame, scene, plan, "llvmpipe, 256 bits", .hash = hash };
    if (kd_encode(&kd_format_png, &picture, KD_EFFORT_KEEP, NULL, file, &error))
        fail_msg("%s", error.message);
}

static void encode(const struct kd_scene *scene, const struct kd_plan *plan, struct kd_buffer *file)
{
    encode_as(scene, plan, NULL, file);
}

/* A caller that knows the scene's hash from the answer's ETag can pass it. The hash is then not computed again. */
static void a_hash_that_is_known_is_taken(void **state)
{
    (void)state;
    static const char *const known[] = { "0123", "" };
    for (int i = 0; i < 2; i++) {
        struct kd_scene scene;
        struct kd_buffer file = { 0 };
        struct kd_png png;
        char hash[65];
        kd_scene_defaults(&scene);
        assert_int_equal(kd_scene_hash(&scene, hash), KD_OK);
        encode_as(&scene, &(struct kd_plan) { 0 }, known[i], &file);
        assert_int_equal(kd_png_decode(file.data, file.size, &png, NULL), KD_OK);
        assert_string_equal(kd_png_text_find(&png, "kerrd:hash"), *known[i] ? known[i] : hash);
        kd_png_finish(&png);
        kd_buffer_finish(&file);
    }
}

static void the_scene_comes_back(void **state)
{
    (void)state;
    struct kd_scene scene, back;
    struct kd_buffer file = { 0 };
    struct kd_error error = { 0 };
    char before[65], after[65];

    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_set(&scene, "spacetime.spin", "0.123456789012345678", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "camera.r", "50", &error), KD_OK);
    encode(&scene, &(struct kd_plan) { 0 }, &file);
    if (kd_format_scene(file.data, file.size, &back, &error))
        fail_msg("%s", error.message);
    assert_int_equal(kd_scene_hash(&scene, before), KD_OK);
    assert_int_equal(kd_scene_hash(&back, after), KD_OK);
    assert_string_equal(before, after);
    kd_buffer_finish(&file);
}

static void the_file_says_how_it_was_made(void **state)
{
    (void)state;
    const struct kd_plan plan = {
        .lens.rays = 12,
        .lens.setting = { KD_ENGINE_KS_RK4, KD_PRECISION_F64, 64, NAN },
        .report.approximations = { { "a.first", "first" }, { "a.second", "second" } },
        .report.n_approximations = 2,
    };
    struct kd_scene scene;
    struct kd_buffer file = { 0 };
    struct kd_png png;
    char hash[65];

    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_hash(&scene, hash), KD_OK);
    encode(&scene, &plan, &file);
    assert_int_equal(kd_png_decode(file.data, file.size, &png, NULL), KD_OK);
    assert_int_equal(png.n_text, 7);
    assert_string_equal(kd_png_text_find(&png, "kerrd:hash"), hash);
    assert_string_equal(kd_png_text_find(&png, "kerrd:version"), KD_VERSION);
    assert_string_equal(kd_png_text_find(&png, "kerrd:approximations"), "first\nsecond");
    assert_string_equal(kd_png_text_find(&png, "kerrd:device"), "llvmpipe, 256 bits");
    assert_string_equal(kd_png_text_find(&png, "kerrd:accuracy"),
                        "rays=12 engine=ks-rk4 precision=f64 steps=64 critical_rays=0 undecided=0 sampled=0");
    assert_string_equal(kd_png_text_find(&png, "Software"), "kerrd " KD_VERSION);
    kd_png_finish(&png);
    kd_buffer_finish(&file);
}

static void refuse(const char *key, const char *value, const char *word)
{
    static const uint8_t pixels[3];
    const struct kd_png_text text = { key, value };
    const struct kd_png_params params = {
        .width = 1,
        .height = 1,
        .bit_depth = 8,
        .pixels = pixels,
        .text = &text,
        .n_text = 1,
    };
    struct kd_buffer file = { 0 };
    struct kd_error error = { 0 };
    struct kd_scene scene, untouched;

    memset(&scene, 0x5a, sizeof scene);
    memcpy(&untouched, &scene, sizeof scene);
    assert_int_equal(kd_png_encode(&params, &file, &error), KD_OK);
    assert_int_equal(kd_format_scene(file.data, file.size, &scene, &error), KD_EINVAL);
    if (!strstr(error.message, word))
        fail_msg("\"%s\" does not say \"%s\"", error.message, word);
    assert_memory_equal(&scene, &untouched, sizeof scene);
    kd_buffer_finish(&file);
}

static void other_pictures_are_refused(void **state)
{
    (void)state;
    refuse("Comment", "{}", "no scene");
    refuse("kerrd:scene", "{\"version\":1,\"nonsense\":1}", "nonsense");
    refuse("kerrd:scene", "{", "");
    struct kd_scene scene;
    assert_int_equal(kd_format_scene("{}", 2, &scene, NULL), KD_EINVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hash_that_is_known_is_taken),
        cmocka_unit_test(the_scene_comes_back),
        cmocka_unit_test(the_file_says_how_it_was_made),
        cmocka_unit_test(other_pictures_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
