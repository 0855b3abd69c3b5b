/* Tests of JPEG files that are encoded in strips. libjpeg decodes such a file to the same pixels as a file of one scan.
 * The bytes do not depend on the number of threads. */
#include "image/jpeg.h"
#include "base/parallel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jpeglib.h>

static uint32_t seed = 99;
static uint32_t random_bits(void) { return (seed = seed * 1664525u + 1013904223u) >> 8; }

static uint8_t *picture(uint32_t width, uint32_t height)
{
    uint8_t *pixels = malloc(3 * (size_t)width * height);
    assert_non_null(pixels);
    for (uint32_t y = 0, i = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (uint32_t c = 0; c < 3; c++)
                pixels[i++] = (uint8_t)(x * (c + 1) / 7 + y / 3 + random_bits() % 40);
    return pixels;
}

/* An error of libjpeg ends the program, so that the test fails. */
static uint8_t *decode(const uint8_t *file, size_t size, uint32_t width, uint32_t height)
{
    struct jpeg_decompress_struct info;
    struct jpeg_error_mgr errors;
    uint8_t *pixels = malloc(3 * (size_t)width * height);
    assert_non_null(pixels);
    info.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, file, size);
    assert_int_equal(jpeg_read_header(&info, TRUE), JPEG_HEADER_OK);
    assert_int_equal(info.image_width, width);
    assert_int_equal(info.image_height, height);
    jpeg_start_decompress(&info);
    while (info.output_scanline < height) {
        JSAMPROW row = pixels + 3 * (size_t)width * info.output_scanline;
        jpeg_read_scanlines(&info, &row, 1);
    }
    assert_true(jpeg_finish_decompress(&info));
    assert_int_equal(errors.num_warnings, 0); /* each restart marker is at the right position, without surplus bytes */
    jpeg_destroy_decompress(&info);
    return pixels;
}

/* The pixels that result if libjpeg encodes them in one scan, with the settings in jpeg.h, and decodes them. */
static uint8_t *expected(const uint8_t *pixels, uint32_t width, uint32_t height, unsigned quality)
{
    struct jpeg_compress_struct info;
    struct jpeg_error_mgr errors;
    uint8_t *file = NULL;
    unsigned long size = 0;
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, &file, &size);
    info.image_width = width;
    info.image_height = height;
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, (int)quality, TRUE);
    info.dct_method = JDCT_ISLOW;
    if (quality >= KD_JPEG_FULL_COLOUR)
        info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < height) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)(pixels + 3 * (size_t)width * info.next_scanline);
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    uint8_t *back = decode(file, size, width, height);
    free(file);
    return back;
}

static size_t restart_markers(const struct kd_buffer *file)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < file->size; i++)
        n += file->data[i] == 0xff && file->data[i + 1] >= 0xd0 && file->data[i + 1] <= 0xd7;
    return n;
}

static void check(uint32_t width, uint32_t height, unsigned quality, size_t intervals)
{
    static const unsigned threads[] = { 1, 2, 3, 7, 0 };
    uint8_t *pixels = picture(width, height), *wanted = expected(pixels, width, height, quality);
    struct kd_buffer first = { 0 };
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        struct kd_buffer file = { 0 };
        kd_parallel_threads = threads[i];
        assert_int_equal(kd_jpeg_encode(width, height, pixels, quality, i ? &file : &first, NULL), KD_OK);
        if (i) {
            assert_int_equal(file.size, first.size);
            assert_memory_equal(file.data, first.data, file.size);
        }
        kd_buffer_finish(&file);
    }
    uint8_t *got = decode(first.data, first.size, width, height);
    assert_memory_equal(got, wanted, 3 * (size_t)width * height);
    assert_int_equal(restart_markers(&first) + 1, intervals);
    kd_buffer_finish(&first);
    free(got);
    free(wanted);
    free(pixels);
}

static void intervals_are_one_scan(void **state)
{
    (void)state;
    check(640, 360, 75, 1);
    check(1280, 720, 50, 1); /* the strip has the tables of the whole picture */
    check(1280, 720, 75, 4);
    check(1280, 720, 90, 4);
    check(1280, 721, 75, 4);
    check(1279, 833, 75, 5);   /* the last strip has one row */
    check(1027, 2590, 75, 11); /* marker numbers wrap around after 8 */
    check(17, 65000, 92, 5);
    check(65500, 70, 75, 5);
}

static void what_is_refused(void **state)
{
    (void)state;
    static const uint8_t pixel[3];
    struct kd_error error = { 0 };
    struct kd_buffer out = { 0 };
    assert_int_equal(kd_jpeg_encode(1, 1, pixel, 0, &out, &error), KD_EINVAL);
    assert_non_null(strstr(error.message, "1 to 100"));
    assert_int_equal(kd_jpeg_encode(1, 1, pixel, 101, &out, &error), KD_EINVAL);
    assert_int_equal(kd_jpeg_encode(0, 1, pixel, 75, &out, &error), KD_EINVAL);
    assert_int_equal(kd_jpeg_encode(1, 65501, pixel, 75, &out, &error), KD_EINVAL);
    assert_int_equal(out.size, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(intervals_are_one_scan), cmocka_unit_test(what_is_refused) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
