/* Tests of the document engine: readers, refusals, writer and schema, for a table with a row of each kind. */
#include "../document_example.h"
#include "document/tree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static enum kd_status read_kind(struct tea *tea, const char *text, unsigned of, uint64_t *given, struct kd_error *error)
{
    struct kd_document document = tea_document;
    cJSON *tree = NULL;
    document.of = of;
    kd_document_defaults(&document, tea);
    assert_int_equal(kd_tree_parse(text, strlen(text), 1000, 64, &tree, error), KD_OK);
    const enum kd_status status = kd_document_read(&document, tea, tree, "", given, error);
    kd_tree_free(tree);
    return status;
}

static void each_kind_is_read_and_written(void **state)
{
    struct tea tea;
    struct kd_error error = { 0 };
    uint64_t given = 0;
    (void)state;
    const char *text = "{\"minutes\":9.5,\"sugar_g\":0.5,\"heat\":80,\"cups\":8,\"leaf\":\"black\",\"pot\":\"auto\","
                       "\"iced\":true,\"table\":{\"milk\":true,\"with\":[\"cake\",\"fruit\"]},\"place\":[-9,0,9],"
                       "\"name\":\"a b\"}";
    assert_int_equal(read_kind(&tea, text, 0, &given, &error), KD_OK);
    assert_true(tea.minutes == 9.5 && tea.sugar_g == 0.5 && tea.heat == 80 && tea.cups == 8 && tea.leaf == 2 &&
                tea.pot == -1 && tea.iced && tea.milk && tea.with == 6 && tea.place[2] == 9);
    assert_string_equal(tea.name, "a b");
    assert_int_equal(given, 0xfff & ~0x200u);
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    kd_json_object(&json, NULL);
    kd_document_write(&json, &tea_document, &tea);
    kd_json_end(&json);
    assert_int_equal(kd_json_finish(&json), KD_OK);
    assert_string_equal((const char *)out.data, text);
    kd_buffer_finish(&out);

    assert_int_equal(read_kind(&tea, "{\"heat\":\"boiling\",\"times\":[0,24],\"host\":{\"x\":1}}", 0, NULL, &error),
                     KD_OK);
    assert_true(isinf(tea.heat) && tea.times.n == 2 && tea.times.at[1] == 24 && tea.minutes == 3 && tea.leaf == 1);
    free(tea.times.at);
}

static void refusals_say_what_it_must_be(void **state)
{
    static const struct {
        const char *text, *pointer, *message;
    } refused[] = {
        { "[]", "", "the document is an array; it must be an object with fields" },
        { "{\"minutes\":10}", "/minutes", "minutes is 10; it must be 0 up to, not including, 10 min" },
        { "{\"minutes\":\"3\"}", "/minutes",
          "minutes is \"3\", a string where a number is needed; it must be 0 up to, not including, 10 min" },
        { "{\"minutes\":null}", "/minutes",
          "minutes is null where a number is needed; it must be 0 up to, not including, 10 min" },
        { "{\"minutes\":1e999}", "/minutes",
          "minutes is a number beyond 1e308; it must be 0 up to, not including, 10 min" },
        { "{\"sugar_g\":0.4}", "/sugar_g", "sugar_g is 0.4; it must be 0, or 0.5 to 50 g" },
        { "{\"heat\":50}", "/heat", "heat is 50; it must be a number above 50 and below 100, or \"boiling\"" },
        { "{\"heat\":\"hot\"}", "/heat",
          "heat is \"hot\"; it must be a number above 50 and below 100, or \"boiling\"" },
        { "{\"heat\":\"60\"}", "/heat",
          "heat is \"60\", a string where a number is needed; it must be a number above 50 and below 100, or "
          "\"boiling\"" },
        { "{\"cups\":9}", "/cups", "cups is 9; it must be a whole number from 1 to 8" },
        { "{\"cups\":1.5}", "/cups", "cups is 1.5; it must be a whole number from 1 to 8" },
        { "{\"leaf\":\"red\"}", "/leaf", "leaf is \"red\"; it must be \"none\", \"green\" or \"black\"" },
        { "{\"iced\":1}", "/iced", "iced is 1; it must be true or false" },
        { "{\"table\":{\"milk\":\"yes\"}}", "/table/milk", "table.milk is \"yes\"; it must be true or false" },
        { "{\"table\":1}", "/table", "table is 1; it must be an object with fields" },
        { "{\"table\":{\"with\":[\"cake\",\"tea\"]}}", "/table/with",
          "table.with is \"tea\"; it must be \"bread\", \"cake\" or \"fruit\"" },
        { "{\"table\":{\"with\":[\"cake\",\"cake\"]}}", "/table/with", "table.with has cake twice" },
        { "{\"table\":{\"with\":[]}}", "/table/with", "table.with has no words; it must have at least one" },
        { "{\"table\":{\"with\":\"cake\"}}", "/table/with", "table.with is \"cake\"; it must be an array of words" },
        { "{\"times\":[]}", "/times", "times has 0 numbers; it must have 1 to 4" },
        { "{\"times\":5}", "/times", "times is 5; it must be an array of numbers" },
        { "{\"times\":[1,25]}", "/times/1", "times is 25; it must be 0 to 24 h" },
        { "{\"place\":[1,2]}", "/place", "place is an array; it must be an array of 3 numbers" },
        { "{\"place\":[1,2,\"x\"]}", "/place/2",
          "place is \"x\", a string where a number is needed; it must be -9 to 9" },
        { "{\"name\":\"12345678\"}", "/name", "name is \"12345678\"; it must be a string of at most 7 bytes" },
        { "{\"cups\":1,\"cups\":2}", "/cups", "cups is given twice" },
        { "{\"host\":1,\"host\":2}", "/host", "host is given twice" },
        { "{\"table\":{},\"table\":{}}", "/table", "table is given twice" },
        { "{\"table\":{\"milk\":true,\"milk\":true}}", "/table/milk", "table.milk is given twice" },
        { "{\"cup\":1}", "/cup", "there is no field cup here; did you mean cups?" },
        { "{\"tabel\":1}", "/tabel", "there is no field tabel here; did you mean table?" },
        { "{\"guest\":1}", "/guest", "there is no field guest here; did you mean guests?" },
        { "{\"milk\":true}", "/milk", "there is no field milk here; did you mean table.milk?" },
        { "{\"xyzzy\":1}", "/xyzzy",
          "there is no field xyzzy here; the fields are table, minutes, sugar_g, heat, cups, leaf, pot, iced, times, "
          "place, "
          "name, host, guests" },
        { "{\"table\":{\"a/b\":1}}", "/table/a~1b", "there is no field table.a/b here; the fields are milk, with" },
        { "{\"table.milk\":true}", "/table.milk",
          "there is no field table.milk here; the fields are table, minutes, sugar_g, heat, cups, leaf, pot, iced, "
          "times, "
          "place, name, host, guests" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        struct tea tea;
        struct kd_error error = { 0 };
        assert_int_equal(read_kind(&tea, refused[i].text, 0, NULL, &error), KD_EINVAL);
        assert_string_equal(error.message, refused[i].message);
        assert_string_equal(error.pointer, refused[i].pointer);
        free(tea.times.at);
    }
}

static void a_kind_of_document_has_its_own_rows(void **state)
{
    struct tea tea;
    struct kd_error error = { 0 };
    (void)state;
    assert_int_equal(read_kind(&tea, "{\"pot\":\"iron\",\"table\":{\"milk\":true}}", TEA_POT, NULL, &error), KD_OK);
    assert_int_equal(tea.pot, 0);
    assert_int_equal(read_kind(&tea, "{\"pot\":\"iron\"}", TEA_BAG, NULL, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/pot");
    assert_int_equal(read_kind(&tea, "{\"table\":{\"milk\":true}}", TEA_BAG, NULL, &error), KD_EINVAL);
    assert_string_equal(error.message, "there is no field table.milk here; the fields are with");
}

static void typed_text_sets_one_field(void **state)
{
    struct tea tea;
    struct kd_error error = { 0 };
    uint64_t given = 0;
    (void)state;
    kd_document_defaults(&tea_document, &tea);
    static const char *const set[][2] = { { "minutes", "1.5" },     { "heat", "boiling" },
                                          { "table.milk", "true" }, { "with", "bread,fruit" },
                                          { "times", "0,12,24" },   { "place", "1,2,3" },
                                          { "name", "5" } };
    for (size_t i = 0; i + 1 < sizeof set / sizeof *set; i++)
        assert_int_equal(kd_document_set(&tea_document, &tea, set[i][0], set[i][1], &given, &error), KD_OK);
    assert_true(tea.minutes == 1.5 && isinf(tea.heat) && tea.milk && tea.with == 5 && tea.times.n == 3 &&
                tea.place[2] == 3 && given == (1 | 4 | 0x80 | 0x100 | 0x200 | 0x400));
    static const char *const refused[][4] = {
        { "milk", "1", "/table/milk", "milk is 1; it must be true or false" },
        { "with", "", "/table/with", "with has no words; it must have at least one" },
        { "times", "1,x", "/times/1", "times is \"x\", a string where a number is needed; it must be 0 to 24 h" },
        { "times", "1,2,3,4,5", "/times", "times has 5 numbers; it must have 1 to 4" },
        { "place", "1,2", "/place", "place is \"1,2\"; it must be an array of 3 numbers" },
        { "tables.milk", "true", "/tables.milk",
          "there is no parameter tables.milk; the parameters are minutes, sugar_g, heat, cups, leaf, pot, iced, milk, "
          "with, "
          "times, place, name" },
        { "leav", "x", "/leav", "there is no parameter leav; did you mean leaf?" },
    };
    assert_int_equal(kd_document_set(&tea_document, &tea, "name",
                                     "\xff"
                                     "e",
                                     NULL, &error),
                     KD_EINVAL); /* no UTF-8 */
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        assert_int_equal(kd_document_set(&tea_document, &tea, refused[i][0], refused[i][1], NULL, &error), KD_EINVAL);
        assert_string_equal(error.message, refused[i][3]);
        assert_string_equal(error.pointer, refused[i][2]);
    }
    free(tea.times.at);
}

static void the_schema_says_the_same(void **state)
{
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    struct kd_document document = tea_document;
    (void)state;
    kd_json_object(&json, NULL);
    kd_document_required(&json, &document);
    kd_json_object(&json, "properties");
    kd_document_properties(&json, &document);
    kd_json_end(&json);
    kd_document_describe(&json, "told", &(const struct kd_document) { .rows = tea_rows + 3, .n = 2 });
    kd_json_end(&json);
    assert_int_equal(kd_json_finish(&json), KD_OK);
    assert_string_equal(
        (const char *)out.data,
        "{\"required\":[\"cups\",\"table\"],\"properties\":{"
        "\"minutes\":{\"type\":\"number\",\"minimum\":0,\"exclusiveMaximum\":10,"
        "\"description\":\"how long it draws [min]\"},"
        "\"sugar_g\":{\"type\":\"number\",\"minimum\":0,\"maximum\":50,\"not\":{\"exclusiveMinimum\":0,"
        "\"exclusiveMaximum\":0.5},\"description\":\"sugar [g]\"},"
        "\"heat\":{\"anyOf\":[{\"type\":\"string\",\"const\":\"boiling\",\"enum\":[\"boiling\"]},{\"type\":\"number\","
        "\"exclusiveMinimum\":"
        "50,"
        "\"exclusiveMaximum\":100}],\"description\":\"temperature\"},"
        "\"cups\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":8,\"description\":\"number of cups\"},"
        "\"leaf\":{\"type\":\"string\",\"enum\":[\"none\",\"green\",\"black\"],\"description\":\"kind of leaf\"},"
        "\"pot\":{\"type\":\"string\",\"enum\":[\"auto\",\"iron\",\"clay\"],\"description\":\"kind of pot\"},"
        "\"iced\":{\"type\":\"boolean\",\"description\":\"with ice or not\"},"
        "\"table\":{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"milk\"],\"properties\":{"
        "\"milk\":{\"type\":\"boolean\",\"description\":\"with milk or not\"},"
        "\"with\":{\"type\":\"array\",\"minItems\":1,\"uniqueItems\":true,\"items\":{\"type\":\"string\",\"enum\":["
        "\"bread\",\"cake\",\"fruit\"]},\"description\":\"what is eaten\"}}},"
        "\"times\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":4,\"items\":{\"type\":\"number\",\"minimum\":0,"
        "\"maximum\":24},\"description\":\"times of the day [h]\"},"
        "\"place\":{\"type\":\"array\",\"minItems\":3,\"maxItems\":3,\"items\":{\"type\":\"number\",\"minimum\":-9,"
        "\"maximum\":9},\"description\":\"x, y, z\"},"
        "\"name\":{\"type\":\"string\",\"maxLength\":7,\"description\":\"whose it is\"}},"
        "\"told\":[{\"name\":\"cups\",\"type\":\"integer\",\"default\":1,\"least\":1,\"most\":8,"
        "\"help\":\"number of cups\"},{\"name\":\"leaf\",\"type\":\"string\",\"default\":\"green\",\"words\":["
        "\"none\",\"green\",\"black\"],\"fixed\":true,\"help\":\"kind of leaf\"}]}");
    kd_buffer_finish(&out);
}

static void ranges_are_read_and_refused(void **state)
{
    static const struct kd_row whole = { .name = "cups",
                                         .kind = KD_KIND_INT,
                                         .least = -2,
                                         .most = 8,
                                         .typed = "1:3:3" },
                               heat = { .name = "heat",
                                        .least = 50,
                                        .most = 100,
                                        .open = KD_OPEN,
                                        .words = "boiling",
                                        .stands = INFINITY,
                                        .typed = "boiling" },
                               leaf = { .name = "leaf", .kind = KD_KIND_WORD, .words = "none|green", .typed = "green" };
    static const struct {
        const struct kd_row *row;
        const char *text, *message; /* message: expected error message; NULL if the text is accepted */
        struct kd_range range;
    } cases[] = {
        { &whole, "-2", NULL, { -2, -2, 1 } },
        { &whole, "-2:8:6", NULL, { -2, 8, 6 } },
        { &heat, "boiling", NULL, { INFINITY, INFINITY, 1 } },
        { &heat, "99:51:100000", NULL, { 99, 51, 100000 } },
        { &leaf, "green", NULL, { 1, 1, 1 } },
        { &whole,
          "1:2:3",
          "cups is \"1:2:3\", a range with the value 1.5; it must be a whole number from -2 to 8, "
          "or a range first:last:count of 2 to 100000 such values",
          { 0 } },
        { &whole,
          "1:9:9",
          "cups is \"1:9:9\", a range with the value 9; it must be a whole number from -2 to 8, "
          "or a range first:last:count of 2 to 100000 such values",
          { 0 } },
        { &whole, "0.5", "", { 0 } },
        { &heat,
          "50:60:3",
          "heat is \"50:60:3\", a range with the value 50; it must be a number above 50 and below 100, or \"boiling\", "
          "or a range "
          "first:last:count of 2 to 100000 such values",
          { 0 } },
        { &heat,
          "51:60:1",
          "heat is \"51:60:1\", a range whose count is 1; it must be a number above 50 and below 100, or \"boiling\", "
          "or a "
          "range first:last:count of 2 to 100000 such values",
          { 0 } },
        { &heat,
          "51:60",
          "heat is \"51:60\"; it must be a number above 50 and below 100, or \"boiling\", or a range "
          "first:last:count of 2 to 100000 such values",
          { 0 } },
        { &heat, "51:60:2.5", "", { 0 } },
        { &heat, "51:60:100001", "", { 0 } },
        { &heat, "51:60:2:2", "", { 0 } },
        { &heat, "boiling:60:2", "", { 0 } },
        { &leaf, "black", "leaf is \"black\"; it must be \"none\" or \"green\"", { 0 } },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_range range = { 7, 7, 7 };
        struct kd_error error = { 0 };
        const bool good = !kd_row_range(cases[i].row, cases[i].text, "/x", &range, &error);
        assert_int_equal(good, !cases[i].message);
        if (good) {
            assert_memory_equal(&range, &cases[i].range, sizeof range);
            continue;
        }
        assert_true(range.count == 7 && error.status == KD_EINVAL);
        assert_string_equal(error.pointer, "/x");
        if (*cases[i].message)
            assert_string_equal(error.message, cases[i].message);
    }
    const struct kd_range down = { 1, 0.7, 4 };
    assert_true(kd_range_at(&down, 0) == 1 && kd_range_at(&down, 3) == 0.7 &&
                fabs(kd_range_at(&down, 1) - 0.9) < 1e-15);
}

static enum kd_status read_tray(struct tray *tray, const char *text, bool patch, struct kd_error *error)
{
    cJSON *tree = NULL;
    assert_int_equal(kd_tree_parse(text, strlen(text), 4096, 64, &tree, error), KD_OK);
    const enum kd_status status =
        (patch ? kd_document_patch : kd_document_read)(&tray_document, tray, tree, "", NULL, error);
    kd_tree_free(tree);
    return status;
}

static void assert_tray(const struct tray *tray, const char *text)
{
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    kd_json_object(&json, NULL);
    kd_document_write(&json, &tray_document, tray);
    kd_json_end(&json);
    assert_int_equal(kd_json_finish(&json), KD_OK);
    assert_string_equal((const char *)out.data, text);
    kd_buffer_finish(&out);
}

#define TRAY(weight, on, fruit, biscuits) \
    "{\"weight_g\":" weight ",\"on\":{" on "},\"fruit\":[" fruit "],\"biscuits\":[" biscuits "]}"
#define PLAIN "\"plates\":\"auto\",\"label\":null,\"cloth\":{\"red\":true}"
#define BISCUIT(size, kind) "{\"size_cm\":" size ",\"kind\":\"" kind "\"}"

static void lists_and_objects_in_objects(void **state)
{
    static const struct {
        const char *text;
        bool patch;
        const char *after; /* indices of steps that are applied before this one */
    } steps[] = {
        { "{}", false, TRAY("200", PLAIN, "\"apple\"", "") },
        { "{\"biscuits\":[{\"size_cm\":4},{\"kind\":\"rye\"}]}", false,
          TRAY("200", PLAIN, "\"apple\"", BISCUIT("4", "oat") "," BISCUIT("5", "rye")) },
        { "{\"biscuits\":{\"2\":{\"size_cm\":9},\"0\":{\"kind\":\"rye\"}}}", false,
          TRAY("200", PLAIN, "\"apple\"", BISCUIT("4", "rye") "," BISCUIT("5", "rye") "," BISCUIT("9", "oat")) },
        { "{\"biscuits\":{\"1\":null},\"weight_g\":-0.0}", true,
          TRAY("0", PLAIN, "\"apple\"", BISCUIT("4", "rye") "," BISCUIT("5", "oat") "," BISCUIT("9", "oat")) },
        { "{\"on\":{\"cloth\":{\"red\":false},\"label\":\"cat.png\",\"plates\":2},\"biscuits\":[{}]}", true,
          TRAY("0", "\"plates\":2,\"label\":\"cat.png\",\"cloth\":{\"red\":false}", "\"apple\"", BISCUIT("5", "oat")) },
        { "{\"on\":null,\"biscuits\":null,\"fruit\":[\"plum_2\",\"plum\"]}", true,
          TRAY("0", PLAIN, "\"plum_2\",\"plum\"", "") },
        { "{\"biscuit2\":{\"size_cm\":1}}", false,
          TRAY("0", PLAIN, "\"plum_2\",\"plum\"", BISCUIT("5", "oat") "," BISCUIT("1", "oat")) },
        { "{\"biscuits\":[],\"weight_g\":null}", true, TRAY("200", PLAIN, "\"plum_2\",\"plum\"", "") },
        { "{\"biscuit2\":{}}", false, TRAY("200", PLAIN, "\"plum_2\",\"plum\"", "") },
    };
    struct tray tray;
    struct kd_error error = { 0 };
    (void)state;
    kd_document_defaults(&tray_document, &tray);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        assert_int_equal(read_tray(&tray, steps[i].text, steps[i].patch, &error), KD_OK);
        assert_tray(&tray, steps[i].after);
        assert_false(signbit(tray.weight_g)); /* -0 becomes 0, so that equal documents have equal bytes */
    }
}

static void lists_are_refused_where_they_are_wrong(void **state)
{
    static const struct {
        const char *text, *pointer, *message;
    } refused[] = {
        { "{\"biscuits\":[{},{\"size_cm\":11}]}", "/biscuits/1/size_cm",
          "biscuits.1.size_cm is 11; it must be 0 to 10" },
        { "{\"biscuits\":[{},{},{},{}]}", "/biscuits/3", "biscuits has 4 elements; it must have at most 3" },
        { "{\"biscuits\":{\"1\":{}}}", "/biscuits/1",
          "there is no biscuits.1: the list has 0 elements, and the next free index is 0" },
        { "{\"biscuits\":{\"01\":{}}}", "/biscuits/01",
          "there is no biscuits.01: biscuits is a list with elements from biscuits.0 to biscuits.2" },
        { "{\"biscuits\":{\"0\":{},\"0\":{}}}", "/biscuits/0", "biscuits.0 is given twice" },
        { "{\"biscuits\":[{\"kind\":\"rye\",\"size_cm\":1,\"kind\":\"oat\"}]}", "/biscuits/0/kind",
          "biscuits.0.kind is given twice" },
        { "{\"biscuits\":[{\"siz_cm\":1}]}", "/biscuits/0/siz_cm",
          "there is no field biscuits.0.siz_cm here; did you mean biscuits.0.size_cm?" },
        { "{\"biscuits\":7}", "/biscuits", "biscuits is 7; it must be an array of up to 3 objects with fields" },
        { "{\"biscuits\":[],\"biscuit2\":{}}", "/biscuit2",
          "biscuit2 is an old name of biscuits.1, and cannot be used with biscuits" },
        { "{\"biscuit2\":{},\"biscuits\":[]}", "/biscuit2",
          "biscuit2 is an old name of biscuits.1, and cannot be used with biscuits" },
        { "{\"on\":{\"cloth\":1}}", "/on/cloth", "on.cloth is 1; it must be an object with fields" },
        { "{\"on\":{\"cloth\":{\"red\":1}}}", "/on/cloth/red", "on.cloth.red is 1; it must be true or false" },
        { "{\"on.cloth\":{}}", "/on.cloth",
          "there is no field on.cloth here; the fields are on, biscuits, weight_g, fruit" },
        { "{\"on\":{\"label\":\"a/b\"}}", "/on/label",
          "on.label is \"a/b\"; it must be null, the SHA-256 of an asset as 64 hexadecimal digits, or a name: a "
          "letter, "
          "then letters, digits, . _ and -" },
        { "{\"on\":{\"plates\":\"some\"}}", "/on/plates",
          "on.plates is \"some\"; it must be a whole number from 1 to 9, or \"auto\"" },
        { "{\"on\":{\"plates\":0}}", "/on/plates",
          "on.plates is 0; it must be a whole number from 1 to 9, or \"auto\"" },
        { "{\"fruit\":[\"plum_1\",\"plum_1\"]}", "/fruit",
          "fruit holds \"plum_1\"; it must be an array: 1 to 2 of apple and plum[_N], each once, N a number" },
        { "{\"fruit\":[]}", "/fruit",
          "fruit is an empty array; it must be an array: 1 to 2 of apple and plum[_N], each once, N a number" },
        { "{\"fruit\":\"apple\"}", "/fruit",
          "fruit is \"apple\"; it must be an array: 1 to 2 of apple and plum[_N], each once, N a number" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        struct tray tray;
        struct kd_error error = { 0 };
        kd_document_defaults(&tray_document, &tray);
        assert_int_equal(read_tray(&tray, refused[i].text, false, &error), KD_EINVAL);
        assert_string_equal(error.message, refused[i].message);
        assert_string_equal(error.pointer, refused[i].pointer);
    }
    /* Without a patch, null is not a valid value. An array within a patch is read as it is without a patch. */
    static const char *const nulls[] = { "{\"on\":null}", "{\"weight_g\":null}", "{\"biscuits\":null}" };
    for (size_t i = 0; i < sizeof nulls / sizeof *nulls; i++) {
        struct tray tray;
        struct kd_error error = { 0 };
        kd_document_defaults(&tray_document, &tray);
        assert_int_equal(read_tray(&tray, nulls[i], false, &error), KD_EINVAL);
        assert_int_equal(read_tray(&tray, nulls[i], true, &error), KD_OK);
        assert_int_equal(read_tray(&tray, "{\"biscuits\":[null]}", true, &error), KD_EINVAL);
    }
}

static void typed_paths_lead_to_one_field(void **state)
{
    static const struct {
        const char *path, *text, *pointer, *message; /* message: expected error message; NULL if the text is accepted */
    } steps[] = {
        { "biscuits.0.size_cm", "3", NULL, NULL },
        { "on.cloth.red", "false", NULL, NULL },
        { "on.plates", "auto", NULL, NULL },
        { "fruit", "plum_3,apple", NULL, NULL },
        { "biscuit2.kind", "rye", NULL, NULL },
        { "biscuit2.size_cm", "99", "/biscuits/1/size_cm", "biscuits.1.size_cm is 99; it must be 0 to 10" },
        { "biscuits.2.size_cm", "99", "/biscuits/2/size_cm", "biscuits.2.size_cm is 99; it must be 0 to 10" },
        { "red", "true", "/red", "there is no field red; did you mean on.cloth.red?" },
        { "on", "1", "/on", "on is a section; name one of its fields, as in on.plates" },
        { "on.cloth", "1", "/on/cloth", "on.cloth is a section; name one of its fields, as in on.cloth.red" },
        { "biscuits", "1", "/biscuits",
          "biscuits is a list; name a field of one of its elements, as in biscuits.0.size_cm" },
        { "biscuits.1", "1", "/biscuits/1",
          "biscuits.1 is an element; name one of its fields, as in biscuits.1.size_cm" },
        { "biscuits.3.kind", "rye", "/biscuits/3",
          "there is no biscuits.3: biscuits is a list with elements from biscuits.0 to biscuits.2" },
    };
    struct tray tray;
    (void)state;
    kd_document_defaults(&tray_document, &tray);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        struct kd_error error = { 0 };
        assert_int_equal(kd_document_set(&tray_document, &tray, steps[i].path, steps[i].text, NULL, &error),
                         steps[i].message ? KD_EINVAL : KD_OK);
        if (steps[i].message) {
            assert_string_equal(error.message, steps[i].message);
            assert_string_equal(error.pointer, steps[i].pointer);
        }
    }
    assert_tray(&tray, TRAY("200", "\"plates\":\"auto\",\"label\":null,\"cloth\":{\"red\":false}",
                            "\"plum_3\",\"apple\"", BISCUIT("3", "oat") "," BISCUIT("5", "rye")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_is_read_and_written),       cmocka_unit_test(refusals_say_what_it_must_be),
        cmocka_unit_test(a_kind_of_document_has_its_own_rows), cmocka_unit_test(typed_text_sets_one_field),
        cmocka_unit_test(lists_and_objects_in_objects),        cmocka_unit_test(lists_are_refused_where_they_are_wrong),
        cmocka_unit_test(typed_paths_lead_to_one_field),       cmocka_unit_test(the_schema_says_the_same),
        cmocka_unit_test(ranges_are_read_and_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
