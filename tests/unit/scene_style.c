/* Tests of styles: the scene that results from a document that names one. */
#include "scene_support.h"

#include "scene/style.h"

static struct kd_scene parsed(const struct kd_scene *before, const char *json, bool patch)
{
    struct kd_scene scene = *before;
    struct kd_error error = { 0 };
    if ((patch ? kd_scene_patch : kd_scene_from_json)(&scene, json, strlen(json), &error))
        fail_msg("%s: %s", json, error.message);
    return scene;
}

static struct kd_scene of(const char *json)
{
    struct kd_scene defaults;
    kd_scene_defaults(&defaults);
    return parsed(&defaults, json, false);
}

static double value(const struct kd_scene *scene, const struct kd_style_row *row)
{
    return kd_field_get(scene, kd_field_find(row->section, row->name), 0);
}

/* Each style sets the fields of its rows and nothing else; some styles leave some fields unchanged. */
static void each_sets_its_fields(void **state)
{
    (void)state;
    const struct kd_row *names = kd_style_field();
    assert_int_equal(kd_word_count(names->words), KD_STYLES + 1);
    for (int style = 0; style < KD_STYLES; style++) {
        char json[64];
        const struct kd_word word = kd_word(names->words, style + 1);
        snprintf(json, sizeof json, "{\"style\":{\"name\":\"%.*s\"}}", word.length, word.text);
        struct kd_scene scene = of(json), defaults = of("{}");
        for (size_t i = 0; i < kd_style_row_count; i++) {
            const struct kd_style_row *row = &kd_style_rows[i];
            const struct kd_row *field = kd_field_find(row->section, row->name);
            assert_non_null(field);
            assert_true(!kd_section_find(field->object)->most && field != names);
            if (isnan(row->values[style])) {
                assert_true(value(&scene, row) == field->initial);
                continue;
            }
            assert_true(kd_row_holds(field, row->values[style]) && value(&scene, row) == row->values[style]);
            kd_field_put(&scene, field, 0, field->initial);
        }
        kd_field_put(&scene, names, 0, names->initial);
        assert_memory_equal(&scene, &defaults, sizeof scene);
    }
}

/* Fields that a document sets keep their values, whatever the order within the document, in a patch, and with null. */
static void what_the_document_sets_stays(void **state)
{
    (void)state;
    static const char *const documents[] = {
        "{\"disk\":{\"doppler\":true},\"style\":{\"name\":\"dngr\",\"bloom\":0.125}}",
        "{\"style\":{\"bloom\":0.125,\"name\":\"dngr\"},\"disk\":{\"doppler\":true}}",
    };
    for (int k = 0; k < 4; k++) {
        struct kd_scene before = of(k / 2 ? "{\"disk\":{\"doppler\":false},\"style\":{\"bloom\":1}}" : "{}");
        const struct kd_scene scene = parsed(&before, documents[k % 2], k / 2);
        assert_true(scene.disk.doppler && !scene.disk.redshift && scene.style.bloom == 0.125);
    }
    struct kd_scene dngr = of("{\"style\":{\"name\":\"dngr\"}}");
    struct kd_scene patched = parsed(&dngr, "{\"style\":{\"name\":\"dngr\",\"bloom\":null}}", true);
    assert_true(patched.style.bloom == 0.4 && !patched.disk.doppler);
    patched = parsed(&dngr, "{\"style\":{\"name\":\"dngr\"},\"disk\":null}", true);
    assert_true(patched.disk.doppler && patched.disk.redshift);
}

/* A document that does not name the style changes only the fields that it names, whatever the style was. */
static void the_name_alone_does_nothing_later(void **state)
{
    (void)state;
    const struct kd_scene dngr = of("{\"style\":{\"name\":\"dngr\"}}");
    struct kd_scene scene = parsed(&dngr, "{\"disk\":{\"doppler\":true}}", true);
    assert_true(scene.disk.doppler && !scene.disk.redshift && scene.style.bloom == dngr.style.bloom);
    scene = parsed(&scene, "{\"style\":{\"name\":\"none\"}}", true);
    assert_true(scene.style.name == KD_STYLE_NONE && scene.style.bloom == dngr.style.bloom && !scene.disk.redshift);
    scene = parsed(&scene, "{\"style\":{\"name\":null}}", true); /* null is the default, which is a style too */
    assert_true(scene.style.name == KD_STYLE_FILM && scene.disk.redshift);
    char *text = support_canonical(&dngr);
    const struct kd_scene again = of(text); /* the text names the style and each of its fields */
    assert_memory_equal(&again, &dngr, sizeof again);
    scene = of("{\"style\":{\"name\":\"dngr\",\"bloom\":0.25,\"dither\":false}}");
    free(text);
    text = support_canonical(&scene);
    const struct kd_scene third = of(text);
    assert_memory_equal(&third, &scene, sizeof third);
    free(text);
}

/* An empty document looks like the default style. */
static void the_default_is_a_style(void **state)
{
    (void)state;
    const struct kd_scene none = of("{}"), named = of("{\"style\":{\"name\":\"film\"}}");
    assert_int_equal(none.style.name, KD_STYLE_FILM);
    assert_memory_equal(&none, &named, sizeof none);
}

/* If a style and its fields are set one at a time, the later setting wins. */
static void by_paths_in_order(void **state)
{
    (void)state;
    struct kd_scene scene = of("{}");
    struct kd_error error = { 0 };
    assert_int_equal(kd_scene_set(&scene, "style.bloom", "0.25", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "style.name", "raw", &error), KD_OK);
    assert_true(scene.style.bloom == 0 && scene.style.tone_map == KD_TONE_SRGB && !scene.style.dither);
    assert_int_equal(kd_scene_set(&scene, "style.bloom", "0.25", &error), KD_OK);
    assert_true(scene.style.bloom == 0.25 && scene.style.tone_map == KD_TONE_SRGB);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(each_sets_its_fields),
                                        cmocka_unit_test(what_the_document_sets_stays),
                                        cmocka_unit_test(the_name_alone_does_nothing_later),
                                        cmocka_unit_test(by_paths_in_order), cmocka_unit_test(the_default_is_a_style) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
