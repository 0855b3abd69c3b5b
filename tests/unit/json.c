/* Tests of JSON documents: their text, and that no document is written in part. */
#include "base/json.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The linker redirects the module's own calls here (--wrap). */
static int left = -1; /* number of allocations before one fails; -1: none fails */
void *__real_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size);

void *__wrap_realloc(void *old, size_t size)
{
    if (!left)
        return NULL;
    left -= left > 0;
    return __real_realloc(old, size);
}

static enum kd_status write_all(struct kd_json *json)
{
    kd_json_object(json, NULL);
    kd_json_number(json, "number", 0.1);
    kd_json_number(json, "whole", 4294967296.);
    kd_json_number(json, "zero", -0.);
    kd_json_number(json, "none", NAN);
    kd_json_string(json, "text", "a\"\\\n\x01\xc3\xa9");
    kd_json_array(json, "empty");
    kd_json_end(json);
    kd_json_array(json, "list");
    kd_json_bool(json, NULL, true);
    kd_json_null(json, NULL);
    kd_json_object(json, NULL);
    kd_json_end(json);
    kd_json_raw(json, NULL, "{\"raw\":1}", 9);
    kd_json_end(json);
    for (int i = 0; i < 200; i++)
        kd_json_number(json, "again", i);
    kd_json_end(json);
    return kd_json_finish(json);
}

static const char head[] = "{\"number\":0.1,\"whole\":4294967296,\"zero\":0,\"none\":null,\"text\":"
                           "\"a\\\"\\\\\\u000a\\u0001\xc3\xa9\",\"empty\":[],"
                           "\"list\":[true,null,{},{\"raw\":1}],\"again\":0,";

static void test_document(void **state)
{
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin(&out);
    (void)state;
    assert_int_equal(write_all(&json), KD_OK);
    assert_memory_equal(out.data, head, sizeof head - 1);
    assert_string_equal(out.data + out.size - 13, ",\"again\":199}");
    kd_buffer_finish(&out);
}

static void test_lines(void **state)
{
    struct kd_buffer out = { 0 };
    struct kd_json json = kd_json_begin_lines(&out);
    (void)state;
    kd_json_object(&json, NULL);
    kd_json_array(&json, "list");
    kd_json_number(&json, NULL, 1);
    kd_json_number(&json, NULL, 2);
    kd_json_end(&json);
    kd_json_object(&json, "empty");
    kd_json_end(&json);
    kd_json_end(&json);
    assert_int_equal(kd_json_finish_line(&json), KD_OK);
    assert_string_equal(out.data, "{\n  \"list\": [\n    1,\n    2\n  ],\n  \"empty\": {}\n}\n");
    kd_buffer_finish(&out);
}

/* If any allocation fails, the buffer keeps its contents, and no part of the document is added. */
static void test_no_memory(void **state)
{
    int failures = 0;
    (void)state;
    for (int n = 0;; n++) {
        struct kd_buffer out = { 0 };
        assert_int_equal(kd_buffer_append(&out, "before", 6), KD_OK);
        struct kd_json json = kd_json_begin(&out);
        left = n;
        enum kd_status status = write_all(&json);
        left = -1;
        if (status) {
            failures++;
            assert_int_equal(status, KD_ENOMEM);
            assert_string_equal(out.data, "before");
            assert_int_equal(out.size, 6);
        }
        kd_buffer_finish(&out);
        if (!status)
            break;
    }
    assert_true(failures > 2);
}

static void test_mistakes(void **state)
{
    struct kd_buffer out = { 0 };
    (void)state;
    for (int mistake = 0; mistake < 6; mistake++) {
        struct kd_json json = kd_json_begin(&out);
        if (mistake == 1)
            kd_json_number(&json, "a name outside", 1);
        if (mistake >= 2)
            kd_json_array(&json, NULL);
        if (mistake == 3)
            kd_json_number(&json, "a name in an array", 1);
        if (mistake >= 3)
            kd_json_end(&json);
        if (mistake == 4)
            kd_json_end(&json);
        if (mistake == 5)
            kd_json_number(&json, NULL, 2);
        assert_int_equal(kd_json_finish(&json), KD_EINVAL);
        assert_int_equal(out.size, 0);
    }
    struct kd_json deep = kd_json_begin(&out);
    for (int i = 0; i <= KD_JSON_DEPTH; i++)
        kd_json_array(&deep, NULL);
    for (int i = 0; i <= KD_JSON_DEPTH; i++)
        kd_json_end(&deep);
    assert_int_equal(kd_json_finish(&deep), KD_EINVAL);
    kd_buffer_finish(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_document),
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_no_memory),
        cmocka_unit_test(test_mistakes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
