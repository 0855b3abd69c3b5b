/* Tests of the angular scale and of the beam that are drawn on a picture: lengths and places are measured in its
 * pixels. */
#include "image/legend.h"
#include "image/sky_scale.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct kd_canvas canvas_of(uint32_t width, uint32_t height, int depth, int value)
{
    const size_t bytes = (size_t)3 * width * height * (depth == 16 ? 2 : 1);
    struct kd_canvas canvas = { malloc(bytes), width, height,
                                /* the block has exactly this size, so that a sanitizer detects a write past the end */
                                depth };
    assert_non_null(canvas.pixels);
    memset(canvas.pixels, value, bytes);
    return canvas;
}

static int value(const struct kd_canvas *c, uint32_t x, uint32_t y)
{
    const size_t at = 3 * ((size_t)y * c->width + x);
    return c->bit_depth == 16 ? ((uint16_t *)c->pixels)[at] / 257 : ((uint8_t *)c->pixels)[at];
}

static void bars_are_round_and_fit(void **state)
{
    (void)state;
    for (double uas = 1e-9; uas < 1e9; uas *= 1.37) {
        const struct kd_sky_scale scale = { uas, 0 };
        const double bar = kd_sky_scale_bar(&scale, 1000), most = 250 * uas,
                     first = bar / pow(10, floor(log10(bar) + 1e-9));
        assert_true(bar <= most * (1 + 1e-12) && bar > most * 0.39); /* the largest step is from 2 to 5 */
        assert_true(fabs(first - 1) < 1e-9 || fabs(first - 2) < 1e-9 || fabs(first - 5) < 1e-9);
    }
}

/* The topmost row of changed pixels is the bar and has its length. The disk of the beam has the beam's diameter, to a
 * pixel. No other pixels change. */
static void lengths_are_to_scale(void **state)
{
    (void)state;
    static const struct {
        uint32_t width, height;
        int depth;
        double pixel_uas, beam_uas, bar_uas;
    } cases[] = {
        { 960, 540, 8, 0.2227, 20, 50 },
        { 320, 180, 16, 0.668, 20, 50 },
        { 640, 640, 8, 1, 100, 100 },
        { 2000, 1500, 8, 0.01, 2, 5 },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct kd_canvas c = canvas_of(cases[k].width, cases[k].height, cases[k].depth, 0);
        const struct kd_sky_scale scale = { cases[k].pixel_uas, cases[k].beam_uas };
        uint32_t left = c.width, right = 0, widest = 0, tallest = 0;
        assert_true(kd_sky_scale_draw(&c, &scale));
        for (uint32_t y = 0; y < c.height && !right; y++)
            for (uint32_t x = 0; x < c.width; x++)
                if (value(&c, x, y)) {
                    left = x < left ? x : left;
                    right = x;
                }
        assert_true(fabs((right + 1 - left) - cases[k].bar_uas / cases[k].pixel_uas) <= 1);
        for (uint32_t y = 0; y < c.height; y++) {
            /* the longest run counts, because the smooth edges of letters have single grey pixels */
            uint32_t run = 0, grey = 0;
            for (uint32_t x = 0; x < c.width; x++) {
                run = abs(value(&c, x, y) - 115) <= 1 ? run + 1 : 0;
                grey = run > grey ? run : grey;
            }
            widest = grey > widest ? grey : widest;
            tallest += grey > 2;
        }
        const double diameter = cases[k].beam_uas / cases[k].pixel_uas, edge = 2 * fmax(1, 0.5 * kd_legend_dot(&c));
        assert_true(fabs(widest + edge - diameter) <= 2 && fabs(tallest + edge - diameter) <= 2);
        for (uint32_t y = 0; y < c.height; y++)
            for (uint32_t x = 0; x < c.width; x++)
                assert_true(!value(&c, x, y) || (x > c.width / 2 && y < c.height / 2));
        free(c.pixels);
    }
}

/* A beam as large as the picture is not drawn, and nothing is drawn in a picture that is too small. */
static void what_has_no_room_is_left_out(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 159, 90 }, { 160, 89 }, { 1, 1 }, { 1, 5000 } };
    for (size_t k = 0; k < 4; k++) {
        struct kd_canvas c = canvas_of(sizes[k][0], sizes[k][1], 8, 9);
        assert_false(kd_sky_scale_draw(&c, &(struct kd_sky_scale) { 1, 10 }));
        for (size_t i = 0; i < (size_t)3 * c.width * c.height; i++)
            assert_int_equal(((uint8_t *)c.pixels)[i], 9);
        free(c.pixels);
    }
    struct kd_canvas with = canvas_of(400, 200, 8, 9), without = canvas_of(400, 200, 8, 9);
    assert_true(kd_sky_scale_draw(&with, &(struct kd_sky_scale) { 1, 51 }));
    assert_true(kd_sky_scale_draw(&without, &(struct kd_sky_scale) { 1, 0 }));
    assert_memory_equal(with.pixels, without.pixels, 3 * 400 * 200);
    assert_true(kd_sky_scale_draw(&with, &(struct kd_sky_scale) { 1, 49 }));
    assert_memory_not_equal(with.pixels, without.pixels, 3 * 400 * 200);
    free(with.pixels);
    free(without.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(bars_are_round_and_fit),
                                        cmocka_unit_test(lengths_are_to_scale),
                                        cmocka_unit_test(what_has_no_room_is_left_out) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
