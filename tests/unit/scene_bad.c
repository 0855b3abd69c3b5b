/* Tests of documents that must be refused, each with the expected JSON pointer and reason; and of good documents with
 * random damage. */
#include "scene_support.h"

#include "document/scan.h"

struct bad { const char *text, *pointer, *fragment; };

static void expect_refused(const char *text, size_t length, const char *pointer, const char *fragment)
{
    struct kd_scene scene, before;
    struct kd_error error = { 0 };
    memset(&scene, 0x5a, sizeof scene); /* filled with arbitrary bytes, because its content must not matter */
    kd_scene_defaults(&scene);
    scene.camera.r = 12;
    before = scene;
    /* The block has exactly this size, so that a sanitizer detects a read past the end. NULL for no bytes. */
    char *exact = length ? malloc(length) : NULL;
    if (length)
        memcpy(exact, text, length);
    enum kd_status status = kd_scene_from_json(&scene, exact, length, &error);
    free(exact);
    if (status != KD_EINVAL || error.status != KD_EINVAL)
        fail_msg("accepted (%d): %.200s", status, text);
    if (strcmp(error.pointer, pointer) || !strstr(error.message, fragment))
        fail_msg("%.200s gave \"%s\" \"%s\", not \"%s\" \"%s\"", text, error.pointer, error.message, pointer, fragment);
    assert_memory_equal(&scene, &before, sizeof before);
}

static const struct bad syntax[] = {
    { "", "", "ends too early, after 0 bytes" },
    { "   ", "", "ends too early" },
    { "{", "", "ends too early" },
    { "{\"camera\"", "", "not valid JSON" },
    { "{\"camera\":", "", "not valid JSON" },
    { "{\"camera\":{\"r\":1", "", "ends too early" },
    { "{\"camera\":{\"r\":10}", "", "ends too early" },
    { "{\"camera\":{\"r\":\"infin", "", "a string without an end at byte 15" },
    { "{\"camera\":{},}", "",
      "at byte 13, line 1, column 14: a bracket after a comma: JSON has no comma after the last value" },
    { "{\"disk\":[1,\n]}", "", "at byte 12, line 2, column 1: a bracket after a comma" },
    { "{\"time\":}", "", "no value after a colon" },
    { "{,}", "", "a comma without a value before it" },
    { "{\"time\":1 \"version\":1}", "",
      "a value right after another, without a comma or a colon between them at byte 10" },
    { "{\"time\" 1}", "", "without a comma or a colon between them at byte 8" },
    { "{\"time\"=1}", "", "an equals sign" },
    { "{time:1}", "", "a name without double quotes" },
    { "{'time':1}", "", "a single quote: in JSON, strings and names have double quotes" },
    { "{\xe2\x80\x9ctime\xe2\x80\x9d:1}", "", "a typographic quote" },
    { "{\"time\":1}}", "", "text follows the document at byte 10" },
    { "{} {}", "", "text follows the document at byte 3" },
    { "{\"time\":1} x", "", "text after the document at byte 11" },
    { "{} // comment", "", "a comment, which JSON lacks" },
    { "{/* spin */}", "", "a comment, which JSON lacks" },
    { "# a scene\n{}", "", "a comment, which JSON lacks" },
    { "{\"time\":NaN}", "", "NaN, which JSON lacks: leave the member out" },
    { "{\"time\":Infinity}", "", "needs the string \"infinity\"" },
    { "{\"time\":-Infinity}", "", "needs the string \"infinity\"" },
    { "{\"time\":None}", "", "None, which is null in JSON" },
    { "{\"time\":01}", "", "malformed number" },
    { "{\"time\":1.}", "", "malformed number" },
    { "{\"time\":.5}", "", ".5 is 0.5 in JSON" },
    { "{\"time\":+5}", "", "a plus before a number, which JSON lacks" },
    { "{\"time\":1e}", "", "malformed number" },
    { "{\"time\":0x10}", "", "a value right after another" },
    { "{\"time\":1.2.3}", "", "malformed number" },
    { "{\"time\":True}", "", "a word in capitals, which is true in JSON" },
    { "{\"time\" true}", "", "a value right after another" },
    { "[1 null]", "", "a value right after another" },
    { "{\"time\":1.0000000000000000000000000000000000000000000000000000000000001}", "", "more than 60 characters" },
    { "{\"time\":\v1}", "", "unexpected character" },
    { "\xef\xbb\xbf{,}", "",
      /* a UTF-8 byte order mark is ignored and not counted */
      "at byte 1, line 1, column 2: a comma without a value before it" },
    { " \xef\xbb\xbf{}", "", "unexpected character at byte 1" },
    { "\xff\xfe{", "", "it is UTF-16; JSON must be UTF-8" },
    { "\xfe\xff", "", "it is UTF-16; JSON must be UTF-8" },
    { "{\"a\nb\":1}", "", "a control character in a string at byte 3" },
    { "{\"a\\x\":1}", "", "unknown escape" },
    { "{\"a\\u00", "", "an escape that ends too early" },
    { "{\"time\\u00zz\":1}", "", "malformed escape at byte 6" },
    { "{\"a\\uD83D\\u0041\":1}", "", "half of a surrogate pair at byte 3" },
    { "{\"a\\ud800\":1}", "", "half of a surrogate pair at byte 3" },
    { "{\"a\\udc00\":1}", "", "half of a surrogate pair at byte 3" },
    { "{\"a\\ud83d\\ud83d\\ude00\":1}", "", "half of a surrogate pair at byte 3" },
    { "{\"time\\u0000x\":1}", "", "NUL in a string at byte 6" },
    { "{\"\xff\":1}", "", "invalid UTF-8 at byte 2" },
    { "{\"\xc0\xaf\":1}", "", "invalid UTF-8" },         /* overlong / */
    { "{\"\xed\xa0\x80\":1}", "", "invalid UTF-8" },     /* a surrogate */
    { "{\"\xf4\x90\x80\x80\":1}", "", "invalid UTF-8" }, /* beyond U+10FFFF */
    { "{\"\xe2\x82", "", "invalid UTF-8" },
    { "{}\xff", "", "invalid UTF-8 at byte 2" },
};

static const struct bad fields[] = {
    { "[]", "", "the document is an array" },
    { "1", "", "the document is 1; it" },
    { "null", "", "the document is null" },
    { "{\"version\":2}", "/version", "version is 2; it must be 1" },
    { "{\"version\":\"1\"}", "/version", "version is \"1\"" },
    { "{\"version\":1.5}", "/version", "version is 1.5" },
    { "{\"version\":null}", "/version", "version is null" },
    { "{\"version\":1,\"version\":1}", "/version", "version is given twice" },
    { "{\"time\":1,\"camera\":{},\"time\":1}", "/time", "time is given twice" },
    { "{\"camera\":{},\"disk\":{},\"camera\":{}}", "/camera", "camera is given twice" },
    { "{\"camera\":{\"r\":9,\"r\":9}}", "/camera/r", "camera.r is given twice" },
    { "{\"camera\":{\"r\":9,\"\\u0072\":9}}", "/camera/r", "camera.r is given twice" },
    { "{\"camera\":{\"r\":9},\"disk\":{\"outer\":0}}", "/disk/outer", "disk.outer is 0; it must be 1 to 1000000 M" },
    { "{\"camera\":5}", "/camera", "camera is 5; it must be an object" },
    { "{\"camera\":null}", "/camera", "camera is null" },
    { "{\"camera\":[]}", "/camera", "camera is an array" },
    { "{\"camera\":\"r\"}", "/camera", "camera is \"r\"" },
    { "{\"Camera\":{}}", "/Camera", "did you mean camera?" },
    { "{\"camera\":{\"R\":5}}", "/camera/R", "did you mean camera.r?" },
    { "{\"camera\":{\"inclination\":5}}", "/camera/inclination", "did you mean camera.inclination_deg?" },
    { "{\"spin\":0.5}", "/spin", "did you mean spacetime.spin?" },
    { "{\"top\":{\"time\":5}}", "/top", "there is no field top" },
    { "{\"\":{}}", "/", "there is no field" },
    { "{\"camera\":{\"\":1}}", "/camera/", "the fields are r, inclination_deg" },
    { "{\"__proto__\":{}}", "/__proto__", "the fields are spacetime, camera" },
    { "{\"a/b~c\":1}", "/a~1b~0c", "there is no field a/b~c" },
    { "{\"\\u001b[31m\":1}", "/\x1b[31m", "there is no field ?[31m" },
    { "{\"spacetime\":{\"spin\":1.0000001}}", "/spacetime/spin",
      "spacetime.spin is 1.0000001; it must be -0.999999999999 to 0.999999999999 M" },
    { "{\"spacetime\":{\"spin\":\"0.9\"}}", "/spacetime/spin",
      "spacetime.spin is \"0.9\", a string where a number is needed; it must be" },
    { "{\"spacetime\":{\"spin\":true}}", "/spacetime/spin", "spacetime.spin is true where a number is needed" },
    { "{\"spacetime\":{\"spin\":null}}", "/spacetime/spin", "spacetime.spin is null" },
    { "{\"spacetime\":{\"mass_msun\":1e999}}", "/spacetime/mass_msun", "is a number beyond 1e308" },
    { "{\"camera\":{\"r\":1e999}}", "/camera/r", "beyond 1e308; it must be 0.01 to 10000000 M, or \"infinity\"" },
    { "{\"camera\":{\"r\":\"Infinity\"}}", "/camera/r", "camera.r is \"Infinity\"; it must be" },
    { "{\"camera\":{\"r\":\"50\"}}", "/camera/r", "camera.r is \"50\", a string where a number is needed" },
    { "{\"camera\":{\"observer\":\"zam\"}}", "/camera/observer",
      "it must be \"static\", \"zamo\", \"keplerian\", \"retrograde\", \"infall\" or \"velocity\"" },
    { "{\"image\":{\"width\":0}}", "/image/width",
      "image.width is 0; it must be a whole number from 1 to 32768 pixels" },
    { "{\"image\":{\"width\":1e9}}", "/image/width", "image.width is 1000000000" },
    { "{\"image\":{\"width\":12.5}}", "/image/width", "image.width is 12.5" },
    { "{\"style\":{\"ringdown\":1.5}}", "/style/ringdown", "style.ringdown is 1.5; it must be 0 to 1" },
    { "{\"style\":{\"ringdown\":true}}", "/style/ringdown", "style.ringdown is true" },
    { "{\"style\":{\"ringdown_time\":1e13}}", "/style/ringdown_time", "it must be -1000000000000 to 1000000000000 M" },
    { "{\"spots\":5}", "/spots", "spots is 5; it must be an array of up to 16 objects with fields" },
    { "{\"spots\":null}", "/spots", "spots is null; it must be an array" },
    { "{\"spots\":[5]}", "/spots/0", "spots.0 is 5; it must be an object with fields" },
    { "{\"spots\":[{},null]}", "/spots/1", "spots.1 is null; it must be an object with fields" },
    { "{\"spots\":[{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}]}", "/spots/16",
      "spots has 17 elements; it must have at most 16" },
    { "{\"spots\":[{},{},{},{\"r\":0.5}]}", "/spots/3/r", "spots.3.r is 0.5; it must be 1 to 1000000 M" },
    { "{\"spots\":[{},{\"r\":2,\"r\":2}]}", "/spots/1/r", "spots.1.r is given twice" },
    { "{\"spots\":[{},{\"q\":2}]}", "/spots/1/q", "there is no field spots.1.q" },
    { "{\"spots\":[{},{\"brightnes\":2}]}", "/spots/1/brightnes", "did you mean spots.1.brightness?" },
    { "{\"spots\":[],\"spots\":[]}", "/spots", "spots is given twice" },
    { "{\"spots\":{\"r\":9}}", "/spots/r",
      "there is no spots.r: spots is a list with elements from spots.0 to spots.15" },
    { "{\"spots\":{\"0\":{},\"0\":{}}}", "/spots/0", "spots.0 is given twice" },
    { "{\"spots\":{\"0\":{},\"3\":{},\"1\":{}}}", "/spots/3",
      "there is no spots.3: the list has 2 elements, and the next free index is 2" },
    { "{\"spots\":{\"16\":{}}}", "/spots/16", "there is no spots.16" },
    { "{\"spots\":{\"01\":{}}}", "/spots/01", "there is no spots.01" },
    { "{\"spots\":{\"0\":null}}", "/spots/0", "spots.0 is null; it must be an object with fields" },
    { "{\"spot1\":null}", "/spots/0", "spots.0 is null" },
    { "{\"spot2\":{\"r\":0}}", "/spots/1/r", "spots.1.r is 0; it must be 1 to 1000000 M" },
    { "{\"spot2\":{},\"spot2\":{}}", "/spot2", "spot2 is given twice" },
    { "{\"spots\":[],\"spot2\":{}}", "/spot2", "spot2 is an old name of spots.1, and cannot be used with spots" },
    { "{\"spot2\":{},\"spots\":{\"0\":{}}}", "/spot2", "spot2 is an old name of spots.1" },
    { "{\"spot4\":{}}", "/spot4", "did you mean spots?" },
    { "{\"style\":{\"dither\":1}}", "/style/dither", "style.dither is 1; it must be true or false" },
};

static void syntax_is_strict(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof syntax / sizeof *syntax; i++)
        expect_refused(syntax[i].text, strlen(syntax[i].text), syntax[i].pointer, syntax[i].fragment);
    expect_refused("{}\0", 3, "", "NUL at byte 2");
    expect_refused("{\"a\0b\":1}", 9, "", "a control character in a string at byte 3");
}

static void fields_are_strict(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        expect_refused(fields[i].text, strlen(fields[i].text), fields[i].pointer, fields[i].fragment);
}

static void every_prefix_is_refused(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    char *text = support_canonical(&scene);
    for (size_t n = 0; n < strlen(text); n++)
        expect_refused(text, n, "", "not valid JSON");
    free(text);
}

/* Texts that would make a careless parser use too much stack, memory or time. */
static void bombs_are_refused(void **state)
{
    (void)state;
    size_t size = KD_SCENE_JSON_MAX;
    char *text = malloc(2 * size);
    memset(text, '[', size);
    expect_refused(text, size, "", "nested deeper than 32 levels at byte 32");
    for (size_t i = 0; i + 5 <= size; i += 5)
        memcpy(text + i, "{\"a\":", 5);
    expect_refused(text, size - size % 5, "", "nested deeper than 32 levels");
    for (size_t i = 0; i + 2 <= size; i += 2)
        memcpy(text + i, i ? "0," : "[ ", 2);
    expect_refused(text, size, "", "more than 4096 values");
    memset(text, ' ', 2 * size);
    memcpy(text, "{}", 2);
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    assert_int_equal(kd_scene_from_json(&scene, text, size, NULL), KD_OK);
    expect_refused(text, size + 1, "", "the document has 1048577 bytes; it must have at most 1048576");
    expect_refused(text, 2 * size, "", "it must have at most 1048576");
    free(text);
}

/* 32 nested levels pass the scan, and then fail because there is no such field; 33 levels fail in the scan. */
static void depth_limit_is_exact(void **state)
{
    (void)state;
    char text[128] = "{\"a\":";
    memset(text + 5, '[', 31);
    memset(text + 36, ']', 31);
    strcpy(text + 67, "}");
    expect_refused(text, strlen(text), "/a", "there is no field a");
    memset(text + 5, '[', 32);
    memset(text + 37, ']', 32);
    strcpy(text + 69, "}");
    expect_refused(text, strlen(text), "", "deeper than 32");
}

/* Finds a member of the outermost object only, however its name is escaped. */
static void names_are_found(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool there;
    } cases[] = {
        { "{\"axes\":1}", true },
        { " {\"a\":{\"b\":[1,\"}\"]}, \"axes\"\n:\t{}}", true },
        { "{\"\\u0061x\\u0065s\":1}", true },
        { "{\"a\":\"\\\\\",\"axes\":1}", true },
        { "{\"a\":{\"axes\":1}}", false },
        { "{\"a\":\"axes\"}", false },
        { "{\"a\":[\"axes\"]}", false },
        { "[\"axes\"]", false },
        { "{\"axe\":1}", false },
        { "{\"axess\":1}", false },
        { "{\"\\u0161xes\":1}", false },
        { "{\"a\":\"\\\"axes\\\":\"}", false },
        { "", false },
        { "{\"axes\"", false },
        { "{\"axes", false },
        { "{\"\\", false },
        { "{\"\\u00", false },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t length = strlen(cases[i].text);
        /* exactly as long as the text, so that a sanitizer detects a read past the end */
        char *exact = malloc(length ? length : 1);
        memcpy(exact, cases[i].text, length);
        if (kd_scan_names(exact, length, "axes") != cases[i].there)
            fail_msg("%s", cases[i].text);
        free(exact);
    }
}

/* A key that is too long for a pointer leaves the pointer at the key's parent. Messages remain valid UTF-8. */
static void long_names_are_cut(void **state)
{
    (void)state;
    char text[1200] = "{\"camera\":{\"";
    for (int i = 0; i < 300; i++)
        strcat(text, "\xe2\x82\xac");
    strcat(text, "\":1}}");
    expect_refused(text, strlen(text), "/camera", "\xe2\x82\xac... here;");
    struct kd_scene scene;
    struct kd_error error;
    kd_scene_defaults(&scene);
    strcpy(text, "{\"camera\":{\"observer\":\"");
    for (int i = 0; i < 300; i++)
        strcat(text, "\xe2\x82\xac");
    strcat(text, "\"}}");
    assert_int_equal(support_parse(&scene, text, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "\xe2\x82\xac...\"; it must be"));
}

static size_t mutate(char *text, size_t length, size_t capacity, uint64_t *seed)
{
    static const char *const pieces[] = { "{",
                                          "}",
                                          "[",
                                          "]",
                                          ",",
                                          ":",
                                          "\"",
                                          "\\",
                                          "\\u0000",
                                          "null",
                                          "-",
                                          "1e999",
                                          "NaN",
                                          "\xff",
                                          "\"camera\":{",
                                          "\"r\":1",
                                          "\"spots\":[",
                                          "\"spots\":{\"0\":{",
                                          "\"spot2\":{",
                                          "},{",
                                          "0.5",
                                          "true",
                                          "\"infinity\"",
                                          "\n" };
    size_t at = length ? support_random(seed) % length : 0, n = 1 + support_random(seed) % 8;
    const char *piece = pieces[support_random(seed) % (sizeof pieces / sizeof *pieces)];
    size_t size = strlen(piece);
    switch (support_random(seed) % 4) {
    case 0: /* a byte */ text[at] = (char)support_random(seed); return length;
    case 1: /* remove some */
        n = n > length - at ? length - at : n;
        memmove(text + at, text + at + n, length - at - n);
        return length - n;
    case 2: /* insert something */
        if (length + size > capacity)
            return length;
        memmove(text + at + size, text + at, length - at);
        memcpy(text + at, piece, size);
        return length + size;
    default: return at; /* cut it off */
    }
}

static void random_damage_is_harmless(void **state)
{
    (void)state;
    uint64_t seed = 1916;
    size_t accepted = 0, refused = 0;
    for (int i = 0; i < 8000; i++) {
        struct kd_scene scene, target, before;
        support_scene(&scene, &seed);
        kd_scene_defaults(&target);
        before = target;
        char *good = support_canonical(&scene);
        size_t length = strlen(good), capacity = length + 256;
        char *text = malloc(capacity);
        memcpy(text, good, length);
        for (uint64_t n = 1 + support_random(&seed) % 3; n; n--)
            length = length ? mutate(text, length, capacity, &seed) : 0;
        text = realloc(text,
                       /* The block has exactly this size, so that a sanitizer detects a read past the end. */
                       length ? length : 1);
        struct kd_error error = { 0 };
        if (kd_scene_from_json(&target, text, length, &error)) {
            refused++;
            assert_int_equal(error.status, KD_EINVAL);
            assert_true(*error.message);
            assert_memory_equal(&target, &before, sizeof before);
        } else {
            accepted++; /* the document may still be valid, for example after a change of a digit */
            for (size_t s = 0; s < KD_SECTION_COUNT; s++) {
                const struct kd_section *section = &kd_sections[s];
                assert_true(!section->most || kd_section_size(&target, section) <= section->most);
                for (size_t index = 0; index < (section->most ? section->most : 1); index++)
                    for (size_t f = section->first; f < section->first + section->count; f++)
                        assert_true(kd_row_holds(&kd_fields[f], kd_field_get(&target, &kd_fields[f], index)));
            }
        }
        free(text);
        free(good);
    }
    assert_true(accepted > 100 && refused > 1000); /* both outcomes, valid and refused, must occur often enough */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(syntax_is_strict),        cmocka_unit_test(fields_are_strict),
        cmocka_unit_test(every_prefix_is_refused), cmocka_unit_test(bombs_are_refused),
        cmocka_unit_test(depth_limit_is_exact),    cmocka_unit_test(names_are_found),
        cmocka_unit_test(long_names_are_cut),      cmocka_unit_test(random_damage_is_harmless),
    };
    return cmocka_run_group_tests_name("scene refusals", tests, NULL, NULL);
}
