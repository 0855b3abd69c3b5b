/* Tests the diameter of the ring in pictures of M87* and Sgr A* through a beam of 20 microarcseconds. The diameter is
 * compared with that in the picture without a beam, after this test has convolved it in double precision. It is also
 * compared with the observed diameter. */
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { W = 320, H = 180 };
static double unblurred[H][W], between[H][W], wanted[H][W], found[H][W];

/* Width of a pixel in microarcseconds (constants: IAU 2015 B3, IAU 2015 B2). */
static double pixel_uas(const struct kd_scene *scene)
{
    const struct kd_spacetime *s = &scene->spacetime;
    return scene->camera.field_m / W * s->mass_msun * 1476.6250385 / (s->distance_pc * 3.0856775814913673e16) *
           206264.80624709636 * 1e6;
}

static void read_light(const struct kd_frame *f, double out[H][W])
{
    for (uint32_t i = 0; i < W * H; i++) {
        out[i / W][i % W] = studio_luminance(f, i % W, i / W) / exp2(f->exposure);
        assert_true(out[i / W][i % W] >= 0); /* nothing is clipped */
    }
}

static void convolve(double sigma)
{
    static double weight[2 * W];
    double sum = 0;
    memset(between, 0, sizeof between);
    memset(wanted, 0, sizeof wanted);
    for (int k = -W; k < W; k++)
        sum += exp(-k * k / (2 * sigma * sigma));
    for (int k = 0; k < 2 * W; k++)
        weight[k] = exp(-k * k / (2 * sigma * sigma)) / sum;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < W; k++)
                between[y][x] += weight[abs(k - x)] * unblurred[y][k];
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < H; k++)
                wanted[y][x] += weight[abs(k - y)] * between[k][x];
}

/* Cubic interpolation, first along rows and then along columns (Catmull and Rom 1974). */
static double at(double p[H][W], double x, double y)
{
    const int i = (int)floor(x), j = (int)floor(y);
    double sum = 0;
    for (int b = -1; b < 3; b++)
        for (int a = -1; a < 3; a++) {
            const double u = fabs(x - i - a), v = fabs(y - j - b);
            const double wu = u < 1 ? 1 + u * u * (1.5 * u - 2.5) : 2 - u * (4 - u * (2.5 - 0.5 * u));
            const double wv = v < 1 ? 1 + v * v * (1.5 * v - 2.5) : 2 - v * (4 - v * (2.5 - 0.5 * v));
            sum += wu * wv * p[j + b][i + a];
        }
    return sum;
}

struct ring { double diameter, scatter; };

/* Measures the ring about a centre (EHT Collaboration 2019, ApJL 875, L4, section 9). Its diameter is twice the mean,
 * over directions, of the radius of largest brightness. scatter: standard deviation of this radius. */
static struct ring about(double p[H][W], double x0, double y0)
{
    enum { DIRECTIONS = 90 };
    double sum = 0, square = 0;
    for (int k = 0; k < DIRECTIONS; k++) {
        const double c = cos(2 * M_PI * k / DIRECTIONS), s = sin(2 * M_PI * k / DIRECTIONS);
        double best = -1, radius = 0;
        for (double r = 8; r < 60; r += 0.05) {
            const double v = at(p, x0 + r * c, y0 + r * s);
            if (v > best)
                best = v, radius = r;
        }
        sum += radius / DIRECTIONS;
        square += radius * radius / DIRECTIONS;
    }
    return (struct ring) { 2 * sum, sqrt(fmax(square - sum * sum, 0)) };
}

/* Ring about the centre for which the radius of the ring scatters least. */
static struct ring ring_of(double p[H][W])
{
    double x = 0.5 * W, y = 0.5 * H;
    struct ring best = about(p, x, y);
    for (double step = 8; step > 0.2; step /= 2)
        for (int k = 0; k < 4; k++) {
            const double x1 = x + (k == 0 ? step : k == 1 ? -step : 0), y1 = y + (k == 2 ? step : k == 3 ? -step : 0);
            const struct ring ring = about(p, x1, y1);
            if (ring.scatter < best.scatter)
                best = ring, x = x1, y = y1, k = -1;
        }
    return best;
}

/* Measures the picture in 16 bits of linear light, and also in the style's false colours. uas, error: the observed
 * diameter and its error. */
static void the_ring_of(const char *preset, double uas, double error)
{
    static const char *const look = "{\"style\":{\"name\":\"raw\",\"exposure\":%d,\"beam_uas\":%g},\"image\":{"
                                    "\"width\":320,\"height\":180,\"samples\":2,\"critical_factor\":4,"
                                    "\"bit_depth\":16}}";
    char json[240];
    snprintf(json, sizeof json, look, -4, 0.0); /* the brightest pixels have a brightness temperature of some 1e11 K */
    struct kd_scene scene = studio_scene(preset, json);
    const double pixel = pixel_uas(&scene);
    struct kd_frame sharp = studio_render(&scene);
    snprintf(json, sizeof json, look, -2, 20.0);
    scene = studio_scene(preset, json);
    struct kd_frame blurred = studio_render(&scene);
    read_light(&sharp, unblurred);
    read_light(&blurred, found);
    convolve(20 / sqrt(8 * log(2)) / pixel);
    const struct ring is = ring_of(found), should = ring_of(wanted), before = ring_of(unblurred);
    printf("%s, 20 uas: a ring of %.2f uas, scatter %.2f; convolved by hand %.2f; without a beam %.2f\n", preset,
           is.diameter * pixel, is.scatter * pixel, should.diameter * pixel, before.diameter * pixel);
    assert_true(fabs(is.diameter / should.diameter - 1) < 0.002);
    assert_true(fabs(is.diameter * pixel - uas) < error);
    double worst = 0, most = 0;
    for (int i = 0; i < W * H; i++) {
        worst = fmax(worst, fabs(found[i / W][i % W] - wanted[i / W][i % W]));
        most = fmax(most, wanted[i / W][i % W]);
    }
    printf("off by %.1e of the brightest at most\n", worst / most);
    assert_true(worst < 5e-4 * most);
    kd_frame_finish(&sharp);
    kd_frame_finish(&blurred);
}

static void the_ring_of_sgra(void **state)
{
    (void)state;
    the_ring_of("sgra", 51.8, 2.3); /* EHT Collaboration 2022, ApJL 930, L12 */
}

static void the_ring_of_m87(void **state)
{
    (void)state;
    the_ring_of("m87", 42, 3); /* EHT Collaboration 2019, ApJL 875, L1 */
}

/* The picture in false colours gives the same diameter. There, brightness is the lightness L* of the colour (CIE 1976;
 * white: 100). */
static void the_style_shows_it_by_lightness(void **state)
{
    (void)state;
    struct kd_scene scene = studio_scene("m87", "{\"style\":{\"name\":\"eht\",\"colour_bar\":false,\"dither\":false},"
                                                "\"image\":{\"width\":320,\"height\":180,\"samples\":2,"
                                                "\"critical_factor\":4,\"bit_depth\":16}}");
    struct kd_frame f = studio_render(&scene);
    double worst = 0, most = 0;
    for (uint32_t i = 0; i < W * H; i++) {
        double y = 0;
        for (int c = 0; c < 3; c++)
            y += (double[]) { 0.2126, 0.7152, 0.0722 }[c] * studio_light(&f, i % W, i / W, c);
        const double lightness = y > 216.0 / 24389 ? 1.16 * cbrt(y) - 0.16 : 24389.0 / 2700 * y;
        const double light = found[i / W][i % W] * exp2(f.exposure);
        worst = fmax(worst, fabs(lightness - light));
        most = fmax(most, light);
    }
    printf("lightness beside brightness: off by %.1e, the brightest is %.3f of white\n", worst, most);
    assert_true(worst < 2e-3 && most > 0.8 && most <= 1);
    kd_frame_finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_ring_of_sgra), cmocka_unit_test(the_ring_of_m87),
                                        cmocka_unit_test(the_style_shows_it_by_lightness) };
    int status = studio_open();
    if (status)
        return status;
    status = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return status;
}
