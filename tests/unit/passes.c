/* Tests that the table of passes is consistent: every pass occurs in some plan, and some pass measures every cost
 * figure. The same is tested for emitters with a cost figure. */
#include "render/accuracy/table.h"
#include "render/emit/emitter.h"
#include "render/frame/frame.h"
#include "render/plan/cost_class.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static struct kd_capacity device(void)
{
    struct kd_capacity c = { .max_binding_bytes = 128u << 20,
                             .memory_bytes = 1u << 30,
                             .accuracy = kd_accuracy_built_in() };
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        c.ns[i] = 10 * (i + 1);
    return c;
}

static struct kd_plan planned(const char *json, const struct kd_capacity *c)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_error error = { 0 };
    kd_scene_smooth(&scene);
    if (kd_scene_from_json(&scene, json, strlen(json), &error) || kd_scene_validate(&scene, &error) ||
        kd_plan_make(&scene, c, &plan, &error))
        fail_msg("%s: %s", json, error.message);
    return plan;
}

/* Each pass and each cost figure occurs in at least one of these scenes. A new pass or cost figure needs a scene that
 * uses it. */
static const char *const scenes[] = {
    "{}",
    "{\"image\": {\"samples\": \"auto\"}}",
    "{\"sky\": {\"model\": \"grid\"}}",
    "{\"sky\": {\"model\": \"stars\"}}",
    "{\"disk\": {\"model\": \"particles\"}}",
    "{\"spots\": [{\"brightness\": 1}]}",
    "{\"accuracy\": {\"engine\": \"mino-rkn6\", \"precision\": \"f32\", \"steps\": 8}}",
    "{\"accuracy\": {\"engine\": \"closed\", \"precision\": \"f64\"}}",
    "{\"style\": {\"exposure\": 0, \"bloom\": 0.5}}",
    "{\"image\": {\"layers\": [\"g\"]}}",
    "{\"style\": {\"beam_uas\": 20}}",
    "{\"volume\": {\"model\": \"uniform\"}}",
    "{\"disk\": {\"height\": 0.1, \"gas\": {\"amplitude\": 1}}, \"accuracy\": {\"profile\": \"high\"}}",
    "{\"jets\": {\"brightness\": 1}}",
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static void names_are_names(void **state)
{
    (void)state;
    for (int i = 0; i < KD_PASS_COUNT; i++) {
        assert_true(*kd_passes[i].name && strlen(kd_passes[i].name) < sizeof((struct kd_timing *)0)->name);
        assert_ptr_equal(kd_pass_find(kd_passes[i].name), &kd_passes[i]); /* names are unique */
        assert_non_null(kd_passes[i].invocations);
    }
    assert_null(kd_pass_find("total"));
}

/* These names must not change, because users of GET /v1/device and older cache files rely on them. */
static void words_stay(void **state)
{
    (void)state;
    const char *const relied_on[] = { "ray_radius",  "ray_full",  "sample_transfer", "pixel_post", "ray_march",
                                      "ray_refined", "ray_stars", "sample_stars",    "particle" };
    for (size_t i = 0; i < sizeof relied_on / sizeof *relied_on; i++)
        assert_string_equal(kd_figures[i].word, relied_on[i]);
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        assert_true(kd_figures[i].guess > 0);
}

/* A plan with footprints that the caller requests. An emitter that needs footprints has the same effect. */
static struct kd_plan with_footprints(const struct kd_capacity *c)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_error error = { 0 };
    kd_scene_smooth(&scene);
    if (kd_scene_validate(&scene, &error) ||
        kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_FOOTPRINT }, c, &plan, &error))
        fail_msg("%s", error.message);
    return plan;
}

static void each_is_in_a_plan_and_each_figure_learned(void **state)
{
    (void)state;
    const struct kd_capacity c = device();
    bool seen[KD_PASS_COUNT] = { false }, learned[KD_NS_NONE + 1] = { false };
    for (int k = 0; k <= SCENES; k++) {
        const struct kd_plan plan = k < SCENES ? planned(scenes[k], &c) : with_footprints(&c);
        double sum = 0;
        int last = -1;
        for (size_t i = 0; i < plan.cost.n_passes; i++) {
            const struct kd_plan_pass *pass = &plan.cost.passes[i];
            const struct kd_pass *of = kd_pass_find(pass->name);
            assert_non_null(of);
            assert_true(of - kd_passes > last && pass->invocations > 0 && pass->estimate_ms > 0 && pass->kernel);
            last = (int)(of - kd_passes);
            sum += pass->estimate_ms;
            seen[last] = learned[pass->figure] = true;
        }
        assert_true(fabs(sum - plan.cost.estimate_ms) < 1e-9 * sum);
    }
    for (int i = 0; i < KD_PASS_COUNT; i++)
        if (!seen[i])
            fail_msg("no scene has the pass \"%s\"", kd_passes[i].name);
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        if (!learned[i])
            fail_msg("no pass is measured for \"%s\"", kd_figures[i].word);
}

/* Each emitter with buffers of its own names the function or the pass that fills them. A named pass exists. */
static void emitters_are_prepared(void **state)
{
    (void)state;
    struct kd_scene scene;
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        const struct kd_emitter *e = kd_emitters[i];
        assert_true(!e->device_bytes == !e->own && (e->own || !e->invocations));
        assert_true(!e->invocations == !kd_pass_find(e->name));
        assert_true(!e->own ||
                    (e->own->bytes && e->own->prepare && e->own->buffers && e->own->forget && e->own->finish));
    }
    kd_scene_smooth(&scene);
    assert_true(!kd_emit_device_bytes(&scene) && !kd_emit_invocations(&scene, KD_EMITTER_particles));
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 5000;
    assert_int_equal(kd_emit_invocations(&scene, KD_EMITTER_particles), 5000);
    /* five particles in each cell, two words for each cell */
    assert_true(kd_emit_device_bytes(&scene) > 4 * 5000 / 5 * 2);
}

/* Estimates of cost, computed by hand for the passes of a default plan. The cost learned from one frame is the estimate
 * for the next plan. */
static void estimates_are_figures(void **state)
{
    (void)state;
    const struct kd_capacity c = device();
    const struct kd_plan plan = planned("{\"image\": {\"width\": 100, \"height\": 50, \"critical_factor\": 1}}", &c);
    const struct {
        const char *name;
        double ms;
    } expected[] = {
        { "trace", 5000 * 10e-6 },    { "interpolate", 5000 * 2.5e-6 },  { "audit", 768 * 4e-3 },
        { "transfer", 5000 * 30e-6 }, { "expose", 5000 * 0.25 * 40e-6 }, { "post", 5000 * 40e-6 },
        { "readback", 5000 * 4e-6 },
    };
    assert_int_equal(plan.cost.n_passes, sizeof expected / sizeof *expected);
    for (size_t i = 0; i < plan.cost.n_passes; i++) {
        assert_string_equal(plan.cost.passes[i].name, expected[i].name);
        assert_true(fabs(plan.cost.passes[i].estimate_ms - expected[i].ms) < 1e-9);
    }
    assert_true(plan.cost.trace_ns == 10);
}

/* A sky of stars has cost figures of its own, which no other scene uses. */
static void stars_have_figures(void **state)
{
    (void)state;
    static const struct {
        const char *json;
        bool stars;
    } of[] = {
        { "{\"image\": {\"width\": 100, \"height\": 50}, \"sky\": {\"model\": \"stars\"}}", true },
        { "{\"image\": {\"width\": 100, \"height\": 50}, \"sky\": {\"model\": \"stars\"}, "
          "\"disk\": {\"model\": \"none\"}}",
          true },
        { "{\"image\": {\"width\": 100, \"height\": 50}, \"sky\": {\"model\": \"grid\"}}", false },
    };
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        const struct kd_capacity c = device();
        const struct kd_plan plan = planned(of[k].json, &c);
        bool looked_for = false;
        for (size_t i = 0; i < plan.cost.n_passes; i++) {
            const struct kd_plan_pass *pass = &plan.cost.passes[i];
            const bool stars = !strcmp(pass->name, "stars"), light = !strcmp(pass->name, "transfer");
            const enum kd_figure_id own = stars ? KD_NS_RAY_STARS : KD_NS_SAMPLE_STARS;
            looked_for |= stars;
            if (stars || (light && of[k].stars))
                assert_true(pass->figure == own &&
                            fabs(pass->estimate_ms - c.ns[own] * 1e-6 * (double)pass->invocations) < 1e-9);
            else
                assert_true(pass->figure != KD_NS_RAY_STARS && pass->figure != KD_NS_SAMPLE_STARS);
        }
        assert_true(looked_for == of[k].stars);
    }
}

static uint64_t class_of(const char *json)
{
    const struct kd_capacity c = device();
    return planned(json, &c).cost.class;
}

/* The cost learned from one picture is the estimate for others of its class, whatever their size and the side from
 * which the hole is seen, and for no other class. */
static void estimates_are_of_a_class(void **state)
{
    (void)state;
    static const char small[] =
        "{\"image\": {\"width\": 100, \"height\": 50}, \"disk\": {\"gas\": {\"amplitude\": 1}}}";
    static const char *const alike[] = {
        "{\"image\": {\"width\": 640, \"height\": 320}, \"disk\": {\"gas\": {\"amplitude\": 1}}}",
        "{\"time\": 70, \"camera\": {\"azimuth_deg\": 30, \"inclination_deg\": 20}, "
        "\"disk\": {\"gas\": {\"amplitude\": 1}}}",
        "{\"image\": {\"width\": 640, \"height\": 320, \"tile\": {\"left\": 64, \"width\": 200, \"height\": 100}}, "
        "\"style\": {\"exposure\": 0}, \"disk\": {\"gas\": {\"amplitude\": 1}}}",
        "{\"camera\": {\"field_m\": 50}, \"style\": {\"exposure\": 2}, \"disk\": {\"gas\": {\"amplitude\": 1}}}",
    };
    static const char *const others[] = {
        "{}",
        "{\"disk\": {\"gas\": {\"amplitude\": 1, \"octaves\": 2}}}",
        "{\"camera\": {\"field_m\": 200}, \"disk\": {\"gas\": {\"amplitude\": 1}}}",
        "{\"disk\": {\"gas\": {\"amplitude\": 1}}, \"spots\": [{\"brightness\": 1}]}",
        "{\"disk\": {\"gas\": {\"amplitude\": 1}}, \"accuracy\": {\"profile\": \"high\"}}",
    };
    struct kd_capacity c = device();
    kd_cost_learn(&c, class_of(small), KD_PASS_TRANSFER, 1000);
    /* the mean of these, with weights 0.7 and 0.3, is 1300 */
    kd_cost_learn(&c, class_of(small), KD_PASS_TRANSFER, 2000);
    for (size_t i = 0; i < sizeof alike / sizeof *alike; i++) {
        const struct kd_plan plan = planned(alike[i], &c);
        assert_true(plan.cost.class == class_of(small));
        for (size_t k = 0; k < plan.cost.n_passes; k++)
            if (!strcmp(plan.cost.passes[k].name, "transfer"))
                assert_true(fabs(plan.cost.passes[k].estimate_ms - 1300e-6 * (double)plan.cost.passes[k].invocations) <
                            1e-9);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_true(class_of(others[i]) != class_of(small) &&
                    !kd_cost_known(&c, class_of(others[i]), KD_PASS_TRANSFER));
    for (uint64_t i = 1; i < KD_COST_CLASSES; i++) { /* fills all the remaining classes */
        kd_cost_learn(&c, i, KD_PASS_POST, 5);
        kd_cost_learn(&c, class_of(small), KD_PASS_TRANSFER, 1300);
    }
    assert_true(kd_cost_known(&c, 1, KD_PASS_POST) == 5 && kd_cost_known(&c, class_of(small), KD_PASS_TRANSFER) > 0);
    kd_cost_learn(&c, KD_COST_CLASSES, KD_PASS_POST, 6);
    assert_true(kd_cost_known(&c, 1, KD_PASS_POST) == 0 && kd_cost_known(&c, 2, KD_PASS_POST) == 5);
    assert_true(kd_cost_known(&c, class_of(small), KD_PASS_TRANSFER) > 0 &&
                kd_cost_known(&c, KD_COST_CLASSES, KD_PASS_POST) == 6);
}

static bool says(const char *json, const char *name)
{
    const struct kd_capacity c = device();
    const struct kd_plan plan = planned(json, &c);
    bool found = false;
    for (size_t i = 0; i < plan.report.n_approximations; i++)
        found |= !strcmp(plan.report.approximations[i].name, name);
    return found;
}

/* If kernels make the lens map, rays that 32-bit arithmetic cannot decide are traced again. They are not traced again
 * if the map is made from listed rays. */
static void arithmetic_is_told(void **state)
{
    (void)state;
    static const char listed[] = "{\"accuracy\": {\"engine\": \"ks-rk4\", \"precision\": \"f32\"}}";
    assert_true(says("{}", "arithmetic.f32") && !says("{}", "arithmetic.f32-listed"));
    assert_true(says(listed, "arithmetic.f32-listed") && !says(listed, "arithmetic.f32"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_is_told),
        cmocka_unit_test(names_are_names),
        cmocka_unit_test(words_stay),
        cmocka_unit_test(each_is_in_a_plan_and_each_figure_learned),
        cmocka_unit_test(emitters_are_prepared),
        cmocka_unit_test(estimates_are_figures),
        cmocka_unit_test(stars_have_figures),
        cmocka_unit_test(estimates_are_of_a_class),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
