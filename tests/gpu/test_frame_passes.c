/* Tests that a frame runs exactly the passes of its plan, under the names in the plan. The passes' times become the
 * estimates of the next plan. */
#include "render_support.h"

#include "render/device/device_internal.h"
#include "render/frame/frame.h"
#include "render/plan/cost_class.h"

#include <math.h>
#include <string.h>

static const char *const scenes[] = {
    "{\"image\": {\"width\": 96, \"height\": 64}}",
    "{\"image\": {\"width\": 96, \"height\": 64}, \"sky\": {\"model\": \"grid\"}, \"style\": {\"exposure\": 0}}",
    "{\"image\": {\"width\": 96, \"height\": 64}, \"disk\": {\"model\": \"particles\", \"particles\": 100000}}",
    "{\"image\": {\"width\": 96, \"height\": 64}, \"spots\": [{\"brightness\": 1}]}",
    "{\"image\": {\"width\": 96, \"height\": 64, \"samples\": \"auto\"}, \"camera\": {\"inclination_deg\": 61}}",
    "{\"image\": {\"width\": 96, \"height\": 64}, \"camera\": {\"r\": 3}}",
    "{\"image\": {\"width\": 96, \"height\": 64}, \"accuracy\": {\"engine\": \"ks-rk4\"}}",
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static struct kd_frame drawn(const char *json, struct kd_plan *plan)
{
    struct kd_scene scene;
    struct kd_capacity c;
    struct kd_frame frame = { 0 };
    struct kd_error error = { 0 };
    kd_scene_smooth(&scene);
    kd_renderer_capacity(renderer, &c);
    if (kd_scene_from_json(&scene, json, strlen(json), &error) || kd_scene_validate(&scene, &error) ||
        kd_plan_make(&scene, &c, plan, &error) || kd_render(renderer, &scene, plan, NULL, NULL, &frame, &error))
        fail_msg("%s: %s", json, error.message);
    return frame;
}

static bool planned(const struct kd_plan *plan, const char *name)
{
    for (size_t i = 0; i < plan->cost.n_passes; i++)
        if (!strcmp(plan->cost.passes[i].name, name))
            return true;
    /* not in the plan: "rays", the device's part of a "trace" of listed rays; "kernels", the time to compile missing
     * kernels */
    return !strcmp(name, "kernels") || !strcmp(name, "upload") || !strcmp(name, "fill") || !strcmp(name, "rays") ||
           !strcmp(name, "total");
}

static void test_names(void **state)
{
    (void)state;
    for (int k = 0; k < SCENES; k++) {
        struct kd_plan plan;
        struct kd_frame frame = drawn(scenes[k], &plan);
        for (size_t i = 0; i < plan.cost.n_passes; i++)
            if (!(timing_of(&frame, plan.cost.passes[i].name) > 0))
                fail_msg("%s: the pass \"%s\" is planned and did not run", scenes[k], plan.cost.passes[i].name);
        for (size_t i = 0; i < frame.n_timings; i++)
            if (!planned(&plan, frame.timings[i].name))
                fail_msg("%s: \"%s\" ran and is not planned", scenes[k], frame.timings[i].name);
        kd_frame_finish(&frame);
        frame = drawn(scenes[k], &plan); /* the second frame uses the cached lens map */
        assert_true(frame.lens_reused);
        for (int i = 0; i < KD_PASS_COUNT; i++)
            if (kd_passes[i].when == KD_EACH_MAP)
                assert_false(ran(&frame, kd_passes[i].name));
        kd_frame_finish(&frame);
    }
}

/* After fifteen frames a wrong estimate has become the true cost of its pass. An estimate that the frames do not
 * measure is unchanged. The time of a frame includes the time in which other processes used the cores, but the learned
 * cost does not. */
static void test_learned(void **state)
{
    (void)state;
    static const char *const scene =
        "{\"image\": {\"width\": 192, \"height\": 108}, \"disk\": {\"model\": \"particles\", \"particles\": 100000}}";
    struct kd_plan plan;
    struct kd_frame frame;
    bool learns[KD_FIGURE_COUNT + 1] = { false };
    double last[KD_FIGURE_COUNT] = { 0 };
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        renderer->capacity.ns[i] = 1e5;
    for (int k = 0; k < 15; k++) {
        renderer->store.maps[0].key[0] = renderer->store.maps[1].key[0] = renderer->store.maps[2].key[0] =
            renderer->store.maps[3].key[0] = 0;
        renderer->frames = 0; /* a new renderer, because there each frame updates the estimates */
        frame = drawn(scene, &plan);
        for (size_t i = 0; i < plan.cost.n_passes; i++) {
            learns[plan.cost.passes[i].figure] = true;
            if (plan.cost.passes[i].figure != KD_NS_NONE)
                last[plan.cost.passes[i].figure] =
                    timing_of(&frame, plan.cost.passes[i].name) * 1e6 / (double)plan.cost.passes[i].invocations;
        }
        kd_frame_finish(&frame);
    }
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        if (learns[i] ? !(renderer->capacity.ns[i] < 1e4 && renderer->capacity.ns[i] > 0.01 * last[i])
                      : renderer->capacity.ns[i] != 1e5)
            fail_msg("\"%s\" is %g ns, the last frame took %g", kd_figures[i].word, renderer->capacity.ns[i], last[i]);
    assert_true(learns[KD_NS_RAY_FULL] && learns[KD_NS_SAMPLE_TRANSFER] && learns[KD_NS_PIXEL_POST] &&
                learns[KD_NS_PARTICLE] && !learns[KD_NS_RAY_RADIUS]);
}

/* Stars and diffuse light take several times as long as the light of a disk. They have their own estimates, and do not
 * change those of disks. */
static void test_stars_are_learned(void **state)
{
    (void)state;
    struct kd_plan plan;
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        renderer->capacity.ns[i] = 1e5;
    for (int k = 0; k < 10; k++) {
        renderer->store.maps[0].key[0] = renderer->store.maps[1].key[0] = renderer->store.maps[2].key[0] =
            renderer->store.maps[3].key[0] = 0;
        renderer->frames = 0; /* a new renderer, because there each frame updates the estimates */
        struct kd_frame frame = drawn("{\"image\": {\"width\": 192, \"height\": 108}, \"disk\": {\"model\": \"none\"}, "
                                      "\"sky\": {\"model\": \"stars\"}}",
                                      &plan);
        assert_true(timing_of(&frame, "stars") > 0 && timing_of(&frame, "transfer") > 0);
        kd_frame_finish(&frame);
    }
    const double *ns = renderer->capacity.ns;
    print_message("stars %.0f ns a ray, light %.0f ns\n", ns[KD_NS_RAY_STARS], ns[KD_NS_SAMPLE_STARS]);
    assert_true(ns[KD_NS_RAY_STARS] < 5e4 && ns[KD_NS_SAMPLE_STARS] < 5e4 && ns[KD_NS_SAMPLE_TRANSFER] == 1e5);
}

static double estimated(const struct kd_plan *plan, const char *pass)
{
    for (size_t i = 0; i < plan->cost.n_passes; i++)
        if (!strcmp(plan->cost.passes[i].name, pass))
            return plan->cost.passes[i].estimate_ms;
    return 0;
}

/* Refinement traces as many rays as the picture needs, which is estimated from earlier pictures. For turbulent gas the
 * estimate used to be a seventh of the actual number. */
static void test_refining_is_learned(void **state)
{
    (void)state;
    static const char *const scene = "{\"image\": {\"width\": 192, \"height\": 108, \"samples\": \"auto\"}, \"disk\": "
                                     "{\"gas\": {\"amplitude\": 0.6, \"scale\": 0.6, \"shear\": 8}}}";
    struct kd_plan plan;
    double took = 0, others = 0;
    renderer->capacity.ns[KD_NS_RAY_REFINED] = 1;
    for (int k = 0; k < 10; k++) {
        renderer->frames = 0; /* a new renderer, because there each frame updates the estimates */
        struct kd_frame frame = drawn(scene, &plan);
        if (k >= 5)
            took += timing_of(&frame, "refine") / 5;
        others = timing_of(&frame, "total");
        kd_frame_finish(&frame);
    }
    struct kd_frame frame = drawn(scene, &plan);
    kd_frame_finish(&frame);
    const double estimate = estimated(&plan, "refine");
    print_message("refining took %.1f ms of %.1f, and is estimated at %.1f\n", took, others, estimate);
    /* The estimate excludes the time in which other processes used the cores. With eight busy threads on two cores, the
     * estimate is a fifth of the measured time. */
    assert_true(estimate > took / 50 && estimate < 2 * took);
}

/* The estimate for a picture comes from pictures of its class, whatever was rendered in between. Classes matter,
 * because the light of a volume takes a hundred times as long as that of a smooth disk. */
static void test_classes_are_learned(void **state)
{
    (void)state;
    static const char *const volume =
                                 "{\"image\": {\"width\": 64, \"height\": 64}, \"volume\": {\"model\": \"torus\"}}",
                             *const other_volume =
                                 "{\"image\": {\"width\": 64, \"height\": 64}, \"volume\": {\"model\": \"uniform\"}}",
                             *const larger = "{\"image\": {\"width\": 128, \"height\": 128}, \"volume\": {\"model\": "
                                             "\"torus\"}, \"camera\": {\"azimuth_deg\": 50}}";
    struct kd_plan plan;
    double least = INFINITY, most = 0;
    for (int k = 0; k < 3; k++) {
        /* The first frames compile kernels. Their costs are discarded. */
        if (k == 1)
            memset(renderer->capacity.classes, 0, sizeof renderer->capacity.classes);
        for (int other = 0; other < 2; other++) {
            renderer->frames = 0; /* a new renderer, because there each frame updates the estimates */
            struct kd_frame frame = drawn(other ? other_volume : volume, &plan);
            const double took = timing_of(&frame, "march") * 1e6 / (double)(64 * 64);
            if (!other && k > 0)
                least = fmin(least, took), most = fmax(most, took);
            kd_frame_finish(&frame);
        }
    }
    struct kd_capacity learned;
    kd_renderer_capacity(renderer, &learned);
    struct kd_frame frame = drawn(larger, &plan);
    kd_frame_finish(&frame);
    const double known = kd_cost_known(&learned, plan.cost.class, KD_PASS_MARCH);
    print_message("a ray took %.0f to %.0f ns, and is known to take %.0f\n", least, most, known);
    /* The times of the two measured frames may differ by a factor of several, if other processes used the cores during
     * one of them. The estimate excludes that time. */
    assert_true(known > least / 100 && known < 1.01 * most);
    assert_true(fabs(estimated(&plan, "march") - known * 1e-6 * (double)kd_plan_rays(&plan.lens)) < 1e-6 * known);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_learned),
        cmocka_unit_test(test_stars_are_learned),
        cmocka_unit_test(test_refining_is_learned),
        cmocka_unit_test(test_classes_are_learned),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
