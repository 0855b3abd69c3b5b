/* Tests of visibilities, for maps whose transforms are known: a uniform disk (2 J1(x)/x), a thin ring (J0(x)), a
 * Gaussian (a Gaussian) (Thompson, Moran & Swenson 2017, table 2.1), and a point (a phase). */
#include "integral/fourier.h"
#include "integral/pictures.h"
#include "integral/request.h"
#include "scene/table.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define UAS (M_PI / 180 / 3.6e9)
enum { WIDTH = 201, HEIGHT = 160 };

/* the hole is not at the centre of the picture */
static const struct kd_fourier_grid grid = { WIDTH, HEIGHT, 1 * UAS, 90.5, 83.25 };

static void near(double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("%.12g, not %.12g", got, want);
}

/* Light at a point. Coordinates: microarcseconds east and north of the figure's centre. */
typedef double light_of(double x, double y);

/* For each pixel, the mean over 15 x 15 points, so that edges are resolved to a fifteenth of a pixel. */
static void draw(float *map, light_of *light, double east, double north)
{
    for (int j = 0; j < HEIGHT; j++)
        for (int i = 0; i < WIDTH; i++) {
            double sum = 0;
            for (int k = 0; k < 225; k++) {
                const double x = -(i - grid.x0 + (k % 15 - 7) / 15.), y = -(j - grid.y0 + (k / 15 - 7) / 15.);
                sum += light(x - east, y - north);
            }
            map[j * WIDTH + i] = (float)(sum / 225);
        }
}

static double a_disk(double x, double y) { return hypot(x, y) < 21 ? 1 : 0; }
static double a_ring(double x, double y) { return exp(-pow((hypot(x, y) - 24) / 1.5, 2) / 2); }
static double a_gaussian(double x, double y) { return exp(-(x * x / (2 * 49.) + y * y / (2 * 144.))); }

/* Effect of averaging over pixels, sinc(u pixel) sinc(v pixel). The map contains this effect, but a sum over points at
 * the pixels' centres does not. */
static double pixel_turns(double u, double v)
{
    const double a = M_PI * u * 1e9 * UAS, b = M_PI * v * 1e9 * UAS;
    return (a == 0 ? 1 : sin(a) / a) * (b == 0 ? 1 : sin(b) / b);
}

/* x = 2 pi q a, for a baseline of q wavelengths and a radius of a in microarcseconds. */
static double argument(double u, double v, double a) { return 2 * M_PI * hypot(u, v) * 1e9 * a * UAS; }

/* Transform of a thin ring: the mean of J0 over its circles, weighted by their light. */
static double ring_transform(double u, double v)
{
    double sum = 0, all = 0;
    for (double r = 12; r < 36; r += 1. / 64) {
        const double light = r * a_ring(r, 0);
        sum += light * j0(argument(u, v, r)), all += light;
    }
    return sum / all;
}

static double transform(int shape, double u, double v)
{
    if (shape == 0) {
        const double x = argument(u, v, 21);
        return x == 0 ? 1 : 2 * j1(x) / x;
    }
    if (shape == 1)
        return ring_transform(u, v);
    return exp(-2 * M_PI * M_PI * (pow(u * 1e9 * 7 * UAS, 2) + pow(v * 1e9 * 12 * UAS, 2)));
}

static void test_transforms_are_the_closed_forms(void **state)
{
    static light_of *const shapes[] = { a_disk, a_ring, a_gaussian };
    static const double bounds[] = {
        3e-3, 1e-5, 1e-5
    }; /* a disk's edge is resolved to a fifteenth of a pixel; the others are smooth */
    static const double away[][2] = { { 0, 0 }, { 8.5, -5.25 } };
    static float map[WIDTH * HEIGHT];
    double scratch[2 * WIDTH], worst[3] = { 0 };
    (void)state;
    for (int shape = 0; shape < 3; shape++)
        for (int place = 0; place < 2; place++) {
            const float *const maps[] = { map };
            const double east = away[place][0], north = away[place][1];
            double zero[1][2], sum[1][2];
            draw(map, shapes[shape], east, north);
            kd_fourier(&grid, maps, 1, 0, 0, scratch, zero);
            for (double q = 0; q < 30; q += 1.3)
                for (double angle = 0; angle < 6; angle += 0.7) {
                    const double u = q * sin(angle), v = q * cos(angle),
                                 turned = -2 * M_PI * 1e9 * UAS * (u * east + v * north);
                    const double want = transform(shape, u, v) * pixel_turns(u, v);
                    kd_fourier(&grid, maps, 1, u, v, scratch, sum);
                    const double off =
                        hypot(sum[0][0] / zero[0][0] - want * cos(turned), sum[0][1] / zero[0][0] - want * sin(turned));
                    worst[shape] = fmax(worst[shape], off);
                    if (!(off < bounds[shape]))
                        fail_msg("shape %d, u %g, v %g: off by %g", shape, u, v, off);
                }
        }
    print_message("visibilities off by at most: disk %.1e, ring %.1e, Gaussian %.1e\n", worst[0], worst[1], worst[2]);
}

/* East is to the left and north is up. A point at x east and y north has the phase exp(-2 pi i (u x + v y)). Several
 * maps are summed at once. */
static void test_a_point_turns(void **state)
{
    static float left[WIDTH * HEIGHT], top[WIDTH * HEIGHT];
    const float *const maps[] = { left, top };
    double scratch[2 * WIDTH], sum[2][2];
    (void)state;
    left[80 * WIDTH + 40] = 2; /* 50.5 uas east, 3.25 uas north */
    top[10 * WIDTH + 90] = 1;  /* 0.5 uas east, 73.25 uas north */
    for (int k = 0; k < 50; k++) {
        const double u = 3.7 * k - 60, v = 100 - 5.3 * k, a = -2 * M_PI * 1e9 * UAS * (u * 50.5 + v * 3.25),
                     b = -2 * M_PI * 1e9 * UAS * (u * 0.5 + v * 73.25);
        kd_fourier(&grid, maps, 2, u, v, scratch, sum);
        near(sum[0][0], 2 * cos(a), 1e-9);
        near(sum[0][1], 2 * sin(a), 1e-9);
        near(sum[1][0], cos(b), 1e-9);
        near(sum[1][1], sin(b), 1e-9);
    }
}

static void ask(struct kd_integral_request *request, enum kd_integral what, const char *text)
{
    struct kd_error error = { 0 };
    kd_integral_request_init(request, what);
    if (kd_integral_request_json(request, text, strlen(text), &error))
        fail_msg("%s: %s at %s", text, error.message, error.pointer);
}

static void test_baselines(void **state)
{
    struct kd_integral_request r;
    (void)state;
    ask(&r, KD_INTEGRAL_VISIBILITY,
        "{\"preset\":\"m87\",\"scene\":{\"disk\":{\"model\":\"novikov-thorne\"},\"volume\":{\"model\":\"none\"}},"
        "\"lengths\":[0,5,8],\"angles_deg\":[0,90,-30],\"orders\":2}");
    assert_int_equal(kd_integral_rows(&r), 27);
    assert_int_equal(kd_integral_pictures(&r), 2);
    assert_true(r.u.n == 9 && r.u.at[4] == 5 && r.v.at[4] == 0 && r.v.at[1] == 5 && r.u.at[1] == 0);
    near(r.u.at[8], -4, 1e-12);
    near(r.v.at[8], 8 * sqrt(0.75), 1e-12);
    const struct kd_scene coarse = kd_integral_scene(&r, 0), fine = kd_integral_scene(&r, 1);
    assert_true(coarse.image.width == 256 && coarse.image.height == 144 && fine.image.width == 384 &&
                fine.image.height == 216 && coarse.style.beam_uas == 0);
    kd_integral_request_finish(&r);
    ask(&r, KD_INTEGRAL_VISIBILITY, "{\"u\":[1,2],\"v\":[3,4],\"check\":\"none\"}");
    assert_int_equal(kd_integral_pictures(&r), 1);
    assert_int_equal(kd_integral_rows(&r), 2);
    kd_integral_request_finish(&r);
    /* With a scene, the spectrum is that of the scene's volume. */
    ask(&r, KD_INTEGRAL_SPECTRUM,
        "{\"frequencies_hz\":[1e11,2e11,3e11],\"preset\":\"riaf\",\"scene\":{\"camera\":{\"inclination_deg\":30}}}");
    assert_int_equal(r.what, KD_INTEGRAL_VOLUME);
    assert_int_equal(kd_integral_pictures(&r), 6);
    near(kd_integral_scene(&r, 3).volume.frequency_ghz, 200, 1e-9);
    kd_integral_request_finish(&r);
    /* Matter that is normalised to a flux has this flux at the scene's frequency. At all other frequencies it is the
     * same matter. */
    ask(&r, KD_INTEGRAL_SPECTRUM,
        "{\"frequencies_hz\":[1e11,2e11],\"preset\":\"riaf\",\"scene\":{\"volume\":{\"normalise_to_jy\":2,\"frequency_"
        "ghz\":230}}}");
    near(kd_integral_scene(&r, 3).volume.normalise_ghz, 230, 1e-9);
    kd_integral_request_finish(&r);
    ask(&r, KD_INTEGRAL_SPECTRUM,
        "{\"frequencies_hz\":[1e11,2e11],\"preset\":\"riaf\",\"scene\":{\"volume\":{\"normalise_to_jy\":2,\"normalise_"
        "ghz\":86}}}");
    near(kd_integral_scene(&r, 3).volume.normalise_ghz, 86, 1e-9);
    kd_integral_request_finish(&r);
    ask(&r, KD_INTEGRAL_SPECTRUM, "{\"frequencies\":7}");
    assert_true(r.what == KD_INTEGRAL_SPECTRUM && !kd_integral_pictures(&r));
    kd_integral_request_finish(&r);
}

static void test_frequencies_of_volumes_are_those_of_scenes(void **state)
{
    (void)state;
    const struct kd_row *row = kd_field_find("volume", "frequency_ghz");
    assert_non_null(row);
    near(row->least * 1e9, KD_INTEGRAL_LEAST_HZ, 1e-9 * KD_INTEGRAL_LEAST_HZ);
    near(row->most * 1e9, KD_INTEGRAL_MOST_HZ, 1e-9 * KD_INTEGRAL_MOST_HZ);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_transforms_are_the_closed_forms),
                                        cmocka_unit_test(test_a_point_turns), cmocka_unit_test(test_baselines),
                                        cmocka_unit_test(test_frequencies_of_volumes_are_those_of_scenes) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
