/* Tests of images of stars in the rim of the shadow. They are compared with the lens equation of Schwarzschild and with
 * rays integrated in Kerr-Schild coordinates. */
#include "kerr_schild.h"
#include "render/sky/rim_images.h"
#include "render/view/camera.h"
#include "render/view/rim_sky.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define RADIUS 30.0
enum { WIDTH = 640, HEIGHT = 360, MOST = 4000 };

static struct kd_scene scene;
static struct kd_rim rim;
static struct kd_error error;
static struct kd_star_image seen[MOST];
static size_t n_seen;

static enum kd_status keep(void *user, const struct kd_star_image *image)
{
    (void)user;
    assert_true(n_seen < MOST);
    seen[n_seen++] = *image;
    return KD_OK;
}

static void look(double spin, double inclination)
{
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = RADIUS;
    scene.camera.inclination_deg = inclination;
    scene.camera.fov_deg = 40;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    assert_true(kd_rim_of(&scene, &rim));
    n_seen = 0;
}

static const double step = 2 * 0.36397023426620236135 / WIDTH; /* tan(20 degrees) */

/* The azimuth that a ray of impact parameter b covers from RADIUS to infinity: w = 1/r, dphi = dw / sqrt(1/b^2 - w^2 +
 * 2 w^3), in to the turning point w_t and out again. The substitution w = w_t sin^2 removes the zero of the root.
 * Midpoint rule. */
static double swept(double b)
{
    double low = 0, high = 1.0 / 3, sum = 0;
    for (int i = 0; i < 100; i++) {
        const double w = 0.5 * (low + high);
        *(1 / (b * b) - w * w * (1 - 2 * w) > 0 ? &low : &high) = w;
    }
    const double turn = 0.5 * (low + high), start = asin(sqrt(1 / RADIUS / turn));
    const int n = 8000;
    for (int part = 0; part < 2; part++) {
        const double begin = part ? start : 0, length = M_PI / 2 - begin;
        for (int i = 0; i < n; i++) {
            const double s = sin(begin + (i + 0.5) * length / n), w = turn * s * s;
            sum += length / n * 2 * sqrt(turn) * s / sqrt(turn + w - 2 * (turn * turn + turn * w + w * w));
        }
    }
    return sum;
}

static const double closest = 5.19615242270663188; /* b of the critical curve */

/* The tangent of the angle from the hole's centre for a ray whose b exceeds the critical b by `above`. */
static double tangent(double above)
{
    const double s = closest * (1 + above) * sqrt(1 - 2 / RADIUS) / RADIUS;
    return s / sqrt(1 - s * s);
}

/* The inverse of swept(): the logarithm of the excess over the critical b of the ray that covers this azimuth. */
static double above_of(double azimuth)
{
    double low = log(1e-6), high = log(1.0);
    for (int i = 0; i < 45; i++) {
        const double middle = 0.5 * (low + high);
        *(swept(closest * (1 + exp(middle))) > azimuth ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

/* A star lies at the angle psi from the direction towards the observer: cos(psi) along it and sin(psi) beside it, at
 * `angle` from the picture's right. Finds all of its images within the rim from the azimuth that their rays cover. */
static size_t judge(double psi, double angle, double *place, double *area)
{
    size_t images = 0;
    for (int k = 0; k < 6; k++) {
        const double azimuth = k & 1 ? 2 * M_PI * (k / 2 + 1) - psi : 2 * M_PI * (k / 2) + psi, side = k & 1 ? -1 : 1,
                     h = 1e-4;
        if (azimuth < 2)
            continue;
        const double above = above_of(azimuth), t = tangent(exp(above)), off = t / tangent(0) - 1;
        if (off > 0.98 * rim.none || off < 1.02 * rim.last)
            continue;
        const double x = 0.5 * (WIDTH - 1) + side * t / step * cos(angle),
                     y = 0.5 * (HEIGHT - 1) - side * t / step * sin(angle);
        const double slope = (swept(closest * (1 + exp(above + h))) - swept(closest * (1 + exp(above - h)))) /
                             (atan(tangent(exp(above + h))) - atan(tangent(exp(above - h))));
        const double want = step * step * pow(1 + t * t, -1.5) * sin(psi) * fabs(slope) / sin(atan(t));
        if (want > KD_RIM_BRIGHTEST / KD_STAR_LEAST) /* here an image of even the brightest star is too faint */
            continue;
        const struct kd_star_image *best = NULL;
        for (size_t i = 0; i < n_seen; i++)
            if (!best || hypot(seen[i].x - x, seen[i].y - y) < hypot(best->x - x, best->y - y))
                best = &seen[i];
        if (!best || hypot(best->x - x, best->y - y) > 0.01)
            fail_msg("psi %g: no image at %.4f, %.4f, %g from the curve, but %.4f, %.4f", psi, x, y, off,
                     best ? best->x : NAN, best ? best->y : NAN);
        *place = fmax(*place, hypot(best->x - x, best->y - y));
        *area = fmax(*area, fabs(best->solid_angle / want - 1));
        if (best->mirrored != (k & 1))
            fail_msg("psi %g: the image at %.4f, %.4f that sweeps %g is%s mirrored", psi, x, y, azimuth,
                     best->mirrored ? "" : " not");
        images++;
    }
    return images;
}

static void by_the_lens_equation(void **state)
{
    (void)state;
    double place = 0, area = 0;
    size_t all = 0;
    for (int i = 0; i < 12; i++) {
        const double psi = i < 3 ? M_PI - pow(0.1, i + 1) : 0.2 + 0.25 * i, angle = 2.39996 * i;
        const struct kd_vec star = { cos(psi), sin(psi) * cos(angle), sin(psi) * sin(angle) };
        look(0, 90);
        assert_int_equal(kd_rim_images(&scene, &rim, &star, NULL, 1, keep, NULL, &error), KD_OK);
        const size_t images = judge(psi, angle, &place, &area);
        /* at each edge of the range there may be one more image, which the test permits */
        if (n_seen < images || n_seen > images + 2)
            fail_msg("psi %g: %zu images instead of %zu", psi, n_seen, images);
        all += images;
    }
    printf("%zu images, places within %.1e pixels, solid angles within %.1e\n", all, place, area);
    assert_true(all > 25 && place < 1e-4 && area < 1e-3);
}

/* The solid angle in sr that a pixel shows at that place, which determines whether the place is bright enough to be
 * tested. */
static double shown(double u, double off)
{
    double n[3][3], at[3][2], a[3], b[3];
    for (int k = 0; k < 3; k++) {
        const double turn = u + (k == 1 ? 1e-3 : 0), from = off * (k == 2 ? 1.001 : 1);
        kd_rim_place(&rim, turn, from, at[k]);
        assert_true(kd_rim_sky_at(&scene, &rim, turn, from, n[k]));
    }
    for (int q = 0; q < 3; q++)
        a[q] = n[1][q] - n[0][q], b[q] = n[2][q] - n[0][q];
    const double area = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
    return step * step *
           fabs((n[0][0] * (a[1] * b[2] - a[2] * b[1]) + n[0][1] * (a[2] * b[0] - a[0] * b[2]) +
                 n[0][2] * (a[0] * b[1] - a[1] * b[0])) /
                area);
}

/* A place next to the critical curve. (x, y): the star in the direction to which the reference's ray from this place
 * goes. */
struct place { double u, off, x, y; };

static struct kd_vec star_of(double spin, double inclination, struct place *at)
{
    const struct kd_camera_exact camera = kd_camera_exact(&scene);
    double place[2], d[3];
    kd_rim_place(&rim, at->u, at->off, place);
    kd_rim_look(&rim, place, d);
    assert_true(kd_camera_seen(&camera, d, &at->x, &at->y));
    const double n = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), to[] = { d[0] / n, d[1] / n, d[2] / n };
    const struct ks_path path = ks_trace(ks_from_camera(spin, RADIUS, inclination * (M_PI / 180), false, to), 8);
    const double s = sqrt(1 - path.u * path.u);
    assert_int_equal(path.fate, KS_ESCAPED);
    return (struct kd_vec) { s * cos(path.sky_phi), s * sin(path.sky_phi), path.u };
}

/* The star has an image at that place. */
static void by_the_oracle(void **state)
{
    (void)state;
    enum { PLACES = 40 };
    static const struct {
        double spin, inclination;
    } cases[] = {
        { 0.5, 35 }, { 0.9, 85 }, { -0.9, 120 }, { 0.97, 60 }, { 0.99, 90 }, { 0.9999, 90 }, { -0.9999, 85 }
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct place places[PLACES];
        struct kd_vec stars[PLACES];
        size_t n = 0;
        double worst = 0;
        look(cases[c].spin, cases[c].inclination);
        for (int i = 0; i < PLACES; i++) {
            places[n] =
                (struct place) { .u = fmod(53.37 * i, KD_RIM_ANGLES),
                                 .off = rim.none * pow(rim.last / rim.none, 0.02 + 0.6 * fmod(0.618034 * i, 1)) };
            if (shown(places[n].u, places[n].off) > KD_RIM_BRIGHTEST / KD_STAR_LEAST)
                continue;
            stars[n] = star_of(cases[c].spin, cases[c].inclination, &places[n]);
            n++;
        }
        assert_int_equal(kd_rim_images(&scene, &rim, stars, NULL, n, keep, NULL, &error), KD_OK);
        for (size_t i = 0; i < n; i++) {
            double nearest = INFINITY;
            for (size_t k = 0; k < n_seen; k++)
                nearest = seen[k].star == i ? fmin(nearest, hypot(seen[k].x - places[i].x, seen[k].y - places[i].y))
                                            : nearest;
            if (!(nearest < 1e-3))
                fail_msg("spin %g: no image at %.4f, %.4f, turn %g, %g from the curve; the nearest is %g off",
                         cases[c].spin, places[i].x, places[i].y, places[i].u, places[i].off, nearest);
            worst = fmax(worst, nearest);
        }
        printf("spin %g, inclination %g: %zu places within %.1e pixels of the oracle's\n", cases[c].spin,
               cases[c].inclination, n, worst);
        assert_true(n >= 15);
    }
}

/* The conversion of a pixel to its direction and back gives the same pixel, in every projection and for an observer at
 * infinity. */
static void seeing_is_looking(void **state)
{
    (void)state;
    static const struct {
        enum kd_projection projection;
        double r;
    } cases[] = {
        { KD_PROJECTION_PINHOLE, 20 },
        { KD_PROJECTION_EQUIRECTANGULAR, 20 },
        { KD_PROJECTION_FULLDOME, 20 },
        { KD_PROJECTION_PLANE, INFINITY },
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        look(0.5, 60);
        scene.camera.projection = (int)cases[c].projection;
        scene.camera.r = cases[c].r;
        scene.camera.yaw_deg = 20, scene.camera.pitch_deg = -10, scene.camera.roll_deg = 30;
        const struct kd_camera_exact camera = kd_camera_exact(&scene);
        for (int i = 0; i < 200; i++) {
            const double px = 150 + fmod(61.7 * i, 340), py = 10.3 + fmod(37.1 * i, 340);
            double d[3], x, y;
            kd_camera_look(&camera, px, py, d);
            for (int q = 0; q < 3 && isfinite(cases[c].r); q++)
                d[q] *= 1.7;
            assert_true(kd_camera_seen(&camera, d, &x, &y));
            if (hypot(x - px, y - py) > 1e-9)
                fail_msg("projection %zu: %g, %g is seen at %g, %g", c, px, py, x, y);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(by_the_lens_equation), cmocka_unit_test(by_the_oracle),
                                        cmocka_unit_test(seeing_is_looking) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
