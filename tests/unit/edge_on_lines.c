/* Tests of lines of disks seen next to edge-on and exactly edge-on. They are compared with sums over rays that are
 * integrated in Kerr-Schild coordinates (tests/oracle/kerr_schild.h). There is one ray in each field of a grid over the
 * image plane, at a random place in the field. The rays share no equation with the code under test, which sums rays in
 * closed form along columns.
 *
 *     unit_edge_on_lines [SIDE [CASE]]     SIDE^2 rays, 100 without; 2000 (4 million) take a quarter of an hour */
#include "base/random.h"
#include "kerr_schild.h"
#include "physics/disk/line_profile.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define RADIAN (M_PI / 180)
enum { BINS = 200, SHORT = 100 };

static int side = SHORT, only = -1;

static const struct {
    double a, q, i, outer, index;
} cases[] = { { 0.9, 0, 89, 400, 3 }, { 0.998, 0, 88, 60, 3 }, { -0.5, 0.6, 90, 100, 2 }, { 0, 0, 89.7, 30, 1 } };

/* g of gas on a circular orbit (Bardeen, Press & Teukolsky 1972, eqs. 2.16, 5.4a; Dadhich & Kale 1977). */
static double redshift(double a, double q2, double r, double momentum)
{
    const double s = sqrt(r - q2);
    return r * sqrt(r * r - 3 * r + 2 * q2 + 2 * a * s) / (r * r + a * s - momentum * s);
}

/* Adds the light of one point, which represents `area` of the image plane. */
static void follow(size_t k, double isco, double alpha, double beta, double area, double *light)
{
    const struct ks_path path =
        ks_trace(ks_from_infinity_charged(cases[k].a, cases[k].q, cos(cases[k].i * RADIAN), alpha, beta), 2);
    const int at = path.crossings > 1 && path.r[0] > cases[k].outer;
    if (!path.crossings || path.r[at] < isco || path.r[at] > cases[k].outer)
        return;
    const double r = path.r[at], g = redshift(cases[k].a, cases[k].q * cases[k].q, r, path.momentum[at]);
    const int bin = (int)(g / 2 * BINS);
    assert_true(bin >= 0 && bin < BINS);
    light[bin] += g * g * g * pow(r, -cases[k].index) * area;
}

static void compare(size_t k, double allowed)
{
    static struct kd_disk_image image;
    const struct kd_hole hole = kd_hole_charged(cases[k].a, cases[k].q);
    const double isco = kd_kerr_isco(&hole), outer = cases[k].outer, wide = asinh((outer + 8) / 2),
                 high = asinh((outer * cos(cases[k].i * RADIAN) + 2 * sqrt(outer) + 10) / 0.2);
    const struct kd_line_params params = { .inner = isco, .outer = outer, .index = cases[k].index };
    struct kd_random random = { k + 1 };
    struct kd_line_profile profile;
    struct kd_error error;
    double edges[BINS + 1], share[BINS], light[BINS] = { 0 }, total = 0, found = 0, sum = 0, worst = 0;
    for (int e = 0; e <= BINS; e++)
        edges[e] = 2. * e / BINS;
    assert_true(kd_disk_image_init(&image, &hole, cases[k].i * RADIAN));
    assert_int_equal(image.angles, 0);
    assert_int_equal(kd_line_profile(&image, &params, edges, BINS, share, &profile, &error), KD_OK);
    for (int x = 0; x < side; x++)
        for (int y = 0; y < side; y++) {
            const double u = wide * (2 * (x + kd_random(&random)) / side - 1),
                         v = high * (2 * (y + kd_random(&random)) / side - 1);
            follow(k, isco, 2 * sinh(u), 0.2 * sinh(v),
                   2 * cosh(u) * 0.2 * cosh(v) * 4 * wide * high / ((double)side * side), light);
        }
    for (int e = 0; e < BINS; e++)
        total += light[e];
    for (int e = 0; e < BINS; e++) {
        found += light[e] / total, sum += share[e];
        worst = fmax(worst, fabs(found - sum));
    }
    print_message("a = %g, q = %g, i = %g: told %.1e, off by %.1e; total %.5g, by rays %.5g\n", cases[k].a, cases[k].q,
                  cases[k].i, profile.error, worst, profile.total, total);
    assert_true(profile.error < 0.003);
    assert_true(worst < allowed);
    assert_true(fabs(total / profile.total - 1) < 2 * allowed);
}

/* The error of a grid of rays falls faster than the size of its fields: in the first case it is 0.053 for 80 rays a
 * side, 0.013 for 200, and 0.006 for 400. 4 million rays must agree within half a percent. */
static void test_lines(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        if (only < 0 || k == (size_t)only)
            compare(k, fmax(0.005, 6. / side));
}

int main(int count, char **words)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_lines) };
    side = count > 1 ? atoi(words[1]) : SHORT;
    only = count > 2 ? atoi(words[2]) : -1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
