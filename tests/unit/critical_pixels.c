/* Tests of the pixels on the critical curve, and of the places of rays within such a pixel. The pixels are compared
 * with the fates of rays in closed form, which do not use the curve. */
#include "render/view/critical_pixels.h"

#include "physics/null/null_geodesic.h"
#include "render/view/camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 72, HEIGHT = 54 };

static struct kd_scene scene_of(double spin, double r, double inclination)
{
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = r;
    scene.camera.inclination_deg = inclination;
    scene.camera.field_m = 18;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    return scene;
}

/* Traces 2 x 2 rays in each pixel. A value is true if its ray falls into the hole. */
static void fates(const struct kd_scene *scene, bool *captured)
{
    const struct kd_scene fine = kd_critical_camera(scene, 2);
    const struct kd_camera_exact camera = kd_camera_exact(&fine);
    for (uint32_t y = 0; y < 2 * HEIGHT; y++)
        for (uint32_t x = 0; x < 2 * WIDTH; x++) {
            struct kd_camera_label label;
            kd_camera_label(&camera, x, y, &label);
            const struct kd_null_ray ray = {
                .hole = kd_hole_of(scene->spacetime.spin),
                .radius = scene->camera.r,
                .cos_theta = camera.u,
                .sin_theta = camera.s,
                .alpha = label.alpha,
                .beta = label.beta,
                .outward = label.outward,
            };
            captured[y * 2 * WIDTH + x] = kd_null_trace_fast(&ray).fate == KD_NULL_CAPTURED;
        }
}

/* True if rays of both fates are among the rays of pixels up to `reach` away from this pixel. */
static bool mixed(const bool *captured, int x, int y, int reach)
{
    bool some[2] = { false, false };
    for (int j = 2 * (y - reach); j < 2 * (y + reach + 1); j++)
        for (int i = 2 * (x - reach); i < 2 * (x + reach + 1); i++)
            if (i >= 0 && i < 2 * WIDTH && j >= 0 && j < 2 * HEIGHT)
                some[captured[j * 2 * WIDTH + i]] = true;
    return some[0] && some[1];
}

/* Checks that all pixels which the visible edge of the shadow passes are listed, and no pixels far from it. Returns
 * the number of listed pixels. */
static size_t judge(const struct kd_scene *scene, const char *what)
{
    static bool captured[4 * WIDTH * HEIGHT];
    struct kd_critical_pixels list;
    struct kd_error error;
    bool listed[WIDTH * HEIGHT] = { false };
    assert_int_equal(kd_critical_pixels_of(scene, &list, &error), KD_OK);
    fates(scene, captured);
    size_t before = 0;
    for (size_t i = 0; i < list.n; i++) {
        size_t at = list.pixels[i].y * WIDTH + list.pixels[i].x;
        assert_true(list.pixels[i].x < WIDTH && list.pixels[i].y < HEIGHT && (!i || at > before));
        listed[before = at] = true;
    }
    /* Pixels next to the picture's edge are not compared. A part of the curve outside the picture may cause them to be
     * listed. */
    const int far = (int)KD_CRITICAL_NEAR + 2;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool inner = x >= far && y >= far && x < WIDTH - far && y < HEIGHT - far;
            if (mixed(captured, x, y, 0) && !listed[y * WIDTH + x])
                fail_msg("%s: the edge of the shadow passes pixel %d %d, which is not listed", what, x, y);
            if (mixed(captured, x, y, 1) && !listed[y * WIDTH + x])
                fail_msg("%s: the edge of the shadow passes next to pixel %d %d, which is not listed", what, x, y);
            if (inner && listed[y * WIDTH + x] && !mixed(captured, x, y, far))
                fail_msg("%s: pixel %d %d is listed, and far from the edge of the shadow", what, x, y);
        }
    for (uint32_t y = 0; y <= HEIGHT; y++) {
        size_t above = 0;
        for (size_t i = 0; i < y * WIDTH; i++)
            above += listed[i];
        assert_int_equal(kd_critical_pixels_above(&list, y), above);
    }
    size_t n = list.n;
    kd_critical_pixels_finish(&list);
    assert_null(list.pixels);
    return n;
}

static void from_infinity(void **state)
{
    (void)state;
    static const double spins[] = { 0, 0.7, -0.9, 0.998, 0.999999 }, inclinations[] = { 0, 17, 82, 90, 135 };
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 5; k++) {
            struct kd_scene scene = scene_of(spins[i], INFINITY, inclinations[k]);
            scene.camera.roll_deg = 25 * k;
            scene.camera.centre_alpha = i - 2;
            scene.camera.centre_beta = 0.7 * k;
            assert_true(judge(&scene, "from infinity") > 200);
        }
}

/* Tests cameras that are yawed and rolled, a camera with the hole all round it, and a camera that looks away from the
 * hole. */
static void from_nearby(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        double spin, r, inclination, fov, yaw, pitch, roll;
        int observer;
        bool some;
        int projection;
    } views[] = {
        { "r = 30", 0.9, 30, 60, 30, 0, 0, 0, KD_OBSERVER_STATIC, true },
        { "r = 30, aside", 0.9, 30, 60, 40, 6, -4, 30, KD_OBSERVER_ZAMO, true },
        { "r = 6, wide", 0, 6, 40, 140, 10, 10, 77, KD_OBSERVER_STATIC, true },
        { "r = 2.6, away from the hole", 0.3, 2.6, 90, 150, 180, 0, 0, KD_OBSERVER_ZAMO, true },
        { "r = 2.6, to the side", 0.3, 2.6, 70, 120, 90, 0, -20, KD_OBSERVER_ZAMO, true },
        { "on the axis", 0.95, 12, 0, 80, 0, 0, 0, KD_OBSERVER_STATIC, true },
        { "r = 1e6", 0.95, 1e6, 80, 0.001, 0, 0, 5, KD_OBSERVER_STATIC, true },
        { "behind one's back", 0.5, 40, 80, 90, 180, 0, 0, KD_OBSERVER_STATIC, false },
        { "a sphere", 0.9, 8, 60, 50, 0, 0, 0, KD_OBSERVER_STATIC, true, KD_PROJECTION_EQUIRECTANGULAR },
        { "a sphere, turned", 0.9, 4, 60, 50, 120, 20, 30, KD_OBSERVER_ZAMO, true, KD_PROJECTION_EQUIRECTANGULAR },
        { "a sphere, the hole behind", 0.9, 8, 60, 50, 180, 0, 0, KD_OBSERVER_ZAMO, true,
          KD_PROJECTION_EQUIRECTANGULAR },
        { "a sphere, the hole at its pole", 0.9, 8, 60, 50, 0, -90, 0, KD_OBSERVER_ZAMO, true,
          KD_PROJECTION_EQUIRECTANGULAR },
        { "a sphere, much of it black", 0.2, 2.3, 60, 50, 0, 0, 0, KD_OBSERVER_ZAMO, true,
          KD_PROJECTION_EQUIRECTANGULAR },
        { "a dome", 0.9, 5, 60, 50, 0, 0, 0, KD_OBSERVER_ZAMO, true, KD_PROJECTION_FULLDOME },
        { "a dome, turned", 0.9, 5, 60, 50, 40, 30, 60, KD_OBSERVER_ZAMO, true, KD_PROJECTION_FULLDOME },
        { "a dome, the hole behind", 0.5, 40, 80, 50, 180, 0, 0, KD_OBSERVER_STATIC, false, KD_PROJECTION_FULLDOME },
    };
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        struct kd_scene scene = scene_of(views[i].spin, views[i].r, views[i].inclination);
        scene.camera.fov_deg = views[i].fov;
        scene.camera.yaw_deg = views[i].yaw;
        scene.camera.pitch_deg = views[i].pitch;
        scene.camera.roll_deg = views[i].roll;
        scene.camera.observer = views[i].observer;
        scene.camera.projection = views[i].projection;
        size_t n = judge(&scene, views[i].what);
        assert_true(views[i].some ? n > 50 : !n);
    }
}

/* Tests a small hole, a hole of which only the edge is in the picture, a hole that fills the picture, and a hole
 * outside it. */
static void sizes(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.5, INFINITY, 60);
    scene.camera.field_m = 1e5;
    struct kd_critical_pixels list;
    struct kd_error error;
    assert_int_equal(kd_critical_pixels_of(&scene, &list, &error), KD_OK);
    assert_in_range(list.n, 12, 24); /* pi 2.5^2 */
    kd_critical_pixels_finish(&list);
    scene.camera.field_m = 0.01;
    scene.camera.centre_alpha = 2;
    assert_int_equal(judge(&scene, "all in the shadow"), 0);
    scene.camera.centre_alpha = 20;
    assert_int_equal(judge(&scene, "no shadow"), 0);
    scene = scene_of(0, INFINITY, 60);
    scene.camera.field_m = 1e-3;
    scene.camera.centre_alpha = sqrt(27);
    assert_in_range(judge(&scene, "the edge"), HEIGHT * 4, HEIGHT * 6);
}

/* Number of bytes requested. The linker redirects calls of malloc and calloc to the functions below. */
static size_t asked;
void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_malloc(size_t size)
{
    asked += size;
    return __real_malloc(size);
}
void *__wrap_calloc(size_t n, size_t size)
{
    asked += n * size;
    return __real_calloc(n, size);
}

/* Planning the largest picture takes memory for the length of the curve, and not for its 2^30 pixels. A bit for each
 * pixel would be 128 MiB. */
static void the_largest_picture(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, INFINITY, 60);
    struct kd_critical_pixels list;
    struct kd_error error;
    scene.image.width = scene.image.height = 32768;
    scene.camera.field_m = 14;
    asked = 0;
    assert_int_equal(kd_critical_pixels_of(&scene, &list, &error), KD_OK);
    assert_true(list.n > 100000);
    assert_in_range(asked, list.n * sizeof *list.pixels, 16 << 20);
    kd_critical_pixels_finish(&list);
}

/* The rays of a pixel are point-symmetric, with one ray in each column and row. Their least distance is compared
 * with that of the closest packing, sqrt(2/sqrt 3) divided by the square root of their number. */
static void places(void **state)
{
    (void)state;
    for (uint32_t side = 2; side <= 16; side++) {
        uint32_t rays = side * side;
        const struct kd_critical_lattice lattice = kd_critical_lattice(rays);
        bool seen[2][256] = { { false } };
        struct kd_pixel all[256];
        double least = rays;
        for (uint32_t k = 0; k < rays; k++) {
            const struct kd_pixel p = kd_critical_place(&lattice, (struct kd_pixel) { 3, 7 }, k);
            assert_true(p.x / rays == 3 && p.y / rays == 7);
            all[k] = (struct kd_pixel) { p.x - 3 * rays, p.y - 7 * rays };
            assert_false(seen[0][all[k].x] || seen[1][all[k].y]);
            seen[0][all[k].x] = seen[1][all[k].y] = true;
        }
        for (uint32_t k = 0; k < rays; k++) {
            assert_int_equal(all[k].x + all[rays - 1 - k].x, rays - 1);
            assert_int_equal(all[k].y + all[rays - 1 - k].y, rays - 1);
            for (uint32_t n = 0; n < k; n++)
                least = fmin(least, hypot((double)all[k].x - all[n].x, (double)all[k].y - all[n].y));
        }
        double closest = sqrt(2 / sqrt(3)) * side;
        if (!(least > 0.65 * closest))
            fail_msg("%u rays: %g apart, at most %g", rays, least, closest);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_infinity),       cmocka_unit_test(from_nearby), cmocka_unit_test(sizes),
        cmocka_unit_test(the_largest_picture), cmocka_unit_test(places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
