/* What a frame says of the error of its volumes is what a march of 16 times as many stretches, on 4 times as many steps, finds in all of its pixels. */
#include "render_support.h"

#include <math.h>

enum { WIDTH = 112, HEIGHT = 63, PIXELS = WIDTH * HEIGHT };

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
    plan.march.fine *= fine;
    plan.march.steps *= steps;
    plan.march.opaque /= fine;
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static const float *intensity(const struct kd_frame *frame) { return kd_frame_layer(frame, "intensity")->data; }

/* Relative to a pixel's light, or to a thousandth of the brightest: what nine of ten pixels with light are within, and the worst. */
static void compare(const struct kd_frame *a, const struct kd_frame *b, double *nine, double *worst)
{
    static double off[PIXELS];
    double most = 0;
    int n = 0;
    for (int i = 0; i < PIXELS; i++)
        most = fmax(most, intensity(b)[i]);
    for (int i = 0; i < PIXELS; i++) {
        const double x = intensity(a)[i], y = intensity(b)[i], own = fmax(x, y);
        if (own > 0)
            off[n++] = fabs(x - y) / fmax(own, 1e-3 * most);
    }
    assert_true(n > PIXELS / 20);
    qsort(off, (size_t)n, sizeof *off, by_value);
    *nine = off[n * 9 / 10];
    *worst = off[n - 1];
}

static const struct { const char *preset, *json; } scenes[] = {
    { "smooth", "{\"volume\":{\"model\":\"uniform\"}}" },
    { "thick-disk", "{\"disk\":{\"gas\":{\"amplitude\":0}},\"camera\":{\"inclination_deg\":90},\"accuracy\":{\"profile\":\"draft\"}}" },
    { "thick-disk", "{\"camera\":{\"inclination_deg\":88},\"accuracy\":{\"profile\":\"draft\"}}" },
    { "jet", "{\"disk\":{\"model\":\"none\"}}" },
};

/* Of some 80 pixels what nine of ten are within is good to a factor of two, and so is what twice as many stretches leave. */
static void test_said(void **state)
{
    (void)state;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        struct kd_scene scene = scene_of(scenes[s].preset, scenes[s].json);
        struct kd_frame plain = by_plan(&scene, 1, 1), fine = by_plan(&scene, 16, 4);
        const struct kd_accuracy_report *said = &plain.accuracy;
        double is, worst;
        compare(&plain, &fine, &is, &worst);
        print_message("scene %zu: said %.2g, worst %.2g of %u; is %.2g, worst %.2g\n", s, said->volume_error, said->volume_error_worst, said->volume_sampled, is, worst);
        assert_true(said->volume_sampled > 10 && said->volume_sampled < PIXELS / 40);
        assert_true(said->volume_error > 0.5 * is && said->volume_error < 2 * is);
        assert_true(said->volume_error_worst >= said->volume_error && said->volume_error_worst < 2 * worst);
        kd_frame_finish(&plain);
        kd_frame_finish(&fine);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_said),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
