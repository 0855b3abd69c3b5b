/* Tests a frame's stated error of its volumes, over all pixels of the frame. For comparison, the frame is rendered by a
 * march of 16 times as many steps, on rays of 4 times as many steps. */
#include "render_support.h"

#include "kerr_schild.h"

#include <math.h>

enum { WIDTH = 192, HEIGHT = 108, PIXELS = WIDTH * HEIGHT }; /* size of the largest picture */

static struct kd_scene scene_of(const char *preset, const char *json)
{
    struct kd_scene scene;
    OK(kd_scene_preset(&scene, preset, &error));
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.samples = 1;
    scene.image.critical_factor = 1;
    scene.sky.model = KD_SKY_NONE;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,intensity", &error));
    return scene;
}

static struct kd_frame by_plan(const struct kd_scene *scene, uint32_t fine, uint32_t steps)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(scene, &c, &plan, &error));
    plan.light.march.fine *= fine;
    plan.light.march.steps *= steps;
    plan.light.march.opaque /= fine;
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static const float *intensity(const struct kd_frame *frame) { return kd_frame_layer(frame, "intensity")->data; }

/* Quantiles of the errors of the pixels that differ: 80, 90 and 96 %, and the maximum. Errors are relative to a pixel's
 * light, or to a thousandth of the brightest pixel's. */
struct errors { double eight, nine, most, worst; };

static struct errors compare(const struct kd_frame *a, const struct kd_frame *b)
{
    static double off[PIXELS];
    double most = 0;
    int n = 0, left_out = 0;
    const int pixels = (int)(a->width * a->height);
    for (int i = 0; i < pixels; i++)
        most = fmax(most, isfinite(intensity(b)[i]) ? intensity(b)[i] : 0);
    for (int i = 0; i < pixels; i++) {
        const double x = intensity(a)[i], y = intensity(b)[i], own = fmax(x, y);
        assert_true(isfinite(x));
        left_out += !isfinite(y);
        if (isfinite(y) && x != y)
            off[n++] = fabs(x - y) / fmax(own, 1e-3 * most);
    }
    print_message("%d of %d rays left out\n", left_out, pixels);
    assert_true(n > pixels / 20 &&
                /* tolerance: the march through turbulence is so long that lavapipe stops it on 252 of the 20 736 rays
                 * */
                left_out < pixels / 40);
    qsort(off, (size_t)n, sizeof *off, by_value);
    return (struct errors) { off[n * 8 / 10], off[n * 9 / 10], off[n * 96 / 100], off[n - 1] };
}

static const struct {
    const char *preset, *json;
} scenes[] = {
    { "smooth", "{\"volume\":{\"model\":\"uniform\"}}" },
    { "thick-disk", "{\"disk\":{\"gas\":{\"amplitude\":0}},\"camera\":{\"inclination_deg\":90},\"accuracy\":{"
                    "\"profile\":\"draft\"}}" },
    { "thick-disk", "{\"camera\":{\"inclination_deg\":88},\"accuracy\":{\"profile\":\"draft\"}}" },
    { "jet", "{\"disk\":{\"model\":\"none\"}}" },
};

/* A frame states the 90th percentile of the errors of a hundred sampled rays. Within two standard deviations, this lies
 * between the 80th and 96th percentiles of all pixels. With twice as many steps the error is at most half. */
static void test_said(void **state)
{
    (void)state;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        struct kd_scene scene = scene_of(scenes[s].preset, scenes[s].json);
        struct kd_frame plain = by_plan(&scene, 1, 1), fine = by_plan(&scene, 16, 4);
        const struct kd_accuracy_report *said = &plain.accuracy;
        const struct errors is = compare(&plain, &fine);
        print_message("scene %zu: said %.2g, worst %.2g of %u; is %.2g to %.2g to %.2g, worst %.2g\n", s,
                      said->volume_error, said->volume_error_worst, said->volume_sampled, is.eight, is.nine, is.most,
                      is.worst);
        assert_true(said->volume_sampled > 10 && said->volume_sampled < PIXELS / 100);
        assert_true(said->volume_error > 0.5 * is.eight && said->volume_error < 1.5 * is.most);
        assert_true(said->volume_error_worst >= said->volume_error && said->volume_error_worst < 2 * is.worst);
        kd_frame_finish(&plain);
        kd_frame_finish(&fine);
    }
}

/* A medium that makes the oracle measure the length of a ray's path through a shell. */
static void path(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    (void)user, (void)p, (void)r, (void)u;
    out[0] = 1;
    out[1] = 0;
}

/* Largest relative error of a uniform shell, against its closed form. */
static double shell_error(struct kd_scene scene)
{
    enum { N = 9 };
    const double step = 24.0 / N;
    double worst = 0;
    int lit = 0;
    scene.image.width = scene.image.height = N;
    scene.camera.field_m = 24;
    scene.disk.height = 0;
    scene.disk.model = KD_DISK_NONE;
    OK(kd_scene_set(&scene, "volume.model", "uniform", &error));
    OK(kd_scene_set(&scene, "volume.inner", "4", &error));
    OK(kd_scene_set(&scene, "volume.outer", "12", &error));
    OK(kd_scene_set(&scene, "volume.redshift", "false", &error));
    struct kd_frame frame = rendered(&scene);
    for (int i = 0; i < N * N; i++) {
        const double x = step * (i % N - 0.5 * (N - 1)), y = -step * (i / N - 0.5 * (N - 1));
        const struct ks_light way =
            ks_along(ks_from_infinity(scene.spacetime.spin, cos(scene.camera.inclination_deg * M_PI / 180), x, y), 4,
                     12, false, path, NULL);
        const double depth = scene.volume.opacity * way.length,
                     want = -scene.volume.emissivity * way.length * expm1(-depth) / depth;
        if (way.length == 0)
            continue;
        worst = fmax(worst, fabs(intensity(&frame)[i] / want - 1));
        lit++;
    }
    assert_true(lit > N * N / 2);
    kd_frame_finish(&frame);
    return worst;
}

/* Each profile meets its target where the light is smooth: on each ray of a shell, and on nine tenths of the rays of a
 * thick disk. */
static void test_profiles(void **state)
{
    (void)state;
    static const double aims[] = KD_MARCH_ERRORS;
    struct kd_scene scene =
        scene_of("thick-disk", "{\"disk\":{\"gas\":{\"amplitude\":0}},\"camera\":{\"inclination_deg\":80}}");
    struct kd_frame fine = by_plan(&scene, 16, 4);
    double shells[5];
    for (int profile = 0; profile < 5; profile++) {
        scene.accuracy.profile = profile;
        shells[profile] = shell_error(scene);
        struct kd_frame frame = rendered(&scene);
        const struct errors is = compare(&frame, &fine);
        print_message("profile %d, aim %.0e: shell %.2g; thick disk %.2g, worst %.2g\n", profile, aims[profile],
                      shells[profile], is.nine, is.worst);
        assert_true(shells[profile] < aims[profile] && is.nine < aims[profile]);
        kd_frame_finish(&frame);
    }
    assert_true(shells[0] > 5 * shells[2] && shells[1] > 2 * shells[2]); /* the profiles differ */
    kd_frame_finish(&fine);
}

/* Each profile also meets its target in turbulence, and the error that it states is not below the true error. Profiles
 * that take minutes are not tested. */
static void test_stirred(void **state)
{
    (void)state;
    static const double aims[] = KD_MARCH_STIRRED_ERRORS;
    struct kd_scene scene = scene_of("thick-disk", "{\"image\":{\"width\":96,\"height\":54}}");
    /* reference: at "balanced" this march is accurate to a seventh of the target */
    struct kd_frame fine = by_plan(&scene, 2, 1);
    for (int profile = 0; profile <= KD_PROFILE_BALANCED; profile++) {
        scene.accuracy.profile = profile;
        struct kd_frame frame = rendered(&scene);
        const struct errors is = compare(&frame, &fine);
        print_message("profile %d, aim %.0e: turbulent disk %.2g, worst %.2g; said %.2g\n", profile, aims[profile],
                      is.nine, is.worst, frame.accuracy.volume_error);
        assert_true(is.nine < aims[profile] && is.nine > 0.02 * aims[profile]);
        assert_true(frame.accuracy.volume_error < aims[profile]);
        kd_frame_finish(&frame);
    }
    kd_frame_finish(&fine);
}

/* With closer rays the noise has more octaves, so that the march takes shorter steps. A picture of usual size then
 * meets the target of "balanced". */
static void test_close_rays(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_scene scene = scene_of("thick-disk", "{\"image\":{\"width\":320,\"height\":180}}");
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    const uint32_t usual = plan.light.march.fine;
    scene.image.width /= 2;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_int_equal(plan.light.march.fine, usual);
    scene.image.samples = 4;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.light.march.fine > usual);
    scene.image.samples = 1;
    scene.image.width = 640;
    scene.image.height = 360;
    struct kd_frame frame = rendered(&scene);
    print_message("640 x 360: said %.2g of %u rays\n", frame.accuracy.volume_error, frame.accuracy.volume_sampled);
    assert_true(frame.accuracy.volume_sampled > 200 &&
                frame.accuracy.volume_error < ((double[])KD_MARCH_STIRRED_ERRORS)[KD_PROFILE_BALANCED]);
    kd_frame_finish(&frame);
}

/* While a view changes, its frames are sketches, and are marked as such. A sketch states its measured error, which is
 * the true one. It leaves out fine octaves, and does not change the lens map. */
static void test_sketch(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan plan, usual;
    struct kd_frame frame;
    struct kd_scene scene =
        scene_of("thick-disk", "{\"image\":{\"width\":160,\"height\":90},\"accuracy\":{\"profile\":\"draft\"}}");
    struct kd_needs needs = kd_needs_of(&scene);
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &usual, &error));
    needs.sketch = true;
    OK(kd_plan_make_for(&scene, &needs, &c, &plan, &error));
    bool said = false;
    for (size_t i = 0; i < plan.report.n_approximations; i++)
        said |= !strncmp(plan.report.approximations[i].text, "volumes: while the view changes", 31);
    assert_true(said && plan.light.march.sketched && !usual.light.march.sketched &&
                plan.report.n_approximations == usual.report.n_approximations + 1);
    assert_true(plan.light.march.fine < usual.light.march.fine &&
                plan.light.march.weight < 0.8 * usual.light.march.weight);
    assert_string_equal(plan.lens.key, usual.lens.key);
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
    plan.light.march.fine *= 8;
    struct kd_frame fine;
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &fine, &error));
    struct kd_frame all = by_plan(&scene, 8, 1);
    const struct errors is = compare(&frame, &fine), left = compare(&frame, &all);
    print_message("sketch: %.2g, worst %.2g; said %.2g of %u; with the octaves left out %.2g\n", is.nine, is.worst,
                  frame.accuracy.volume_error, frame.accuracy.volume_sampled, left.nine);
    assert_true(is.nine < KD_MARCH_SKETCHED && frame.accuracy.volume_sampled > 10 &&
                frame.accuracy.volume_error < KD_MARCH_SKETCHED);
    assert_true(left.nine < 0.15 && left.nine > is.nine);
    kd_frame_finish(&frame);
    kd_frame_finish(&fine);
    kd_frame_finish(&all);
}

/* A tolerance that 32 bits cannot meet is refused. The message names a tolerance that they can meet. */
static void test_refused(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_error refused;
    struct kd_scene scene = scene_of("thick-disk", "{}");
    kd_renderer_capacity(renderer, &c);
    scene.accuracy.tolerance = 1e-6;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &refused), KD_EINVAL);
    assert_string_equal(refused.pointer, "/accuracy/tolerance");
    assert_non_null(strstr(refused.message, "5e-05"));
    scene.accuracy.tolerance = KD_MARCH_HOLDS;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.light.march.fine > 4);
    scene.accuracy.tolerance = 1e-6;
    scene.disk.height = 0;
    OK(kd_plan_make(&scene, &c, &plan, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_said),       cmocka_unit_test(test_profiles), cmocka_unit_test(test_stirred),
        cmocka_unit_test(test_close_rays), cmocka_unit_test(test_sketch),   cmocka_unit_test(test_refused),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
