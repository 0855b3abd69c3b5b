/* Tests of colour maps by the lightness and hue of displayed colours: sRGB is decoded, converted to XYZ by the
 * standard's matrix, and then to CIELAB. */
#include "image/colour_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

struct lab { double l, a, b; };

static double decode(double c) { return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4); }
static double cube_root(double t) { return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116; }

/* The matrix of IEC 61966-2-1 from linear RGB to XYZ. It is the inverse of the matrix with which the maps are made. */
static struct lab lab_of(struct kd_map_colour c)
{
    double r = decode(c.r), g = decode(c.g), b = decode(c.b);
    double x = cube_root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505),
           y = cube_root(0.2126 * r + 0.7152 * g + 0.0722 * b);
    double z = cube_root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890);
    return (struct lab) { 116 * y - 16, 500 * (x - y), 200 * (y - z) };
}

static double distance(struct lab p, struct lab q)
{
    return sqrt(pow(p.l - q.l, 2) + pow(p.a - q.a, 2) + pow(p.b - q.b, 2));
}

static void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within))
        fail_msg("%.9g is not %.9g within %g", value, wanted, within);
}

enum { STEPS = 400 };

/* Lightness rises by the same amount at each step, and colours do not jump. */
static void lightness_rises_at_a_constant_rate(void **state)
{
    (void)state;
    static const struct {
        enum kd_colour_map map;
        double low, high;
    } maps[] = {
        { KD_MAP_SEQUENTIAL, 8, 94 },
        { KD_MAP_HEAT, 0, 100 },
    };
    for (size_t k = 0; k < 2; k++) {
        struct lab last = lab_of(kd_colour_map_at(maps[k].map, 0));
        assert_near(last.l, maps[k].low, 0.02);
        for (int i = 1; i <= STEPS; i++) {
            struct lab now = lab_of(kd_colour_map_at(maps[k].map, i / (double)STEPS));
            assert_near(now.l - last.l, (maps[k].high - maps[k].low) / STEPS, 0.02);
            assert_true(distance(now, last) < 2.5);
            last = now;
        }
        assert_near(last.l, maps[k].high, 0.02);
    }
}

static void a_diverging_map_has_a_white_middle_and_equal_sides(void **state)
{
    (void)state;
    struct lab middle = lab_of(kd_colour_map_at(KD_MAP_DIVERGING, 0.5));
    assert_near(middle.l, 94, 0.02);
    assert_near(hypot(middle.a, middle.b), 0, 0.1);
    for (int i = 1; i <= STEPS; i++) {
        double x = 0.5 + 0.5 * i / STEPS;
        struct lab up = lab_of(kd_colour_map_at(KD_MAP_DIVERGING, x)),
                   down = lab_of(kd_colour_map_at(KD_MAP_DIVERGING, 1 - x));
        assert_near(up.l, down.l, 0.02);
        assert_near(up.l, 94 - 58.0 * i / STEPS, 0.02);
        assert_true(up.b < 0 && down.a > 0); /* blue; red */
    }
}

/* The two ends have the same colour, lightness is constant, and equal steps change the hue equally. */
static void a_cyclic_map_closes(void **state)
{
    (void)state;
    struct kd_map_colour start = kd_colour_map_at(KD_MAP_CYCLIC, 0), end = kd_colour_map_at(KD_MAP_CYCLIC, 1);
    assert_true(start.r == end.r && start.g == end.g && start.b == end.b);
    struct lab last = lab_of(start);
    for (int i = 1; i <= STEPS; i++) {
        struct lab now = lab_of(kd_colour_map_at(KD_MAP_CYCLIC, i / (double)STEPS));
        assert_near(now.l, 70, 0.03);
        assert_near(distance(now, last), 2 * 38 * sin(M_PI / STEPS), 0.02);
        last = now;
    }
}

static void classes_differ(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < i; j++)
            assert_true(distance(lab_of(kd_colour_map_at(KD_MAP_CATEGORICAL, i)),
                                 lab_of(kd_colour_map_at(KD_MAP_CATEGORICAL, j))) > 25);
}

static void a_table_is_the_map(void **state)
{
    (void)state;
    for (int map = KD_MAP_SEQUENTIAL; map <= KD_MAP_CYCLIC; map++) {
        struct kd_map_table table;
        kd_colour_map_fill(&table, (enum kd_colour_map)map);
        for (int i = -10; i <= 10 * STEPS; i++) {
            double x = i / (10.0 * STEPS - 10);
            struct kd_map_colour own = kd_colour_map_at((enum kd_colour_map)map, x), kept = kd_map_table_at(&table, x);
            /* bound: half an entry of the table, where the map is steepest, from violet to blue */
            assert_near(kept.r, own.r, 1.0 / 150);
            assert_near(kept.g, own.g, 1.0 / 150);
            assert_near(kept.b, own.b, 1.0 / 150);
        }
        assert_true(kd_map_table_at(&table, NAN).r == table.at[0].r);
    }
    struct kd_map_table classes;
    kd_colour_map_fill(&classes, KD_MAP_CATEGORICAL);
    for (int i = 0; i < 9; i++)
        assert_near(classes.at[i].g, kd_colour_map_at(KD_MAP_CATEGORICAL, i).g, 0);
}

static void scales_place_numbers(void **state)
{
    (void)state;
    const struct kd_map_scale linear = { -2, 6, false }, logarithmic = { 0.1, 1000, true }, down = { 1, 0, false },
                              none = { 3, 3, false };
    assert_near(kd_map_scale_place(&linear, 0), 0.25, 1e-15);
    assert_near(kd_map_scale_place(&linear, 7), 1.125, 1e-15);
    assert_near(kd_map_scale_place(&logarithmic, 1), 0.25, 1e-15);
    assert_near(kd_map_scale_place(&logarithmic, 0.01), -0.25, 1e-15);
    assert_near(kd_map_scale_place(&down, 0.25), 0.75, 1e-15);
    assert_near(kd_map_scale_place(&none, 3), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lightness_rises_at_a_constant_rate),
        cmocka_unit_test(a_diverging_map_has_a_white_middle_and_equal_sides),
        cmocka_unit_test(a_cyclic_map_closes),
        cmocka_unit_test(classes_differ),
        cmocka_unit_test(a_table_is_the_map),
        cmocka_unit_test(scales_place_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
