/* Tests of legends: the numbers at a bar, and their layout. */
#include "image/font.h"
#include "image/legend.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void letters_have_shapes(void **state)
{
    (void)state;
    const char *all = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.,-+_/()=:*^%<>?";
    for (const char *c = all; *c; c++) {
        assert_true(kd_font_has(*c));
        for (const char *d = all; d < c; d++) {
            int differ = 0;
            for (int i = 0; i < KD_FONT_WIDTH * KD_FONT_HEIGHT; i++)
                differ += kd_font_dot(*c, i % KD_FONT_WIDTH, i / KD_FONT_WIDTH) !=
                          kd_font_dot(*d, i % KD_FONT_WIDTH, i / KD_FONT_WIDTH);
            if (!differ)
                fail_msg("%c looks like %c", *c, *d);
        }
    }
    assert_false(kd_font_has('\n'));
    assert_false(kd_font_has(0xc3));
    assert_true(kd_font_dot(0xc3, 0, 0)); /* a box for an unknown character */
    assert_true(kd_font_dot('L', 0, 0) && !kd_font_dot('L', 4, 0) && kd_font_dot('L', 4, 6));
}

/* Text is read letter by letter, even if it is not valid UTF-8. */
static void text_has_letters(void **state)
{
    (void)state;
    const uint32_t wanted[] = { '5', 0xb5, 'a', 0xb0, 0xfffd, 0xfffd, 'z' };
    const char *text = "5µa°\xff→z";
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        assert_int_equal(kd_font_next(&text), wanted[i]);
    assert_int_equal(*text, 0);
    assert_int_equal(kd_canvas_text_width(2, "5µa"), 34);
    assert_true(kd_font_has(0xb5) && kd_font_has(0xb0));
}

/* Strokes join neighbouring dots; diagonally only if no dot lies between them. */
static void letters_are_strokes(void **state)
{
    (void)state;
    const struct {
        char letter;
        double x, y, distance;
    } points[] = {
        { 'L', 0, 0, 0 },
        { 'L', 0, 2.5, 0 },
        { 'L', 0.5, 3, 0.5 },
        /* the corner of the stroke is cut if this is 0 */
        { 'L', -0.75, 6, 0.75 },
        { 'L', 4.6, 6.8, 1 },
        { 'L', 0.5, 5.5, 0.5 },
        { 'X', 1.5, 2.5, 0 }, /* between dots across */
        { 'X', 2, 0, 1 },
        { '.', 2.5, 5.5, 0.5 },
    };
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        assert_float_equal(kd_font_distance((uint32_t)points[i].letter, points[i].x, points[i].y), points[i].distance,
                           1e-12);
}

static void check_labels(const struct kd_map_scale *scale, double room, const char *wanted)
{
    struct kd_tick ticks[KD_LEGEND_TICKS];
    char found[200] = "";
    size_t n = kd_legend_ticks(scale, room, ticks);
    for (size_t i = 0; i < n; i++)
        snprintf(found + strlen(found), sizeof found - strlen(found), "%s%s", i ? " " : "", ticks[i].label);
    assert_string_equal(found, wanted);
}

static void numbers_are_round(void **state)
{
    (void)state;
    check_labels(&(struct kd_map_scale) { 0, 1, false }, 18, "0 0.5 1");
    check_labels(&(struct kd_map_scale) { 0, 1, false }, 24, "0 0.2 0.4 0.6 0.8 1");
    check_labels(&(struct kd_map_scale) { 0, 2e-5, false }, 18, "0 1e-5 2e-5");
    check_labels(&(struct kd_map_scale) { 0, 60000, false }, 18, "0 2e4 4e4 6e4");
    check_labels(&(struct kd_map_scale) { 2.3, 22, false }, 18, "5 10 15 20");
    check_labels(&(struct kd_map_scale) { -3, 3, false }, 30, "-3 -2 -1 0 1 2 3");
    check_labels(&(struct kd_map_scale) { 0.5, 2, true }, 18, "0.5 1 2");
    check_labels(&(struct kd_map_scale) { 0.5, 2, true }, 24, "0.5 0.7 1 1.5 2");
    check_labels(&(struct kd_map_scale) { 1e-3, 10, true }, 18, "0.01 1");
    check_labels(&(struct kd_map_scale) { 1e-3, 10, true }, 24, "0.001 0.01 0.1 1 10");
    check_labels(&(struct kd_map_scale) { 1.03, 1.05, true }, 18, "1.03 1.04 1.05");
    check_labels(&(struct kd_map_scale) { 4, 4, false }, 18, "4");
    /* an invalid scale has no numbers; the search for numbers ends at once */
    check_labels(&(struct kd_map_scale) { 0, 2, true }, 18, "");
    check_labels(&(struct kd_map_scale) { -1, 2, true }, 18, "");
    check_labels(&(struct kd_map_scale) { 1, INFINITY, true }, 18, "1");
}

/* For any scale, the bar has at least two numbers, at the right positions, and the numbers do not touch. */
static void numbers_fit(void **state)
{
    (void)state;
    uint32_t seed = 7;
    for (int round = 0; round < 20000; round++) {
        double x[3];
        for (int i = 0; i < 3; i++)
            x[i] = (seed = seed * 1664525u + 1013904223u) / 4294967296.0;
        bool logarithmic = round % 2;
        double low = pow(10, 12 * x[0] - 6), length = pow(10, 6 * x[1] - 3);
        const struct kd_map_scale scale = { logarithmic ? low : low - 20,
                                            logarithmic ? low * (1 + length) : low - 20 + length, logarithmic };
        double room = 16 + 20 * x[2], end = -1;
        struct kd_tick ticks[KD_LEGEND_TICKS];
        size_t n = kd_legend_ticks(&scale, room, ticks);
        if (n < 1 || n > KD_LEGEND_TICKS)
            fail_msg("%zu numbers from %.17g to %.17g", n, scale.low, scale.high);
        for (size_t i = 0; i < n; i++) {
            double place = kd_map_scale_place(&scale, ticks[i].value),
                   half = 0.5 * (double)strlen(ticks[i].label) / room;
            assert_true(place > -1e-6 && place < 1 + 1e-6);
            assert_true(!i || place - half > end);
            assert_true(fabs(atof(ticks[i].label) - ticks[i].value) <= 0.51e-3 * fabs(ticks[i].value) + 1e-12);
            end = place + half;
        }
    }
}

static struct kd_canvas canvas_of(uint32_t width, uint32_t height, int depth, int value)
{
    size_t bytes = (size_t)3 * width * height * (depth == 16 ? 2 : 1);
    struct kd_canvas canvas = { malloc(bytes), width, height,
                                depth }; /* exact size, so that a sanitizer detects an overrun */
    assert_non_null(canvas.pixels);
    memset(canvas.pixels, value, bytes);
    return canvas;
}

static int channel(const struct kd_canvas *canvas, uint32_t x, uint32_t y, int i)
{
    size_t at = 3 * ((size_t)y * canvas->width + x) + (size_t)i;
    return canvas->bit_depth == 16 ? ((uint16_t *)canvas->pixels)[at] / 257 : ((uint8_t *)canvas->pixels)[at];
}

static const struct kd_legend bar = { .title = "r (M)", .map = KD_MAP_SEQUENTIAL, .scale = { 2, 22, false } };

/* Outside the corner the picture is unchanged; 8 and 16 bits agree to a step. */
static void a_legend_stays_in_its_corner(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 160, 90 }, { 640, 360 }, { 1280, 720 }, { 300, 2000 }, { 3000, 100 } };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        uint32_t width = sizes[k][0], height = sizes[k][1], touched = 0;
        struct kd_canvas c8 = canvas_of(width, height, 8, 200), c16 = canvas_of(width, height, 16, 200);
        assert_true(kd_legend_draw(&c8, &bar));
        assert_true(kd_legend_draw(&c16, &bar));
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++) {
                bool changed = false;
                for (int i = 0; i < 3; i++) {
                    changed = changed || channel(&c8, x, y, i) != 200;
                    assert_true(abs(channel(&c8, x, y, i) - channel(&c16, x, y, i)) <= 1);
                }
                touched += changed;
                if (changed && height > 160 && width > 300)
                    assert_true(x < width / 2 && y > height - height / 5);
            }
        assert_true(touched >= 144 * 37 * 9 / 10 && (uint64_t)touched * 4 < (uint64_t)width * height * 3);
        free(c8.pixels);
        free(c16.pixels);
    }
}

static void too_small_a_picture_has_none(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 159, 90 }, { 160, 89 }, { 1, 1 }, { 1, 5000 } };
    for (size_t k = 0; k < 4; k++) {
        struct kd_canvas canvas = canvas_of(sizes[k][0], sizes[k][1], 8, 9);
        assert_false(kd_legend_draw(&canvas, &bar));
        for (size_t i = 0; i < (size_t)3 * canvas.width * canvas.height; i++)
            assert_int_equal(((uint8_t *)canvas.pixels)[i], 9);
        free(canvas.pixels);
    }
}

/* A row through the bar has the colours of the map in order, 2 pixels a dot. */
static void the_bar_is_the_map(void **state)
{
    (void)state;
    struct kd_canvas canvas = canvas_of(1280, 720, 8, 0);
    assert_true(kd_legend_draw(&canvas, &bar));
    uint32_t y = 720 - (37 + 4) * 2 + (4 + 7 + 3) * 2 + 7, left = (4 + 16) * 2, width = 2 * 112;
    for (uint32_t i = 0; i < width; i++) {
        struct kd_map_colour c = kd_colour_map_at(KD_MAP_SEQUENTIAL, i / (width - 1.0));
        assert_int_equal(channel(&canvas, left + i, y, 0), lround(255 * c.r));
        assert_int_equal(channel(&canvas, left + i, y, 1), lround(255 * c.g));
        assert_int_equal(channel(&canvas, left + i, y, 2), lround(255 * c.b));
    }
    assert_int_equal(channel(&canvas, left - 1, y, 1), 0);
    assert_int_equal(channel(&canvas, left + width, y, 1), 0);
    free(canvas.pixels);
}

static void classes_have_boxes(void **state)
{
    (void)state;
    const struct kd_legend legend = { .title = "order", .map = KD_MAP_CATEGORICAL, .classes = 3 };
    struct kd_canvas canvas = canvas_of(320, 200, 8, 0);
    assert_true(kd_legend_draw(&canvas, &legend));
    uint32_t y = 200 - (37 + 4) + 4 + 7 + 3 + 3;
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(channel(&canvas, 20 + i * (112 / 3) + 10, y, 0),
                         lround(255 * kd_colour_map_at(KD_MAP_CATEGORICAL, i).r));
    free(canvas.pixels);
}

/* Two titles that differ only in their last letter give different pictures, since the panel is as wide as its title. */
static void a_long_title_is_whole(void **state)
{
    (void)state;
    struct kd_legend long_title = bar;
    struct kd_canvas one = canvas_of(320, 200, 8, 0), other = canvas_of(320, 200, 8, 0);
    long_title.title = "specific_intensity (Jy/sr)";
    assert_true(kd_legend_draw(&one, &long_title));
    long_title.title = "specific_intensity (Jy/sr(";
    assert_true(kd_legend_draw(&other, &long_title));
    assert_true(memcmp(one.pixels, other.pixels, (size_t)3 * 320 * 200) != 0);
    free(one.pixels);
    free(other.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_have_shapes),
        cmocka_unit_test(text_has_letters),
        cmocka_unit_test(letters_are_strokes),
        cmocka_unit_test(numbers_are_round),
        cmocka_unit_test(numbers_fit),
        cmocka_unit_test(a_legend_stays_in_its_corner),
        cmocka_unit_test(too_small_a_picture_has_none),
        cmocka_unit_test(the_bar_is_the_map),
        cmocka_unit_test(classes_have_boxes),
        cmocka_unit_test(a_long_title_is_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
