/* Files of numbers, read back: texts of any length in FITS cards, the checksum by its definition, members of a ZIP
 * file, attributes of an EXR file; and each of them cut short. tests/cli/files.py has other people's readers judge
 * them. */
#include "image/exr.h"
#include "image/fits.h"
#include "image/zip.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define OK(call) assert_int_equal(call, KD_OK)

static const float pixels[2 * 3 * 2] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };

static struct kd_buffer file_with(const char *text)
{
    struct kd_buffer cards = { 0 }, out = { 0 };
    const struct kd_fits_array array = { 3, 2, 2, pixels };
    OK(kd_fits_text(&cards, "BEFORE", "x", NULL));
    OK(kd_fits_text(&cards, "TEXT", text, "what it is"));
    OK(kd_fits_text(&cards, "BEHIND", "y", NULL));
    assert_int_equal(cards.size % KD_FITS_CARD, 0);
    OK(kd_fits_image(&out, true, &array, &cards));
    kd_buffer_finish(&cards);
    return out;
}

static bool found(const struct kd_buffer *file, const char *key, const char *expected)
{
    struct kd_buffer text = { 0 };
    bool same = !kd_fits_find(file->data, file->size, key, &text) && text.size == strlen(expected) &&
                !memcmp(text.data, expected, text.size);
    kd_buffer_finish(&text);
    return same;
}

/* Quotes at every place of texts that fill one, two and three cards: doubled, and never parted. */
static void texts_of_any_length(void **state)
{
    (void)state;
    char text[220];
    for (size_t n = 8; n < 210; n++)
        for (size_t quote = n > 40 ? n - 40 : 0; quote + 1 < n; quote++) {
            memset(text, 'a', n);
            text[quote] = text[quote + 1] = '\'';
            text[n] = 0;
            struct kd_buffer file = file_with(text);
            if (!found(&file, "TEXT", text) || !found(&file, "BEHIND", "y       "))
                fail_msg("%zu characters, quotes at %zu: not what was written", n, quote);
            kd_buffer_finish(&file);
        }
    struct kd_buffer file = file_with("\xc2\xb5 and a line\nfeed");
    assert_true(found(&file, "TEXT", "?? and a line?feed"));
    kd_buffer_finish(&file);
}

/* By its definition: the ones' complement sum of all words of a unit is all ones, and of the data what DATASUM says. */
static void checksums(void **state)
{
    (void)state;
    for (int more = 0; more < 40; more++) {
        char text[64] = "some text ", sum[32];
        for (int i = 0; i < more; i++)
            text[10 + i] = (char)(33 + (i * 7 + more) % 80);
        struct kd_buffer file = file_with(text), told = { 0 };
        uint64_t all = 0, data = 0;
        assert_int_equal(file.size, 2 * KD_FITS_BLOCK);
        for (size_t i = 0; i < file.size; i += 4) {
            uint32_t word = (uint32_t)file.data[i] << 24 | (uint32_t)file.data[i + 1] << 16 |
                            (uint32_t)file.data[i + 2] << 8 | file.data[i + 3];
            all = (all + word) % 0xffffffffu; /* ones' complement is arithmetic modulo 2^32 - 1 */
            data = i < KD_FITS_BLOCK ? 0 : (data + word) % 0xffffffffu;
        }
        assert_int_equal(all, 0);
        OK(kd_fits_find(file.data, file.size, "DATASUM", &told));
        snprintf(sum, sizeof sum, "%-8llu", (unsigned long long)data);
        assert_true(told.size == strlen(sum) && !memcmp(told.data, sum, told.size));
        kd_buffer_finish(&told);
        kd_buffer_finish(&file);
    }
}

/* Numbers read back the same, and are numbers with a point. */
static void numbers(void **state)
{
    (void)state;
    static const double values[] = {
        0, 1, -1, 0.1, 1.0 / 3, 6.5e9, 1e-300, -1.7976931348623157e308, 123456789012345678.0
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        struct kd_buffer cards = { 0 };
        OK(kd_fits_real(&cards, "NUMBER", values[i],
                        "a comment that is longer than there is room for, so that it is cut at the end"));
        assert_int_equal(cards.size, KD_FITS_CARD);
        char card[KD_FITS_CARD + 1] = "";
        memcpy(card, cards.data, KD_FITS_CARD);
        assert_true(strtod(card + 10, NULL) == values[i] && strpbrk(strtok(card + 10, "/"), ".E"));
        kd_buffer_finish(&cards);
    }
}

static void first_row_is_the_lowest(void **state)
{
    (void)state;
    struct kd_buffer file = file_with("x");
    static const float expected[] = { 6, 8, 10, 0, 2, 4, 7, 9, 11, 1, 3, 5 };
    for (size_t i = 0; i < 12; i++) {
        const uint8_t *at = file.data + KD_FITS_BLOCK + 4 * i;
        uint32_t word = (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
        float value;
        memcpy(&value, &word, 4);
        assert_true(value == expected[i]);
    }
    kd_buffer_finish(&file);
}

static void zip_members(void **state)
{
    (void)state;
    for (int deflated = 0; deflated < 2; deflated++) {
        struct kd_buffer file = { 0 }, again = { 0 }, got = { 0 };
        for (int k = 0; k < 2; k++) {
            struct kd_zip *zip;
            struct kd_buffer *out = k ? &again : &file;
            OK(kd_zip_create(out, deflated, &zip));
            OK(kd_zip_add(zip, "a.npy", pixels, sizeof pixels));
            OK(kd_zip_add(zip, "b", "", 0));
            OK(kd_zip_add(zip, "notes.json", "{}", 2));
            OK(kd_zip_close(zip));
            kd_zip_destroy(zip);
        }
        assert_true(file.size == again.size && !memcmp(file.data, again.data, file.size));
        OK(kd_zip_find(file.data, file.size, "a.npy", 1000, &got));
        assert_true(got.size == sizeof pixels && !memcmp(got.data, pixels, sizeof pixels));
        assert_int_equal(kd_zip_find(file.data, file.size, "a.npy", sizeof pixels - 1, &got), KD_EINVAL);
        assert_int_equal(kd_zip_find(file.data, file.size, "c", 1000, &got), KD_EINVAL);
        assert_int_equal(kd_zip_find(file.data, 60, "notes.json", 1000, &got), KD_EINVAL);
        kd_buffer_finish(&got);
        kd_buffer_finish(&again);
        kd_buffer_finish(&file);
    }
}

static void exr_texts(void **state)
{
    (void)state;
    struct kd_error error;
    const struct kd_exr_channel channels[] = { { "r", pixels, 2 }, { "a", pixels + 1, 2 } };
    const struct kd_exr_text texts[] = { { "kerrd:scene", "{\"version\":1}" }, { "kerrd:hash", "" } };
    const struct kd_exr image = { 3, 2, channels, 2, texts, 2 };
    struct kd_buffer file = { 0 }, got = { 0 };
    OK(kd_buffer_append(&file, "before", 6)); /* it is appended */
    OK(kd_exr_encode(&image, &file, &error));
    OK(kd_exr_find_text(file.data + 6, file.size - 6, "kerrd:scene", &got, &error));
    assert_true(got.size == 13 && !memcmp(got.data, "{\"version\":1}", 13));
    assert_int_equal(kd_exr_find_text(file.data + 6, file.size - 6, "kerrd:none", &got, &error), KD_EINVAL);
    for (size_t size = 0; size < 300; size += 7) { /* in its header */
        uint8_t *cut = malloc(size + 1);           /* of its own size, so that a sanitizer sees a byte too far */
        memcpy(cut, file.data + 6, size);
        assert_int_equal(kd_exr_find_text(cut, size, "kerrd:scene", &got, &error), KD_EINVAL);
        assert_memory_equal(error.message, "EXR: ", 5);
        free(cut);
    }
    kd_buffer_finish(&got);
    kd_buffer_finish(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_of_any_length),     cmocka_unit_test(checksums),   cmocka_unit_test(numbers),
        cmocka_unit_test(first_row_is_the_lowest), cmocka_unit_test(zip_members), cmocka_unit_test(exr_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
