/* Tests of motion without user input in a live session, and of its end. */
#include "scene_support.h"

#include "qnm_reference.h"
#include "render/emit/motion.h"

static struct kd_scene struck(double spin, double amplitude)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.motion.time_rate = 10;
    scene.style.ringdown = amplitude;
    scene.style.ringdown_time = scene.top.time = 1000;
    return scene;
}

static void a_smooth_disk_rests(void **state)
{
    (void)state;
    struct kd_scene scene = struck(0.5, 0);
    assert_false(kd_emit_moves(&scene));
    scene.motion.azimuth_rate_deg = 10;
    assert_false(kd_emit_moves(&scene));
    scene.sky.model = KD_SKY_GRID;
    assert_true(kd_emit_moves(&scene));
    scene = struck(0.5, 0);
    scene.disk.model = KD_DISK_PARTICLES;
    assert_true(kd_emit_moves(&scene));
    scene.motion.time_rate = 0;
    assert_false(kd_emit_moves(&scene));
    for (int sign = -1; sign <= 1; sign += 2) { /* tested at both limits of time */
        scene.motion.time_rate = sign * 1e6;
        scene.top.time = sign * (1e12 - 1);
        assert_true(kd_emit_moves(&scene));
        kd_scene_advance(&scene, 1);
        assert_false(kd_emit_moves(&scene));
        scene.motion.time_rate = -sign;
        assert_true(kd_emit_moves(&scene));
    }
}

static void rings_move_while_time_does(void **state)
{
    (void)state;
    struct kd_scene scene = struck(0.5, 0.01);
    assert_true(kd_emit_moves(&scene));
    scene.top.time = 999.999; /* this time is just before the ringdown begins */
    assert_false(kd_emit_moves(&scene));
    kd_scene_advance(&scene, 1e-3);
    assert_true(kd_emit_moves(&scene));
    scene.motion.time_rate = -10;
    assert_true(kd_emit_moves(&scene));
    scene.motion.time_rate = 0;
    assert_false(kd_emit_moves(&scene));
    scene = struck(-0.5, 1);
    assert_true(kd_emit_moves(&scene));
    scene.disk.model = KD_DISK_NONE;
    assert_false(kd_emit_moves(&scene));
    scene = struck(0.5, 1);
    scene.accuracy.orders = 1; /* with one order only, the ringdown does not show in the picture */
    assert_false(kd_emit_moves(&scene));
}

/* The slope of the sRGB curve at white is 0.44. When the motion ends, the remaining change is between a fortieth and a
 * half of one of 255 steps. The decay time is computed by another method. */
static void it_ends_when_it_cannot_be_seen(void **state)
{
    (void)state;
    static const double amplitudes[] = { 1, 0.1 };
    for (size_t i = 0; i < sizeof qnm_reference / sizeof *qnm_reference; i++) {
        const struct qnm_reference *q = &qnm_reference[i];
        if (q->l != 2 || q->m != 2 || q->n)
            continue;
        for (int k = 0; k < 4; k++) {
            struct kd_scene scene = struck(k & 1 ? q->a : -q->a, amplitudes[k / 2]);
            double decay = 1000 / -q->im, low = 0, high = decay; /* moves at `low`, is at rest at `high` */
            while (high - low > 1e-3) {
                double middle = (low + high) / 2;
                scene.top.time = 1000 + middle;
                *(kd_emit_moves(&scene) ? &low : &high) = middle;
            }
            double left = 0.44 * 255 * amplitudes[k / 2] * exp(q->im * high);
            if (!(left < 0.5 && left > 1 / 40.0))
                fail_msg("spin %g: it ends with %g of a step left", scene.spacetime.spin, left);
        }
    }
}

/* An infalling observer moves until the last place where a camera can be, whatever the scene shows. An orbiting
 * observer counts as moving only if something in the scene is not axially symmetric. */
static void an_observer_goes_on_by_its_own_clock(void **state)
{
    (void)state;
    struct kd_scene scene, later;
    struct kd_fall_clock clock;
    kd_scene_smooth(&scene);
    assert_false(kd_scene_clock(&scene, &clock));
    scene.spacetime.spin = 0;
    scene.spacetime.mass_msun = 4.3e6;
    scene.camera.r = 8;
    scene.camera.observer = KD_OBSERVER_INFALL;
    scene.motion.proper_time_rate = 2;
    assert_true(kd_emit_moves(&scene) && !kd_emit_only_dims(&scene) && kd_scene_falls(&scene) &&
                kd_scene_time_goes_on(&scene));
    const double second = 4.925490947e-6 * 4.3e6, whole = sqrt(2) / 3 * pow(8, 1.5); /* GM/c^3 of the Sun */
    for (double s = 0; s < 6; s += 0.7) {
        later = scene;
        kd_scene_advance(&later, s);
        const double left = fmax(whole - 2 * s, sqrt(2) / 3 * 1e-3);
        assert_true(fabs(later.camera.r - pow(3 / sqrt(2) * left, 2. / 3)) < 1e-10);
        assert_true(kd_scene_clock(&later, &clock));
        assert_true(fabs(clock.to_end - left) < 1e-9 && fabs(clock.second / second - 1) < 1e-6);
        assert_true(later.camera.r > 2 ? fabs(clock.to_horizon - (left - 4. / 3)) < 1e-9 : isnan(clock.to_horizon));
        assert_int_equal(kd_emit_moves(&later), 2 * s < whole);
    }
    scene.motion.proper_time_rate = 0;
    assert_false(kd_emit_moves(&scene) || kd_scene_time_goes_on(&scene));
    scene.camera =
        (struct kd_camera) { .r = 10, .observer = KD_OBSERVER_KEPLERIAN, .inclination_deg = 90, .fov_deg = 50 };
    scene.motion.proper_time_rate = 1;
    assert_false(kd_emit_moves(&scene) || kd_scene_falls(&scene));
    scene.sky.model = KD_SKY_GRID;
    assert_true(kd_emit_moves(&scene) && kd_scene_azimuth_goes_on(&scene));
    kd_scene_advance(&scene, 3);
    assert_true(scene.camera.r == 10 && scene.camera.azimuth_deg > 0 && scene.top.time > 3);
    scene.camera.observer = KD_OBSERVER_STATIC;
    assert_false(kd_emit_moves(&scene) || kd_scene_azimuth_goes_on(&scene));
    assert_true(kd_scene_time_goes_on(&scene));
}

/* With slow light, `time` is the time of a clock far away. For rain in Schwarzschild's metric it advances further than
 * proper time, by the integral of 2/(r - 2) dr. */
static void slow_light_has_the_far_clock(void **state)
{
    (void)state;
    struct kd_scene scene, slow;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = 0;
    scene.camera.r = 8;
    scene.camera.observer = KD_OBSERVER_INFALL;
    slow = scene;
    slow.disk.slow_light = true;
    kd_scene_go_on(&scene, 5);
    kd_scene_go_on(&slow, 5);
    const double r = scene.camera.r;
    assert_true(slow.camera.r == r && fabs(slow.top.time - scene.top.time - 2 * log(6 / (r - 2))) < 1e-10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_smooth_disk_rests),
        cmocka_unit_test(rings_move_while_time_does),
        cmocka_unit_test(it_ends_when_it_cannot_be_seen),
        cmocka_unit_test(an_observer_goes_on_by_its_own_clock),
        cmocka_unit_test(slow_light_has_the_far_clock),
    };
    return cmocka_run_group_tests_name("scene motion", tests, NULL, NULL);
}
