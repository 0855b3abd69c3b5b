/* Tests of stereo pairs. Each half equals the picture of its eye, byte for byte. The hole's displacement is the
 * Euclidean parallax of the eyes. */
#include "render_support.h"

static struct kd_scene pair_from(double spin, double r, double distance)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = r;
    scene.camera.stereo = KD_STEREO_PAIR;
    scene.camera.eye_distance = distance;
    scene.image.width = 96;
    scene.image.height = 54;
    return scene;
}

static void each_half_is_an_eyes(const struct kd_scene *scene)
{
    struct kd_frame pair = rendered(scene);
    assert_int_equal(pair.width, 2 * scene->image.width);
    assert_int_equal(pair.height, scene->image.height);
    const size_t row = (size_t)scene->image.width * 3;
    for (int side = 0; side < 2; side++) {
        struct kd_scene one = kd_scene_eye(scene, 2 * side - 1);
        if (side)
            one.style.exposure = pair.exposure; /* the pair has the left eye's exposure, which is "auto" */
        struct kd_frame eye = rendered(&one);
        assert_true(eye.exposure == pair.exposure);
        const uint8_t *whole = kd_frame_pixels(&pair), *half = kd_frame_pixels(&eye);
        for (size_t y = 0; y < eye.height; y++)
            assert_memory_equal(whole + (2 * y + (size_t)side) * row, half + y * row, row);
        kd_frame_finish(&eye);
    }
    const uint8_t *whole = kd_frame_pixels(&pair);
    size_t differ = 0;
    for (size_t y = 0; y < pair.height; y++)
        differ += memcmp(whole + 2 * y * row, whole + (2 * y + 1) * row, row) != 0;
    assert_true(differ > pair.height / 4); /* the eyes' views differ */
    kd_frame_finish(&pair);
}

static void test_halves(void **state)
{
    (void)state;
    struct kd_scene scene = pair_from(0.7, 20, 1);
    each_half_is_an_eyes(&scene);
    scene.camera.observer = KD_OBSERVER_KEPLERIAN;
    scene.camera.inclination_deg = 90;
    scene.camera.roll_deg = 30;
    scene.sky.model = KD_SKY_GRID;
    each_half_is_an_eyes(&scene);
    scene = pair_from(0.7, 1.5, 0.2); /* within the horizon */
    scene.camera.observer = KD_OBSERVER_INFALL;
    scene.camera.pitch_deg = 10;
    each_half_is_an_eyes(&scene);
}

/* A camera placed at the left eye by hand: without spin, in the equatorial plane. */
static void test_by_hand(void **state)
{
    (void)state;
    struct kd_scene scene = pair_from(0, 20, 2), hand;
    scene.camera.inclination_deg = 90;
    scene.style.exposure = 0;
    hand = scene;
    hand.camera.stereo = KD_STEREO_NONE;
    hand.camera.r = hypot(20, 1);
    hand.camera.azimuth_deg = hand.camera.yaw_deg = -atan(1 / 20.) * (180 / M_PI);
    struct kd_frame pair = rendered(&scene), one = rendered(&hand);
    const uint8_t *whole = kd_frame_pixels(&pair), *half = kd_frame_pixels(&one);
    double sum = 0;
    for (size_t i = 0; i < (size_t)one.width * one.height * 3; i++) {
        const double off = (double)whole[i / (3 * one.width) * 6 * one.width + i % (3 * one.width)] - half[i];
        sum += off * off;
    }
    assert_true(sqrt(sum / (one.width * one.height * 3.)) <
                0.5); /* tolerance: half of one of 255 levels, because the cameras agree only up to rounding */
    kd_frame_finish(&pair);
    kd_frame_finish(&one);
}

/* For a distant observer, the dark disk is displaced sideways by half of the eyes' distance divided by the radius, in
 * pixels of the tangent plane. */
static void test_parallax(void **state)
{
    (void)state;
    struct kd_scene scene = pair_from(0, 2000, 20);
    scene.disk.model = KD_DISK_NONE;
    scene.sky.model = KD_SKY_GRID;
    scene.sky.grid_deg = 1;
    scene.image.layers = (struct kd_words) { 0 };
    assert_int_equal(kd_scene_set(&scene, "image.layers", "fate", NULL), KD_OK);
    scene.image.legend = false;
    scene.camera.inclination_deg = 90;
    scene.camera.fov_deg = 1.5;
    scene.image.width = 200;
    scene.image.height = 120;
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(&scene, &error));
    OK(kd_plan_make(&scene, &c, &plan, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
    const struct kd_layer *fate = &frame.layers[0];
    const uint8_t *pixels = fate->data;
    const double expected = 10. / 2000 / (2 * tan(0.75 * M_PI / 180)) * 200;
    const uint8_t *corner = pixels; /* the corner is a pixel of the sky */
    for (int side = 0; side < 2; side++) {
        double n = 0, x = 0, y = 0;
        for (uint32_t j = 0; j < 120; j++)
            for (uint32_t i = 0; i < 200; i++)
                if (memcmp(pixels + 3 * ((size_t)j * 400 + 200 * (size_t)side + i), corner, 3)) {
                    n++;
                    x += i - 99.5;
                    y += j - 59.5;
                }
        assert_true(n > 500);
        if (!(fabs(x / n - (side ? -expected : expected)) < 0.3 && fabs(y / n) < 0.3))
            fail_msg("eye %d: the dark disk stands at %g, %g, Euclid has it at %g", side, x / n, y / n,
                     side ? -expected : expected);
    }
    kd_frame_finish(&frame);
}

static void test_plan(void **state)
{
    (void)state;
    struct kd_scene scene = pair_from(0.7, 20, 1), one;
    struct kd_plan plan, single;
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    one = kd_scene_eye(&scene, -1);
    OK(kd_plan_make(&one, &c, &single, &error));
    assert_true(plan.picture.eyes == 2 && single.picture.eyes == 0 &&
                plan.cost.estimate_ms > 1.8 * single.cost.estimate_ms &&
                plan.cost.estimate_ms < 2.2 * single.cost.estimate_ms);
    assert_int_equal(plan.report.n_approximations, single.report.n_approximations + 1);
    scene.image.width++;
    struct kd_plan other;
    OK(kd_plan_make(&scene, &c, &other, &error));
    assert_string_not_equal(plan.lens.key, other.lens.key);
    const struct kd_needs needs = { .light = true, .no_image = true };
    struct kd_error wrong = { 0 };
    assert_int_equal(kd_plan_make_for(&scene, &needs, &c, &plan, &wrong), KD_EINVAL);
    assert_string_equal(wrong.pointer, "/camera/stereo");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_parallax),
        cmocka_unit_test(test_plan),
    };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests_name("stereo", tests, NULL, NULL));
}
