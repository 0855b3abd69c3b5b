/* Tests of properties that any picture has, without a reference: symmetries, averages, reproducibility. */
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* With these settings linear light can be recovered from the pixels: no tone curve, no dither, 16 bits, and no
 * clipping, because g^4 stays below 16. */
#define LINEAR "\"style\":{\"exposure\":-4,\"tone_map\":\"srgb\",\"dither\":false}"
#define SIZE(w, h) "\"image\":{\"width\":" #w ",\"height\":" #h ",\"bit_depth\":16,\"critical_factor\":1}"

/* Largest difference between a pixel of `a` and the pixel of `b` at the same position, or at the mirrored position, in
 * 1/255. */
enum { FLIP_X = 1, FLIP_Y = 2 };
static double difference(const struct kd_frame *a, const struct kd_frame *b, int flip)
{
    double worst = 0;
    assert_true(a->width == b->width && a->height == b->height);
    for (uint32_t y = 0; y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++)
            for (int c = 0; c < 3; c++) {
                uint32_t bx = flip & FLIP_X ? a->width - 1 - x : x, by = flip & FLIP_Y ? a->height - 1 - y : y;
                worst = fmax(worst, fabs(studio_value(a, x, y, c) - studio_value(b, bx, by, c)));
            }
    return 255 * worst;
}

static double light_between(const struct kd_frame *f, uint32_t from, uint32_t to)
{
    double sum = 0;
    for (uint32_t y = 0; y < f->height; y++)
        for (uint32_t x = from; x < to; x++)
            for (int c = 0; c < 3; c++)
                sum += studio_light(f, x, y, c);
    return sum;
}

/* The gas turns towards +phi whatever the hole's spin: it approaches at alpha < 0. At 75 degrees g^4 differs by far
 * more than a factor of two between the sides. */
static void the_approaching_side_is_left(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":75", "\"inclination_deg\":105",
                                    "\"r\":40,\"fov_deg\":60,\"inclination_deg\":75",
                                    "\"r\":40,\"fov_deg\":60,\"inclination_deg\":75,\"observer\":\"zamo\"" };
    for (int k = 0; k < 12; k++) {
        double a = (k % 3 - 1) * 0.9;
        struct kd_frame f = studio_shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{%s}," SIZE(96, 54) "," LINEAR "}", a,
                                         cameras[k / 3]);
        double left = light_between(&f, 0, 48), right = light_between(&f, 48, 96);
        if (!(left > 2 * right && right > 0))
            fail_msg("a = %g, {%s}: %g on the left, %g on the right", a, cameras[k / 3], left, right);
        kd_frame_finish(&f);
    }
}

/* The two pictures of each pair have the same rays in another order, equal up to the last bits. The 16-bit values are
 * compared to one step of 8 bits, which is 256 steps. The disk fades at its edges, so that nothing in the picture is
 * sharp. */
static void symmetries(void **state)
{
    (void)state;
    const struct {
        const char *what, *one, *other;
        int flip;
    } pairs[] = {
        { "left and right without spin and Doppler shift", "\"spacetime\":{\"spin\":0},\"disk\":{\"doppler\":false}",
          "\"spacetime\":{\"spin\":0},\"disk\":{\"doppler\":false}", FLIP_X },
        { "left and right edge-on without spin",
          "\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":90},\"disk\":{\"doppler\":false}",
          "\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":90},\"disk\":{\"doppler\":false}", FLIP_X },
        { "above and below the plane", "\"camera\":{\"inclination_deg\":70}", "\"camera\":{\"inclination_deg\":110}",
          FLIP_Y },
        { "above and below, retrograde", "\"spacetime\":{\"spin\":-0.8},\"camera\":{\"inclination_deg\":25}",
          "\"spacetime\":{\"spin\":-0.8},\"camera\":{\"inclination_deg\":155}", FLIP_Y },
        { "above and below, near", "\"camera\":{\"r\":30,\"inclination_deg\":60}",
          "\"camera\":{\"r\":30,\"inclination_deg\":120}", FLIP_Y },
        { "roll by half a turn", "\"camera\":{\"inclination_deg\":70}",
          "\"camera\":{\"inclination_deg\":70,\"roll_deg\":180}", FLIP_X | FLIP_Y },
        { "roll by half a turn, near", "\"camera\":{\"r\":30,\"observer\":\"zamo\"}",
          "\"camera\":{\"r\":30,\"observer\":\"zamo\",\"roll_deg\":-180}", FLIP_X | FLIP_Y },
        { "roll by a whole turn, looking aside", "\"camera\":{\"r\":30,\"yaw_deg\":5,\"pitch_deg\":3}",
          "\"camera\":{\"r\":30,\"yaw_deg\":5,\"pitch_deg\":3,\"roll_deg\":360}", 0 },
        { "azimuth, which does not change the disk", "\"camera\":{\"azimuth_deg\":0}",
          "\"camera\":{\"azimuth_deg\":77}", 0 },
        { "mass and rate, which do not change a chosen temperature", "\"disk\":{\"mdot_edd\":0.1}",
          "\"disk\":{\"mdot_edd\":3},\"spacetime\":{\"mass_msun\":10}", 0 },
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct kd_frame a = studio_shoot("{%s," SIZE(128, 72) "," LINEAR "}", pairs[i].one);
        struct kd_frame b = studio_shoot("{%s," SIZE(128, 72) "," LINEAR "}", pairs[i].other);
        double d = difference(&a, &b, pairs[i].flip);
        if (!(d <= 1))
            fail_msg("%s: off by %g/255", pairs[i].what, d);
        assert_true(light_between(&a, 0, a.width) > 1); /* the total light shows that the picture is not black */
        kd_frame_finish(&a);
        kd_frame_finish(&b);
    }
}

/* If the camera is turned clockwise by a quarter turn, a pixel on the right shows what was below before. */
static void a_quarter_turn(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":70", "\"r\":30,\"inclination_deg\":70" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame level = studio_shoot("{\"camera\":{%s}," SIZE(96, 96) "," LINEAR "}", cameras[k]);
        struct kd_frame rolled =
            studio_shoot("{\"camera\":{%s,\"roll_deg\":90}," SIZE(96, 96) "," LINEAR "}", cameras[k]);
        for (uint32_t y = 0; y < 96; y++)
            for (uint32_t x = 0; x < 96; x++)
                for (int c = 0; c < 3; c++)
                    if (!(fabs(studio_value(&rolled, x, y, c) - studio_value(&level, 95 - y, x, c)) <= 1.0 / 255))
                        fail_msg("{%s}: (%u, %u) is not what was at (%u, %u)", cameras[k], x, y, 95 - y, x);
        kd_frame_finish(&level);
        kd_frame_finish(&rolled);
    }
}

/* Pictures without the symmetry differ. The pairs above are therefore not equal merely because they are blank. */
static void asymmetries(void **state)
{
    (void)state;
    struct kd_frame a = studio_shoot("{\"camera\":{\"inclination_deg\":70}," SIZE(128, 72) "," LINEAR "}");
    assert_true(difference(&a, &a, FLIP_X) > 20);
    assert_true(difference(&a, &a, FLIP_Y) > 20);
    assert_true(difference(&a, &a, 0) == 0);
    kd_frame_finish(&a);
}

/* The rays of 2 x 2 samples are the pixels of a picture twice as large. The average of these pixels in linear light
 * equals the pixel, up to the rounding to 16 bits. A step of 16 bits is at most 4e-5 in linear light. */
static void samples_are_averages(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":80", "\"r\":25,\"inclination_deg\":80,\"roll_deg\":10" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame f = studio_shoot("{\"camera\":{%s},\"image\":{\"width\":60,\"height\":40,\"bit_depth\":16,"
                                         "\"samples\":2,\"critical_factor\":1}," LINEAR "}",
                                         cameras[k]);
        struct kd_frame big = studio_shoot("{\"camera\":{%s}," SIZE(120, 80) "," LINEAR "}", cameras[k]);
        for (uint32_t y = 0; y < 40; y++)
            for (uint32_t x = 0; x < 60; x++)
                for (int c = 0; c < 3; c++) {
                    double mean =
                        0.25 * (studio_light(&big, 2 * x, 2 * y, c) + studio_light(&big, 2 * x + 1, 2 * y, c) +
                                studio_light(&big, 2 * x, 2 * y + 1, c) + studio_light(&big, 2 * x + 1, 2 * y + 1, c));
                    double got = studio_light(&f, x, y, c);
                    if (!(fabs(got - mean) < 8e-5))
                        fail_msg("{%s}: pixel (%u, %u): %g, not %g", cameras[k], x, y, got, mean);
                }
        kd_frame_finish(&f);
        kd_frame_finish(&big);
    }
}

/* A stop is a factor of two in linear light. The resolution of 16 bits is 1e-3 of any value above 0.004. */
static void a_stop_is_a_factor_of_two(void **state)
{
    (void)state;
    const char *scene = "{\"style\":{\"exposure\":%d,\"tone_map\":\"srgb\",\"dither\":false}," SIZE(80, 45) "}";
    struct kd_frame dim = studio_shoot(scene, -5), bright = studio_shoot(scene, -4);
    int counted = 0;
    for (uint32_t y = 0; y < 45; y++)
        for (uint32_t x = 0; x < 80; x++)
            for (int c = 0; c < 3; c++) {
                double one = studio_light(&dim, x, y, c);
                if (one < 0.004)
                    continue;
                counted++;
                if (!(fabs(studio_light(&bright, x, y, c) / one - 2) < 4e-3))
                    fail_msg("pixel (%u, %u): %g and %g", x, y, one, studio_light(&bright, x, y, c));
            }
    assert_true(counted > 200);
    kd_frame_finish(&dim);
    kd_frame_finish(&bright);
}

/* The same scene gives the same bytes: from a cached lens map, and from a fresh renderer. */
static void the_same_bytes(void **state)
{
    (void)state;
    const char *const scenes[] = { "{\"image\":{\"width\":161,\"height\":91}}",
                                   "{\"camera\":{\"r\":12},\"sky\":{\"model\":\"grid\"},\"disk\":{\"opacity\":0.5},"
                                   "\"image\":{\"width\":161,\"height\":91,\"bit_depth\":16}}" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame first = studio_shoot("%s", scenes[k]), kept = studio_shoot("%s", scenes[k]);
        size_t size = 161 * 91 * 3 * (size_t)kd_frame_bit_depth(&first) / 8;
        assert_true(kept.lens_reused);
        assert_memory_equal(kd_frame_pixels(&first), kd_frame_pixels(&kept), size);
        studio_close();
        assert_int_equal(studio_open(), 0);
        struct kd_frame fresh = studio_shoot("%s", scenes[k]);
        assert_false(fresh.lens_reused);
        assert_memory_equal(kd_frame_pixels(&first), kd_frame_pixels(&fresh), size);
        kd_frame_finish(&first);
        kd_frame_finish(&kept);
        kd_frame_finish(&fresh);
    }
}

/* Area, centre and extent, in pixels, of the bright part of a picture. */
struct shape { double area, x, y, xx, yy; };
static struct shape shape_of(const struct kd_frame *f)
{
    struct shape s = { 0 };
    for (uint32_t y = 0; y < f->height; y++)
        for (uint32_t x = 0; x < f->width; x++) {
            if (studio_black(f, x, y))
                continue;
            s.area++;
            s.x += x, s.y += y;
        }
    s.x /= s.area, s.y /= s.area;
    for (uint32_t y = 0; y < f->height; y++)
        for (uint32_t x = 0; x < f->width; x++)
            if (!studio_black(f, x, y))
                s.xx += pow(x - s.x, 2) / s.area, s.yy += pow(y - s.y, 2) / s.area;
    s.xx = sqrt(s.xx), s.yy = sqrt(s.yy);
    return s;
}

/* At r = 1000 M a disk of 20 M has 2 % of perspective, and 0.2 % of light bending. The tolerance of the shape is
 * therefore 3 %. Half of the picture's height is 0.0115 rad there. */
static void far_away_is_infinity(void **state)
{
    (void)state;
    const char *disk =
        "\"disk\":{\"outer\":20,\"taper\":0},\"style\":{\"exposure\":4,\"dither\":false}," SIZE(200, 120);
    double fov = 2 * atan(0.5 * 46 / 1000) * 180 / M_PI;
    for (int k = 0; k < 6; k++) {
        double a = k % 3 * 0.45;
        struct kd_frame near =
            studio_shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{\"r\":1000,\"fov_deg\":%.9g,\"observer\":\"%s\","
                         "\"inclination_deg\":70},%s}",
                         a, fov, k < 3 ? "static" : "zamo", disk);
        struct kd_frame far = studio_shoot(
            "{\"spacetime\":{\"spin\":%g},\"camera\":{\"field_m\":46,\"inclination_deg\":70},%s}", a, disk);
        struct shape p = shape_of(&near), q = shape_of(&far);
        if (!(fabs(p.area / q.area - 1) < 0.03 && fabs(p.xx / q.xx - 1) < 0.03 && fabs(p.yy / q.yy - 1) < 0.03 &&
              fabs(p.x - q.x) < 0.5 && fabs(p.y - q.y) < 0.03 * q.yy + 0.5))
            fail_msg("a = %g: area %g, centre (%g, %g), extent (%g, %g), at infinity %g, (%g, %g), (%g, %g)", a, p.area,
                     p.x, p.y, p.xx, p.yy, q.area, q.x, q.y, q.xx, q.yy);
        double ratio = light_between(&near, 0, 200) / light_between(&far, 0, 200);
        assert_true(fabs(ratio - 1) < 0.03);
        kd_frame_finish(&near);
        kd_frame_finish(&far);
    }
}

/* Fully transparent gas gives the sky of a scene without a disk. The computation of the rays continues from another
 * crossing, and the grid's lines are sharp. One pixel in 200 may therefore differ. */
static void a_transparent_disk(void **state)
{
    (void)state;
    const char *scene = "{\"disk\":{%s},\"sky\":{\"model\":\"grid\",\"brightness\":1},\"style\":{"
                        "\"exposure\":-2,\"tone_map\":\"srgb\","
                        "\"dither\":false}," SIZE(120, 80) "}";
    struct kd_frame none = studio_shoot(scene, "\"model\":\"none\""), clear = studio_shoot(scene, "\"opacity\":0");
    struct kd_frame thin = studio_shoot(scene, "\"opacity\":0.01"), thick = studio_shoot(scene, "\"opacity\":1");
    int off = 0;
    double change[2] = { 0 };
    for (uint32_t y = 0; y < 80; y++)
        for (uint32_t x = 0; x < 120; x++) {
            double l = studio_light(&clear, x, y, 0);
            off += fabs(l - studio_light(&none, x, y, 0)) > 1e-3;
            change[0] += fabs(l - studio_light(&thin, x, y, 0));
            change[1] += fabs(l - studio_light(&thick, x, y, 0));
        }
    assert_in_range(off, 0, 48);
    /* A hundredth of the opacity changes the picture by about a hundredth, and by more where light passes several
     * times. */
    assert_true(change[0] > 0.008 * change[1] && change[0] < 0.03 * change[1]);
    kd_frame_finish(&none);
    kd_frame_finish(&clear);
    kd_frame_finish(&thin);
    kd_frame_finish(&thick);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_approaching_side_is_left),
        cmocka_unit_test(symmetries),
        cmocka_unit_test(a_quarter_turn),
        cmocka_unit_test(asymmetries),
        cmocka_unit_test(samples_are_averages),
        cmocka_unit_test(a_stop_is_a_factor_of_two),
        cmocka_unit_test(the_same_bytes),
        cmocka_unit_test(far_away_is_infinity),
        cmocka_unit_test(a_transparent_disk),
    };
    int code = studio_open();
    if (code)
        return code;
    code = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return code;
}
