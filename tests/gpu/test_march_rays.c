/* Tests of pixels with several rays through a volume. Their light is the mean of their rays' light, also if the driver
 * stops loops after many passes. */
#include "render_support.h"

#include "render/frame/probe.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 12, HEIGHT = 4, SIDE = 4 };

/* Turbulent, fine gas, seen nearly edge-on. A ray takes some hundred steps, of 22 passes of a loop each. */
static struct kd_frame picture(int width, int height, const char *samples, const char *critical)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    const char *set[][2] = {
        { "spacetime.spin", "0.7" },    { "camera.inclination_deg", "86" },    { "camera.field_m", "14" },
        { "camera.centre_alpha", "8" }, { "disk.model", "novikov-thorne" },    { "disk.emission_opacity", "3" },
        { "disk.height", "0.15" },      { "disk.gas.amplitude", "0.8" },       { "disk.gas.scale", "0.2" },
        { "image.samples", samples },   { "image.critical_factor", critical }, { "image.layers", "rgb,intensity" },
    };
    for (size_t i = 0; i < sizeof set / sizeof *set; i++)
        OK(kd_scene_set(&scene, set[i][0], set[i][1], &error));
    scene.image.width = width;
    scene.image.height = height;
    return rendered(&scene);
}

static const float *intensity(const struct kd_frame *frame)
{
    const struct kd_layer *layer = kd_frame_layer(frame, "intensity");
    assert_non_null(layer);
    return layer->data;
}

static double mean_of_rays(const float *single, int x, int y)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += single[(y * SIDE + i / SIDE) * WIDTH * SIDE + x * SIDE + i % SIDE];
    return sum / (SIDE * SIDE);
}

static double off(double is, double want) { return fabs(is / want - 1); }

/* Tests pictures with sixteen rays in each pixel, and pictures with as many rays as each pixel needs. */
static void test_mean(void **state)
{
    (void)state;
    struct kd_frame rays = picture(WIDTH * SIDE, HEIGHT * SIDE, "1", "1"), many = picture(WIDTH, HEIGHT, "4", "1");
    struct kd_frame one = picture(WIDTH, HEIGHT, "1", "1"), chosen = picture(WIDTH, HEIGHT, "auto", "1");
    double worst = 0, worst_chosen = 0;
    int refined = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double want = mean_of_rays(intensity(&rays), i % WIDTH, i / WIDTH);
        const double by_many = off(intensity(&many)[i], want), by_one = off(intensity(&chosen)[i], intensity(&one)[i]);
        const double by_chosen = off(intensity(&chosen)[i], want);
        assert_true(want > 0);
        refined += by_one > 1e-3;
        worst = fmax(worst, by_many);
        worst_chosen = fmax(worst_chosen, fmin(by_one, by_chosen));
    }
    printf("%d pixels: worst %.2g; %d refined: worst %.2g\n", WIDTH * HEIGHT, worst, refined, worst_chosen);
    assert_true(worst < 1e-5 && refined > WIDTH * HEIGHT / 8 &&
                worst_chosen < 0.01); /* tolerance: the footprint of a listed ray is measured differently */
    struct kd_frame *all[] = { &rays, &many, &one, &chosen };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        kd_frame_finish(all[i]);
}

/* Rays along a turbulent disk of 5e5 M, some hundred M of which are visible. Rays take only few steps in the dark.
 * lavapipe stops loops of eight rays after 65 535 passes, but stops none of these. With steps for all streaks, 18 rays
 * were given up, and 5 pixels of the layer had no light. */
static void test_wide(void **state)
{
    (void)state;
    static const char json[] =
        "{\"camera\":{\"inclination_deg\":70},\"style\":{\"exposure\":0,\"bloom\":0},\"disk\":{\"height\":0.1,"
        "\"outer\":500000,"
        "\"emission_opacity\":10,\"gas\":{\"amplitude\":0.8}},\"image\":{\"width\":48,\"height\":27,"
        "\"critical_factor\":1,\"layers\":[\"rgb\",\"intensity\"],"
        "\"tile\":{\"left\":8,\"top\":19,\"width\":8,\"height\":4}}}";
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    struct kd_frame frame = rendered(&scene);
    uint32_t untold = 0;
    for (uint32_t i = 0; i < frame.width * frame.height; i++)
        untold += !isfinite(intensity(&frame)[i]);
    printf("%u of %u pixels have no light, %llu rays were given up\n", untold, frame.width * frame.height,
           (unsigned long long)frame.accuracy.lost);
    assert_int_equal(frame.accuracy.lost, 0);
    assert_int_equal(untold, 0);
    kd_frame_finish(&frame);
}

/* A ray that grazes the horizon has light. This is tested for an extremal hole and an observer who falls near it, with
 * each kind of gas that fills space. */
static void test_extremal(void **state)
{
    (void)state;
    static const char *const volumes[] = {
        "\"model\":\"uniform\"",
        "\"model\":\"torus\",\"inner\":20,\"outer\":90,\"torus_radius\":30",
        "\"model\":\"gold\"",
        "\"model\":\"riaf\"",
    };
    for (size_t k = 0; k < sizeof volumes / sizeof *volumes; k++) {
        char json[512];
        struct kd_scene scene;
        kd_scene_smooth(&scene);
        snprintf(json, sizeof json,
                 "{\"spacetime\":{\"spin\":-0.999999999999},\"camera\":{\"r\":3,\"observer\":\"infall\","
                 "\"inclination_deg\":120,\"yaw_deg\":45},\"disk\":{\"model\":\"none\"},"
                 "\"volume\":{%s},\"style\":{\"exposure\":0,\"bloom\":0},"
                 "\"image\":{\"width\":36,\"height\":36,\"layers\":[\"rgb\",\"intensity\"]}}",
                 volumes[k]);
        OK(kd_scene_from_json(&scene, json, strlen(json), &error));
        struct kd_frame frame = rendered(&scene);
        uint32_t untold = 0, lit = 0;
        for (uint32_t i = 0; i < frame.width * frame.height; i++) {
            untold += !isfinite(intensity(&frame)[i]);
            lit += intensity(&frame)[i] > 0;
        }
        printf("%s: %u of %u pixels have no light, %u are lit, %llu rays were given up\n", volumes[k], untold,
               frame.width * frame.height, lit, (unsigned long long)frame.accuracy.lost);
        assert_int_equal(frame.accuracy.lost, 0);
        assert_int_equal(untold, 0);
        assert_true(lit > frame.width * frame.height / 3);
        kd_frame_finish(&frame);
    }
}

/* A tile of a tall turbulent disk at the finest setting: its rays take thousands of steps. */
static struct kd_scene tall(int width, int samples, int left, int top, int columns, int rows)
{
    char json[512];
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    snprintf(
        json, sizeof json,
        "{\"accuracy\":{\"profile\":\"reference\"},\"style\":{\"exposure\":0,\"bloom\":0},\"disk\":{\"height\":0.3,"
        "\"emission_opacity\":10,\"gas\":{\"amplitude\":0.8}},\"image\":{\"width\":%d,\"height\":%d,\"samples\":%d,"
        "\"critical_factor\":1,\"layers\":[\"rgb\",\"intensity\"],"
        "\"tile\":{\"left\":%d,\"top\":%d,\"width\":%d,\"height\":%d}}}",
        width, width * 3 / 4, samples, left, top, columns, rows);
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    return scene;
}

/* The light of one ray that is traced alone, divided by the light of its pixel. */
static double beside_alone(const struct kd_scene *scene, uint32_t x, uint32_t y)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(scene, &c, &plan, &error));
    plan.report.probe.on = true;
    plan.report.probe.x = x;
    plan.report.probe.y = y;
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    assert_non_null(frame.told);
    assert_int_equal(frame.accuracy.lost, 0);
    double worst = 0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, off((double)frame.told->radiance[i], (double)frame.told->middle.light[i]));
    kd_frame_finish(&frame);
    return worst;
}

/* lavapipe stops the loops of eight such rays together, but not the loop of a single ray. Stopped rays are continued in
 * pieces. Their light is then the same as for rays that are traced alone, also within their pixel. Without this, 16
 * rays of the tile were given up. */
static void test_pieces(void **state)
{
    (void)state;
    enum { LEFT = 36, TOP = 32, COLUMNS = 8, ROWS = 2 };
    const struct kd_scene scene = tall(96, 1, LEFT, TOP, COLUMNS, ROWS),
                          coarse = tall(48, 2, LEFT / 2, TOP / 2, COLUMNS / 2, ROWS / 2);
    struct kd_frame rays = rendered(&scene), many = rendered(&coarse);
    const float *each = intensity(&rays);
    double worst = 0, worst_mean = 0;
    for (uint32_t x = 0; x < COLUMNS; x++)
        worst = fmax(worst, beside_alone(&scene, x, 0));
    for (int i = 0; i < COLUMNS / 2; i++) {
        const float *four = each + 2 * i;
        const double mean = ((double)four[0] + four[1] + four[COLUMNS] + four[COLUMNS + 1]) / 4;
        worst_mean = fmax(worst_mean, off(intensity(&many)[i], mean));
    }
    printf("%llu and %llu rays were given up; worst beside a ray alone %.2g, beside the mean of four %.2g\n",
           (unsigned long long)rays.accuracy.lost, (unsigned long long)many.accuracy.lost, worst, worst_mean);
    assert_int_equal(rays.accuracy.lost + many.accuracy.lost, 0);
    assert_true(worst < 2e-6 && worst_mean < 2e-6);
    kd_frame_finish(&rays);
    kd_frame_finish(&many);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_mean), cmocka_unit_test(test_wide),
                                        cmocka_unit_test(test_pieces), cmocka_unit_test(test_extremal) };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
