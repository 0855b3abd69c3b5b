/* What must hold for any picture, without a reference: the shadow's outline, symmetries, averages, repetition. */
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Linear light can be read back from these: no film curve, no dither, nothing clipped (g^4 stays below 16), 16 bits. */
#define LINEAR "\"style\":{\"exposure\":-4,\"tone_map\":\"srgb\",\"dither\":false}"
#define SIZE(w, h) "\"image\":{\"width\":" #w ",\"height\":" #h ",\"bit_depth\":16}"

static struct kd_frame __attribute__((format(printf, 1, 2))) shoot(const char *format, ...)
{
    char json[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(json, sizeof json, format, list);
    va_end(list);
    return studio_shoot(json);
}

/* Largest difference between a pixel of `a` and the one of `b` at the same place, or mirrored, in 1/255. */
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

/* The outline of the shadow for an observer at infinity: (alpha, beta) of the spherical photon orbits (Bardeen 1973), of
 * which the code under test knows nothing. The upper half from left to right in beta >= 0; a = 0 is a circle. */
#define OUTLINE 400
static int outline(double a, double inclination, double alpha[OUTLINE], double beta[OUTLINE])
{
    int n = 0;
    double s = sin(inclination), c = cos(inclination);
    for (int i = 0; i < OUTLINE; i++) {
        double al, be2;
        if (a == 0) {
            al = -sqrt(27) * cos(M_PI * i / (OUTLINE - 1));
            be2 = 27 - al * al;
        } else { /* r between the two equatorial photon orbits */
            double low = 2 + 2 * cos(2.0 / 3 * acos(-fabs(a))), high = 2 + 2 * cos(2.0 / 3 * acos(fabs(a)));
            double r = 0.5 * (low + high) - 0.5 * (high - low) * cos(M_PI * i / (OUTLINE - 1));
            double xi = (r * r * (3 - r) - a * a * (r + 1)) / (a * (r - 1));
            double eta = r * r * r * (4 * a * a - r * (r - 3) * (r - 3)) / (a * a * (r - 1) * (r - 1));
            al = -xi / s;
            be2 = eta + a * a * c * c - xi * xi * c * c / (s * s);
        }
        if (be2 >= -1e-9)
            alpha[n] = al, beta[n++] = sqrt(fmax(be2, 0));
    }
    return n;
}

/* Half height of the outline at this alpha, -1 beside it. */
static double half_height(const double *alpha, const double *beta, int n, double at)
{
    for (int i = 0; i + 1 < n; i++) {
        double t = (at - alpha[i]) / (alpha[i + 1] - alpha[i]);
        if (t >= 0 && t <= 1)
            return beta[i] + t * (beta[i + 1] - beta[i]);
    }
    return -1;
}

/* Every ray inside the outline is black, every ray outside it sees the sky, which is nowhere black. A twentieth of M aside:
 * the polygon and single precision are some 1e-4. */
static void the_shadow_has_bardeens_outline(void **state)
{
    (void)state;
    const double spins[] = { 0, 0.5, 0.9, 0.998, -0.9 }, inclinations[] = { 15, 60, 90, 140 };
    const double margin = 0.05, field = 16;
    for (int k = 0; k < 20; k++) {
        double a = spins[k % 5], i = inclinations[k / 5], alpha[OUTLINE], beta[OUTLINE];
        int n = outline(a, i * M_PI / 180, alpha, beta), inside = 0;
        struct kd_frame f = shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{\"inclination_deg\":%g,\"field_m\":%g},"
                                  "\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"grid\",\"brightness\":1},"
                                  "\"style\":{\"exposure\":0}," SIZE(128, 128) "}", a, i, field);
        for (uint32_t y = 0; y < 128; y++)
            for (uint32_t x = 0; x < 128; x++) {
                double al = (x + 0.5 - 64) * field / 128, be = fabs((63.5 - y) * field / 128);
                double left = half_height(alpha, beta, n, al - margin), right = half_height(alpha, beta, n, al + margin);
                double low = fmin(left, right) - margin, high = fmax(left, right) + margin;
                bool black = studio_black(&f, x, y);
                inside += black;
                if ((be < low && !black) || (be > high + margin && black))
                    fail_msg("a = %g, i = %g: (%g, %g) is %s", a, i, al, be, black ? "black" : "not black");
            }
        assert_in_range(inside, 4000, 6000); /* the shadow's area is 80 to 85 M^2, a pixel 1/64 */
        kd_frame_finish(&f);
    }
}

/* Synge 1966: an observer at rest at r sees the hole under sin(angle) = sqrt(27 (1 - 2/r))/r, more than a right angle inside
 * r = 3. Looking away (yaw 180) is looking at the rest of the sky. */
static void the_shadow_has_synges_angle(void **state)
{
    (void)state;
    const struct { double r, fov; int yaw; const char *observer; } cases[] = {
        { 6, 120, 0, "static" }, { 6, 120, 0, "zamo" }, { 20, 40, 0, "static" }, { 1000, 1, 0, "static" },
        { 3.5, 160, 0, "static" }, { 2.5, 150, 180, "static" }, { 2.1, 120, 180, "zamo" },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double r = cases[k].r, edge = asin(sqrt(27 * (1 - 2 / r)) / r); /* from the hole, or inside 3 from the sky */
        bool away = cases[k].yaw;
        int seen[2] = { 0 };
        struct kd_frame f = shoot("{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":%g,\"observer\":\"%s\",\"fov_deg\":%g,"
                                  "\"yaw_deg\":%d,\"inclination_deg\":50},\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":"
                                  "\"grid\",\"brightness\":1},\"style\":{\"exposure\":0}," SIZE(101, 101) "}",
                                  r, cases[k].observer, cases[k].fov, cases[k].yaw);
        for (uint32_t y = 0; y < 101; y++)
            for (uint32_t x = 0; x < 101; x++) {
                double angle = atan(hypot(x - 50.0, y - 50.0) / 50.5 * tan(0.5 * cases[k].fov * M_PI / 180));
                bool black = studio_black(&f, x, y);
                seen[black]++;
                if (fabs(angle / edge - 1) > 0.005 && black != (away ? angle > edge : angle < edge))
                    fail_msg("r = %g: %g degrees off the axis, edge at %g, is %s", r, angle * 180 / M_PI, edge * 180 / M_PI,
                             black ? "black" : "not black");
            }
        assert_true(seen[0] > 200 && seen[1] > 200);
        kd_frame_finish(&f);
    }
}

/* Face on without spin: the direct image of radius r lies at about b = r + 1, of the ISCO at 7; what passes within 5.2 falls
 * in after one crossing. Neither the film curve nor the dither may lift black. */
static void the_hole_in_the_disk_is_black(void **state)
{
    (void)state;
    struct kd_frame f = studio_shoot("{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":0,\"field_m\":24},"
                                     "\"image\":{\"width\":120,\"height\":120},\"style\":{\"exposure\":8}}");
    for (uint32_t y = 0; y < 120; y++)
        for (uint32_t x = 0; x < 120; x++) {
            double b = hypot(x - 59.5, y - 59.5) * 0.2;
            if (b < 4.9 ? !studio_black(&f, x, y) : b > 8 && b < 11 && studio_black(&f, x, y))
                fail_msg("b = %g is %s", b, b < 4.9 ? "not black" : "black");
        }
    kd_frame_finish(&f);
}

/* The gas turns towards +phi whatever the hole does: it approaches at alpha < 0. At 75 degrees the g^4 of the two sides
 * differ by far more than a factor of two. */
static void the_approaching_side_is_left(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":75", "\"inclination_deg\":105",
                                    "\"r\":40,\"fov_deg\":60,\"inclination_deg\":75",
                                    "\"r\":40,\"fov_deg\":60,\"inclination_deg\":75,\"observer\":\"zamo\"" };
    for (int k = 0; k < 12; k++) {
        double a = (k % 3 - 1) * 0.9;
        struct kd_frame f = shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{%s}," SIZE(96, 54) "," LINEAR "}", a,
                                  cameras[k / 3]);
        double left = light_between(&f, 0, 48), right = light_between(&f, 48, 96);
        if (!(left > 2 * right && right > 0))
            fail_msg("a = %g, {%s}: %g on the left, %g on the right", a, cameras[k / 3], left, right);
        kd_frame_finish(&f);
    }
}

/* Each of these pairs is the same rays in another order, up to the last bits; a step of 8 bits is 256 times the step of
 * the 16 that are compared. The disk fades at its edges and nothing else is sharp. */
static void symmetries(void **state)
{
    (void)state;
    const struct { const char *what, *one, *other; int flip; } pairs[] = {
        { "left and right without spin and Doppler shift", "\"spacetime\":{\"spin\":0},\"disk\":{\"doppler\":false}",
          "\"spacetime\":{\"spin\":0},\"disk\":{\"doppler\":false}", FLIP_X },
        { "left and right edge-on without spin", "\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":90},"
          "\"disk\":{\"doppler\":false}", "\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":90},"
          "\"disk\":{\"doppler\":false}", FLIP_X },
        { "above and below the plane", "\"camera\":{\"inclination_deg\":70}", "\"camera\":{\"inclination_deg\":110}", FLIP_Y },
        { "above and below, retrograde", "\"spacetime\":{\"spin\":-0.8},\"camera\":{\"inclination_deg\":25}",
          "\"spacetime\":{\"spin\":-0.8},\"camera\":{\"inclination_deg\":155}", FLIP_Y },
        { "above and below, near", "\"camera\":{\"r\":30,\"inclination_deg\":60}",
          "\"camera\":{\"r\":30,\"inclination_deg\":120}", FLIP_Y },
        { "roll by half a turn", "\"camera\":{\"inclination_deg\":70}", "\"camera\":{\"inclination_deg\":70,\"roll_deg\":180}",
          FLIP_X | FLIP_Y },
        { "roll by half a turn, near", "\"camera\":{\"r\":30,\"observer\":\"zamo\"}",
          "\"camera\":{\"r\":30,\"observer\":\"zamo\",\"roll_deg\":-180}", FLIP_X | FLIP_Y },
        { "azimuth, of which the disk knows nothing", "\"camera\":{\"azimuth_deg\":0}", "\"camera\":{\"azimuth_deg\":77}", 0 },
        { "pitched over the top", "\"camera\":{\"r\":30,\"yaw_deg\":5,\"pitch_deg\":3}",
          "\"camera\":{\"r\":30,\"yaw_deg\":5,\"pitch_deg\":3,\"roll_deg\":360}", 0 },
        { "mass and rate, of which a chosen temperature knows nothing", "\"disk\":{\"mdot_edd\":0.1}",
          "\"disk\":{\"mdot_edd\":3},\"spacetime\":{\"mass_msun\":10}", 0 },
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct kd_frame a = shoot("{%s," SIZE(128, 72) "," LINEAR "}", pairs[i].one);
        struct kd_frame b = shoot("{%s," SIZE(128, 72) "," LINEAR "}", pairs[i].other);
        double d = difference(&a, &b, pairs[i].flip);
        if (!(d <= 1))
            fail_msg("%s: off by %g/255", pairs[i].what, d);
        assert_true(light_between(&a, 0, a.width) > 1); /* there is something to see */
        kd_frame_finish(&a);
        kd_frame_finish(&b);
    }
}

/* A camera turned clockwise by a quarter has its right-hand side down: a pixel to the right shows what was below. */
static void a_quarter_turn(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":70", "\"r\":30,\"inclination_deg\":70" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame level = shoot("{\"camera\":{%s}," SIZE(96, 96) "," LINEAR "}", cameras[k]);
        struct kd_frame rolled = shoot("{\"camera\":{%s,\"roll_deg\":90}," SIZE(96, 96) "," LINEAR "}", cameras[k]);
        for (uint32_t y = 0; y < 96; y++)
            for (uint32_t x = 0; x < 96; x++)
                for (int c = 0; c < 3; c++)
                    if (!(fabs(studio_value(&rolled, x, y, c) - studio_value(&level, 95 - y, x, c)) <= 1.0 / 255))
                        fail_msg("{%s}: (%u, %u) is not what was at (%u, %u)", cameras[k], x, y, 95 - y, x);
        kd_frame_finish(&level);
        kd_frame_finish(&rolled);
    }
}

/* And the picture is not blind to them: what the pairs above share is no blank. */
static void asymmetries(void **state)
{
    (void)state;
    struct kd_frame a = shoot("{\"camera\":{\"inclination_deg\":70}," SIZE(128, 72) "," LINEAR "}");
    assert_true(difference(&a, &a, FLIP_X) > 20);
    assert_true(difference(&a, &a, FLIP_Y) > 20);
    assert_true(difference(&a, &a, 0) == 0);
    kd_frame_finish(&a);
}

/* The rays of 2 x 2 samples are the pixels of a picture twice as large: the average in linear light is the same up to the
 * rounding to 16 bits, whose step in linear light is at most 4e-5. */
static void samples_are_averages(void **state)
{
    (void)state;
    const char *const cameras[] = { "\"inclination_deg\":80", "\"r\":25,\"inclination_deg\":80,\"roll_deg\":10" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame f = shoot("{\"camera\":{%s},\"image\":{\"width\":60,\"height\":40,\"bit_depth\":16,\"samples\":2}," LINEAR "}",
                                  cameras[k]);
        struct kd_frame big = shoot("{\"camera\":{%s}," SIZE(120, 80) "," LINEAR "}", cameras[k]);
        for (uint32_t y = 0; y < 40; y++)
            for (uint32_t x = 0; x < 60; x++)
                for (int c = 0; c < 3; c++) {
                    double mean = 0.25 * (studio_light(&big, 2 * x, 2 * y, c) + studio_light(&big, 2 * x + 1, 2 * y, c) +
                                          studio_light(&big, 2 * x, 2 * y + 1, c) + studio_light(&big, 2 * x + 1, 2 * y + 1, c));
                    double got = studio_light(&f, x, y, c);
                    if (!(fabs(got - mean) < 8e-5))
                        fail_msg("{%s}: pixel (%u, %u): %g, not %g", cameras[k], x, y, got, mean);
                }
        kd_frame_finish(&f);
        kd_frame_finish(&big);
    }
}

/* A stop is a factor of two in linear light. 16 bits resolve 1e-3 of anything above 0.004. */
static void a_stop_is_a_factor_of_two(void **state)
{
    (void)state;
    const char *scene = "{\"style\":{\"exposure\":%d,\"tone_map\":\"srgb\",\"dither\":false}," SIZE(80, 45) "}";
    struct kd_frame dim = shoot(scene, -5), bright = shoot(scene, -4);
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

/* The same scene gives the same bytes: from a lens map that was kept, and from a renderer that has seen nothing. */
static void the_same_bytes(void **state)
{
    (void)state;
    const char *const scenes[] = { "{\"image\":{\"width\":161,\"height\":91}}",
                                   "{\"camera\":{\"r\":12},\"sky\":{\"model\":\"grid\"},\"disk\":{\"opacity\":0.5},"
                                   "\"image\":{\"width\":161,\"height\":91,\"bit_depth\":16}}" };
    for (int k = 0; k < 2; k++) {
        struct kd_frame first = studio_shoot(scenes[k]), kept = studio_shoot(scenes[k]);
        size_t size = 161 * 91 * 3 * (size_t)first.bit_depth / 8;
        assert_true(kept.lens_reused);
        assert_memory_equal(first.pixels, kept.pixels, size);
        studio_close();
        assert_int_equal(studio_open(), 0);
        struct kd_frame fresh = studio_shoot(scenes[k]);
        assert_false(fresh.lens_reused);
        assert_memory_equal(first.pixels, fresh.pixels, size);
        kd_frame_finish(&first);
        kd_frame_finish(&kept);
        kd_frame_finish(&fresh);
    }
}

/* Area, centre and extent of what is lit, in pixels. */
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

/* From r = 1000 a disk of 20 M is seen in a perspective of 2 % and the light is bent by another 0.2 %: 3 % in shape. Half a
 * picture height is 0.0115 rad there. */
static void far_away_is_infinity(void **state)
{
    (void)state;
    const char *disk = "\"disk\":{\"outer\":20,\"taper\":0},\"style\":{\"exposure\":4,\"dither\":false}," SIZE(200, 120);
    double fov = 2 * atan(0.5 * 46 / 1000) * 180 / M_PI;
    for (int k = 0; k < 6; k++) {
        double a = k % 3 * 0.45;
        struct kd_frame near = shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{\"r\":1000,\"fov_deg\":%.9g,\"observer\":\"%s\","
                                     "\"inclination_deg\":70},%s}", a, fov, k < 3 ? "static" : "zamo", disk);
        struct kd_frame far = shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{\"field_m\":46,\"inclination_deg\":70},%s}", a, disk);
        struct shape p = shape_of(&near), q = shape_of(&far);
        if (!(fabs(p.area / q.area - 1) < 0.03 && fabs(p.xx / q.xx - 1) < 0.03 && fabs(p.yy / q.yy - 1) < 0.03 &&
              fabs(p.x - q.x) < 0.5 && fabs(p.y - q.y) < 0.03 * q.yy + 0.5))
            fail_msg("a = %g: area %g, centre (%g, %g), extent (%g, %g), at infinity %g, (%g, %g), (%g, %g)", a, p.area, p.x, p.y,
                     p.xx, p.yy, q.area, q.x, q.y, q.xx, q.yy);
        double ratio = light_between(&near, 0, 200) / light_between(&far, 0, 200);
        assert_true(fabs(ratio - 1) < 0.03);
        kd_frame_finish(&near);
        kd_frame_finish(&far);
    }
}

/* Gas that lets everything pass is no gas: the sky of a scene without a disk. Rays are followed from another crossing on, and
 * the lines of the grid are sharp: a pixel in 200 may differ. Half opaque is between. */
static void a_transparent_disk(void **state)
{
    (void)state;
    const char *scene = "{\"disk\":{%s},\"sky\":{\"model\":\"grid\",\"brightness\":1},\"style\":{\"exposure\":-2,\"tone_map\":\"srgb\","
                        "\"dither\":false}," SIZE(120, 80) "}";
    struct kd_frame none = shoot(scene, "\"model\":\"none\""), clear = shoot(scene, "\"opacity\":0");
    struct kd_frame thin = shoot(scene, "\"opacity\":0.01"), thick = shoot(scene, "\"opacity\":1");
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
    /* a hundredth of the opacity is a hundredth of the change, and more where the light passes several times */
    assert_true(change[0] > 0.008 * change[1] && change[0] < 0.03 * change[1]);
    kd_frame_finish(&none);
    kd_frame_finish(&clear);
    kd_frame_finish(&thin);
    kd_frame_finish(&thick);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shadow_has_bardeens_outline),
        cmocka_unit_test(the_shadow_has_synges_angle),
        cmocka_unit_test(the_hole_in_the_disk_is_black),
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
