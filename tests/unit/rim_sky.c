/* Where rays next to the critical curve come from: by the Kerr-Schild oracle, and by closed form at each ray of the rim. */
#include "kerr_schild.h"
#include "render/view/camera.h"
#include "render/view/rim_sky.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

static struct kd_scene scene;
static struct kd_rim rim;
static struct kd_error error;
static float sky[3 * KD_RIM_ROWS * KD_RIM_ANGLES];

static bool looks(double spin, double r, double inclination, enum kd_observer observer)
{
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = r;
    scene.camera.inclination_deg = inclination;
    scene.camera.observer = (int)observer;
    scene.camera.fov_deg = 40;
    if (observer == KD_OBSERVER_VELOCITY)
        scene.camera.velocity_theta = 0.3, scene.camera.velocity_r = -0.4;
    return kd_rim_of(&scene, &rim);
}

static double apart(const double a[3], uint32_t row, uint32_t k)
{
    const size_t rays = kd_rim_rays(&rim), at = (size_t)row * KD_RIM_ANGLES + k;
    return sqrt(pow(a[0] - sky[at], 2) + pow(a[1] - sky[rays + at], 2) + pow(a[2] - sky[2 * rays + at], 2));
}

/* At rest, by the oracle, which knows no curve, no roots and no angles. */
static void by_the_oracle(void **state)
{
    (void)state;
    static const struct { double spin, r, inclination; } cases[] = { { 0, 30, 70 }, { 0.5, 12, 35 }, { 0.9, 30, 85 }, { 0.9, 40, 90 }, { -0.9, 20, 120 }, { 0.97, 8, 60 }, { 0.9, 25, 2 } };
    double worst = 0;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        assert_true(looks(cases[c].spin, cases[c].r, cases[c].inclination, KD_OBSERVER_STATIC));
        assert_int_equal(kd_rim_sky(&scene, &rim, sky, &error), KD_OK);
        for (int i = 0; i < 12; i++) {
            const uint32_t k = (uint32_t)(i * 83) % KD_RIM_ANGLES, row = (uint32_t)(i * 37) % rim.rows;
            const double off = rim.far * exp(-(double)row * rim.fall);
            double d[3];
            for (int q = 0; q < 3; q++)
                d[q] = rim.ahead[q] + (1 + off) * (rim.x[k] * rim.right[q] + rim.y[k] * rim.up[q]);
            const double n = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), to[] = { d[0] / n, d[1] / n, d[2] / n };
            const struct ks_path path = ks_trace(ks_from_camera(cases[c].spin, cases[c].r, cases[c].inclination * (M_PI / 180), false, to), 8);
            const double s = sqrt(1 - path.u * path.u), want[] = { s * cos(path.sky_phi), s * sin(path.sky_phi), path.u };
            const double is = apart(want, row, k);
            if (path.fate != KS_ESCAPED)
                fail_msg("spin %g, r %g, inclination %g: captured at %g of the curve, column %u", cases[c].spin, cases[c].r, cases[c].inclination, off, k);
            if (is > 3e-6)
                fail_msg("spin %g, r %g, inclination %g: off by %g at %g of the curve, column %u", cases[c].spin, cases[c].r, cases[c].inclination, is, off, k);
            worst = fmax(worst, is);
        }
    }
    printf("by the oracle within %.2g rad\n", worst);
}

/* What is interpolated is what each ray does, for whoever looks from wherever; and there is no ray that does not escape. */
static void each_ray(void **state)
{
    (void)state;
    static const double spins[] = { 0, 1e-9, 0.3, 0.9, -0.9, 0.95 }, inclinations[] = { 0, 1e-6, 20, 89.9999, 90, 150 };
    static const struct { enum kd_observer observer; double r; } at[] = {
        { KD_OBSERVER_STATIC, 4.2 }, { KD_OBSERVER_STATIC, INFINITY }, { KD_OBSERVER_ZAMO, 1000 }, { KD_OBSERVER_INFALL, 10 }, { KD_OBSERVER_VELOCITY, 20 } };
    double worst = 0;
    int rims = 0;
    for (size_t s = 0; s < sizeof spins / sizeof *spins; s++)
        for (size_t i = 0; i < sizeof inclinations / sizeof *inclinations; i++)
            for (size_t o = 0; o < sizeof at / sizeof *at; o++) {
                if (!looks(spins[s], at[o].r, inclinations[i], at[o].observer))
                    continue;
                rims++;
                if (kd_rim_sky(&scene, &rim, sky, &error))
                    fail_msg("spin %g, inclination %g, r %g: %s", spins[s], inclinations[i], at[o].r, error.message);
                for (uint32_t n = 0; n < 400; n++) {
                    const uint32_t row = n * 7 % rim.rows, k = n * 101 % KD_RIM_ANGLES;
                    double want[3];
                    assert_true(kd_rim_sky_at(&scene, &rim, k, rim.far * exp(-(double)row * rim.fall), want));
                    if (!(apart(want, row, k) < 5e-6))
                        fail_msg("spin %g, inclination %g, r %g, observer %d: row %u column %u off by %g", spins[s], inclinations[i], at[o].r, (int)at[o].observer, row, k, apart(want, row, k));
                    worst = fmax(worst, apart(want, row, k));
                }
            }
    printf("%d rims, interpolated within %.2g rad\n", rims, worst);
    assert_true(rims >= 140);
}

/* However closely one looks, the last row is one that double precision can tell of, and there is none that does not escape. */
static void close_up(void **state)
{
    (void)state;
    static const struct { double spin, inclination, r, field; } views[] = { { 0.9, 60, INFINITY, 1e-4 }, { 0.9, 60, INFINITY, 0.01 }, { 0.9, 60, 50, 1e-5 }, { 0.5, 90, 50, 1e-3 }, { 0, 75, INFINITY, 1e-4 } };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        double worst = 0;
        kd_scene_smooth(&scene);
        scene.spacetime.spin = views[v].spin;
        scene.camera.inclination_deg = views[v].inclination;
        scene.camera.r = views[v].r;
        *(isinf(views[v].r) ? &scene.camera.field_m : &scene.camera.fov_deg) = views[v].field;
        assert_true(kd_rim_of(&scene, &rim));
        const double last = rim.far * exp(-(rim.rows - 1.0) * rim.fall);
        assert_true(last > 0.99e-7 && last < 1.2e-7);
        assert_int_equal(kd_rim_sky(&scene, &rim, sky, &error), KD_OK);
        for (uint32_t n = 0; n < 400; n++) {
            const uint32_t row = rim.rows - 1 - n % rim.rows, k = n * 101 % KD_RIM_ANGLES;
            double want[3];
            assert_true(kd_rim_sky_at(&scene, &rim, k, rim.far * exp(-(double)row * rim.fall), want));
            worst = fmax(worst, apart(want, row, k));
        }
        printf("field %g: last row %g from the curve, within %.2g rad\n", views[v].field, last, worst);
        assert_true(worst < 5e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(by_the_oracle), cmocka_unit_test(each_ray), cmocka_unit_test(close_up) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
