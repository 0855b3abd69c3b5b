/* Tests of the two eyes of a stereo pair. Cameras and places are compared with Euclidean geometry in Cartesian
 * coordinates. The comparison is valid far from the hole. For observers who fall from rest at infinity towards a hole
 * without spin it is valid at any radius, because their space is flat (Painleve 1921, Gullstrand 1922). */
#include "scene_support.h"

#include "render/output/wcs.h"
#include "render/view/camera.h"

struct eye { double place[3], ahead[3], right[3], up[3]; };

/* The camera of a scene relative to the hole, from the directions that the kernels are given. */
static struct eye eye_of(const struct kd_scene *scene)
{
    const struct kd_camera_exact c = kd_camera_exact(scene);
    const double theta = scene->camera.inclination_deg * (M_PI / 180), phi = scene->camera.azimuth_deg * (M_PI / 180),
                 r = scene->camera.r;
    const double legs[3][3] = { { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) },
                                { cos(theta) * cos(phi), cos(theta) * sin(phi), -sin(theta) },
                                { -sin(phi), cos(phi), 0 } };
    const double local[3][3] = { { c.c0x, c.c0y, c.c0z }, { c.cxx, c.cxy, c.cxz }, { c.cyx, c.cyy, c.cyz } };
    struct eye e = { 0 };
    double *const to[3] = { e.ahead, e.right, e.up };
    for (int i = 0; i < 3; i++) {
        const double length = sqrt(local[i][0] * local[i][0] + local[i][1] * local[i][1] + local[i][2] * local[i][2]);
        e.place[i] = r * legs[0][i];
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++)
                to[i][k] += local[i][j] / length * legs[j][k];
    }
    return e;
}

static void compare(const struct kd_scene *scene, double bound)
{
    const struct eye middle = eye_of(scene);
    for (int side = -1; side <= 1; side += 2) {
        const struct kd_scene one = kd_scene_eye(scene, side);
        const struct eye got = eye_of(&one);
        const double half = 0.5 * side * scene->camera.eye_distance;
        assert_int_equal(kd_scene_validate(&one, NULL), KD_OK);
        assert_int_equal(one.camera.stereo, KD_STEREO_NONE);
        for (int i = 0; i < 3; i++) {
            const double off[] = { (got.place[i] - middle.place[i] - half * middle.right[i]) /
                                       scene->camera.eye_distance,
                                   got.ahead[i] - middle.ahead[i], got.right[i] - middle.right[i],
                                   got.up[i] - middle.up[i] };
            for (int k = 0; k < 4; k++)
                if (!(fabs(off[k]) <= bound))
                    fail_msg("from %g M, eye %d: %s is off by %g", scene->camera.r, side,
                             (const char *[]) { "the place", "the axis", "right", "up" }[k], off[k]);
        }
    }
}

static const double aims[][5] = {
    /* inclination, azimuth, yaw, pitch, roll */
    { 90, 0, 0, 0, 0 },      { 60, 30, 10, 0, 0 }, { 82, -170, -100, 35, 0 }, { 20, 100, 170, -60, 40 },
    { 140, 10, 5, 5, -120 }, { 0, 0, 12, 0, 0 },   { 180, 50, 0, 20, 300 },
};

static void far_away_eyes_are_euclids(void **state)
{
    (void)state;
    static const enum kd_observer kinds[] = { KD_OBSERVER_STATIC, KD_OBSERVER_ZAMO, KD_OBSERVER_KEPLERIAN,
                                              KD_OBSERVER_INFALL };
    for (size_t i = 0; i < sizeof aims / sizeof *aims; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            struct kd_scene scene;
            kd_scene_smooth(&scene);
            scene.spacetime.spin = 0.9;
            scene.camera = (struct kd_camera) { .r = 1e6,
                                                .inclination_deg = aims[i][0],
                                                .azimuth_deg = aims[i][1],
                                                .yaw_deg = aims[i][2],
                                                .pitch_deg = aims[i][3],
                                                .roll_deg = aims[i][4],
                                                .observer = kinds[k],
                                                .fov_deg = 50,
                                                .infall_from = INFINITY,
                                                .infall_energy = INFINITY,
                                                .stereo = KD_STEREO_PAIR,
                                                .eye_distance = 3e5,
                                                .field_m = 46,
                                                .field_uas = INFINITY,
                                                .ring_decades_min = -10 };
            assert_false(kd_wcs_of(&scene).known);
            compare(&scene, k == 3 ? 3e-6 : 2e-6); /* the error is M/r, and 1.5 M/r for an infalling observer */
        }
}

static void rain_sees_flat_space(void **state)
{
    (void)state;
    static const double radii[] = { 50, 6, 2, 1.1 };
    for (size_t i = 0; i < sizeof aims / sizeof *aims; i++)
        for (size_t k = 0; k < sizeof radii / sizeof *radii; k++) {
            struct kd_scene scene;
            kd_scene_smooth(&scene);
            scene.spacetime.spin = 0;
            scene.camera = (struct kd_camera) { .r = radii[k],
                                                .inclination_deg = aims[i][0],
                                                .azimuth_deg = aims[i][1],
                                                .yaw_deg = aims[i][2],
                                                .pitch_deg = aims[i][3],
                                                .roll_deg = aims[i][4],
                                                .observer = KD_OBSERVER_INFALL,
                                                .fov_deg = 50,
                                                .infall_from = INFINITY,
                                                .infall_energy = INFINITY,
                                                .stereo = KD_STEREO_PAIR,
                                                .eye_distance = 0.5,
                                                .field_m = 46,
                                                .field_uas = INFINITY,
                                                .ring_decades_min = -10 };
            compare(&scene, 1e-12);
        }
}

/* The distance of the eyes near the hole. For an observer of zero angular momentum in the equatorial plane, a unit of
 * length is dr = sqrt(Delta/Sigma) or dphi = 1/sqrt(g_phiphi). */
static void near_eyes_are_as_far_apart_as_they_say(void **state)
{
    (void)state;
    for (double a = -0.9; a < 1; a += 0.45)
        for (double r = 3; r < 30; r *= 2) {
            struct kd_scene scene, eye;
            kd_scene_smooth(&scene);
            scene.spacetime.spin = a;
            scene.camera.r = r;
            scene.camera.inclination_deg = 90;
            scene.camera.observer = KD_OBSERVER_ZAMO;
            scene.camera.stereo = KD_STEREO_PAIR;
            scene.camera.eye_distance = 0.2;
            eye = kd_scene_eye(&scene, 1);
            const double turn = 0.1 / sqrt(r * r + a * a + 2 * a * a / r);
            assert_true(fabs(tan(eye.camera.azimuth_deg * (M_PI / 180)) - turn) < 1e-13);
            assert_true(fabs(eye.camera.r - r * hypot(1, turn)) < 1e-12 && eye.camera.yaw_deg > 0);
            scene.camera.yaw_deg = 90; /* now the camera's right is outwards */
            eye = kd_scene_eye(&scene, 1);
            assert_true(fabs(eye.camera.r - r - 0.1 * sqrt(1 - 2 / r + a * a / (r * r))) < 1e-12 &&
                        fabs(eye.camera.azimuth_deg) < 1e-12);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(far_away_eyes_are_euclids),
        cmocka_unit_test(rain_sees_flat_space),
        cmocka_unit_test(near_eyes_are_as_far_apart_as_they_say),
    };
    return cmocka_run_group_tests_name("eyes of a pair", tests, NULL, NULL);
}
