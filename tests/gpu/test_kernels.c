/* Tests that kernels are first recorded and then compiled together on several threads. A frame uses exactly the kernels
 * that it recorded. */
#include "render_support.h"

#include "render/device/device_internal.h"
#include "render/frame/compilation.h"
#include "render/rays/rays.h"
#include "scene/dynamic_bodies.h"
#include "vk/device.h"

/* The same scene as in test_pieces of test_march_rays.c. */
static const char TALL[] =
    "{\"accuracy\":{\"profile\":\"reference\"},\"style\":{\"exposure\":0,\"bloom\":0},\"disk\":{\"height\":0.3,"
    "\"emission_opacity\":10,\"gas\":{\"amplitude\":0.8}},\"image\":{\"width\":96,\"height\":72,\"samples\":1,"
    "\"critical_factor\":1,\"tile\":{\"left\":36,\"top\":32,\"width\":8,\"height\":2}}}";
static const char RIAF[] = "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"riaf\",\"normalise_to_jy\":2.4},"
                           "\"image\":{\"width\":40,\"height\":24}}";

static uint32_t made(void) { return renderer->vk->n_pipelines; }

static const struct kd_vk_pipeline *post(bool film, bool wide)
{
    /* any address; the test checks that the function overwrites it */
    const struct kd_vk_pipeline *out = (const struct kd_vk_pipeline *)renderer;
    OK(kd_kernels_get(&renderer->kernels, renderer->vk, KD_KERNEL_POST, (uint32_t[]) { film, wide }, 2, &out, &error));
    return out;
}

static void noted_kernels_are_made_once(void **state)
{
    (void)state;
    const struct kd_vk_pipeline *known = post(false, false);
    const uint32_t before = made();
    kd_kernels_note(&renderer->kernels);
    for (int i = 0; i < 3; i++) {
        assert_null(post(true, false));
        assert_null(post(false, true));
        assert_null(post(true, true));
        assert_null(post(false, false));
    }
    assert_int_equal(made(), before);
    kd_kernels_make(&renderer->kernels, renderer->vk);
    assert_int_equal(made(), before + 3);
    const struct kd_vk_pipeline *all[] = { post(true, false), post(false, true), post(true, true), post(false, false) };
    assert_ptr_equal(all[3], known);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < i; k++)
            assert_ptr_not_equal(all[i], all[k]);
    assert_int_equal(made(), before + 3);
    kd_kernels_note(&renderer->kernels);
    kd_kernels_make(&renderer->kernels, renderer->vk); /* does nothing, because no kernel is missing */
    assert_int_equal(made(), before + 3);
}

/* If more kernels are requested than can be recorded, the remaining ones are compiled at their first use. */
static void what_cannot_be_made_is_told_later(void **state)
{
    (void)state;
    static const uint32_t words[5];
    static const struct kd_vk_pipeline_params broken = { .name = "broken",
                                                         .spirv = words,
                                                         .spirv_bytes = sizeof words };
    struct kd_error why = { 0 };
    const struct kd_vk_pipeline *out;
    const uint32_t before = made();
    kd_kernels_note(&renderer->kernels);
    for (uint32_t i = 0; i < 2 * KD_KERNEL_WISHES; i++)
        OK(kd_kernels_get_of(&renderer->kernels, renderer->vk, &broken, &i, 1, &out, &error));
    kd_kernels_make(&renderer->kernels, renderer->vk);
    assert_int_equal(made(), before);
    assert_int_equal(kd_kernels_get_of(&renderer->kernels, renderer->vk, &broken, NULL, 0, &out, &why), KD_EINTERNAL);
    assert_non_null(strstr(why.message, "broken"));
}

/* The first frame of a scene uses each kernel that it compiles in advance: after its compilation, the kernel appears in
 * the order of use. */
static void a_frame_notes_what_it_needs(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "{\"image\":{\"width\":64,\"height\":36},\"disk\":{\"model\":\"none\"},\"camera\":{\"r\":40},\"sky\":{"
        "\"model\":\"catalogue\",\"milky_way\":0}}",
        "{\"image\":{\"width\":64,\"height\":36},\"camera\":{\"r\":4,\"observer\":\"infall\"},\"sky\":{\"model\":"
        "\"stars\"},\"disk\":{\"model\":\"none\"}}",
        "{\"image\":{\"width\":64,\"height\":36}}",
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct kd_scene scene;
        struct kd_frame frame;
        kd_kernels_finish(&renderer->kernels, renderer->vk);
        kd_scene_defaults(&scene);
        OK(kd_scene_from_json(&scene, scenes[i], strlen(scenes[i]), &error));
        frame = rendered(&scene);
        kd_frame_finish(&frame);
        size_t unused = 0, n = 0;
        for (size_t k = 0; k < KD_KERNELS_KEPT; k++) {
            const struct kd_kernel_entry *e = &renderer->kernels.entries[k];
            n += e->pipeline != NULL;
            unused += e->pipeline && e->used <= renderer->kernels.noted;
        }
        print_message("scene %zu: %zu kernels, %zu of them never asked for\n", i, n, unused);
        assert_int_equal(unused, 0);
    }
}

/* A frame whose lens map is cached compiles no kernel for tracing. */
static void a_kept_lens_map_is_not_traced(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.image.width = 66;
    scene.image.height = 38;
    for (int i = 0; i < 2; i++) {
        kd_kernels_finish(&renderer->kernels, renderer->vk);
        struct kd_frame frame = rendered(&scene);
        size_t tracing = 0, all = 0;
        for (size_t k = 0; k < KD_KERNELS_KEPT; k++) {
            const struct kd_kernel_entry *e = &renderer->kernels.entries[k];
            all += e->pipeline != NULL;
            tracing += e->pipeline && !strncmp(e->source->name, "lens_", 5);
        }
        assert_true(all > 2 && frame.lens_reused == (i == 1));
        assert_true(i ? tracing == 0 : tracing > 0);
        kd_frame_finish(&frame);
    }
}

struct wanted {
    struct kd_rays_params params;
    size_t n;
};

static enum kd_status ask_rays(struct kd_renderer *r, const void *user)
{
    const struct wanted *w = user;
    return kd_rays_ask_kernels(r, &w->params, w->n);
}

static bool goes_on(void *user, double fraction)
{
    (void)user, (void)fraction;
    return true;
}

/* Kernels that are compiled while the device works are exactly those that the frame uses, and the picture does not
 * change. */
static void compiled_beside_the_device(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "{\"image\":{\"width\":67,\"height\":36},\"sky\":{\"model\":\"catalogue\"},\"style\":{\"bloom\":0.1}}",
        "{\"image\":{\"width\":67,\"height\":36,\"samples\":\"auto\",\"layers\":[\"r\"]}}",
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct kd_scene scene;
        struct kd_plan plan;
        struct kd_capacity capacity;
        kd_scene_defaults(&scene);
        OK(kd_scene_from_json(&scene, scenes[i], strlen(scenes[i]), &error));
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        kd_kernels_finish(&renderer->kernels, renderer->vk);
        struct kd_frame frame = rendered(&scene);
        kd_kernels_finish(&renderer->kernels, renderer->vk);
        kd_store_empty(&renderer->store);
        struct kd_compilation *c = kd_compilation_begin(renderer, &scene, &plan);
        assert_non_null(c);
        assert_int_equal(made(), 0);
        OK(kd_compilation_run(c, goes_on, NULL, &error));
        kd_compilation_end(c);
        assert_null(kd_compilation_begin(renderer, &scene, &plan));
        const uint32_t before = made();
        struct kd_frame again = rendered(&scene);
        print_message("scene %zu: %u kernels beside the device, %u more\n", i, before, made() - before);
        assert_true(before > 3);
        assert_memory_equal(kd_frame_pixels(&frame), kd_frame_pixels(&again), 3 * 67 * 36);
        kd_frame_finish(&frame);
        kd_frame_finish(&again);
    }
}

static struct kd_plan planned(const struct kd_scene *scene)
{
    struct kd_plan plan;
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make(scene, &capacity, &plan, &error));
    return plan;
}

static void begin_without_kernels(void)
{
    kd_kernels_finish(&renderer->kernels, renderer->vk);
    kd_store_empty(&renderer->store);
}

static void compiled(struct kd_compilation *c)
{
    assert_non_null(c);
    OK(kd_compilation_run(c, goes_on, NULL, &error));
    kd_compilation_end(c);
}

/* Pictures that determine a density are also rehearsed on a device that computes nothing, in order to compile their
 * kernels. */
static void a_density_is_rehearsed(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_renderer *own;
    struct kd_frame frame;
    const struct kd_renderer_params params = {
        .device = renderer->opening.device, .cache_dir = "", .passing = true, .compiles_only = true
    };
    kd_scene_smooth(&scene);
    OK(kd_scene_from_json(&scene, RIAF, strlen(RIAF), &error));
    const struct kd_plan plan = planned(&scene);
    OK(kd_renderer_create(&params, &own, &error));
    OK(kd_render(own, &scene, &plan, NULL, NULL, &frame, &error));
    kd_frame_finish(&frame);
    kd_renderer_destroy(own);
}

static bool has_kernel(const char *name)
{
    for (size_t i = 0; i < KD_KERNELS_KEPT; i++)
        if (renderer->kernels.entries[i].pipeline && !strcmp(renderer->kernels.entries[i].source->name, name))
            return true;
    return false;
}

/* The explanation of a pixel with its steps needs two kernels for lists of rays. */
static void steps_of_a_pixel(void **state)
{
    (void)state;
    static const char json[] = "{\"accuracy\":{\"engine\":\"mino-rkn6\"},\"image\":{\"width\":40,\"height\":24}}";
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    struct kd_plan plan = planned(&scene);
    plan.report.probe.on = plan.report.probe.steps = true;
    begin_without_kernels();
    compiled(kd_compilation_begin(renderer, &scene, &plan));
    assert_true(has_kernel("rays") && has_kernel("rays, told"));
}

static struct lack {
    int times, background_renders;
    bool gives_up;
} lack;

static bool lacks(void *user, struct kd_compilation *c, bool background)
{
    assert_ptr_equal(user, &lack);
    lack.times++;
    lack.background_renders += background;
    const uint32_t before = made();
    compiled(c);
    assert_int_equal(made(), before + 1);
    return !lack.gives_up;
}

/* If the driver stops rays early, one more kernel is needed. It is compiled by exactly one thread, which may be any. */
static void a_kernel_that_nobody_foresaw(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    OK(kd_scene_from_json(&scene, TALL, strlen(TALL), &error));
    const struct kd_plan plan = planned(&scene);
    struct kd_frame frames[3];
    renderer->lacks = lacks;
    renderer->lacks_user = &lack;
    for (int i = 0; i < 3; i++) {
        begin_without_kernels();
        lack = (struct lack) { .gives_up = i == 2 };
        compiled(kd_compilation_begin(renderer, &scene, &plan));
        struct kd_error why = { 0 };
        const enum kd_status status =
            i == 1 ? kd_render_in_background(renderer, &scene, &plan, goes_on, NULL, NULL, &frames[i], &why)
                   : kd_render(renderer, &scene, &plan, NULL, NULL, &frames[i], &why);
        assert_int_equal(status, i == 2 ? KD_ECANCELLED : KD_OK);
        if (!lack.times) {
            print_message("this driver ends no loop\n");
            skip();
        }
        assert_int_equal(lack.times, 1);
        assert_int_equal(lack.background_renders, i == 1);
    }
    /* requested again after the kernel was compiled */
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frames[2], &error));
    assert_int_equal(lack.times, 1);
    for (int i = 0; i < 3; i++) {
        assert_memory_equal(kd_frame_pixels(&frames[0]), kd_frame_pixels(&frames[i]), 3 * 8 * 2);
        assert_int_equal(frames[i].accuracy.lost, 0);
    }
    for (int i = 0; i < 3; i++)
        kd_frame_finish(&frames[i]);
    renderer->lacks = NULL;
}

/* Kernels of lists of rays are compiled in the same way, including those for a tolerance. */
static void kernels_of_lists_of_rays(void **state)
{
    (void)state;
    const struct kd_rays_params params = {
        .spin = 0.7, .r = INFINITY, .inclination_deg = 60, .orders = 2, .engine = KD_ENGINE_MINO_RKN6, .tolerance = 1e-9
    };
    const struct wanted wanted[] = { { params, 1 }, { params, 100000 } };
    begin_without_kernels();
    compiled(kd_compilation_of(renderer, ask_rays, &wanted[0]));
    assert_int_equal(made(), 1);
    compiled(kd_compilation_of(renderer, ask_rays, &wanted[1]));
    assert_int_equal(made(), 2);
    assert_null(kd_compilation_of(renderer, ask_rays, &wanted[1]));
    static double rays[2 * 20000];
    static struct kd_ray_crossing crossings[2 * 20000];
    static struct kd_ray_end ends[20000];
    for (int i = 0; i < 20000; i++)
        rays[2 * i] = 5.2 + 1e-4 * i;
    OK(kd_rays_trace(renderer, &params, rays, 20000, crossings, ends, NULL, NULL, &error));
    assert_int_equal(made(), 2);
}

/* The last other reference to a playground's bodies may be released before the rehearsal. */
static void bodies_are_held_while_kernels_are_compiled(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_capacity capacity;
    struct kd_dynamic_bodies *dynamic;
    kd_scene_smooth(&scene);
    scene.image.width = 67;
    scene.image.height = 36;
    OK(kd_dynamic_bodies_create(1, 0, 0, &dynamic, &error));
    dynamic->bodies[0] = (struct kd_seen_body) { .r = 12, .s = 1, .radius = 1, .temperature_k = 6000, .brightness = 1 };
    kd_scene_show(&scene, dynamic);
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    kd_kernels_finish(&renderer->kernels, renderer->vk);
    struct kd_compilation *c = kd_compilation_begin(renderer, &scene, &plan);
    assert_non_null(c);
    assert_int_equal(atomic_load(&dynamic->holders), 2);
    kd_dynamic_bodies_release(dynamic);
    OK(kd_compilation_run(c, goes_on, NULL, &error));
    assert_int_equal(atomic_load(&dynamic->holders), 1);
    kd_dynamic_bodies_keep(dynamic);
    kd_compilation_end(c);
    assert_int_equal(atomic_load(&dynamic->holders), 1);
    kd_dynamic_bodies_release(dynamic);
}

int main(void)
{
    int skip = open_renderer();
    if (skip)
        return skip;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noted_kernels_are_made_once),  cmocka_unit_test(what_cannot_be_made_is_told_later),
        cmocka_unit_test(a_frame_notes_what_it_needs),  cmocka_unit_test(a_kept_lens_map_is_not_traced),
        cmocka_unit_test(a_density_is_rehearsed),       cmocka_unit_test(steps_of_a_pixel),
        cmocka_unit_test(a_kernel_that_nobody_foresaw), cmocka_unit_test(kernels_of_lists_of_rays),
        cmocka_unit_test(compiled_beside_the_device),   cmocka_unit_test(bodies_are_held_while_kernels_are_compiled),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
