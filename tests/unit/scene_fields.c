/* Tests of every field of the scene table: its bounds, its words, kd_scene_set, and the texts generated from it. */
#include "scene_support.h"

#include "scene/control.h"
#include "document/number.h"

#include <cjson/cJSON.h>
#include <limits.h>

/* Checks that a value is accepted both as JSON and as text of a command line, or refused as both. */
static void expect(const struct kd_row *field, const char *json, const char *text, bool accepted, double stored)
{
    struct kd_scene a, b, before;
    struct kd_error error = { 0 };
    char document[256], path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    kd_scene_defaults(&a);
    b = before = a;
    support_document(document, field, json);
    kd_field_path(field, 0, path);
    kd_field_pointer(field, 0, pointer);
    for (int way = 0; way < 2; way++) {
        struct kd_scene *scene = way ? &b : &a;
        memset(&error, 0, sizeof error);
        enum kd_status status = way ? kd_scene_set(scene, path, text, &error) : support_parse(scene, document, &error);
        if ((status == KD_OK) != accepted)
            fail_msg("%s = %s by way %d: status %d, %s", path, json, way, status, error.message);
        if (accepted) {
            assert_true(kd_field_get(scene, field, 0) == stored);
        } else {
            assert_int_equal(status, KD_EINVAL);
            assert_string_equal(error.pointer, pointer);
            assert_non_null(strstr(error.message, path));
            assert_non_null(strstr(error.message, "it must be"));
            if (*field->unit && strcmp(field->unit, "1"))
                assert_non_null(strstr(error.message, field->unit));
            assert_memory_equal(scene, &before, sizeof before);
        }
    }
}

static void expect_number(const struct kd_row *field, double value, bool accepted)
{
    char text[KD_NUMBER_SIZE];
    kd_number_format(text, value);
    expect(field, text, text, accepted, value);
}

static void expect_word(const struct kd_row *field, const char *word, bool accepted, double stored)
{
    char json[96];
    snprintf(json, sizeof json, "\"%s\"", word);
    expect(field, json, word, accepted, stored);
}

static void bounds_are_inclusive(void **state)
{
    (void)state;
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        bool whole = field->kind == KD_KIND_INT;
        if (field->kind == KD_KIND_BOOL || field->kind == KD_KIND_WORD || field->kind == KD_KIND_SERIES ||
            field->kind == KD_KIND_ASSET)
            continue;
        expect_number(field, field->least, true);
        expect_number(field, field->most, true);
        expect_number(field, whole ? field->least - 1 : nextafter(field->least, -INFINITY), false);
        expect_number(field, whole ? field->most + 1 : nextafter(field->most, INFINITY), false);
        expect_number(field, 1e300, false);
        if (whole) {
            expect_number(field, field->least + 0.5, false);
            /* this number would wrap to the minimum in 32 bits */
            expect_number(field, 4294967296.0 + field->least, false);
        }
    }
}

static void words_are_exact(void **state)
{
    (void)state;
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        if (field->kind == KD_KIND_ASSET)
            continue;
        expect_word(field, "no-such-word", false, 0);
        expect_word(field, "", false, 0);
        if (field->words && (field->kind == KD_KIND_REAL || field->kind == KD_KIND_INT))
            expect_word(field, field->words, true, INFINITY);
        if (field->kind != KD_KIND_WORD)
            continue;
        for (int w = 0; w < kd_word_count(field->words); w++) {
            char word[64], longer[72];
            struct kd_word span = kd_word(field->words, w);
            snprintf(word, sizeof word, "%.*s", span.length, span.text);
            expect_word(field, word, true, w);
            snprintf(longer, sizeof longer, "%s ", word);
            expect_word(field, longer, false, 0);
            longer[strlen(word) - 1] = 0;
            expect_word(field, longer, false, 0);
        }
        expect_word(field, field->words, false, 0);
        expect(field, "0", "0", false, 0);
    }
}

static void types_are_strict(void **state)
{
    (void)state;
    static const char *const never[] = { "null", "[]", "[1]", "{}", "{\"x\":1}" };
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        bool truth = field->kind == KD_KIND_BOOL;
        if (field->kind == KD_KIND_ASSET) /* --set takes any text as a name, also a text that is a number in JSON */
            continue;
        for (size_t n = 0; n < sizeof never / sizeof *never; n++)
            expect(field, never[n], never[n], false, 0);
        expect(field, "true", "true", truth, 1);
        expect(field, "false", "false", truth, 0);
        expect(field, "\"1\"", "1 ", false, 0);
        expect(field, "1e999", "1e999", false, 0);
        expect(field, "-1e999", "-1e999", false, 0);
        if (truth)
            expect(field, "1", "1", false, 0);
    }
}

static void assets_have_names(void **state)
{
    (void)state;
    static const char *const hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", *const bad[] = {
        "1",
        "-",
        ".png",
        "a b",
        "a/b",
        "\xc3\xa9t\xc3\xa9",
        "BA7816BF8F01CFEA414140DE5DAE2223B00361A396177A9CB410FF61F20015AD",
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad0",
        "http://example.org/sky.png",
    };
    size_t n = 0;
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        if (field->kind != KD_KIND_ASSET)
            continue;
        n++;
        expect_word(field, hash, true, 1);
        expect_word(field, "milky-way_1.png", true, 1);
        expect_word(field, "", true, 0);
        expect(field, "null", "", true, 0);
        expect(field, "7", "7", false, 0);
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
            expect_word(field, bad[k], false, 0);
    }
    assert_int_equal(n, 2);
}

/* Numbers that strtod accepts but JSON does not are refused, except unfinished ones: .5 is accepted, because its
 * meaning is clear. */
static void set_reads_numbers(void **state)
{
    (void)state;
    static const char *const bad[] = { "nan", "inf", "-inf", "NAN", "0x10", " 1",  "1 ",  "+1",  "01",  "1,5",
                                       "1e",  "-",   "",     ".",   "-.",   ".e1", ".5.", ".5e", "00.5" };
    static const struct {
        const char *text;
        double value;
    } good[] = { { "-1.25e2", -125 }, { ".5", 0.5 }, { "-.5", -0.5 }, { "5.", 5 },
                 { "-5.e-1", -0.5 },  { ".5e1", 5 }, { "0.", 0 } };
    struct kd_scene scene;
    struct kd_error error;
    kd_scene_defaults(&scene);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(kd_scene_set(&scene, "time", bad[i], &error), KD_EINVAL);
        assert_string_equal(error.pointer, "/time");
    }
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        assert_int_equal(kd_scene_set(&scene, "time", good[i].text, &error), KD_OK);
        assert_true(scene.top.time == good[i].value);
    }
    assert_int_equal(kd_scene_set(&scene, "image.width", "6.4e2", &error), KD_OK);
    assert_int_equal(scene.image.width, 640);
    assert_int_equal(kd_scene_set(&scene, "time", "-0", &error), KD_OK);
    assert_false(signbit(scene.top.time));
    assert_int_equal(kd_scene_set(&scene, "version", "1", &error), KD_OK);
    assert_int_equal(kd_scene_set(&scene, "version", "2", &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/version");
    assert_int_equal(kd_scene_set(&scene, "time", "nonsense", NULL), KD_EINVAL);
}

static void set_names_unknown_paths(void **state)
{
    (void)state;
    static const struct {
        const char *path, *pointer, *fragment;
    } cases[] = {
        { "camera.inclination", "/camera/inclination", "did you mean camera.inclination_deg?" },
        { "camera.spin", "/camera/spin", "did you mean spacetime.spin?" },
        { "spin", "/spin", "did you mean spacetime.spin?" },
        { "cammera.r", "/cammera/r", "did you mean camera.r?" },
        { "disk.color", "/disk/color", "did you mean disk.colour?" },
        { "TIME", "/TIME", "did you mean time?" },
        { "camera", "/camera", "is a section" },
        { "camera.", "/camera/", "the fields are r," },
        { "", "/", "the fields are spacetime," },
        { ".time", "/.time", "there is no field" },
        { "top.time", "/top/time", "did you mean time?" },
        { "camera.r.x", "/camera/r.x", "there is no field camera.r.x" },
        { "zzzzzzzz", "/zzzzzzzz", "the fields are spacetime, camera" },
        { "a/b.c~d", "/a~1b/c~0d", "there is no field" },
        { "spots", "/spots", "spots is a list; name a field of one of its elements, as in spots.0.brightness" },
        { "spots.0", "/spots/0", "spots.0 is an element; name one of its fields, as in spots.0.brightness" },
        { "spots.15", "/spots/15", "as in spots.15.brightness" },
        { "spot2", "/spots/1", "as in spots.1.brightness" },
        { "spots.", "/spots/", "with elements from spots.0 to spots.15" },
        { "spots.r", "/spots/r", "there is no spots.r: spots is a list with elements from spots.0 to spots.15" },
        { "spots.16.r", "/spots/16", "with elements from spots.0 to spots.15" },
        { "spots.-1.r", "/spots/-1", "there is no spots.-1" },
        { "spots.00.r", "/spots/00", "there is no spots.00" },
        { "spots.4294967296.r", "/spots/4294967296", "there is no spots.4294967296" },
        { "spots.18446744073709551616.r", "/spots/18446744073709551616", "there is no" },
        { "spots.1.r", "/spots/1", "there is no spots.1: the list has 0 elements, and the next free index is 0" },
        { "spots.0.q", "/spots/0/q", "there is no field spots.0.q" },
        { "spots.0.brightnes", "/spots/0/brightnes", "did you mean spots.0.brightness?" },
        { "spot3.brightnes", "/spots/2/brightnes", "did you mean spots.2.brightness?" },
        { "spots.0.r.x", "/spots/0/r.x", "there is no field spots.0.r.x" },
        { "spot4.r", "/spot4/r", "did you mean spots.0.r?" },
        { "camera.\x1b[31m\xff", "/camera/\x1b[31m?", "camera.?[31m?" },
    };
    struct kd_scene scene, before;
    kd_scene_defaults(&scene);
    before = scene;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_error error;
        assert_int_equal(kd_scene_set(&scene, cases[i].path, "1", &error), KD_EINVAL);
        assert_string_equal(error.pointer, cases[i].pointer);
        if (!strstr(error.message, cases[i].fragment))
            fail_msg("%s: \"%s\" lacks \"%s\"", cases[i].path, error.message, cases[i].fragment);
        assert_memory_equal(&scene, &before, sizeof before);
    }
}

static void defaults_are_valid(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_error error;
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_validate(&scene, &error), KD_OK);
    assert_true(scene.spacetime.spin == 0.7);
    assert_true(isinf(scene.camera.r));
    assert_int_equal(scene.disk.model, KD_DISK_NOVIKOV_THORNE);
    assert_int_equal(scene.image.width, 1280);
    assert_true(scene.style.dither);
}

/* The schema of a section, or of a section nested in another. */
static const cJSON *schema_of(const cJSON *properties, const char *section)
{
    char first[KD_PATH_SIZE];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(section, "."), section);
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(properties, first);
    section += strlen(first);
    return *section ? schema_of(cJSON_GetObjectItemCaseSensitive(found, "properties"), section + 1) : found;
}

/* The number of members of the document that are sections. */
static int outer_sections(void)
{
    int n = 0;
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        n += *kd_sections[i].name && !strchr(kd_sections[i].name, '.');
    return n;
}

static void schema_names_each_field(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_scene_schema(&text), KD_OK);
    cJSON *schema = cJSON_Parse((char *)text.data);
    assert_non_null(schema);
    const cJSON *root = cJSON_GetObjectItemCaseSensitive(schema, "properties");
    assert_int_equal(cJSON_GetArraySize(root),
                     1 + outer_sections() + kd_sections[KD_SECTION_COUNT - 1].count + KD_OLD_NAME_COUNT);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        const cJSON *home = root;
        if (*field->object) {
            const cJSON *section = schema_of(root, field->object);
            if (kd_section_find(field->object)->most) {
                assert_string_equal(cJSON_GetObjectItemCaseSensitive(section, "type")->valuestring, "array");
                assert_int_equal(cJSON_GetObjectItemCaseSensitive(section, "maxItems")->valuedouble,
                                 kd_section_find(field->object)->most);
                section = cJSON_GetObjectItemCaseSensitive(section, "items");
            }
            assert_true(cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(section, "additionalProperties")));
            home = cJSON_GetObjectItemCaseSensitive(section, "properties");
        }
        const cJSON *row = cJSON_GetObjectItemCaseSensitive(home, field->name);
        assert_non_null(row);
        assert_string_equal(cJSON_GetObjectItemCaseSensitive(row, "description")->valuestring, field->help);
        assert_non_null(cJSON_GetObjectItemCaseSensitive(row, "default"));
        assert_string_equal(cJSON_GetObjectItemCaseSensitive(row, "x-nature")->valuestring,
                            kd_natures[kd_field_pages[i].nature].word);
        assert_int_equal(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(row, "x-front")),
                         kd_field_pages[i].place == KD_FIELD_FRONT);
        if (field->kind == KD_KIND_REAL && !field->words)
            assert_true(cJSON_GetObjectItemCaseSensitive(row, "maximum")->valuedouble == field->most);
    }
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++) {
        const cJSON *old = cJSON_GetObjectItemCaseSensitive(root, kd_old_names[i].name);
        const cJSON *list = cJSON_GetObjectItemCaseSensitive(root, kd_old_names[i].object);
        assert_true(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(old, "deprecated")));
        assert_true(cJSON_Compare(
            cJSON_GetObjectItemCaseSensitive(old, "properties"),
            cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(list, "items"), "properties"), true));
    }
    cJSON_Delete(schema);
    kd_buffer_finish(&text);
}

static enum kd_field_nature nature_of(const char *section, const char *name)
{
    return kd_field_pages[kd_field_find(section, name) - kd_fields].nature;
}

/* Each group on the page has at least one field that is shown at once, so that no opened group is empty. Some known
 * fields have the right nature. */
static void natures_and_groups(void **state)
{
    (void)state;
    size_t in_front[KD_GROUP_COUNT] = { 0 };
    for (size_t s = 0; s < KD_SECTION_COUNT; s++)
        for (size_t i = 0; i < kd_sections[s].count; i++)
            in_front[kd_sections[s].group] += kd_field_pages[kd_sections[s].first + i].place == KD_FIELD_FRONT;
    for (size_t g = 0; g < KD_GROUP_COUNT; g++)
        if (in_front[g] == 0)
            fail_msg("no field stands in front of the group %s", kd_groups[g]);
    assert_int_equal(nature_of("spacetime", "spin"), KD_FIELD_PHYSICS);
    assert_int_equal(nature_of("disk", "peak_temperature_k"), KD_FIELD_MODEL);
    assert_int_equal(nature_of("style", "tone_map"), KD_FIELD_LOOK);
}

/* Each control belongs to exactly one field, which refers to it. */
static void controls_are_of_fields(void **state)
{
    (void)state;
    for (size_t k = 0; k < kd_control_count; k++) {
        const struct kd_control *c = &kd_controls[k];
        const struct kd_row *of = NULL;
        for (int i = 0; i < KD_FIELD_COUNT; i++)
            for (const struct kd_control *found = kd_control_find(&kd_fields[i], c->kind); found;
                 found = kd_control_next(&kd_fields[i], found))
                if (found == c)
                    of = &kd_fields[i];
        if (!of)
            fail_msg("%s is no field", c->path);
        const struct kd_control *first = kd_control_find(of, c->kind);
        if (first != c && (c->kind != KD_CONTROL_WITH || strcmp(first->text, c->text) || first->a == c->a))
            fail_msg("%s has two controls of this kind", c->path);
        if (c->kind == KD_CONTROL_SPAN)
            assert_true(of->least <= c->a && c->a < c->b && c->b <= of->most);
        if (c->kind == KD_CONTROL_FIRST || c->kind == KD_CONTROL_BUTTON)
            assert_true(kd_row_holds(of, c->a) && c->a != of->initial);
        if (c->kind == KD_CONTROL_WITH)
            assert_true(kd_field_find(of->object, c->text) && kd_row_holds(kd_field_find(of->object, c->text), c->a));
    }
    assert_true(kd_control_count > 30);
}

static void reference_is_current(void **state)
{
    (void)state;
    struct kd_buffer page = { 0 };
    assert_int_equal(kd_scene_reference(&page), KD_OK);
    FILE *file = fopen(KD_REFERENCE, "rb");
    if (!file)
        fail_msg("cannot open " KD_REFERENCE);
    char *text = calloc(1, page.size + 2);
    size_t size = fread(text, 1, page.size + 1, file);
    fclose(file);
    if (size != page.size || memcmp(text, page.data, size))
        fail_msg("docs/scene.md is not what src/scene/fields.h says; update it with\n"
                 "    BUILD/src/scene/kd_scene_reference > docs/scene.md");
    free(text);
    kd_buffer_finish(&page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_are_inclusive), cmocka_unit_test(words_are_exact),
        cmocka_unit_test(types_are_strict),     cmocka_unit_test(assets_have_names),
        cmocka_unit_test(set_reads_numbers),    cmocka_unit_test(set_names_unknown_paths),
        cmocka_unit_test(defaults_are_valid),   cmocka_unit_test(schema_names_each_field),
        cmocka_unit_test(natures_and_groups),   cmocka_unit_test(controls_are_of_fields),
        cmocka_unit_test(reference_is_current),
    };
    return cmocka_run_group_tests_name("scene fields", tests, NULL, NULL);
}
