/* The scene document: round trips, canonical form, hash. */
#include "scene_support.h"

#include "scene/number.h"

#include <locale.h>

static void assert_round_trip(const struct kd_scene *scene)
{
    struct kd_scene back;
    struct kd_error error;
    char *text = support_canonical(scene);
    kd_scene_defaults(&back);
    if (support_parse(&back, text, &error))
        fail_msg("%s: %s in %s", error.pointer, error.message, text);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        double a = kd_field_get(scene, &kd_fields[i]), b = kd_field_get(&back, &kd_fields[i]);
        if (memcmp(&a, &b, sizeof a))
            fail_msg("%s.%s: %a became %a", kd_fields[i].section, kd_fields[i].name, a, b);
    }
    char *again = support_canonical(&back);
    assert_string_equal(text, again);
    free(text);
    free(again);
}

static void random_scenes_round_trip(void **state)
{
    (void)state;
    uint64_t seed = 20191105;
    for (int i = 0; i < 1000; i++) {
        struct kd_scene scene;
        support_scene(&scene, &seed);
        assert_round_trip(&scene);
    }
}

static void empty_document_is_the_default(void **state)
{
    (void)state;
    static const char *const same[] = { "{}", " { } \n", "{\"version\":1}", "{\"camera\":{}}",
                                        "{\"version\":1.0}" };
    struct kd_scene scene, defaults;
    kd_scene_defaults(&defaults);
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        kd_scene_defaults(&scene);
        assert_int_equal(support_parse(&scene, same[i], NULL), KD_OK);
        assert_memory_equal(&scene, &defaults, sizeof scene);
    }
}

static void documents_merge(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    assert_int_equal(support_parse(&scene, "{\"spacetime\":{\"spin\":0.5},\"camera\":{\"r\":30}}", NULL),
                     KD_OK);
    assert_int_equal(support_parse(&scene, "{\"camera\":{\"inclination_deg\":1}, \"time\": -0.0}", NULL),
                     KD_OK);
    assert_true(scene.spacetime.spin == 0.5 && scene.camera.r == 30 && scene.camera.inclination_deg == 1);
    assert_false(signbit(scene.top.time));
    assert_int_equal(support_parse(&scene, "{\"camera\":{\"r\":\"infin\\u0069ty\"}}", NULL), KD_OK);
    assert_true(isinf(scene.camera.r));
}

/* RFC 7396: null is the default, of a field or of a section; what is not named stays; nothing half done. */
static void patches(void **state)
{
    (void)state;
    struct kd_scene scene, before;
    struct kd_error error;
    kd_scene_defaults(&scene);
    scene.camera.inclination_deg = 10;
    scene.camera.r = 40;
    scene.disk.outer = 99;
    scene.top.time = 7;
    const char *text = "{\"camera\":{\"r\":null},\"disk\":null,\"time\":null,\"spacetime\":{\"spin\":0.25}}";
    assert_int_equal(kd_scene_patch(&scene, text, strlen(text), &error), KD_OK);
    assert_true(isinf(scene.camera.r) && scene.camera.inclination_deg == 10 && scene.disk.outer == 22 && scene.top.time == 0);
    assert_true(scene.spacetime.spin == 0.25);
    before = scene;
    static const char *const wrong[] = { "{\"camera\":{\"x\":null}}", "{\"nothing\":null}", "{\"disk\":null,\"disk\":null}",
                                         "{\"time\":1,\"camera\":{\"r\":\"far\"}}", "null" };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(kd_scene_patch(&scene, wrong[i], strlen(wrong[i]), &error), KD_EINVAL);
        assert_memory_equal(&scene, &before, sizeof scene);
    }
    assert_int_equal(support_parse(&scene, "{\"time\":null}", NULL), KD_EINVAL); /* a document has no null */
}

/* A file from an earlier version must go on meaning the same. */
static void canonical_form_is_stable(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.camera.azimuth_deg = -1e-7;
    scene.top.time = 0.1 + 0.2;
    char *text = support_canonical(&scene);
    const char *start = "{\"version\":1,\"spacetime\":{\"spin\":0.7,\"mass_msun\":100000000},"
                        "\"camera\":{\"r\":\"infinity\",\"inclination_deg\":82,\"azimuth_deg\":-1e-7,";
    const char *end = "\"accuracy\":{\"profile\":\"balanced\",\"tolerance\":\"profile\",\"engine\":\"auto\",\"precision\":\"auto\",\"steps\":0,\"orders\":3},\"time\":0.30000000000000004}";
    assert_memory_equal(text, start, strlen(start));
    assert_true(strlen(text) > strlen(end));
    assert_string_equal(text + strlen(text) - strlen(end), end);
    free(text);
}

static void numbers_are_short(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        { 0.1, "0.1" },
        { 1.0 / 3, "0.3333333333333333" },
        { 0.1 + 0.2, "0.30000000000000004" },
        { 1e-6, "1e-6" },
        { 1e22, "1e22" },
        { 5e-324, "4.94065645841247e-324" },
        { -0.999999999999, "-0.999999999999" },
        { 1e100, "1e100" },
        { 2.5e-10, "2.5e-10" },
        { 1e7, "10000000" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[KD_NUMBER_SIZE];
        kd_number_format(text, cases[i].value);
        assert_string_equal(text, cases[i].text);
        assert_true(kd_number_parse(text) == cases[i].value);
        assert_int_equal(kd_number_span(text, strlen(text)), strlen(text));
    }
}

static void invalid_scenes_have_no_text(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_buffer text = { 0 };
    char hash[65];
    kd_scene_defaults(&scene);
    scene.spacetime.spin = NAN;
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
    assert_int_equal(kd_scene_hash(&scene, hash), KD_EINVAL);
    assert_string_equal(hash, "");
    kd_scene_defaults(&scene);
    scene.disk.model = 99;
    assert_int_equal(kd_scene_to_json(&scene, &text), KD_EINVAL);
    kd_buffer_finish(&text);
}

static void hash_feels_each_field(void **state)
{
    (void)state;
    struct kd_scene defaults;
    char original[65], hash[65], seen[KD_FIELD_COUNT][65];
    kd_scene_defaults(&defaults);
    assert_int_equal(kd_scene_hash(&defaults, original), KD_OK);
    assert_int_equal(strspn(original, "0123456789abcdef"), 64);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_field *field = &kd_fields[i];
        struct kd_scene scene = defaults;
        double value = kd_field_get(&scene, field);
        switch (field->kind) {
        case KD_FIELD_WORD: value = field->minimum; break;
        case KD_FIELD_REAL: value = nextafter(value, value < field->maximum ? INFINITY : -INFINITY); break;
        default: value = kd_field_holds(field, value + 1) ? value + 1 : value - 1;
        }
        kd_field_put(&scene, field, value);
        assert_int_equal(kd_scene_hash(&scene, seen[i]), KD_OK);
        assert_string_not_equal(seen[i], original);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(seen[i], seen[j]);
    }
    assert_int_equal(kd_scene_hash(&defaults, hash), KD_OK);
    assert_string_equal(hash, original);
}

/* The same digest from another program. */
static void hash_is_sha256(void **state)
{
    (void)state;
    struct kd_scene scene;
    char hash[65], other[65] = "", path[] = "/tmp/kerrd-scene-XXXXXX", command[96];
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_hash(&scene, hash), KD_OK);
    char *text = support_canonical(&scene);
    int fd = mkstemp(path);
    FILE *file = fd < 0 ? NULL : fdopen(fd, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    free(text);
    snprintf(command, sizeof command, "sha256sum %s", path);
    FILE *pipe = popen(command, "r");
    bool read = pipe && fread(other, 1, 64, pipe) == 64;
    if (pipe)
        pclose(pipe);
    remove(path);
    if (!read) {
        print_message("sha256sum is not there to compare with\n");
        skip();
    }
    assert_string_equal(hash, other);
}

static void locale_does_not_matter(void **state)
{
    (void)state;
    static const char *const commas[] = { "de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "cs_CZ.UTF-8",
                                          "ru_RU.UTF-8" };
    const char *found = NULL;
    for (size_t i = 0; i < sizeof commas / sizeof *commas && !found; i++)
        found = setlocale(LC_ALL, commas[i]);
    if (!found) {
        print_message("no locale with a decimal comma is installed\n");
        skip();
    }
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    enum kd_status parsed = support_parse(&scene, "{\"spacetime\":{\"spin\":0.25}}", NULL);
    enum kd_status set = kd_scene_set(&scene, "time", "1.5", NULL);
    char *text = support_canonical(&scene);
    setlocale(LC_ALL, "C");
    assert_int_equal(parsed, KD_OK);
    assert_int_equal(set, KD_OK);
    assert_true(scene.spacetime.spin == 0.25 && scene.top.time == 1.5);
    assert_non_null(strstr(text, "\"spin\":0.25,"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_round_trip), cmocka_unit_test(empty_document_is_the_default),
        cmocka_unit_test(documents_merge), cmocka_unit_test(patches),          cmocka_unit_test(canonical_form_is_stable),
        cmocka_unit_test(numbers_are_short),        cmocka_unit_test(invalid_scenes_have_no_text),
        cmocka_unit_test(hash_feels_each_field),    cmocka_unit_test(hash_is_sha256),
        cmocka_unit_test(locale_does_not_matter),
    };
    return cmocka_run_group_tests_name("scene documents", tests, NULL, NULL);
}
