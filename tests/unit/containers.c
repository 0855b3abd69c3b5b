/* Tests that numeric files read back: texts of any length in FITS cards, the checksum by its definition, members of a
 * ZIP file, and attributes of an EXR file. Each file is also truncated. tests/cli/files.py uses third-party readers. */
#include "image/exr.h"
#include "image/fits.h"
#include "image/unzip.h"
#include "image/zip.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

/* Texts that fill one, two and three cards, with a quote at every position. Quotes are doubled, and the two halves are
 * never split. */
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

/* By definition, the ones' complement sum of all words of a FITS unit is all ones, and the sum of the unit's data is
 * DATASUM. */
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

/* Numbers read back the same, and are written with a decimal point. */
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
        struct kd_unzip zip;
        struct kd_error error;
        OK(kd_unzip_open(file.data, file.size, &zip, &error));
        const struct kd_unzip_member *member = kd_unzip_find(&zip, "a.npy");
        OK(kd_unzip_take(&zip, member, 1000, &got, &error));
        assert_true(got.size == sizeof pixels && !memcmp(got.data, pixels, sizeof pixels));
        kd_buffer_finish(&got);
        assert_int_equal(kd_unzip_take(&zip, member, sizeof pixels - 1, &got, &error), KD_EINVAL);
        assert_null(got.data);
        OK(kd_unzip_take(&zip, kd_unzip_find(&zip, "b"), 0, &got, &error));
        assert_int_equal(got.size, 0);
        kd_buffer_finish(&got);
        assert_null(kd_unzip_find(&zip, "c"));
        kd_unzip_finish(&zip);
        kd_buffer_finish(&again);
        kd_buffer_finish(&file);
    }
}

/* A file that is cut anywhere, or has any byte changed, is either refused or read. Values that are read equal those
 * written. A sanitizer detects overruns. */
static void damaged_zip(void **state)
{
    (void)state;
    struct kd_buffer file = { 0 };
    struct kd_zip *writer;
    OK(kd_zip_create(&file, true, &writer));
    OK(kd_zip_add(writer, "a", pixels, sizeof pixels));
    OK(kd_zip_begin(writer, "b", 3));
    OK(kd_zip_append(writer, "xy", 2));
    OK(kd_zip_append(writer, "z", 1));
    OK(kd_zip_close(writer));
    kd_zip_destroy(writer);
    for (size_t i = 0; i < 9 * file.size; i++) {
        const size_t size = i < file.size ? i : file.size;
        uint8_t *bytes = malloc(size + 1);
        struct kd_unzip zip;
        struct kd_error error;
        memcpy(bytes, file.data, size);
        if (i >= file.size)
            bytes[i % file.size] ^= (uint8_t)(1 << (i / file.size - 1));
        bytes = realloc(bytes, size ? size : 1);
        if (!kd_unzip_open(bytes, size, &zip, &error))
            for (size_t k = 0; k < zip.n; k++) {
                struct kd_buffer got = { 0 };
                const bool taken = !kd_unzip_take(&zip, &zip.members[k], 1000, &got, &error);
                const void *was = k ? (const void *)"xyz" : pixels;
                assert_true(!taken || (got.size == (k ? 3 : sizeof pixels) && !memcmp(got.data, was, got.size)));
                assert_true(taken || !got.data);
                kd_buffer_finish(&got);
            }
        kd_unzip_finish(&zip);
        free(bytes);
    }
    kd_buffer_finish(&file);
}

/* A ZIP directory of 700 000 entries is refused because of the count, in either form of the end record. The entries are
 * not read, because this would take seconds. */
static void too_many_members(void **state)
{
    (void)state;
    enum { MANY = 700000, ENTRY = 46 };
    const size_t size = (size_t)MANY * ENTRY;
    uint8_t *bytes = calloc(1, size + 98), *end = bytes + size;
    struct timespec begun, done;
    for (size_t i = 0; i < MANY; i++)
        memcpy(bytes + i * ENTRY, "PK\1\2", 4);
    memcpy(end, "PK\6\6", 4); /* APPNOTE 4.3.14 */
    const uint64_t counts[] = { MANY, MANY, size, 0 }, at = size;
    memcpy(end + 24, counts, sizeof counts);
    memcpy(end + 56, "PK\6\7", 4);
    memcpy(end + 64, &at, 8);
    memcpy(end + 76, "PK\5\6", 4);
    for (int liar = 0; liar < 2; liar++) {
        struct kd_unzip zip;
        struct kd_error error;
        /* if `liar` is true, the record states fewer entries than the directory has */
        const uint16_t said = liar ? 3 : 0xffff;
        const uint32_t bytes_said = liar ? (uint32_t)size : 0xffffffff;
        memcpy(end + 84, &said, 2);
        memcpy(end + 86, &said, 2);
        memcpy(end + 88, &bytes_said, 4);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
        assert_int_equal(kd_unzip_open(bytes, size + 98, &zip, &error), KD_EINVAL);
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &done);
        assert_non_null(strstr(error.message, liar ? "another number of entries than it states"
                                                   : "at most 1024 members; it has 700000"));
        assert_true((double)(done.tv_sec - begun.tv_sec) + 1e-9 * (double)(done.tv_nsec - begun.tv_nsec) < 0.5);
        assert_null(zip.members);
    }
    free(bytes);
}

/* Members beyond 4 GiB have the sizes that the writer declared, in the fields of ZIP64. The test removes the bytes
 * themselves, as a film does. */
static void long_members(void **state)
{
    (void)state;
    enum { PIECE = 64 << 20 };
    const uint64_t size = (4ull << 30) + 3;
    struct kd_buffer file = { 0 };
    struct kd_zip *writer;
    uint8_t *piece = calloc(1, PIECE);
    uint64_t taken = 0; /* bytes removed from the buffer */
    OK(kd_zip_create(&file, false, &writer));
    OK(kd_zip_begin(writer, "long", size));
    for (uint64_t left = size, n; left; left -= n) {
        n = left < PIECE ? left : PIECE;
        OK(kd_zip_append(writer, piece, (size_t)n));
        taken += file.size;
        file.size = 0;
    }
    free(piece);
    OK(kd_zip_add(writer, "short", "x", 1));
    OK(kd_zip_close(writer));
    kd_zip_destroy(writer);
    const uint8_t *entry = memmem(file.data, file.size, "PK\1\2", 4),
                  *second = memmem(entry + 4, file.size - (size_t)(entry + 4 - file.data), "PK\1\2", 4);
    uint64_t told;
    memcpy(&told, entry + 46 + 4 + 4, 8);
    assert_true(told == size && !memcmp(entry + 24, "\xff\xff\xff\xff", 4));
    memcpy(&told, second + 46 + 5 + 4, 8);
    assert_true(told == taken);
    const uint8_t *locator = memmem(file.data, file.size, "PK\6\7", 4);
    memcpy(&told, locator + 8, 8);
    assert_true(told + 56 + 20 + 22 == taken + file.size);
    kd_buffer_finish(&file);
}

static void exr_texts(void **state)
{
    (void)state;
    struct kd_error error;
    const struct kd_exr_channel channels[] = { { "r", pixels, 2 }, { "a", pixels + 1, 2 } };
    const struct kd_exr_text texts[] = { { "kerrd:scene", "{\"version\":1}" }, { "kerrd:hash", "" } };
    const struct kd_exr image = { 3, 2, channels, 2, texts, 2 };
    struct kd_buffer file = { 0 }, got = { 0 };
    OK(kd_buffer_append(&file, "before", 6)); /* the file is appended */
    OK(kd_exr_encode(&image, &file, &error));
    OK(kd_exr_find_text(file.data + 6, file.size - 6, "kerrd:scene", &got, &error));
    assert_true(got.size == 13 && !memcmp(got.data, "{\"version\":1}", 13));
    assert_int_equal(kd_exr_find_text(file.data + 6, file.size - 6, "kerrd:none", &got, &error), KD_EINVAL);
    for (size_t size = 0; size < 300; size += 7) { /* a file that is cut within its header */
        /* allocated with exact size, so that a sanitizer detects an overrun */
        uint8_t *cut = malloc(size + 1);
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
        cmocka_unit_test(texts_of_any_length),     cmocka_unit_test(checksums),    cmocka_unit_test(numbers),
        cmocka_unit_test(first_row_is_the_lowest), cmocka_unit_test(zip_members),  cmocka_unit_test(damaged_zip),
        cmocka_unit_test(too_many_members),        cmocka_unit_test(long_members), cmocka_unit_test(exr_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
