/* Tests of the colour of a black body. It is compared with published chromaticities and efficacies, and with a second
 * quadrature, whose Planck function is itself tested by the Stefan-Boltzmann law. */
#include "physics/disk/colour.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void near(const char *what, double temperature, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("%s at %g K: %.9g, not %.9g: off by %.2g, allowed %.2g", what, temperature, got, want,
                 fabs(got - want), allowed);
}

struct xy { double x, y; };

static struct xy chromaticity(struct kd_colour_xyz c)
{
    double sum = c.x + c.y + c.z;
    return (struct xy) { c.x / sum, c.y / sum };
}

/* Sums of the three colour-matching functions from 380 to 780 nm in steps of 5 nm, as printed in CIE 15:2004. y-bar is
 * V(lambda), and is 1 at 555 nm. */
static void the_standard_observer(void **state)
{
    (void)state;
    double sum[3] = { 0 }, top = 0;
    for (int i = 0; i < KD_CIE1931_COUNT; i++) {
        for (int k = 0; k < 3 && i >= 4 && i <= 84; k++)
            sum[k] += kd_cie1931[i][k];
        top = fmax(top, kd_cie1931[i][1]);
    }
    near("sum of x-bar", 0, sum[0], 21.371524, 2e-6);
    near("sum of y-bar", 0, sum[1], 21.371327, 2e-6);
    near("sum of z-bar", 0, sum[2], 21.371540, 2e-6);
    assert_true(top == 1 && kd_cie1931[(555 - 360) / 5][1] == 1);
    assert_true(KD_CIE1931_FIRST_NM + (KD_CIE1931_COUNT - 1) * KD_CIE1931_STEP_NM == 830);
}

/* Illuminant A: CIE 15:2004, table T.3 (x = 0.44758, y = 0.40745), Planckian at 2848 K with c2 = 1.4350 cm K,
 * which is 2855.5 K with today's c2. The others: Wyszecki & Stiles 1982, table 1(3.11), four decimals and a
 * c2 of 1.4388, so that 3e-4 covers their rounding and the choice of the summation. */
static void published_chromaticities(void **state)
{
    (void)state;
    const struct {
        double t, x, y, bound;
    } table[] = {
        { 2848 * 1.438776877 / 1.4350, 0.44758, 0.40745, 2e-5 },
        { 1000, 0.6528, 0.3444, 3e-4 },
        { 2000, 0.5267, 0.4133, 3e-4 },
        { 3000, 0.4369, 0.4041, 3e-4 },
        { 4000, 0.3805, 0.3768, 3e-4 },
        { 5000, 0.3451, 0.3516, 3e-4 },
        { 6500, 0.3135, 0.3237, 3e-4 },
        { 10000, 0.2807, 0.2884, 3e-4 },
        { 1e9, 0.2399, 0.2341, 3e-4 }, /* last row: the limit of infinite T */
    };
    for (size_t i = 0; i < COUNT(table); i++) {
        struct xy c = chromaticity(kd_colour_blackbody(table[i].t));
        near("x", table[i].t, c.x, table[i].x, table[i].bound);
        near("y", table[i].t, c.y, table[i].y, table[i].bound);
    }
}

/* Rational cubics that approximate the Planckian locus (Kim et al., US patent 7024034). The error of their fit is about
 * 1e-3 in x and y. */
static void along_the_locus(void **state)
{
    (void)state;
    for (double t = 1700; t <= 25000; t *= 1.01) {
        double x = t < 4000 ? ((-0.2661239e9 / t - 0.2343589e6) / t + 0.8776956e3) / t + 0.179910
                            : ((-3.0258469e9 / t + 2.1070379e6) / t + 0.2226347e3) / t + 0.240390;
        double y = t < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : t < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                              : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
        struct xy c = chromaticity(kd_colour_blackbody(t));
        near("x", t, c.x, x, 1e-3);
        near("y", t, c.y, y, 1e-3);
    }
}

/* Planck's law from the two radiation constants (CODATA 2018), W m^-3 sr^-1. */
static double radiance(double wavelength, double temperature)
{
    const double c1l = 1.191042972e-16, c2 = 1.438776877e-2;
    return c1l / pow(wavelength, 5) / (exp(c2 / (wavelength * temperature)) - 1);
}

/* A second quadrature, which interpolates the colour-matching functions linearly, and samples their product with the
 * radiance ten times as finely. It differs from the first by the curvature within a step: the radiance changes by 5 % a
 * step at 2000 K, and both peaks of x-bar and that of z-bar are narrow. */
static struct kd_colour_xyz second_opinion(double temperature)
{
    struct kd_colour_xyz c = { 0, 0, 0 };
    const int fine = 10;
    for (int i = 0; i < (KD_CIE1931_COUNT - 1) * fine; i++) {
        double f = (i % fine + 0.5) / fine; /* midpoints */
        const double *p = kd_cie1931[i / fine], *q = p + 3;
        double b = radiance((360 + 5 * (i / fine + f)) * 1e-9, temperature) * 5e-9 / fine;
        c.x += b * (p[0] + f * (q[0] - p[0]));
        c.y += b * (p[1] + f * (q[1] - p[1]));
        c.z += b * (p[2] + f * (q[2] - p[2]));
    }
    return c;
}

static void stefan_and_boltzmann(void **state)
{
    (void)state;
    for (double t = 2000; t < 1e6; t *= 1.5) {
        double total = 0;
        const int n = 4000;
        for (int i = 0; i < n; i++) { /* midpoints in ln(lambda); lambda T ranges from 1e-4 to 1e3 m K */
            double y = log(1e-4 / t) + (i + 0.5) / n * log(1e7);
            total += radiance(exp(y), t) * exp(y) * log(1e7) / n;
        }
        double want = 5.670374419e-8 * pow(t, 4) / M_PI;
        near("total radiance", t, total / want, 1, 1e-8); /* tolerance: the published constants have nine digits */
        struct kd_colour_xyz got = kd_colour_blackbody(t), fine = second_opinion(t);
        near("X", t, got.x / fine.x, 1, 3e-4);
        near("Y", t, got.y / fine.y, 1, 3e-4);
        near("Z", t, got.z / fine.z, 1, 1.5e-3);
        near("luminous fraction", t, kd_colour_luminous_fraction(t) * total / got.y, 1, 1e-8);
    }
}

/* Published values (683 lm/W times the fraction): 95 lm/W at the maximum, near 6600 K, and at 7000 K; 54.7 at 4000
 * K; 15 at 2800 K. The efficacy falls on both sides of the maximum. The bounds are half a unit of the last digit. */
static void luminous_efficacy(void **state)
{
    (void)state;
    double best = 0, at = 0, last = 0;
    for (double t = 500; t < 1e6; t *= 1.002) {
        double fraction = kd_colour_luminous_fraction(t);
        if (fraction > best)
            best = fraction, at = t;
        if (at == t ? fraction <= last : fraction >= last)
            fail_msg("%g K: a second maximum of the luminous fraction", t);
        last = fraction;
    }
    near("temperature of the largest efficacy", at, at, 6630, 30);
    near("largest efficacy", at, 683.002 * best, 95, 0.5);
    near("efficacy", 7000, 683.002 * kd_colour_luminous_fraction(7000), 95, 0.5);
    near("efficacy", 4000, 683.002 * kd_colour_luminous_fraction(4000), 54.7, 0.05);
    near("efficacy", 2800, 683.002 * kd_colour_luminous_fraction(2800), 15, 0.5);
}

/* IEC 61966-2-1: white D65, (x, y) = (0.3127, 0.3290), is (1, 1, 1), and each primary has a single component. The
 * standard gives chromaticities to four decimals, which leaves 2e-4. */
static void the_matrix_of_srgb(void **state)
{
    (void)state;
    const struct {
        double x, y, luminance;
    } primaries[] = {
        { 0.64, 0.33, 0.2126 },
        { 0.30, 0.60, 0.7152 },
        { 0.15, 0.06, 0.0722 },
        { 0.3127, 0.3290, 1 },
    };
    for (int i = 0; i < 4; i++) {
        double x = primaries[i].x, y = primaries[i].y, l = primaries[i].luminance / y;
        struct kd_colour_rgb c = kd_colour_xyz_to_srgb((struct kd_colour_xyz) { l * x, l * y, l * (1 - x - y) });
        near("red", 0, c.r, i == 0 || i == 3, 5e-4);
        near("green", 0, c.g, i == 1 || i == 3, 5e-4);
        near("blue", 0, c.b, i == 2 || i == 3, 1e-3); /* tolerance: the published 0.0722 has three digits */
    }
}

/* The matrix as the standard of 1999 prints it, to four decimals: the XYZ of each component alone. */
static void the_printed_matrix(void **state)
{
    (void)state;
    static const double printed[3][3] = { { 3.2406, -0.9689, 0.0557 },
                                          { -1.5372, 1.8758, -0.2040 },
                                          { -0.4986, 0.0415, 1.0570 } };
    for (int i = 0; i < 3; i++) {
        struct kd_colour_rgb c = kd_colour_xyz_to_srgb((struct kd_colour_xyz) { i == 0, i == 1, i == 2 });
        near("red", 0, c.r, printed[i][0], 5.1e-5);
        near("green", 0, c.g, printed[i][1], 5.1e-5);
        near("blue", 0, c.b, printed[i][2], 5.1e-5);
    }
}

/* The unit colour is always inside the gamut and has luminance 1. It is redder for a cooler body. */
static void unit_colours(void **state)
{
    (void)state;
    double last = 100;
    for (double t = 20; t < 1e10; t *= 1.01) {
        struct kd_colour_rgb c = kd_colour_blackbody_unit(t);
        /* the rows of the two matrices are rounded to seven digits; a component that should be zero may be negative
         * by a rounding */
        near("luminance", t, 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b, 1, 2e-7);
        if (!(c.r >= -1e-15 && c.g >= -1e-15 && c.b >= -1e-15))
            fail_msg("%g K: (%g, %g, %g) is outside the gamut", t, c.r, c.g, c.b);
        /* below 890 K all the light is far red, so that the chromaticity hardly changes; the mapping into the gamut
         * reverses the order by less than 1e-3 a step */
        if (!(c.r <= last * (t < 890 ? 1.001 : 1)))
            fail_msg("%g K: redder than the cooler body before it", t);
        last = c.r;
    }
    /* at this temperature, the red and the blue component of a black body are most nearly equal */
    struct kd_colour_rgb white = kd_colour_blackbody_unit(6600);
    near("red of the whitest", 6600, white.r, 1, 0.06);
    near("green of the whitest", 6600, white.g, 1, 0.06);
    near("blue of the whitest", 6600, white.b, 1, 0.06);
}

/* Where the colour is inside the gamut, the unit colour is the colour itself. */
static void unit_colours_inside_the_gamut(void **state)
{
    (void)state;
    for (double t = 2000; t < 1e6; t *= 1.1) {
        struct kd_colour_xyz xyz = kd_colour_blackbody(t);
        struct kd_colour_rgb direct = kd_colour_xyz_to_srgb(xyz), unit = kd_colour_blackbody_unit(t);
        near("red", t, unit.r, direct.r / xyz.y, 1e-12);
        near("green", t, unit.g, direct.g / xyz.y, 1e-12);
        near("blue", t, unit.b, direct.b / xyz.y, 1e-12);
    }
}

/* IEC 61966-2-1 gives the inverse of the encoding as ((c + 0.055)/1.055)^2.4 and c/12.92; the two pieces meet to
 * within the standard's own digits. */
static void encoding(void **state)
{
    (void)state;
    for (double c = 0; c <= 1; c += 1. / 1024) {
        double e = kd_colour_srgb_encode(c), back = e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
        near("decoded", c, back, c, 1e-15);
    }
    near("middle grey", 0.5, kd_colour_srgb_encode(0.5), 0.7353569830524495, 1e-15);
    near("where the pieces meet", 0, kd_colour_srgb_encode(0.0031308 * (1 + 1e-12)), kd_colour_srgb_encode(0.0031308),
         1e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_standard_observer),
        cmocka_unit_test(published_chromaticities),
        cmocka_unit_test(along_the_locus),
        cmocka_unit_test(stefan_and_boltzmann),
        cmocka_unit_test(luminous_efficacy),
        cmocka_unit_test(the_matrix_of_srgb),
        cmocka_unit_test(the_printed_matrix),
        cmocka_unit_test(unit_colours),
        cmocka_unit_test(unit_colours_inside_the_gamut),
        cmocka_unit_test(encoding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
