/* Tests of slow light of volumes. Emission times along a ray are compared with the Kerr-Schild oracle, which does not
 * use Mino time. The turbulence of a disk of some height is compared with pictures at the emission times that the lens
 * map and the oracle give. */
#include "physics/spacetime/kerr.h"
#include "render/explain/explain.h"
#include "scene/hole.h"

#include "render_support.h"

#include "kerr_schild.h"

#include <math.h>

enum { WIDTH = 15, HEIGHT = 11, PIXELS = WIDTH * HEIGHT };

static struct kd_scene scene_of(double spin, double inclination, double r, const char *json)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.samples = 1;
    scene.image.critical_factor = 1;
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.r = r;
    scene.camera.field_m = 30;
    scene.camera.fov_deg = 60;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,intensity", &error));
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

static struct ks_photon photon_of(const struct kd_scene *scene, int x, int y)
{
    const double theta = scene->camera.inclination_deg * M_PI / 180;
    const bool far = isinf(scene->camera.r);
    const int width = scene->image.width, height = scene->image.height;
    const double step = far ? scene->camera.field_m / width : 2 * tan(scene->camera.fov_deg * M_PI / 360) / width;
    const double right = step * (x - 0.5 * (width - 1)), up = -step * (y - 0.5 * (height - 1));
    const double length = sqrt(1 + right * right + up * up), k[3] = { -1 / length, -up / length, right / length };
    const double a = scene->spacetime.spin, q = scene->spacetime.charge;
    return far ? ks_from_infinity_charged(a, q, cos(theta), right, up)
               : ks_from_camera_charged(a, q, scene->camera.r, theta, scene->camera.observer == KD_OBSERVER_ZAMO, k);
}

static struct kd_frame told_at(const struct kd_scene *scene, int x, int y)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    char at[40];
    kd_renderer_capacity(renderer, &c);
    needs.radiance = true;
    snprintf(at, sizeof at, "%d.5,%d.5", x, y);
    OK(kd_plan_make_for(scene, &needs, &c, &plan, &error));
    OK(kd_explain_at(at, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    assert_non_null(frame.told);
    return frame;
}

struct judged {
    int places;
    double worst, least, most;
};

/* Compares the emission times at both ends of each step of a ray with the oracle's. */
static void judge_ray(const struct kd_scene *scene, int x, int y, struct judged *all)
{
    static double places[2 * KD_PROBED_STRETCHES][2], want[2 * KD_PROBED_STRETCHES], off[2 * KD_PROBED_STRETCHES];
    struct kd_frame frame = told_at(scene, x, y);
    const struct kd_probed_ray *told = &frame.told->middle;
    const double near_horizon = 1.05 * kd_scene_hole(scene)->outer;
    for (size_t i = 0; i < 2 * told->n_stretches; i++) {
        places[i][0] = 1 / (double)told->stretches[i / 2].w[i % 2];
        places[i][1] = (double)told->stretches[i / 2].u[i % 2];
    }
    ks_delays(photon_of(scene, x, y), (const double (*)[2])places, 2 * (int)told->n_stretches, want, off);
    for (size_t i = 0; i < 2 * told->n_stretches; i++) {
        const double is = (double)told->stretches[i / 2].delay[i % 2], wrong = fabs(is - want[i]);
        if (places[i][0] < near_horizon)
            continue;
        if (!(off[i] < 2e-5 * places[i][0]))
            fail_msg("spin %g, (%d, %d): the oracle passes (r %.7g, cos %.7g) by %.2g", scene->spacetime.spin, x, y,
                     places[i][0], places[i][1], off[i]);
        if (!(wrong <= 2e-4))
            fail_msg(
                "spin %g, inclination %g, camera %g, (%d, %d): delay of (r %.7g, cos %.7g) is %.7g, by the oracle %.7g",
                scene->spacetime.spin, scene->camera.inclination_deg, scene->camera.r, x, y, places[i][0], places[i][1],
                is, want[i]);
        all->places++;
        all->worst = fmax(all->worst, wrong);
        all->least = fmin(all->least, is);
        all->most = fmax(all->most, is);
    }
    kd_frame_finish(&frame);
}

/* Tests the times that the march computes, for rays that pass the hole, circle it and fall in. */
static void test_delays(void **state)
{
    (void)state;
    static const struct {
        double spin, inclination, r;
        const char *json;
    } views[] = {
        { 0, 60, INFINITY, "{}" },
        { 0.9, 80, INFINITY, "{}" },
        { 0.998, 17, INFINITY, "{}" },
        { -0.7, 150, INFINITY, "{}" },
        { 0.95, 88, 60, "{}" },
        { 0.5, 40, 7, "{}" },                                                     /* the camera is within the volume */
        { 0.9, 89, 1.9, "{\"camera\":{\"observer\":\"zamo\",\"fov_deg\":120}}" }, /* within the ergosphere */
        { 0, 60, INFINITY, "{\"spacetime\":{\"charge\":0.9}}" },
        { 0.6, 80, 20, "{\"spacetime\":{\"charge\":0.7}}" },
    };
    static const int at[][2] = { { 4, 5 }, { 5, 6 }, { 6, 4 }, { 8, 7 }, { 9, 4 }, { 13, 6 } };
    struct judged all = { 0, 0, INFINITY, -INFINITY };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = scene_of(views[v].spin, views[v].inclination, views[v].r, views[v].json);
        scene.disk.model = KD_DISK_NONE;
        scene.volume.model = KD_VOLUME_UNIFORM;
        scene.volume.outer = 40;
        scene.volume.opacity = 0;
        for (size_t i = 0; i < sizeof at / sizeof *at; i++)
            judge_ray(&scene, at[i][0], at[i][1], &all);
    }
    printf("%d places: off by %.2g M at worst, delays from %.4g to %.4g\n", all.places, all.worst, all.least, all.most);
    assert_true(all.places > 500 && all.most - all.least > 50);
}

static const float *layer(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *of = kd_frame_layer(frame, name);
    assert_non_null(of);
    return of->data;
}

#define TIME 5000.0
#define GAS \
    "{\"time\":5000,\"camera\":{\"field_m\":20,\"fov_deg\":45},\"disk\":{\"outer\":16,\"slow_light\":true,\"gas\":{" \
    "\"amplitude\":0.8,\"octaves\":2,\"scale\":1}}}"

/* Delays of the crossings that pixels show: from the thin disk's lens map, or from the oracle for a near observer. */
static void thin_delays(struct kd_scene scene, double out[PIXELS])
{
    for (int i = 0; i < PIXELS && isfinite(scene.camera.r); i++)
        out[i] = ks_trace(photon_of(&scene, i % WIDTH, i / WIDTH), 1).delay[0];
    if (isfinite(scene.camera.r))
        return;
    scene.disk.height = 0;
    OK(kd_scene_set(&scene, "image.layers", "rgb,delay", &error));
    struct kd_frame frame = rendered(&scene);
    for (int i = 0; i < PIXELS; i++)
        out[i] = (double)layer(&frame, "delay")[i];
    kd_frame_finish(&frame);
}

/* If the gas is opaque and has almost no height, a pixel shows the point where its ray first crosses the plane. The
 * point looks as in a picture of the emission time. */
static void test_thin(void **state)
{
    (void)state;
    static const struct { double spin, inclination, r; } views[] = { { 0.9, 70, INFINITY }, { -0.4, 60, 25 } };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = scene_of(views[v].spin, views[v].inclination, views[v].r, GAS);
        double delays[PIXELS];
        thin_delays(scene, delays);
        scene.disk.height = 5e-5;
        struct kd_frame slow = rendered(&scene);
        scene.disk.slow_light = false;
        struct kd_frame now = rendered(&scene);
        double worst = 0, of_now = 0;
        int n = 0;
        for (int i = 3; i < PIXELS && n < 8; i += 7) {
            const double seen = (double)layer(&slow, "intensity")[i], delay = delays[i];
            if (!(seen > 0.02) || !isfinite(delay))
                continue;
            scene.top.time = TIME - delay;
            struct kd_frame then = rendered(&scene);
            const double off = fabs(seen / (double)layer(&then, "intensity")[i] - 1);
            kd_frame_finish(&then);
            scene.top.time = TIME;
            if (!(off < 5e-3))
                fail_msg("view %zu, pixel %d, delay %g: light is off by %g of it", v, i, delay, off);
            worst = fmax(worst, off);
            of_now += fabs(seen / (double)layer(&now, "intensity")[i] - 1);
            n++;
        }
        printf("view %zu: %d pixels off by %.1e at most, by %.2f in the mean from the picture of one time\n", v, n,
               worst, of_now / n);
        assert_true(n == 8 && of_now / n > 0.05);
        kd_frame_finish(&slow);
        kd_frame_finish(&now);
    }
}

/* Seen along the axis, all light of a circle was emitted at the same time. The circle therefore looks the same as in a
 * picture of that time. */
static void test_face_on(void **state)
{
    (void)state;
    static const int at[][4] = {
        { 11, 5, 3, 5 }, { 7, 1, 7, 9 }, { 10, 2, 4, 8 }, { 4, 2, 10, 8 }
    }; /* two pixels opposite each other */
    struct kd_scene scene = scene_of(0.7, 0, INFINITY, GAS);
    scene.disk.height = 1e-3;
    struct kd_frame slow = rendered(&scene);
    scene.disk.slow_light = false;
    double worst = 0;
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        const struct ks_path path = ks_trace(photon_of(&scene, at[k][0], at[k][1]), 1);
        assert_int_equal(path.crossings, 1);
        scene.top.time = TIME - path.delay[0];
        struct kd_frame then = rendered(&scene);
        for (int i = 0; i < 2; i++) {
            const int pixel = at[k][2 * i + 1] * WIDTH + at[k][2 * i];
            const double is = (double)layer(&slow, "intensity")[pixel], want = (double)layer(&then, "intensity")[pixel];
            if (!(want > 0 && fabs(is / want - 1) < 5e-3))
                fail_msg("pixel %d, delay %g: %g, not %g", pixel, path.delay[0], is, want);
            worst = fmax(worst, fabs(is / want - 1));
        }
        kd_frame_finish(&then);
    }
    printf("face on: off by %.1e at most\n", worst);
    kd_frame_finish(&slow);
}

/* Pictures contain no NaN, either next to the horizon, where the emission time diverges, or far away. Pictures from
 * within the horizon are refused. */
static void test_extremes(void **state)
{
    (void)state;
    static const struct {
        double spin, inclination, r;
        const char *json;
    } hard[] = {
        { 0.999999999999, 88, INFINITY, "{}" }, /* gas almost at the horizon */
        { 0.998, 90, 1.0633, "{\"camera\":{\"observer\":\"zamo\"}}" },
        { 0.7, 60, 1.71432, "{\"camera\":{\"observer\":\"zamo\",\"yaw_deg\":180}}" },
        { 0.5, 75, 1.87, "{\"camera\":{\"observer\":\"infall\"}}" },
        { -0.999, 180, INFINITY, "{\"disk\":{\"outer\":1e6},\"camera\":{\"field_m\":2e6}}" },
    };
    for (size_t v = 0; v < sizeof hard / sizeof *hard; v++) {
        struct kd_scene scene = scene_of(hard[v].spin, hard[v].inclination, hard[v].r, hard[v].json);
        scene.disk.slow_light = true;
        scene.disk.height = 0.2;
        scene.gas.amplitude = 0.8;
        scene.disk.emission_opacity = 0.3;
        struct kd_frame frame = rendered(&scene);
        for (int i = 0; i < PIXELS; i++)
            if (!(layer(&frame, "intensity")[i] >= 0 && isfinite(layer(&frame, "intensity")[i])))
                fail_msg("scene %zu, pixel %d: %g", v, i, (double)layer(&frame, "intensity")[i]);
        kd_frame_finish(&frame);
    }
    struct kd_scene scene = scene_of(0.5, 75, 1.5,
                                     "{\"camera\":{\"observer\":\"infall\"},\"disk\":{\"slow_light\":true,\"height\":0."
                                     "2,\"gas\":{\"amplitude\":1}}}");
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_error refused;
    kd_renderer_capacity(renderer, &c);
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &refused), KD_EINVAL);
    assert_string_equal(refused.pointer, "/disk/slow_light");
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_delays), cmocka_unit_test(test_thin),
                                        cmocka_unit_test(test_face_on), cmocka_unit_test(test_extremes) };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
