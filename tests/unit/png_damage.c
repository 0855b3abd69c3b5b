/* Tests that PNG files that are cut, altered or inconsistent give KD_EINVAL and a message, and never a crash or a leak
 * (sanitizers detect these). */
#include "image/png.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <zlib.h>

static uint32_t seed = 99;
static uint32_t random_bits(void) { return (seed = seed * 1664525u + 1013904223u) >> 8; }

static void sample(struct kd_buffer *file, int depth)
{
    uint8_t pixels[8 * 6 * 6];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)random_bits();
    const struct kd_png_text text[] = { { "kerrd:scene", "{}" }, { "Title", "\xe2\x88\x9e" } };
    struct kd_png_params params = {
        .width = 8,
        .height = 6,
        .bit_depth = depth,
        .compression = 6,
        .pixels = pixels,
        .text = text,
        .n_text = 2,
    };
    assert_int_equal(kd_png_encode(&params, file, NULL), KD_OK);
}

/* Decodes from a block of exactly that size, so that a sanitizer detects a read past the end. */
static enum kd_status decode_exact(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    struct kd_png png;
    struct kd_error error = { 0 };
    assert_non_null(copy);
    if (size)
        memcpy(copy, data, size);
    enum kd_status status = kd_png_decode(copy, size, &png, &error);
    if (status) {
        assert_int_equal(status, KD_EINVAL);
        assert_int_equal(error.status, KD_EINVAL);
        assert_true(error.message[0]);
        assert_null(png.pixels);
        assert_null(png.text);
    }
    kd_png_finish(&png);
    free(copy);
    return status;
}

static void every_cut_is_refused(void **state)
{
    (void)state;
    for (int depth = 8; depth <= 16; depth += 8) {
        struct kd_buffer file = { 0 };
        sample(&file, depth);
        for (size_t size = 0; size < file.size; size++)
            if (decode_exact(file.data, size) != KD_EINVAL)
                fail_msg("cut to %zu of %zu bytes: accepted", size, file.size);
        assert_int_equal(decode_exact(file.data, file.size), KD_OK);
        kd_buffer_finish(&file);
    }
}

/* Every chunk has a checksum, so a flipped bit anywhere after the lengths must be detected. */
static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    struct kd_buffer file = { 0 };
    sample(&file, 8);
    for (size_t bit = 0; bit < 8 * file.size; bit++) {
        file.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
        if (decode_exact(file.data, file.size) != KD_EINVAL)
            fail_msg("bit %zu of byte %zu flipped: accepted", bit % 8, bit / 8);
        file.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    kd_buffer_finish(&file);
}

static uint32_t get32(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static void put32(uint8_t *p, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        p[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* Makes the checksums right again, so that damage reaches the parsers behind them. */
static void seal(uint8_t *data, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        uint32_t length = get32(data + at);
        if (length > size - at - 12)
            return;
        put32(data + at + 8 + length, (uint32_t)crc32(0, data + at + 4, length + 4));
        at += 12 + length;
    }
}

static void sealed_damage_does_not_crash(void **state)
{
    (void)state;
    struct kd_buffer file = { 0 };
    sample(&file, 16);
    uint8_t *copy = malloc(file.size);
    assert_non_null(copy);
    int accepted = 0;
    for (int i = 0; i < 6000; i++) {
        memcpy(copy, file.data, file.size);
        for (uint32_t n = 1 + random_bits() % 4; n > 0; n--)
            copy[8 + random_bits() % (file.size - 8)] = (uint8_t)random_bits();
        seal(copy, file.size);
        accepted += !decode_exact(copy, file.size);
    }
    print_message("6000 altered files, %d of them still PNG\n", accepted);
    free(copy);
    kd_buffer_finish(&file);
}

static void with_sides(uint32_t width, uint32_t height, const char *word)
{
    struct kd_buffer file = { 0 };
    struct kd_png png;
    struct kd_error error = { 0 };
    sample(&file, 8);
    put32(file.data + 16, width);
    put32(file.data + 20, height);
    seal(file.data, file.size);
    assert_int_equal(kd_png_decode(file.data, file.size, &png, &error), KD_EINVAL);
    if (!strstr(error.message, word))
        fail_msg("\"%s\" does not say \"%s\"", error.message, word);
    kd_buffer_finish(&file);
}

static void impossible_sides_are_refused(void **state)
{
    (void)state;
    with_sides(0, 6, "0 x 6");
    with_sides(8, 0, "8 x 0");
    with_sides(32769, 6, "32769 x 6");
    with_sides(8, 0xffffffffu, "4294967295");
    with_sides(32768, 32768, "too short"); /* 400 bytes claim to hold 3 GiB of pixels */
}

/* Decodes with a chunk of `type` with this body inserted before the first IDAT. */
static enum kd_status with_chunk(const char *type, const void *body, uint32_t length)
{
    struct kd_buffer file = { 0 }, out = { 0 };
    uint8_t word[4];
    sample(&file, 8);
    uint8_t *idat = memmem(file.data, file.size, "IDAT", 4);
    size_t before = (size_t)(idat - file.data) - 4;
    kd_buffer_append(&out, file.data, before);
    put32(word, length);
    kd_buffer_append(&out, word, 4);
    kd_buffer_append(&out, type, 4);
    kd_buffer_append(&out, body, length);
    kd_buffer_append(&out, word, 4);
    kd_buffer_append(&out, file.data + before, file.size - before);
    seal(out.data, out.size);
    enum kd_status status = decode_exact(out.data, out.size);
    kd_buffer_finish(&file);
    kd_buffer_finish(&out);
    return status;
}

static void text_is_limited(void **state)
{
    (void)state;
    enum { HUGE_TEXT = (2u << 20) };
    char *body = malloc(HUGE_TEXT);
    assert_non_null(body);
    memset(body, 'x', HUGE_TEXT);
    memcpy(body, "key", 4);
    assert_int_equal(with_chunk("tEXt", body, 1u << 19), KD_OK);
    assert_int_equal(with_chunk("tEXt", body, HUGE_TEXT), KD_EINVAL);
    assert_int_equal(with_chunk("iTXt", "key\0\0\0\0\0bad \xff", 13), KD_EINVAL);
    assert_int_equal(with_chunk("iTXt", "key\0\0\0\0\0ok \xc3\xa4", 13), KD_OK);
    uint8_t bomb[1 << 16];
    uLongf packed = sizeof bomb - 5;
    memset(body, 'x', HUGE_TEXT);
    memcpy(bomb, "key\0", 5);
    assert_int_equal(compress(bomb + 5, &packed, (const Bytef *)body, HUGE_TEXT), Z_OK);
    assert_int_equal(with_chunk("zTXt", bomb, 5 + (uint32_t)packed), KD_EINVAL); /* the text was not decompressed */
    free(body);
}

/* libpng would skip such a chunk with a warning. The chunk may be the one with the scene, so the file is refused
 * instead of being read without it. */
static void no_text_is_lost_in_silence(void **state)
{
    (void)state;
    static const struct {
        const char *type, *body;
        uint32_t length;
    } chunks[] = {
        { "zTXt", "key\0\0not a stream of zlib", 23 },
        { "zTXt", "key\0\7unknown method", 19 },
        { "iTXt", "key\0\2\0\0\0flag", 12 },
        { "iTXt", "key\0\1\0\0\0stream", 14 },
        { "iTXt", "key", 3 },
    };
    for (size_t i = 0; i < sizeof chunks / sizeof *chunks; i++)
        if (with_chunk(chunks[i].type, chunks[i].body, chunks[i].length) != KD_EINVAL)
            fail_msg("chunk %zu, a %s, is passed over", i, chunks[i].type);
    struct kd_buffer file = { 0 }, out = { 0 };
    static const uint8_t text[] = "\0\0\0\5tEXtkey\0x\0\0\0\0";
    struct kd_png png;
    sample(&file, 8); /* makes a file with two texts */
    size_t before = (size_t)((uint8_t *)memmem(file.data, file.size, "IDAT", 4) - file.data) - 4;
    kd_buffer_append(&out, file.data, before);
    for (int n = 3; n <= 110; n++) {
        kd_buffer_append(&out, text, sizeof text - 1);
        struct kd_buffer whole = { 0 };
        kd_buffer_append(&whole, out.data, out.size);
        kd_buffer_append(&whole, file.data + before, file.size - before);
        seal(whole.data, whole.size);
        enum kd_status status = kd_png_decode(whole.data, whole.size, &png, NULL);
        assert_true(status ? n > 99 && status == KD_EINVAL : png.n_text == (size_t)n);
        kd_png_finish(&png);
        kd_buffer_finish(&whole);
    }
    kd_buffer_finish(&file);
    kd_buffer_finish(&out);
}

static void latin1_becomes_utf8(void **state)
{
    (void)state;
    struct kd_buffer file = { 0 };
    struct kd_png png;
    sample(&file, 8);
    /* Replaces the value of the tEXt chunk by two Latin-1 letters. */
    uint8_t *value = memmem(file.data, file.size, "kerrd:scene", 11);
    memcpy(value + 12, "\xe4\xff", 2);
    seal(file.data, file.size);
    assert_int_equal(kd_png_decode(file.data, file.size, &png, NULL), KD_OK);
    assert_string_equal(kd_png_text_find(&png, "kerrd:scene"), "\xc3\xa4\xc3\xbf");
    kd_png_finish(&png);
    kd_buffer_finish(&file);
}

static void other_files_are_not_png(void **state)
{
    (void)state;
    static const char *const files[] = { "", "{}", "\xff\xd8\xff\xe0", "GIF89a", "\x89PNG\r\n\x1a\n" };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        assert_int_equal(decode_exact((const uint8_t *)files[i], strlen(files[i])), KD_EINVAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cut_is_refused),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(sealed_damage_does_not_crash),
        cmocka_unit_test(impossible_sides_are_refused),
        cmocka_unit_test(text_is_limited),
        cmocka_unit_test(no_text_is_lost_in_silence),
        cmocka_unit_test(latin1_becomes_utf8),
        cmocka_unit_test(other_files_are_not_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
