/* Tests of the places on the sky from which rays next to the critical curve come. They are compared with integration in
 * Kerr-Schild coordinates, and with the closed form for each ray of the rim. */
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
static struct kd_rim_grids grids;
static struct kd_error error;
static float sky[3 * KD_RIM_RAYS + KD_RIM_RAYS];

/* Sets up the scene with this observer, for an image of 640 x 360. */
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
    if (!kd_rim_of(&scene, &rim))
        return false;
    kd_rim_grids_of(&scene, &rim, &grids);
    return true;
}

/* A ray of a grid: the grid, the row and column, the place along the curve, and the distance from the curve. It is
 * chosen by a number. */
struct ray {
    const struct kd_rim_grid *grid;
    uint32_t row, k;
    double u, off;
};

static struct ray ray_of(uint32_t number)
{
    const struct kd_rim_grid *g = &grids.of[number % grids.n];
    struct ray ray = { g, number * 37 % g->rows, number * 83 % g->columns, 0, 0 };
    ray.u = g->u + ray.k * g->du;
    ray.off = exp(g->l - ray.row * g->dl);
    return ray;
}

static double apart(const double a[3], const struct ray *ray)
{
    const size_t rays = kd_rim_grid_rays(ray->grid),
                 at = ray->grid->first + (size_t)ray->row * ray->grid->columns + ray->k;
    return sqrt(pow(a[0] - sky[at], 2) + pow(a[1] - sky[rays + at], 2) + pow(a[2] - sky[2 * rays + at], 2));
}

/* For an observer at rest the origins agree with the reference integration, which uses no curve, no roots and no
 * angles. */
static void by_the_oracle(void **state)
{
    (void)state;
    static const struct {
        double spin, r, inclination;
    } cases[] = { { 0, 30, 70 },      { 0.5, 12, 35 },      { 0.9, 30, 85 },   { 0.9, 40, 90 },  { -0.9, 20, 120 },
                  { 0.97, 8, 60 },    { 0.9, 25, 2 },       { 0.95, 30, 90 },  { 0.99, 30, 90 }, { 0.998, 30, 85 },
                  { 0.9999, 30, 90 }, { -0.9999, 12, 100 }, { 0.9999, 30, 45 } };
    double worst = 0;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        assert_true(looks(cases[c].spin, cases[c].r, cases[c].inclination, KD_OBSERVER_STATIC));
        assert_int_equal(kd_rim_sky(&scene, &rim, &grids, sky, &error), KD_OK);
        for (uint32_t i = 0; i < 24; i++) {
            const struct ray ray = ray_of(7 * i + 1);
            double place[2], d[3];
            kd_rim_place(&rim, ray.u, ray.off, place);
            kd_rim_look(&rim, place, d);
            const double n = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), to[] = { d[0] / n, d[1] / n, d[2] / n };
            const struct ks_path path =
                ks_trace(ks_from_camera(cases[c].spin, cases[c].r, cases[c].inclination * (M_PI / 180), false, to), 8);
            const double s = sqrt(1 - path.u * path.u),
                         want[] = { s * cos(path.sky_phi), s * sin(path.sky_phi), path.u };
            const double is = apart(want, &ray);
            if (path.fate != KS_ESCAPED)
                fail_msg("spin %g, r %g, inclination %g: captured at %g of the curve, turn %g", cases[c].spin,
                         cases[c].r, cases[c].inclination, ray.off, ray.u);
            if (is > 3e-6)
                fail_msg("spin %g, r %g, inclination %g: off by %g at %g of the curve, turn %g", cases[c].spin,
                         cases[c].r, cases[c].inclination, is, ray.off, ray.u);
            worst = fmax(worst, is);
        }
    }
    printf("by the oracle within %.2g rad\n", worst);
}

/* The interpolated origin agrees with that of each ray, for all kinds of observers and places. Every ray escapes. */
static void each_ray(void **state)
{
    (void)state;
    static const double spins[] = { 0, 1e-9, 0.3, 0.9, -0.9, 0.95, 0.9999, 1 - 1e-12 },
                        inclinations[] = { 0, 1e-6, 20, 89.9999, 90, 150 };
    static const struct {
        enum kd_observer observer;
        double r;
    } at[] = { { KD_OBSERVER_STATIC, 4.2 },
               { KD_OBSERVER_STATIC, INFINITY },
               { KD_OBSERVER_ZAMO, 1000 },
               { KD_OBSERVER_INFALL, 10 },
               { KD_OBSERVER_VELOCITY, 20 } };
    double worst = 0;
    int rims = 0;
    for (size_t s = 0; s < sizeof spins / sizeof *spins; s++)
        for (size_t i = 0; i < sizeof inclinations / sizeof *inclinations; i++)
            for (size_t o = 0; o < sizeof at / sizeof *at; o++) {
                if (!looks(spins[s], at[o].r, inclinations[i], at[o].observer))
                    continue;
                rims++;
                if (kd_rim_sky(&scene, &rim, &grids, sky, &error))
                    fail_msg("spin %g, inclination %g, r %g: %s", spins[s], inclinations[i], at[o].r, error.message);
                for (uint32_t n = 0; n < 400 && grids.n; n++) {
                    const struct ray ray = ray_of(n * 101);
                    double want[3];
                    assert_true(kd_rim_sky_at(&scene, &rim, ray.u, ray.off, want));
                    if (!(apart(want, &ray) < 5e-6))
                        fail_msg("spin %g, inclination %g, r %g, observer %d: turn %g, %g from the curve: off by %g",
                                 spins[s], inclinations[i], at[o].r, (int)at[o].observer, ray.u, ray.off,
                                 apart(want, &ray));
                    worst = fmax(worst, apart(want, &ray));
                }
            }
    printf("%d rims, interpolated within %.2g rad\n", rims, worst);
    assert_true(rims >= 165);
}

/* However narrow the view of some place of the curve is, the last row is one that double precision can resolve, and all
 * rays escape. */
static void close_up(void **state)
{
    (void)state;
    static const struct {
        double spin, inclination, r, field;
        uint32_t width;
    } views[] = { { 0.9, 60, INFINITY, 14, 60000 }, { 0.9, 60, 50, 1e-4, 640 },    { 0.5, 90, 50, 1e-2, 640 },
                  { 0, 75, 50, 1e-4, 640 },         { 0.9999, 90, 50, 1e-3, 640 }, { 0.998, 90, 50, 0.1, 640 } };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        double worst = 0, place[2], look[3], last = INFINITY;
        kd_scene_smooth(&scene);
        scene.spacetime.spin = views[v].spin;
        scene.camera.inclination_deg = views[v].inclination;
        scene.camera.r = views[v].r;
        scene.image.width = views[v].width;
        assert_true(kd_rim_of(&scene, &rim));
        kd_rim_place(&rim, 29.3, 0, place);
        kd_rim_look(&rim, place, look);
        *(isinf(views[v].r) ? &scene.camera.field_m : &scene.camera.fov_deg) = views[v].field;
        if (isfinite(views[v].r)) {
            scene.camera.yaw_deg = atan2(look[2], -look[0]) * (180 / M_PI);
            scene.camera.pitch_deg = atan2(-look[1], hypot(look[2], look[0])) * (180 / M_PI);
        }
        assert_true(kd_rim_of(&scene, &rim));
        kd_rim_grids_of(&scene, &rim, &grids);
        assert_true(grids.n > 0 && grids.rays <= KD_RIM_RAYS && 4ull * grids.numbers <= kd_rim_bytes_most());
        assert_int_equal(kd_rim_sky(&scene, &rim, &grids, sky, &error), KD_OK);
        for (uint32_t n = 0; n < 400; n++) {
            const struct ray ray = ray_of(n);
            double want[3];
            assert_true(kd_rim_sky_at(&scene, &rim, ray.u, ray.off, want));
            worst = fmax(worst, apart(want, &ray));
            last = fmin(last, ray.off);
        }
        printf("spin %g, field %g: %u grids, %u rays, to %g from the curve, within %.2g rad\n", views[v].spin,
               views[v].field, grids.n, grids.rays, last, worst);
        assert_true(rim.last >= KD_RIM_NEAREST && last > 0.3 * KD_RIM_NEAREST && worst < 5e-6);
    }
}

/* Adjacent parts of the grids contain each image exactly once: shares add up to 1 wherever the rim is in the picture
 * and bright enough. */
static void shares(void **state)
{
    (void)state;
    static const struct {
        double spin, r, inclination;
    } cases[] = { { 0, 30, 70 }, { 0.9, 30, 90 }, { 0.998, 30, 90 }, { 0.9999, 12, 85 } };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        int whole = 0, none = 0;
        assert_true(looks(cases[c].spin, cases[c].r, cases[c].inclination, KD_OBSERVER_STATIC));
        assert_int_equal(kd_rim_sky(&scene, &rim, &grids, sky, &error), KD_OK);
        for (int i = 0; i < 4000; i++) {
            const double u = fmod(0.618033988749 * i, 1) * KD_RIM_ANGLES,
                         l = log(rim.full) + fmod(0.754877666 * i, 1) * log(rim.last / rim.full);
            double sum = 0;
            for (uint32_t g = 0; g < grids.n; g++)
                for (int turn = -1; turn <= 1; turn++) {
                    const struct kd_rim_grid *grid = &grids.of[g];
                    const float *part = sky + grid->table;
                    const double x = (u + turn * KD_RIM_ANGLES - grid->u) / grid->du, y = (grid->l - l) / grid->dl;
                    const double ways[] = { (x - part[0]) * part[2], (part[1] - x) * part[2], (y - part[3]) * part[5],
                                            (part[4] - y) * part[5] };
                    double share = 1;
                    for (int k = 0; k < 4; k++)
                        share *= fmin(fmax(ways[k] + 0.5, 0), 1);
                    if (share > 0 && !(x > 2.4 && x < grid->columns - 3.4 && y > 2.4 && y < grid->rows - 3.4))
                        fail_msg("spin %g: turn %g, log %g has a share of %g at column %g, row %g of %u, %u",
                                 cases[c].spin, u, l, share, x, y, grid->columns, grid->rows);
                    sum += share;
                }
            if (sum > 1 + 1e-4)
                fail_msg("spin %g: turn %g, log %g is shared to %g", cases[c].spin, u, l, sum);
            whole += sum > 1 - 1e-4, none += sum < 1e-4;
        }
        printf("spin %g: %u grids, %u rays; of 4000 places %d are theirs, %d too faint or out of the picture\n",
               cases[c].spin, grids.n, grids.rays, whole, none);
        assert_true(whole > 1000 && 4000 - whole - none < 400);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(by_the_oracle), cmocka_unit_test(each_ray),
                                        cmocka_unit_test(close_up), cmocka_unit_test(shares) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
