/* Tests of sky.image: from the bytes of a PNG file to a panorama and its mipmaps. */
#include "image/png.h"
#include "render/sky/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define NEAR(x, y, by) assert_true(fabs((x) - (y)) <= (by))

static struct kd_buffer file(uint32_t width, uint32_t height, int depth, const void *pixels,
                             const struct kd_png_text *text, size_t n)
{
    struct kd_buffer out = { 0 };
    struct kd_error error;
    const struct kd_png_params params = { width, height, depth, 1, pixels, text, n };
    assert_int_equal(kd_png_encode(&params, &out, &error), KD_OK);
    return out;
}

static struct kd_sky_picture read_it(const struct kd_buffer *png, char credit[KD_SKY_CREDIT])
{
    struct kd_sky_picture picture;
    struct kd_error error;
    if (kd_sky_image(png->data, png->size, &picture, credit, &error))
        fail_msg("%s", error.message);
    return picture;
}

/* Values of IEC 61966-2-1 that were computed by other means: 188 of 255 is 0.502886 of white, 10 of 255 is 0.00303527,
 * and 30000 of 65535 is 0.177015. */
static void light(void **state)
{
    (void)state;
    static uint8_t eight[32 * 16 * 3];
    static uint16_t sixteen[32 * 16 * 3];
    char credit[KD_SKY_CREDIT];
    eight[3 * 37] = 188;
    eight[3 * 37 + 1] = 10;
    eight[3 * 37 + 2] = 255;
    sixteen[3 * 37] = 30000;
    sixteen[3 * 37 + 2] = 65535;
    struct kd_buffer a = file(32, 16, 8, eight, NULL, 0), b = file(32, 16, 16, sixteen, NULL, 0);
    struct kd_sky_picture one = read_it(&a, credit), two = read_it(&b, credit);
    assert_true(one.width == 32 && one.height == 16 && two.width == 32);
    NEAR(one.texels[3 * 37], 0.502886, 1e-5);
    NEAR(one.texels[3 * 37 + 1], 0.00303527, 1e-7);
    NEAR(one.texels[3 * 37 + 2], 1, 1e-6);
    NEAR(two.texels[3 * 37], 0.177015, 1e-5);
    NEAR(two.texels[3 * 37 + 2], 1, 1e-6);
    NEAR(one.texels[3 * 38], 0, 0);
    kd_sky_picture_finish(&one);
    kd_sky_picture_finish(&two);
    kd_buffer_finish(&a);
    kd_buffer_finish(&b);
}

/* Sides become powers of two; no light is lost, or moved by more than a tenth of a texel. */
static void sizes(void **state)
{
    (void)state;
    static const struct {
        uint32_t height, rows;
    } cases[] = {
        { 16, 16 }, { 17, 16 }, { 22, 32 }, { 40, 32 }, { 50, 64 }, { 64, 64 }, { 500, 512 }, { 1200, 1024 }
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const uint32_t h = cases[i].height, w = 2 * h;
        uint8_t *pixels = calloc(3 * (size_t)w, h);
        char credit[KD_SKY_CREDIT];
        assert_non_null(pixels);
        for (uint32_t y = h / 5; y < h / 3; y++)
            for (uint32_t x = w / 7; x < w / 4; x++)
                pixels[3 * ((size_t)y * w + x)] = 255;
        struct kd_buffer png = file(w, h, 8, pixels, NULL, 0);
        struct kd_sky_picture p = read_it(&png, credit);
        double sum = 0, cx = 0, cy = 0;
        assert_int_equal(p.height, cases[i].rows);
        assert_int_equal(p.width, 2 * p.height);
        for (uint32_t y = 0; y < p.height; y++)
            for (uint32_t x = 0; x < p.width; x++) {
                const double t = p.texels[3 * ((size_t)y * p.width + x)];
                sum += t;
                cx += t * (x + 0.5) / p.width;
                cy += t * (y + 0.5) / p.height;
            }
        const double lit = (double)(h / 3 - h / 5) * (w / 4 - w / 7);
        NEAR(sum / ((double)p.width * p.height) / (lit / ((double)w * h)), 1, 1e-5);
        NEAR(cx / sum, 0.5 * (w / 7 + w / 4) / w, 0.1 / p.width);
        NEAR(cy / sum, 0.5 * (h / 5 + h / 3) / h, 0.1 / p.height);
        kd_sky_picture_finish(&p);
        kd_buffer_finish(&png);
        free(pixels);
    }
}

static void refuse(const void *data, size_t size, const char *why)
{
    struct kd_sky_picture p;
    struct kd_error error = { 0 };
    char credit[KD_SKY_CREDIT];
    assert_int_equal(kd_sky_image(data, size, &p, credit, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/sky/image");
    assert_ptr_equal(strstr(error.message, "sky.image cannot be used: "), error.message);
    if (!strstr(error.message, why))
        fail_msg("%s", error.message);
    assert_null(p.texels);
}

static void bad_files(void **state)
{
    (void)state;
    static const uint8_t pixels[3 * 64 * 32];
    struct kd_buffer square = file(32, 32, 8, pixels, NULL, 0), flat = file(14, 7, 8, pixels, NULL, 0),
                     off = file(33, 16, 8, pixels, NULL, 0), good = file(64, 32, 8, pixels, NULL, 0);
    refuse(square.data, square.size,
           "a picture of 32 x 32 pixels; it must show the whole sky, twice as wide as high, with 16 to 4096 rows");
    refuse(flat.data, flat.size, "14 x 7 pixels");
    refuse(off.data, off.size, "33 x 16 pixels");
    refuse("text", 4, "not a PNG file");
    refuse("", 0, "not a PNG file");
    good.data[good.size - 20] ^= 8; /* damage that only decoding the pixels finds */
    refuse(good.data, good.size, "damaged PNG file");
    kd_buffer_finish(&square);
    kd_buffer_finish(&flat);
    kd_buffer_finish(&off);
    kd_buffer_finish(&good);
}

static void credits(void **state)
{
    (void)state;
    static const uint8_t pixels[3 * 32 * 16];
    char credit[KD_SKY_CREDIT], long_one[1000];
    memset(long_one, 'x', sizeof long_one - 1);
    long_one[sizeof long_one - 1] = 0;
    const struct {
        struct kd_png_text text[2];
        size_t n;
        const char *credit;
    } cases[] = {
        { { { "Author", "Somebody" }, { "Copyright", "\xc3\x89lise, CC BY" } }, 2, "\xc3\x89lise, CC BY" },
        { { { "Author", "Somebody" } }, 1, "Somebody" },
        { { { "Comment", "no" } }, 1, "" },
        { { { "Copyright", long_one } }, 1, NULL },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_buffer png = file(32, 16, 8, pixels, cases[i].text, cases[i].n);
        struct kd_sky_picture p = read_it(&png, credit);
        if (cases[i].credit)
            assert_string_equal(credit, cases[i].credit);
        else
            assert_true(strlen(credit) > 380 && !memcmp(credit, long_one, 380));
        kd_sky_picture_finish(&p);
        kd_buffer_finish(&png);
    }
}

enum { WIDTH = 512, HEIGHT = 256 };

/* Draws a wave in longitude with the given period in texels. Measures the remaining amplitude and the mean in the row
 * of the given latitude at a mipmap level. */
static void wave(bool even, double period, double latitude, int level, double *amplitude, double *mean)
{
    struct kd_sky_picture p = { WIDTH, HEIGHT, malloc(3 * sizeof(float) * WIDTH * HEIGHT), even };
    uint32_t *words = malloc(sizeof *words * kd_panorama_words(WIDTH, HEIGHT)), *row = words, n = WIDTH, rows = HEIGHT;
    struct kd_error error;
    double c = 0, s = 0;
    assert_true(p.texels && words);
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        p.texels[i] = (float)(1 + cos(2 * M_PI * (double)(i / 3 % WIDTH) / period));
    assert_int_equal(kd_panorama_fill(&p, words, &error), KD_OK);
    for (int k = 0; k < level; k++, n /= 2, rows /= 2)
        row += n * rows;
    row += n * (uint32_t)((0.5 - latitude / 180) * rows);
    *mean = 0;
    for (uint32_t x = 0; x < n; x++) {
        float rgb[3];
        kd_panorama_unpack(row[x], rgb);
        *mean += rgb[0] / n;
        c += 2 * rgb[0] * cos(2 * M_PI * (x << level) / period) / n;
        s += 2 * rgb[0] * sin(2 * M_PI * (x << level) / period) / n;
    }
    *amplitude = hypot(c, s);
    kd_sky_picture_finish(&p);
    free(words);
}

/* At a latitude of 86 degrees 32 texels are as wide as 2.2 texels at the equator. At level 2, whose texels are 4 texels
 * of level 0 wide, such a wave has vanished. At level 0, and next to the equator, it remains. */
static void poles(void **state)
{
    (void)state;
    double amplitude, mean;
    wave(true, 32, 86, 2, &amplitude, &mean);
    NEAR(amplitude, 0, 0.05);
    NEAR(mean, 1, 5e-3);
    wave(true, 32, 86, 0, &amplitude, &mean); /* the mean over 14.3 texels multiplies a wave by sin(x)/x */
    NEAR(amplitude, 0.70, 0.03);
    wave(true, 32, 0.5, 2, &amplitude, &mean);
    NEAR(amplitude, 0.97, 0.03);
    wave(false, 32, 86, 2, &amplitude, &mean); /* compared with a wave that needs no such averaging */
    NEAR(amplitude, 0.98, 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light),   cmocka_unit_test(sizes), cmocka_unit_test(bad_files),
        cmocka_unit_test(credits), cmocka_unit_test(poles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
