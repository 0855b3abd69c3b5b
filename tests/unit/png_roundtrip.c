/* Tests that kd_png_decode reads back what kd_png_encode writes, and that other colour types, written by libpng itself,
 * are read as RGB. */
#include "base/parallel.h"
#include "image/png.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>
#include <png.h>

static uint32_t seed = 12345;
static uint32_t random_bits(void) { return seed = seed * 1664525u + 1013904223u; }

static void fill_random(void *to, size_t size)
{
    for (size_t i = 0; i < size; i++)
        ((uint8_t *)to)[i] = (uint8_t)(random_bits() >> 24);
}

static void round_trip(uint32_t width, uint32_t height, int depth, int level)
{
    size_t size = (size_t)width * height * 3 * ((size_t)depth / 8);
    uint8_t *pixels = malloc(size);
    struct kd_buffer file = { 0 };
    struct kd_png png;
    struct kd_error error = { 0 };

    assert_non_null(pixels);
    fill_random(pixels, size);
    struct kd_png_params params = {
        .width = width,
        .height = height,
        .bit_depth = depth,
        .compression = level,
        .pixels = pixels,
    };
    assert_int_equal(kd_png_encode(&params, &file, &error), KD_OK);
    assert_int_equal(kd_png_decode(file.data, file.size, &png, &error), KD_OK);
    assert_int_equal(png.width, width);
    assert_int_equal(png.height, height);
    assert_int_equal(png.bit_depth, depth);
    assert_memory_equal(png.pixels, pixels, size);
    assert_int_equal(png.n_text, 0);
    assert_non_null(memmem(file.data, file.size, "sRGB", 4));
    kd_png_finish(&png);
    kd_buffer_finish(&file);
    free(pixels);
}

static void pixels_survive(void **state)
{
    (void)state;
    static const uint32_t sides[][2] = { { 1, 1 }, { 1, 97 }, { 97, 1 }, { 3, 2 }, { 64, 36 }, { 641, 37 } };
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++)
        for (int level = 0; level <= 8; level++) {
            round_trip(sides[i][0], sides[i][1], 8, level);
            round_trip(sides[i][0], sides[i][1], 16, level);
        }
    round_trip(32768, 1, 8, 1);
    round_trip(1, 32768, 16, 1);
}

/* Fills a picture of either bit depth with noise, ramps and flat parts. */
static void fill_picture(uint8_t *pixels, uint32_t width, uint32_t height, size_t step)
{
    for (uint32_t y = 0; y < height; y++)
        for (size_t i = 0; i < width * step; i++)
            *pixels++ = (uint8_t)(y % 300 < 100 ? random_bits() >> 28 : y % 300 < 200 ? i * y >> 6 : 0);
}

/* A picture of several strips is the same file on any number of threads, and has the right pixels. The same holds for
 * rows so long that each row is a strip. */
static void strips_survive(uint32_t width, uint32_t height, int depth, int level)
{
    static const unsigned threads[] = { 1, 2, 3, 7, 0 };
    const size_t step = 3 * (size_t)depth / 8, size = step * width * height;
    uint8_t *pixels = malloc(size);
    struct kd_buffer first = { 0 };
    struct kd_png png;
    assert_non_null(pixels);
    fill_picture(pixels, width, height, step);
    const struct kd_png_params params = {
        .width = width, .height = height, .bit_depth = depth, .compression = level, .pixels = pixels
    };
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        struct kd_buffer file = { 0 };
        kd_parallel_threads = threads[i];
        assert_int_equal(kd_png_encode(&params, i ? &file : &first, NULL), KD_OK);
        if (i) {
            assert_int_equal(file.size, first.size);
            assert_memory_equal(file.data, first.data, file.size);
        }
        kd_buffer_finish(&file);
    }
    assert_int_equal(kd_png_decode(first.data, first.size, &png, NULL), KD_OK);
    assert_memory_equal(png.pixels, pixels, size);
    kd_png_finish(&png);
    kd_buffer_finish(&first);
    free(pixels);
}

static void large_pictures_survive(void **state)
{
    (void)state;
    static const int levels[] = { 0, 1, 5 };
    for (size_t i = 0; i < sizeof levels / sizeof *levels; i++) {
        strips_survive(1427, 1003, 8, levels[i]);
        strips_survive(1427, 1003, 16, levels[i]);
    }
    strips_survive(32768, 37, 16, 1);
    strips_survive(23, 32768, 16, 5);
}

/* Rows that repeat downwards, or that are the mean of left and above, compress well only with the matching filter. With
 * any other filter they take as many bytes as noise. */
static void each_row_has_the_filter_that_suits_it(void **state)
{
    (void)state;
    enum { N = 128, STRIDE = 3 * N };
    static uint8_t pixels[N * STRIDE];
    for (int kind = 0; kind < 3; kind++) {
        fill_random(pixels, sizeof pixels);
        for (int y = 1; y < N; y++)
            for (int i = 0; i < STRIDE; i++) {
                const uint8_t *above = pixels + (y - 1) * STRIDE, *row = pixels + y * STRIDE;
                pixels[y * STRIDE + i] = kind == 0   ? above[i]
                                         : kind == 1 ? (uint8_t)(((i < 3 ? 0 : row[i - 3]) + above[i]) / 2)
                                         : i < 3     ? above[i]
                                                     : row[i - 3];
            }
        struct kd_png_params params = { .width = N, .height = N, .bit_depth = 8, .compression = 5, .pixels = pixels };
        struct kd_buffer file = { 0 };
        struct kd_error error = { 0 };
        assert_int_equal(kd_png_encode(&params, &file, &error), KD_OK);
        assert_true(file.size < 2 * STRIDE + 500); /* the first row is noise */
        kd_buffer_finish(&file);
    }
}

static void text_survives(void **state)
{
    (void)state;
    static char big[100001];
    memset(big, 'x', sizeof big - 1);
    static const uint8_t pixels[12];
    const struct kd_png_text text[] = {
        { "kerrd:scene", "{\"version\":1}" },
        { "Title", "Schwarzes Loch, \xc3\xa4\xc3\xb6\xc3\xbc, \xe2\x88\x9e, \xf0\x9f\x95\xb3" },
        { "big", big },
        { "empty", "" },
        { "lines", "one\ntwo\n" },
    };
    struct kd_png_params params = {
        .width = 2,
        .height = 2,
        .bit_depth = 8,
        .compression = 6,
        .pixels = pixels,
        .text = text,
        .n_text = 5,
    };
    struct kd_buffer file = { 0 };
    struct kd_png png;
    struct kd_error error = { 0 };

    assert_int_equal(kd_png_encode(&params, &file, &error), KD_OK);
    assert_int_equal(kd_png_decode(file.data, file.size, &png, &error), KD_OK);
    assert_int_equal(png.n_text, 5);
    for (size_t i = 0; i < 5; i++)
        assert_string_equal(kd_png_text_find(&png, text[i].key), text[i].value);
    assert_null(kd_png_text_find(&png, "absent"));
    assert_non_null(memmem(file.data, file.size, "iTXtTitle", 9));
    assert_non_null(memmem(file.data, file.size, "tEXtkerrd:scene", 15));
    kd_png_finish(&png);
    kd_buffer_finish(&file);
}

/* A round trip cannot detect bytes that are swapped both in writing and in reading; an uncompressed file can. */
static void sixteen_bits_are_big_endian(void **state)
{
    (void)state;
    static const uint16_t pixel[3] = { 0x0102, 0x0304, 0x0506 };
    const struct kd_png_params params = { .width = 1, .height = 1, .bit_depth = 16, .pixels = pixel };
    struct kd_buffer file = { 0 };
    assert_int_equal(kd_png_encode(&params, &file, NULL), KD_OK);
    assert_non_null(memmem(file.data, file.size, "\0\1\2\3\4\5\6", 7));
    kd_buffer_finish(&file);
}

/* The same input gives the same bytes. The previous contents of the buffer stay, also when encoding fails. */
static void appends_the_same_bytes(void **state)
{
    (void)state;
    uint8_t pixels[3 * 16 * 9];
    fill_random(pixels, sizeof pixels);
    struct kd_png_params params = { .width = 16, .height = 9, .bit_depth = 8, .compression = 1, .pixels = pixels };
    struct kd_buffer a = { 0 }, b = { 0 };
    struct kd_error error = { 0 };

    assert_int_equal(kd_png_encode(&params, &a, &error), KD_OK);
    assert_int_equal(kd_buffer_append(&b, "head", 4), KD_OK);
    assert_int_equal(kd_png_encode(&params, &b, &error), KD_OK);
    assert_int_equal(b.size, a.size + 4);
    assert_memory_equal(b.data, "head", 4);
    assert_memory_equal(b.data + 4, a.data, a.size);
    params.bit_depth = 12;
    assert_int_equal(kd_png_encode(&params, &b, &error), KD_EINVAL);
    assert_int_equal(b.size, a.size + 4);
    kd_buffer_finish(&a);
    kd_buffer_finish(&b);
}

static void refused(struct kd_png_params params, const char *word)
{
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };
    assert_int_equal(kd_png_encode(&params, &out, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, word));
    assert_int_equal(out.size, 0);
    kd_buffer_finish(&out);
}

static void bad_parameters_are_refused(void **state)
{
    (void)state;
    static const uint8_t pixels[12];
#define WITH(...) ((struct kd_png_params) { .width = 2, .height = 2, .bit_depth = 8, .pixels = pixels, __VA_ARGS__ })
    refused(WITH(.width = 0), "0 x 2");
    refused(WITH(.height = 0), "2 x 0");
    refused(WITH(.width = 32769), "32769");
    refused(WITH(.bit_depth = 4), "4 bits");
    refused(WITH(.compression = 9), "level is 9");
    refused(WITH(.compression = -1), "level is -1");
    static const char *const keys[] = { "", " a", "a ", "a  b", "a\nb", "\xc3\xa4" };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        struct kd_png_text text = { keys[i], "x" };
        refused(WITH(.text = &text, .n_text = 1), "key");
    }
    static const char *const bad[] = { "\x80", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                       "\xc3", "\xff" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct kd_png_text text = { "key", bad[i] };
        refused(WITH(.text = &text, .n_text = 1), "UTF-8");
    }
    char *huge = malloc((1u << 20) + 1);
    assert_non_null(huge);
    memset(huge, 'x', 1u << 20);
    huge[1u << 20] = 0;
    struct kd_png_text text = { "key", huge };
    refused(WITH(.text = &text, .n_text = 1), "1048579");
    free(huge);
#undef WITH
}

/* The largest permitted text is read back: in one chunk of either kind, and in the largest permitted number of
 * chunks. */
static void all_text_comes_back(void **state)
{
    (void)state;
    enum { MOST = (1u << 20) - 3, PIECES = 99 };
    static const uint8_t pixel[3];
    char *value = malloc(MOST + 1), keys[PIECES][8];
    struct kd_png_text texts[PIECES];
    assert_non_null(value);
    memset(value, 'x', MOST);
    value[MOST] = 0;
    for (int i = 0; i < PIECES; i++) {
        snprintf(keys[i], sizeof keys[i], "key %d", i);
        texts[i] = (struct kd_png_text) { keys[i], keys[i] };
    }
    for (int kind = 0; kind < 3; kind++) {
        struct kd_buffer file = { 0 };
        struct kd_png png;
        const struct kd_png_text one = { "key", value };
        if (kind == 1)
            memcpy(value, "\xc3\xa4", 2); /* not ASCII, so it becomes an iTXt chunk */
        struct kd_png_params params = { .width = 1,
                                        .height = 1,
                                        .bit_depth = 8,
                                        .pixels = pixel,
                                        .text = kind < 2 ? &one : texts,
                                        .n_text = kind < 2 ? 1 : PIECES };
        assert_int_equal(kd_png_encode(&params, &file, NULL), KD_OK);
        assert_int_equal(kd_png_decode(file.data, file.size, &png, NULL), KD_OK);
        assert_int_equal(png.n_text, params.n_text);
        for (size_t i = 0; i < params.n_text; i++)
            assert_string_equal(kd_png_text_find(&png, params.text[i].key), params.text[i].value);
        kd_png_finish(&png);
        kd_buffer_finish(&file);
    }
    free(value);
}

/* A file of some other colour type. libpng's errors end this test. */
static void write_other(struct kd_buffer *file, int type, int depth, int interlace, bool transparent)
{
    char *memory = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&memory, &size);
    assert_non_null(stream);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    assert_false(setjmp(png_jmpbuf(png)));
    png_init_io(png, stream);
    png_set_IHDR(png, info, 13, 11, depth, type, interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_color palette[2] = { { 10, 20, 30 }, { 200, 210, 220 } };
    if (type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 2);
    png_byte alpha[2] = { 0, 128 };
    png_color_16 key = { .gray = 1, .red = 1, .green = 1, .blue = 1 };
    if (transparent)
        png_set_tRNS(png, info, alpha, type == PNG_COLOR_TYPE_PALETTE ? 2 : 1, &key);
    png_write_info(png, info);
    png_byte row[13 * 8]; /* every sample, alpha too, is 0 or the largest value */
    for (int pass = 0, n = png_set_interlace_handling(png); pass < n; pass++)
        for (int y = 0; y < 11; y++) {
            memset(row, y % 2 ? 0xff : 0, sizeof row);
            if (type == PNG_COLOR_TYPE_PALETTE && depth == 8)
                memset(row, y % 2, sizeof row);
            png_write_row(png, row);
        }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    fclose(stream);
    assert_int_equal(kd_buffer_append(file, memory, size), KD_OK);
    free(memory);
}

static void check_other(int type, int depth, int interlace, bool transparent)
{
    struct kd_buffer file = { 0 };
    struct kd_png png;
    struct kd_error error = { 0 };
    write_other(&file, type, depth, interlace, transparent);
    if (kd_png_decode(file.data, file.size, &png, &error))
        fail_msg("type %d depth %d: %s", type, depth, error.message);
    assert_int_equal(png.bit_depth, depth == 16 ? 16 : 8);
    size_t sample = (size_t)png.bit_depth / 8, stride = 13 * 3 * sample;
    for (size_t y = 0; y < 11; y++)
        for (size_t i = 0; i < stride; i++) {
            int got = ((uint8_t *)png.pixels)[y * stride + i];
            int palette = (int)(i % 3 + 1) * 10 + (y % 2 ? 190 : 0);
            assert_int_equal(got, type == PNG_COLOR_TYPE_PALETTE ? palette : y % 2 ? 255 : 0);
        }
    kd_png_finish(&png);
    kd_buffer_finish(&file);
}

static void every_colour_type_is_read(void **state)
{
    (void)state;
    for (int interlace = 0; interlace < 2; interlace++) {
        for (int depth = 1; depth <= 16; depth *= 2)
            for (int clear = 0; clear < 2; clear++) {
                check_other(PNG_COLOR_TYPE_GRAY, depth, interlace, clear);
                if (depth >= 8)
                    check_other(PNG_COLOR_TYPE_RGB, depth, interlace, clear);
            }
        for (int depth = 8; depth <= 16; depth += 8) {
            check_other(PNG_COLOR_TYPE_GRAY_ALPHA, depth, interlace, false);
            check_other(PNG_COLOR_TYPE_RGB_ALPHA, depth, interlace, false);
        }
        check_other(PNG_COLOR_TYPE_PALETTE, 1, interlace, false);
        check_other(PNG_COLOR_TYPE_PALETTE, 8, interlace, false);
        check_other(PNG_COLOR_TYPE_PALETTE, 8, interlace, true);
    }
}

/* Prints, without asserting, the time that the live view needs to encode a frame. */
static void time_of_a_live_frame(void **state)
{
    (void)state;
    enum { WIDTH = 1280, HEIGHT = 720 };
    uint8_t *pixels = malloc(3 * WIDTH * HEIGHT);
    assert_non_null(pixels);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH - WIDTH / 2, y = i / WIDTH - HEIGHT / 2;
        for (int c = 0; c < 3; c++)
            pixels[3 * i + c] = (uint8_t)(255 / (1 + (x * x + y * y) / (5000 << c)));
    }
    struct kd_png_params params = {
        .width = WIDTH,
        .height = HEIGHT,
        .bit_depth = 8,
        .compression = 1,
        .pixels = pixels,
    };
    double best = 1e9;
    size_t size = 0;
    for (int i = 0; i < 5; i++) {
        struct kd_buffer file = { 0 };
        struct timespec from, to;
        clock_gettime(CLOCK_MONOTONIC, &from);
        assert_int_equal(kd_png_encode(&params, &file, NULL), KD_OK);
        clock_gettime(CLOCK_MONOTONIC, &to);
        double ms = (double)(to.tv_sec - from.tv_sec) * 1e3 + (double)(to.tv_nsec - from.tv_nsec) / 1e6;
        best = ms < best ? ms : best;
        size = file.size;
        kd_buffer_finish(&file);
    }
    print_message("1280 x 720, 8 bit, level 1: %.1f ms, %zu bytes\n", best, size);
    free(pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_text_comes_back),
        cmocka_unit_test(pixels_survive),
        cmocka_unit_test(large_pictures_survive),
        cmocka_unit_test(each_row_has_the_filter_that_suits_it),
        cmocka_unit_test(text_survives),
        cmocka_unit_test(sixteen_bits_are_big_endian),
        cmocka_unit_test(appends_the_same_bytes),
        cmocka_unit_test(bad_parameters_are_refused),
        cmocka_unit_test(every_colour_type_is_read),
        cmocka_unit_test(time_of_a_live_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
