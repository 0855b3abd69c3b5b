/* Tests of adaptive sampling: a picture whose pixels get as many rays as they need is compared with pictures that have
 * 1, 16 or 64 rays in every pixel. */
#include "render/frame/choose.h"
#include "render/frame/residual.h"
#include "render/render.h"

#include "render_support.h"

#include <math.h>

#define WIDTH 640
#define HEIGHT 360
#define PIXELS (WIDTH * HEIGHT)

/* samples 0: auto. */
static struct kd_scene scene_of(const char *json, int samples)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.bit_depth = 16;
    scene.image.samples = samples;
    scene.style.exposure = 0.5;
    scene.style.dither = false;
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

static struct kd_frame render_in(const struct kd_scene *scene, uint64_t binding, struct kd_plan *plan)
{
    struct kd_capacity capacity;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &capacity);
    if (binding)
        capacity.max_binding_bytes = binding;
    OK(kd_plan_make(scene, &capacity, plan, &error));
    OK(kd_render(renderer, scene, plan, NULL, NULL, &frame, &error));
    return frame;
}

static struct kd_frame render(const char *json, int samples, struct kd_plan *plan)
{
    const struct kd_scene scene = scene_of(json, samples);
    return render_in(&scene, 0, plan);
}

static const uint16_t *pixel(const struct kd_frame *f, int k) { return (const uint16_t *)kd_frame_pixels(f) + 3 * k; }

/* Mean squared difference, relative to white. */
static double off(const struct kd_frame *a, const struct kd_frame *b)
{
    double sum = 0;
    for (int k = 0; k < 3 * PIXELS; k++)
        sum += pow((pixel(a, 0)[k] - pixel(b, 0)[k]) / 65535.0, 2);
    return sum / (3 * PIXELS);
}

static const char *const scenes[] = {
    "{}",
    "{\"disk\": {\"taper\": 0}, \"camera\": {\"inclination_deg\": 60}}",
    "{\"camera\": {\"r\": 20, \"fov_deg\": 60}, \"disk\": {\"taper\": 0}, \"style\": {\"tone_map\": \"srgb\"}}",
    "{\"disk\": {\"gas\": {\"amplitude\": 0.5}}}",
    "{\"camera\": {\"inclination_deg\": 85}, \"disk\": {\"gas\": {\"amplitude\": 0.8}, \"emission_opacity\": 10}}",
    "{\"sky\": {\"model\": \"grid\"}, \"disk\": {\"model\": \"none\"}}",
    /* A picture with almost no edges. Its remaining differences are due to curvature, and to third differences of the
     * map. */
    "{\"spacetime\": {\"spin\": 0.998}, \"camera\": {\"inclination_deg\": 85}}",
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* Fraction of the pixels of `a` that differ from those of `b` and from those of `c` by more than 0.003 of white. */
static double neither(const struct kd_frame *a, const struct kd_frame *b, const struct kd_frame *c)
{
    int n = 0;
    for (int k = 0; k < PIXELS; k++) {
        int to_b = 0, to_c = 0;
        for (int i = 0; i < 3; i++) {
            to_b = fmax(to_b, abs(pixel(a, k)[i] - pixel(b, k)[i]));
            to_c = fmax(to_c, abs(pixel(a, k)[i] - pixel(c, k)[i]));
        }
        n += to_b > 0.003 * 65535 && to_c > 0.003 * 65535;
    }
    return (double)n / PIXELS;
}

/* A frame estimates its residual from some 200 pixels. The estimate is close to the residual over all pixels, although
 * a few pixels contribute most of the sum of squares. */
static void residual(const struct kd_frame *adaptive, const struct kd_frame *truth)
{
    double left = sqrt(off(adaptive, truth)), said = adaptive->accuracy.pixel_error;
    print_message("off by %.1e, said %.1e, worst %.1e\n", left, said, adaptive->accuracy.pixel_error_worst);
    assert_true(adaptive->accuracy.pixel_sampled > 96 && adaptive->accuracy.pixel_error_worst >= said);
    assert_true(said < 4 * left && said > left / 4);
}

/* The requirement: an adaptive picture has at most a quarter of the rays of the picture with 16 rays a pixel. The
 * errors of the two, relative to a picture with 64 rays a pixel, agree within 0.5 dB. Each pixel equals that of the
 * picture with 1 or with 16 rays a pixel, except for a few, where an interpolated ray falls on the other side of an
 * edge. */
static void test_as_good(void **state)
{
    (void)state;
    for (int i = 0; i < SCENES; i++) {
        struct kd_plan plans[4];
        struct kd_frame one = render(scenes[i], 1, &plans[0]), sixteen = render(scenes[i], 4, &plans[1]);
        struct kd_frame truth = render(scenes[i], 8, &plans[2]), adaptive = render(scenes[i], 0, &plans[3]);
        uint64_t rays = kd_plan_rays(&plans[3].lens) + adaptive.accuracy.followed;
        double by_one = -10 * log10(off(&one, &truth)), by_sixteen = -10 * log10(off(&sixteen, &truth)),
               by_adaptive = -10 * log10(off(&adaptive, &truth));
        double share = (double)rays / (double)kd_plan_rays(&plans[1].lens),
               strange = neither(&adaptive, &one, &sixteen);
        print_message("%s: %.1f dB by one ray, %.2f dB by 16, %.2f dB adaptively with %.1f %% of their rays, %llu "
                      "refined, %llu between, %.2f %% neither\n",
                      scenes[i], by_one, by_sixteen, by_adaptive, 100 * share,
                      (unsigned long long)adaptive.accuracy.refined, (unsigned long long)adaptive.accuracy.between,
                      100 * strange);
        assert_true(adaptive.accuracy.refined > 0 && adaptive.accuracy.between > 0);
        assert_true(by_adaptive > by_sixteen - 0.5 && by_one < by_sixteen - 5 && share <= 0.25 && strange < 0.005);
        residual(&adaptive, &truth);
        kd_frame_finish(&one);
        kd_frame_finish(&sixteen);
        kd_frame_finish(&truth);
        kd_frame_finish(&adaptive);
    }
}

/* With a smaller target, more pixels are chosen and the error is smaller. */
static void test_target(void **state)
{
    (void)state;
    static const double wanted[] = { 0.05, 0.005, 0.001 };
    struct kd_plan plan;
    struct kd_frame truth = render(scenes[3], 8, &plan);
    double before = INFINITY;
    uint64_t chosen_before = 0;
    for (int i = 0; i < 3; i++) {
        struct kd_scene scene = scene_of(scenes[3], 0);
        scene.image.pixel_error = wanted[i];
        struct kd_frame frame = render_in(&scene, 0, &plan);
        double left = sqrt(off(&frame, &truth));
        uint64_t n = frame.accuracy.refined + frame.accuracy.between;
        print_message("%g of white: %llu pixels, off by %.2e\n", wanted[i], (unsigned long long)n, left);
        assert_true(left < before && n > chosen_before);
        before = left;
        chosen_before = n;
        kd_frame_finish(&frame);
    }
    kd_frame_finish(&truth);
}

/* The picture is the same with the cached lens map. In bands, only rays at the edges of bands differ, because they are
 * traced instead of interpolated. With listed rays, only pixels next to an edge differ. A preview, and the flux,
 * contain all rays. */
static void test_same(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(scenes[3], 0);
    struct kd_plan plan;
    struct kd_frame whole = render_in(&scene, 0, &plan), again = render_in(&scene, 0, &plan);
    assert_true(again.lens_reused && again.accuracy.refined == whole.accuracy.refined &&
                again.accuracy.pixel_error == whole.accuracy.pixel_error);
    assert_memory_equal(kd_frame_pixels(&whole), kd_frame_pixels(&again), 6 * PIXELS);
    struct kd_frame bands = render_in(&scene, 4 * plan.lens.planes * WIDTH * 32 + 64, &plan);
    assert_true(plan.picture.bands > 4 && bands.accuracy.refined > whole.accuracy.refined);
    assert_true(off(&bands, &whole) < 1e-6);
    scene.accuracy.engine = 1 + KD_ENGINE_CLOSED;
    if (has_float64("listed rays")) {
        scene.accuracy.precision = 1 + KD_PRECISION_F64;
        OK(kd_scene_validate(&scene, &error));
        struct kd_frame listed = render_in(&scene, 0, &plan);
        assert_true(plan.lens.path == KD_LENS_LISTED && listed.accuracy.refined > 0 && listed.accuracy.between > 0);
        assert_true(off(&listed, &whole) < 1e-6);
        kd_frame_finish(&listed);
    }
    kd_frame_finish(&whole);
    kd_frame_finish(&again);
    kd_frame_finish(&bands);
}

/* The host converts light of any strength as post.comp does, to half a step of 16 bits. */
static void test_shown(void **state)
{
    (void)state;
    static const char *const curves[] = { "{\"style\": {\"tone_map\": \"aces\"}}",
                                          "{\"style\": {\"tone_map\": \"srgb\"}}",
                                          "{\"style\": {\"tone_map\": \"neutral\"}}" };
    for (int i = 0; i < 3; i++) {
        struct kd_scene scene = scene_of(curves[i], 1);
        struct kd_plan plan;
        struct kd_frame frame = render_in(&scene, 0, &plan);
        struct kd_vk_buffer *host;
        OK(kd_vk_buffer_create(renderer->vk, 12 * PIXELS, KD_VK_READBACK, "test", &host, &error));
        OK(kd_vk_copy(renderer->vk, "readback", host, 0, renderer->store.radiance.buffers[0], 0, 12 * PIXELS, &error));
        OK(kd_vk_submit(renderer->vk, NULL, &error));
        OK(kd_vk_wait(renderer->vk, 0, &error));
        const float *light = kd_vk_buffer_map(host);
        double worst = 0;
        for (int k = 0; k < PIXELS; k++) {
            double shown[3];
            kd_frame_shown(light + 3 * k, exp2(frame.exposure), scene.style.tone_map, shown);
            for (int c = 0; c < 3; c++)
                worst = fmax(worst, fabs(65535 * shown[c] - pixel(&frame, k)[c]));
        }
        print_message("%s: worst %.2f steps\n", curves[i], worst);
        assert_true(worst < 0.6);
        kd_vk_buffer_destroy(renderer->vk, host);
        kd_frame_finish(&frame);
    }
}

enum { W = 16, H = 8 };
static uint8_t kinds[W * H]; /* 1: excluded */

static struct kd_choice bent(const uint16_t *pixels, uint64_t most)
{
    const struct kd_shown shown = { pixels, kinds, 1, W, H };
    struct kd_choice out;
    OK(kd_choose_bent(&shown, 0.01, &out, &error));
    kd_choose_largest(&out, most);
    return out;
}

static struct kd_pixel place(const struct kd_choice *c, size_t i) { return c->list.pixels[i]; }

/* Pixels of faint curvature are chosen only if the picture has no stronger curvature, until almost no sum of squares is
 * left. In a picture with an edge they are not chosen. */
static void test_faint(void **state)
{
    (void)state;
    static uint16_t pixels[3 * W * H];
    memset(kinds, 0, sizeof kinds);
    for (int k = 0; k < W * H; k++)
        pixels[3 * k] = 1000;
    for (int x = 0; x < W; x++) /* the dark border of the picture is excluded */
        kinds[x] = kinds[(H - 1) * W + x] = 1;
    for (int y = 0; y < H; y++)
        kinds[y * W] = kinds[y * W + W - 1] = 1;
    pixels[3 * (3 * W + 4)] += 400;  /* curvatures of 800 and 400, below the threshold of 1311 */
    pixels[3 * (5 * W + 11)] += 100; /* curvatures of 200 and 100; only 200 exceeds the floor of 132 */
    struct kd_choice choice = bent(pixels, W * H);
    assert_int_equal(choice.list.n, 9 + 1);
    kd_choice_finish(&choice);
    pixels[3 * (3 * W + 4)] += 20000;
    choice = bent(pixels, W * H);
    assert_int_equal(choice.list.n, 9);
    kd_choice_finish(&choice);
}

/* Tests which pixels of a synthetic picture are chosen. */
static void test_choice(void **state)
{
    (void)state;
    static uint16_t pixels[3 * W * H], before[3 * W * H];
    memset(kinds, 0, sizeof kinds);
    for (int k = 0; k < W * H; k++) /* draws a steep, straight ramp */
        for (int c = 0; c < 3; c++)
            pixels[3 * k + c] = (uint16_t)(4000 * (k % W) + 300 * (k / W));
    struct kd_choice choice = bent(pixels, W * H);
    assert_true(choice.list.n > 0);
    for (size_t i = 0; i < choice.list.n; i++) /* checks that no pixel inside the square is chosen */
        assert_true(place(&choice, i).x == 0 || place(&choice, i).x == W - 1 || place(&choice, i).y == 0 ||
                    place(&choice, i).y == H - 1);
    kd_choice_finish(&choice);
    memset(pixels, 0, sizeof pixels);
    for (int k = 0; k < 9; k++) /* raises a square in one channel by 0.03, and one corner by 0.3 */
        pixels[3 * ((3 + k / 3) * W + 6 + k % 3) + 1] = k ? 1966 : 19660;
    choice = bent(pixels, W * H);
    assert_int_equal(choice.list.n, 25); /* the pixels of the square and its neighbours */
    assert_true(place(&choice, 0).x == 5 && place(&choice, 0).y == 2 && place(&choice, 24).x == 9 &&
                place(&choice, 24).y == 6);
    kd_choice_finish(&choice);
    choice = bent(pixels, 9); /* the largest differences are chosen first: the corner and its neighbours */
    assert_true(choice.list.n == 9 && place(&choice, 8).x == 7 && place(&choice, 8).y == 4);
    kd_choice_finish(&choice);
    kinds[2 * W + 5] = kinds[2 * W + 6] = kinds[3 * W + 12] = kinds[6 * W + 9] = 1;
    choice = bent(pixels, W * H);
    assert_int_equal(choice.list.n, 25 - 3);
    kd_choice_finish(&choice);
    memcpy(before, pixels, sizeof before); /* only one of the two changed pixels has changed by enough */
    before[3 * (4 * W + 7) + 1] += 700;
    before[3 * (6 * W + 2) + 2] += 600;
    struct kd_pixel last[] = { { 7, 4 }, { 2, 6 } };
    const struct kd_critical_pixels lists[] = { { last, 1 }, { last + 1, 1 } };
    const struct kd_shown shown = { pixels, kinds, 1, W, H };
    kinds[4 * W + 7] = kinds[3 * W + 7] = 1;
    OK(kd_choose_beside(&shown, before, lists, 2, 0.01, &choice, &error));
    assert_true(choice.list.n == 9 - 2 && place(&choice, 0).x == 6 && place(&choice, 0).y == 3 &&
                place(&choice, 6).x == 8 && place(&choice, 6).y == 5);
    kd_choice_finish(&choice);
}

/* Plans estimate the numbers of traced and interpolated rays to a factor of two, whether such rays are needed only at
 * the critical curve or everywhere. When one fraction was used for all pictures, the count of a smooth disk was four
 * times too high. */
static void test_planned(void **state)
{
    (void)state;
    static const char *const presets[] = { "gargantua", NULL };
    for (size_t i = 0; i < 2; i++) {
        struct kd_scene scene;
        struct kd_plan plan;
        kd_scene_defaults(&scene);
        if (presets[i])
            OK(kd_scene_preset(&scene, presets[i], &error));
        scene.image.width = WIDTH;
        scene.image.height = HEIGHT;
        scene.image.samples = 0;
        struct kd_frame frame = render_in(&scene, 0, &plan);
        const struct kd_plan_pass *pass = plan.cost.passes;
        while (strcmp(pass->name, "refine"))
            pass++;
        const double had = (double)(frame.accuracy.followed + 16 * frame.accuracy.between),
                     planned = (double)pass->invocations;
        printf("%s: %.0f rays planned, %.0f had: %.2f\n", presets[i] ? presets[i] : "default", planned, had,
               planned / had);
        assert_true(planned < 2 * had && had < 2 * planned);
        kd_frame_finish(&frame);
    }
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planned), cmocka_unit_test(test_choice), cmocka_unit_test(test_faint),
        cmocka_unit_test(test_as_good), cmocka_unit_test(test_target), cmocka_unit_test(test_same),
        cmocka_unit_test(test_shown),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
