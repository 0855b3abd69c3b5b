/* Tests that links hold scenes: each preset and each change is read back unchanged, and the link is short. */
#include "scene_support.h"

#include "scene/difference.h"
#include "scene/link.h"
#include "scene/presets.h"
#include "scene/style.h"

#include <math.h>

/* Applies the parameters of a link in the order in which the query is read: the preset, the style, the rest. */
static struct kd_scene read_link(const char *link)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    for (int style = 1; style >= 0; style--) {
        char *text = strdup(link), *rest = NULL;
        for (char *pair = strtok_r(text, "&", &rest); pair; pair = strtok_r(NULL, "&", &rest)) {
            char *value = strchr(pair, '=');
            assert_non_null(value);
            *value++ = 0;
            if (!strcmp(pair, "preset"))
                assert_true(!style || !kd_scene_preset(&scene, value, &error));
            else if ((strcmp(pair, "style.name") == 0) == style && kd_scene_set(&scene, pair, value, &error))
                fail_msg("%s: %s", link, error.message);
        }
        free(text);
    }
    return scene;
}

static char *link_of(const struct kd_scene *scene)
{
    struct kd_buffer text = { 0 };
    struct kd_error error = { 0 };
    if (kd_scene_link(scene, &text, &error))
        fail_msg("%s", error.message);
    return text.data ? (char *)text.data : strdup("");
}

/* Asserts that two scenes are equal, except for the size of the picture, which is not part of a link. */
static void assert_same(const struct kd_scene *scene, const char *link)
{
    struct kd_scene back = read_link(link);
    back.image.width = scene->image.width;
    back.image.height = scene->image.height;
    back.tile = scene->tile;
    if (memcmp(&back, scene, sizeof back))
        fail_msg("%s is another scene", link);
}

static void presets_are_their_names(void **state)
{
    (void)state;
    for (size_t i = 0; i < kd_preset_count; i++) {
        struct kd_scene scene;
        char expected[80];
        assert_int_equal(kd_scene_preset(&scene, kd_presets[i].name, NULL), KD_OK);
        scene.image.width = 7;
        scene.tile.width = scene.tile.height = 3;
        char *link = link_of(&scene);
        snprintf(expected, sizeof expected, "preset=%s", kd_presets[i].name);
        assert_string_equal(link, expected);
        free(link);
    }
    struct kd_scene plain;
    kd_scene_defaults(&plain);
    char *link = link_of(&plain);
    assert_string_equal(link, "");
    free(link);
}

/* For each preset: every field at each of its ends and words, one by one, then some of them at random together. */
static void changes_come_back(void **state)
{
    (void)state;
    uint64_t seed = 40;
    for (size_t p = 0; p < kd_preset_count; p += 9) {
        struct kd_scene preset, many;
        assert_int_equal(kd_scene_preset(&preset, kd_presets[p].name, NULL), KD_OK);
        many = preset;
        for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
            const struct kd_row *field = &kd_fields[i];
            if (field->kind == KD_KIND_ASSET || field->kind == KD_KIND_SERIES)
                continue;
            const double u = support_uniform(&seed),
                         value = field->kind == KD_KIND_BOOL   ? u < 0.5
                                 : field->kind == KD_KIND_WORD ? floor(u * kd_word_count(field->words))
                                 : field->kind == KD_KIND_INT  ? field->least
                                                               : field->least + u * (field->most - field->least);
            struct kd_scene scene = preset;
            char path[KD_PATH_SIZE], text[40];
            kd_field_path(field, 0, path);
            if (field->kind == KD_KIND_WORD)
                snprintf(text, sizeof text, "%.*s", kd_word(field->words, (int)value).length,
                         kd_word(field->words, (int)value).text);
            else if (field->kind == KD_KIND_BOOL)
                strcpy(text, value != 0 ? "true" : "false");
            else
                snprintf(text, sizeof text, "%.17g", value);
            if (kd_scene_set(&scene, path, text, NULL))
                continue;
            char *link = link_of(&scene);
            assert_same(&scene, link);
            free(link);
            if (support_uniform(&seed) < 0.1)
                kd_scene_set(&many, path, text, NULL);
        }
        char *link = link_of(&many);
        assert_same(&many, link);
        free(link);
    }
}

/* A style sets fields. A field that is set back to its default is still part of the link. */
static void a_style_does_not_hide_what_it_sets(void **state)
{
    (void)state;
    for (size_t i = 0; i < kd_style_row_count; i++) {
        const struct kd_row *field = kd_field_find(kd_style_rows[i].section, kd_style_rows[i].name);
        struct kd_scene scene;
        struct kd_buffer line = { 0 };
        char told[2 * KD_PATH_SIZE];
        kd_scene_defaults(&scene);
        assert_int_equal(kd_scene_set(&scene, "style.name", "dngr", NULL), KD_OK);
        if (kd_field_get(&scene, field, 0) == field->initial)
            continue;
        kd_field_put(&scene, field, 0, field->initial);
        char *link = link_of(&scene);
        assert_same(&scene, link);
        free(link);
        assert_int_equal(kd_scene_line(&scene, &line), KD_OK);
        snprintf(told, sizeof told, "%s.%s=", field->object, field->name);
        assert_non_null(strstr((const char *)line.data, told));
        kd_buffer_finish(&line);
    }
}

/* -0 is 0 in a document, and therefore in a link. */
static void minus_zero_has_a_link(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.camera.azimuth_deg = -0.0;
    char *link = link_of(&scene);
    assert_string_equal(link, "");
    free(link);
}

/* Fields of a link cannot shorten a list, so a link to a shorter list is based on another preset or on the default
 * scene. */
static void a_shorter_list_has_another_base(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_preset(&scene, "companions", NULL), KD_OK);
    const struct kd_scene base = scene;
    kd_section_resize(&scene, kd_section_find("bodies"), 0);
    assert_int_equal(kd_scene_difference(&base, &scene, '&', &text), KD_EINVAL);
    assert_int_equal(text.size, 0);
    char *link = link_of(&scene);
    assert_same(&scene, link);
    free(link);
    kd_buffer_finish(&text);
}

static void an_asset_is_refused(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_buffer text = { 0 };
    struct kd_error error = { 0 };
    kd_scene_defaults(&scene);
    memset(scene.sky.image, 'a', 64);
    assert_int_equal(kd_scene_link(&scene, &text, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/sky/image");
    assert_non_null(strstr(error.message, "sky.image names an asset"));
    assert_int_equal(text.size, 0);
    kd_buffer_finish(&text);
}

static void changes_are_told(void **state)
{
    (void)state;
    static const struct kd_scene_changed all[] = { { "spacetime.spin", "0.5" },
                                                   { "camera.inclination_deg", "60" },
                                                   { "camera.r", "30" },
                                                   { "disk.doppler", "false" },
                                                   { "time", "7" },
                                                   { "spots.1.r", "9" } };
    static const char *const told[] = {
        "",
        "spacetime spin 0.5 M",
        "spacetime spin 0.5 M and camera inclination 60°",
        "spacetime spin 0.5 M, camera inclination 60° and camera r 30 M",
        "spacetime spin 0.5 M, camera inclination 60°, camera r 30 M and disk doppler false",
        "spacetime spin 0.5 M, camera inclination 60°, camera r 30 M, disk doppler false and 1 more",
        "spacetime spin 0.5 M, camera inclination 60°, camera r 30 M, disk doppler false and 2 more",
    };
    for (size_t n = 0; n < sizeof told / sizeof *told; n++) {
        struct kd_buffer text = { 0 };
        assert_int_equal(kd_scene_link_tell(all, n, &text), KD_OK);
        assert_string_equal(text.data ? (const char *)text.data : "", told[n]);
        kd_buffer_finish(&text);
    }
}

/* A preview shows the same vertical part of the sky as a picture of 16:9. tan(fov/2) and the width grow by
 * (1200/630)/(16/9). */
static void a_preview_is_as_high(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.camera.fov_deg = 90;
    scene.camera.field_uas = 100;
    scene.tile.width = 3;
    scene.camera.stereo = KD_STEREO_PAIR;
    const double width = scene.camera.field_m, by = 1200.0 / 630 * 9 / 16;
    kd_scene_link_preview(&scene, 1200, 630);
    assert_float_equal(tan(scene.camera.fov_deg * M_PI / 360), by, 1e-12);
    assert_float_equal(scene.camera.field_m, by * width, 1e-12 * width);
    assert_true(isinf(scene.camera.field_uas) && !kd_scene_has_tile(&scene));
    assert_int_equal(scene.image.width, 1200);
    assert_int_equal(scene.image.samples, 2);
    assert_int_equal(scene.camera.stereo, KD_STEREO_NONE);
    scene.jets.brightness = 1;
    kd_scene_link_preview(&scene, 1200, 630);
    assert_int_equal(scene.image.samples, 1);
    assert_int_equal(scene.accuracy.profile, KD_PROFILE_DRAFT);
    scene.jets.brightness = 0;
    scene.volume.model = KD_VOLUME_RIAF;
    scene.accuracy.profile = KD_PROFILE_BALANCED;
    kd_scene_link_preview(&scene, 1200, 630);
    assert_int_equal(scene.image.samples, 1);
    assert_int_equal(scene.accuracy.profile, KD_PROFILE_DRAFT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(presets_are_their_names),
        cmocka_unit_test(changes_come_back),
        cmocka_unit_test(minus_zero_has_a_link),
        cmocka_unit_test(a_style_does_not_hide_what_it_sets),
        cmocka_unit_test(a_shorter_list_has_another_base),
        cmocka_unit_test(an_asset_is_refused),
        cmocka_unit_test(changes_are_told),
        cmocka_unit_test(a_preview_is_as_high),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
