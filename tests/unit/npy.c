/* Tests of NPY headers: those of NumPy, those that kerrd writes, and damaged ones, which must be refused. */
#include "image/npy.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Builds a file: the version, the header text padded to `length` (0: unpadded), then zeros. */
struct file {
    uint8_t *data;
    size_t size;
};

static struct file file_of(int version, const char *text, size_t zeros)
{
    size_t n = strlen(text), start = version == 1 ? 10 : 12;
    struct file file = { .size = start + n + zeros };
    file.data = calloc(1, file.size); /* a copy of exactly this size, so that a sanitizer detects an overrun */
    assert_non_null(file.data);
    memcpy(file.data, "\x93NUMPY", 6);
    file.data[6] = (uint8_t)version;
    file.data[8] = (uint8_t)n;
    file.data[9] = (uint8_t)(n >> 8);
    if (version > 1)
        file.data[10] = (uint8_t)(n >> 16);
    memcpy(file.data + start, text, n);
    return file;
}

static enum kd_status read_text(int version, const char *text, size_t zeros, struct kd_npy *out, struct kd_error *error)
{
    struct file file = file_of(version, text, zeros);
    enum kd_status status = kd_npy_read(file.data, file.size, out, error);
    free(file.data);
    return status;
}

static void plain_arrays(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        size_t bytes, n_dimensions;
        uint64_t shape[4];
    } table[] = {
        { "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }            \n", 48, 2, { 3, 2 } },
        { "{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }\n", 32, 1, { 4 } },
        { "{'descr': '<f8', 'fortran_order': False, 'shape': (), }\n", 8, 0, { 0 } },
        { "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 2), }\n", 0, 2, { 0, 2 } },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }\n", 24, 2, { 3, 2 } },
        { "{\"shape\":(2,2),\"fortran_order\":False,\"descr\":\"|u1\"}", 4, 2, { 2, 2 } },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        for (int version = 1; version < 3; version++) {
            struct kd_npy array;
            struct kd_error error = { 0 };
            if (read_text(version, table[i].text, table[i].bytes, &array, &error))
                fail_msg("%s: %s", table[i].text, error.message);
            assert_int_equal(array.n_fields, 1);
            assert_string_equal(array.fields[0].name, "");
            assert_int_equal(array.n_dimensions, table[i].n_dimensions);
            for (size_t k = 0; k < array.n_dimensions; k++)
                assert_int_equal(array.shape[k], table[i].shape[k]);
            assert_int_equal(array.items * array.item_size, table[i].bytes);
            assert_int_equal(array.header_size, strlen(table[i].text) + (version == 1 ? 10 : 12));
        }
}

static void records(void **state)
{
    (void)state;
    struct kd_npy array;
    struct kd_error error = { 0 };
    const char *text =
        "{'descr': [('fate', '|u1'), ('r', '<f8', (3,)), ('x_1', '<f8', )], 'fortran_order': False, 'shape': (2,), }";
    if (read_text(1, text, 2 * 33, &array, &error))
        fail_msg("%s", error.message);
    assert_int_equal(array.n_fields, 3);
    assert_string_equal(array.fields[1].name, "r");
    assert_int_equal(array.fields[1].type, KD_NPY_F8);
    assert_int_equal(array.fields[1].count, 3);
    assert_int_equal(array.fields[2].count, 0);
    assert_int_equal(array.item_size, 33);
}

static void refused(void **state)
{
    (void)state;
#define ARRAY(descr, order, shape) "{'descr': " descr ", 'fortran_order': " order ", 'shape': " shape "}"
    static const struct {
        const char *text, *words;
        size_t bytes;
    } table[] = {
        { "", "dictionary", 0 },
        { "{", "dictionary", 0 },
        { "{}", "lacks", 0 },
        { "[]", "dictionary", 0 },
        { ARRAY("'<f8'", "True", "(2, 2)"), "Fortran", 32 },
        { ARRAY("'<f8'", "true", "(2, 2)"), "neither", 32 },
        { ARRAY("'>f8'", "False", "(2, 2)"), "element type is >f8", 32 },
        { ARRAY("'<i4'", "False", "(2, 2)"), "element type is <i4; it must be <f8, <f4 or |u1", 16 },
        { ARRAY("'|O'", "False", "(2, 2)"), "element type is |O", 32 },
        { ARRAY("'\x01\xff'", "False", "(2, 2)"), "element type is ??", 32 },
        { ARRAY("'0123456789012345678'", "False", "(2, 2)"), "plain string", 32 },
        { ARRAY("<f8", "False", "(2, 2)"), "plain string", 32 },
        { ARRAY("'<f8'", "False", "(2)"), "tuple", 16 },
        { ARRAY("'<f8'", "False", "2"), "tuple", 16 },
        { ARRAY("'<f8'", "False", "(2 2)"), "tuple", 32 },
        { ARRAY("'<f8'", "False", "(,)"), "tuple", 32 },
        { ARRAY("'<f8'", "False", "(-1,)"), "tuple", 8 },
        { ARRAY("'<f8'", "False", "(2.0,)"), "tuple", 16 },
        { ARRAY("'<f8'", "False", "(02,)"), "tuple", 16 },
        { ARRAY("'<f8'", "False", "(1, 1, 1, 1, 1)"), "dimensions", 8 },
        { ARRAY("'<f8'", "False", "(18446744073709551616,)"), "2^64", 8 },
        { ARRAY("'<f8'", "False", "(18446744073709551615,)"), "more elements than memory can have", 8 },
        { ARRAY("'<f8'", "False", "(2305843009213693952,)"), "more elements than memory can have", 0 },
        { ARRAY("'<f8'", "False", "(4294967296, 4294967296)"), "more elements than memory can have", 0 },
        { ARRAY("'<f8'", "False", "(4294967296, 4294967296, 0)"), "more elements than memory can have", 0 },
        { ARRAY("'<f8'", "False", "(2, 2)"), "bytes follow", 31 },
        { ARRAY("'<f8'", "False", "(2, 2)"), "bytes follow", 33 },
        { ARRAY("'<f8'", "False", "(2, 2)") "x", "text follows", 32 },
        { ARRAY("'<f8'", "False", "(2, 2), 'more': 1"), "and no other", 32 },
        { ARRAY("'<f8'", "False", "(2, 2), 'shape': (2, 2)"), "each once", 32 },
        { ARRAY("[]", "False", "(2, 2)"), "no fields", 32 },
        { ARRAY("[('a', '<f8'), ('a', '<f8')]", "False", "(2,)"), "name", 32 },
        { ARRAY("[('', '<f8')]", "False", "(2,)"), "name", 16 },
        { ARRAY("[('a b', '<f8')]", "False", "(2,)"), "name", 16 },
        { ARRAY("[('a', '<f8', (2, 2))]", "False", "(2,)"), "dimensions", 64 },
        { ARRAY("[('a', '<f8', (0,))]", "False", "(2,)"), "more than one dimension", 0 },
        { ARRAY("[('a', '<f8', (4294967295,))]", "False", "(2,)"), "more than one dimension", 0 },
        { ARRAY("[('a', [('b', '<f8')])]", "False", "(2,)"), "plain string", 16 },
        { ARRAY("[('a', '<f8'", "False", "(2,)"), "", 16 },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct kd_npy array;
        struct kd_error error = { 0 };
        if (read_text(1, table[i].text, table[i].bytes, &array, &error) != KD_EINVAL)
            fail_msg("%s was taken", table[i].text);
        if (!strstr(error.message, table[i].words))
            fail_msg("%s: %s", table[i].text, error.message);
    }
}

/* A file that is cut anywhere, or has any byte of its start changed, gives a result or an error, and no crash. */
static void damaged(void **state)
{
    (void)state;
    struct file file = file_of(1, ARRAY("[('a', '<f8', (2,)), ('b', '|u1')]", "False", "(2,)"), 34);
    struct kd_npy array;
    assert_int_equal(kd_npy_read(file.data, file.size, &array, NULL), KD_OK);
    for (size_t n = 0; n < file.size; n++) {
        uint8_t *part = malloc(n + !n);
        assert_non_null(part);
        memcpy(part, file.data, n);
        assert_int_equal(kd_npy_read(part, n, &array, NULL), KD_EINVAL);
        free(part);
    }
    for (size_t i = 0; i < file.size - 34; i++)
        for (int change = 1; change < 256; change++) {
            file.data[i] ^= (uint8_t)change;
            kd_npy_read(file.data, file.size, &array, NULL);
            file.data[i] ^= (uint8_t)change;
        }
    free(file.data);
    file = file_of(2, "{}", 20000);
    file.data[9] = 0x40; /* a header of 16386 bytes */
    struct kd_error error = { 0 };
    assert_int_equal(kd_npy_read(file.data, file.size, &array, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "10000"));
    file.data[6] = 3;
    assert_int_equal(kd_npy_read(file.data, file.size, &array, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "version"));
    free(file.data);
}

/* The first header equals numpy.save's byte for byte. */
static void written(void **state)
{
    (void)state;
    struct kd_buffer out = { 0 };
    const struct kd_npy plain = {
        .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1, .shape = { 3, 2 }, .n_dimensions = 2
    };
    assert_int_equal(kd_npy_write_header(&plain, &out), KD_OK);
    assert_int_equal(out.size, 128);
    const char *want = "\x93NUMPY\x01";
    assert_memory_equal(out.data, want, 7);
    assert_memory_equal(out.data + 7, "\0v\0{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }  ", 64);
    assert_int_equal(out.data[127], '\n');
    kd_buffer_finish(&out);

    const struct kd_npy structured = {
        .fields = { { "fate", KD_NPY_U1, 0 }, { "r", KD_NPY_F8, 16 }, { "error", KD_NPY_F8, 0 } },
        .n_fields = 3,
        .shape = { 1 },
        .n_dimensions = 1,
    };
    struct kd_npy back;
    uint8_t zeros[137] = { 0 };
    assert_int_equal(kd_npy_write_header(&structured, &out), KD_OK);
    assert_int_equal(out.size % 64, 0);
    assert_int_equal(kd_buffer_append(&out, zeros, kd_npy_item_size(&structured)), KD_OK);
    assert_int_equal(kd_npy_read(out.data, out.size, &back, NULL), KD_OK);
    assert_int_equal(back.n_fields, 3);
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(back.fields[i].name, structured.fields[i].name);
        assert_int_equal(back.fields[i].type, structured.fields[i].type);
        assert_int_equal(back.fields[i].count, structured.fields[i].count);
    }
    assert_int_equal(back.item_size, 137);
    kd_buffer_finish(&out);
}

/* Texts as written by numpy.array("...") and numpy.frombuffer. */
static void texts(void **state)
{
    (void)state;
    static const struct {
        const char *type, *shape;
        const void *bytes;
        size_t size;
        const char *wanted;
    } table[] = {
        { "<U3", "()", "a\0\0\0\xe9\0\0\0\0\0\0\0", 12, "a\xc3\xa9" },
        { "<U1", "()", "\x00\xf6\x01\0", 4, "\xf0\x9f\x98\x80" },
        { "<U1", "()", "\xac\x20\0\0", 4, "\xe2\x82\xac" },
        { "|S4", "()", "{}\0\0", 4, "{}" },
        { "|u1", "(3,)", "abc", 3, "abc" },
        { "<U1", "()", "\0\xd8\0\0", 4, NULL },
        { "<U1", "()", "\0\0\x11\0", 4, NULL },
        { "<f8", "(1,)", "12345678", 8, NULL },
        { "<U0", "()", "", 0, NULL },
        { "<U2", "(1,)", "a\0\0\0b\0\0\0", 8, NULL },
        { "<U2", "()", "a\0\0\0", 4, NULL },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char header[100];
        struct kd_buffer out = { 0 };
        struct kd_error error = { 0 };
        struct kd_npy array;
        snprintf(header, sizeof header, "{'descr': '%s', 'fortran_order': False, 'shape': %s, }\n", table[i].type,
                 table[i].shape);
        struct file file = file_of(1, header, table[i].size);
        memcpy(file.data + file.size - table[i].size, table[i].bytes, table[i].size);
        enum kd_status status = kd_npy_read_text(file.data, file.size, &out, &error);
        assert_int_equal(status, table[i].wanted ? KD_OK : KD_EINVAL);
        if (table[i].wanted) {
            assert_int_equal(out.size, strlen(table[i].wanted));
            assert_memory_equal(out.data, table[i].wanted, out.size);
        } else
            assert_true(*error.message);
        if (table[i].type[1] == 'U')
            /* the file has numbers only */
            assert_int_equal(kd_npy_read(file.data, file.size, &array, &error), KD_EINVAL);
        kd_buffer_finish(&out);
        free(file.data);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_arrays), cmocka_unit_test(records), cmocka_unit_test(refused),
        cmocka_unit_test(damaged),      cmocka_unit_test(written), cmocka_unit_test(texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
