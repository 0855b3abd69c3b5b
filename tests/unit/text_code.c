/* Tests of texts encoded as characters of a URL: encoding and decoding, and refusal of anything else within bounded
 * memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "image/text_code.h"

#include <string.h>

static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

static void texts_come_back(void **state)
{
    (void)state;
    char text[400];
    for (size_t n = 0; n < sizeof text; n++) {
        struct kd_buffer code = { 0 }, back = { 0 };
        text[n] = (char)('a' + n * n % 23);
        assert_int_equal(kd_text_code_write(text, n, &code, NULL), KD_OK);
        assert_int_equal(strspn((const char *)code.data, letters), code.size);
        assert_int_equal(kd_text_code_read((const char *)code.data, &back, NULL), KD_OK);
        assert_int_equal(back.size, n);
        assert_memory_equal(back.data, text, n);
        kd_buffer_finish(&code);
        kd_buffer_finish(&back);
    }
}

/* Made by Python: base64.urlsafe_b64encode(zlib.compress(text, 9, -15)).rstrip(b"=") */
static void codes_of_others_are_read(void **state)
{
    (void)state;
    struct kd_buffer text = { 0 };
    assert_int_equal(kd_text_code_read("KyhKLU4tsU1PLEpPzCspTQQA", &text, NULL), KD_OK);
    assert_string_equal((const char *)text.data, "preset=gargantua");
    kd_buffer_finish(&text);
}

static void what_is_no_code_is_refused(void **state)
{
    (void)state;
    static char longest[KD_TEXT_CODE_MOST + 2];
    memset(longest, 'A', sizeof longest - 1);
    static const struct {
        const char *code, *says;
        enum kd_status status;
    } wrong[] = {
        { "", "must be one deflated text", KD_EINVAL },
        { "Kyh+", "must be base64url", KD_EINVAL },
        { "Kyh=", "must be base64url", KD_EINVAL },
        { "K", "must be base64url", KD_EINVAL },
        /* the code has bits left over after the last byte */
        { "KyhKLU4tsS3Ozc8vyTACAB", "must be base64url", KD_EINVAL },
        { "KyhKLU4tsU1PLEpPzCsp", "must be one deflated text", KD_EINVAL },       /* the stream is cut off */
        { "KyhKLU4tsU1PLEpPzCspTQQAAA", "must be one deflated text", KD_EINVAL }, /* a byte follows the stream's end */
        { "YwAA", "must be one deflated text", KD_EINVAL },                       /* NUL */
        { longest, "longer than 2048", KD_ETOOBIG },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct kd_buffer text = { 0 };
        struct kd_error error = { 0 };
        const enum kd_status status = kd_text_code_read(wrong[i].code, &text, &error);
        if (status != wrong[i].status || !strstr(error.message, wrong[i].says))
            fail_msg("%.40s: %d, \"%s\"", wrong[i].code, status, error.message);
        assert_null(text.data);
    }
}

static void a_bomb_stays_small(void **state)
{
    (void)state;
    static char zeros[KD_TEXT_CODE_TEXT_MOST + 1];
    struct kd_buffer code = { 0 }, text = { 0 };
    struct kd_error error = { 0 };
    memset(zeros, 'a', sizeof zeros);
    assert_int_equal(kd_text_code_write(zeros, sizeof zeros, &code, &error), KD_ETOOBIG);
    assert_int_equal(kd_text_code_write(zeros, sizeof zeros - 1, &code, &error), KD_OK);
    assert_int_equal(kd_text_code_read((const char *)code.data, &text, &error), KD_OK);
    assert_int_equal(text.size, sizeof zeros - 1);
    kd_buffer_finish(&text);
    kd_buffer_finish(&code);
    /* 100 kB of "a", by Python as above */
    static const char bomb[] = "7cExAQAAAMKgrOtfwhoeQAEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
                               "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAACvBg";
    assert_int_equal(kd_text_code_read(bomb, &text, &error), KD_ETOOBIG);
    assert_non_null(strstr(error.message, "more than 8192 bytes"));
    assert_null(text.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_come_back),
        cmocka_unit_test(codes_of_others_are_read),
        cmocka_unit_test(what_is_no_code_is_refused),
        cmocka_unit_test(a_bomb_stays_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
