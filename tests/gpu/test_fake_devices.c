/* Tests of pictures, lists and particles on simulated devices: with low limits, with incoherent memory, or lost during
 * the work. The results equal those of the real device byte for byte. */
#include "fake_device.h"

#include "render/output/particle_list.h"
#include "render/rays/rays.h"
#include "render/render.h"

#include <math.h>

enum { WIDTH = 150, HEIGHT = 120, RAYS = 700, ORDERS = 3, PARTICLES = 500 };

/* Results of each kind of request. */
struct answers {
    struct kd_frame frames[3];
    struct kd_ray_crossing crossings[RAYS * ORDERS];
    struct kd_ray_end ends[RAYS];
};

static enum kd_status open(struct kd_renderer **out, struct kd_error *error)
{
    const struct kd_renderer_params params = { .device = getenv("KERRD_TEST_DEVICE"),
                                               .cache_dir = "",
                                               .validate = true };
    return kd_renderer_create(&params, out, error);
}

/* kind of scene. 0: map of radii, bands and exposure. 1: sky, and a camera nearby. 2: particles, hot spots, and light
 * that is measured. */
static struct kd_scene scene_of(int k)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.bit_depth = k == 1 ? 16 : 8;
    if (k == 1) {
        scene.camera.r = 20;
        scene.sky.model = KD_SKY_GRID;
    }
    if (k == 2) {
        scene.disk.model = KD_DISK_PARTICLES;
        scene.disk.particles = 20000;
        scene.spots.count = 1;
        scene.spots.at[0].brightness = 3;
    }
    return scene;
}

static enum kd_status draw(struct kd_renderer *renderer, int k, struct kd_frame *out, struct kd_error *error)
{
    struct kd_scene scene = scene_of(k);
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &capacity);
    enum kd_status status = kd_scene_validate(&scene, error);
    if (!status)
        status = kd_plan_make(&scene, &capacity, &plan, error);
    return status ? status : kd_render(renderer, &scene, &plan, NULL, NULL, out, error);
}

static void ask(struct kd_renderer *renderer, struct answers *out)
{
    static double rays[2 * RAYS];
    const struct kd_rays_params params = { .spin = 0.9,
                                           .r = INFINITY,
                                           .inclination_deg = 60,
                                           .orders = ORDERS,
                                           .engine = KD_ENGINE_MINO_RKN6,
                                           .precision = KD_PRECISION_F32 };
    for (int i = 0; i < RAYS; i++) {
        rays[2 * i] = -8 + 16.0 * i / RAYS;
        rays[2 * i + 1] = -8 + fmod(7.3 * i, 16);
    }
    for (int k = 0; k < 3; k++)
        OK(draw(renderer, k, &out->frames[k], &error));
    OK(kd_rays_trace(renderer, &params, rays, RAYS, out->crossings, out->ends, NULL, NULL, &error));
}

static void same(const struct answers *a, const struct answers *b)
{
    for (int k = 0; k < 3; k++) {
        const struct kd_frame *x = &a->frames[k], *y = &b->frames[k];
        assert_true(x->width == y->width && x->height == y->height && x->exposure == y->exposure);
        assert_memory_equal(kd_frame_pixels(x), kd_frame_pixels(y),
                            (size_t)x->width * x->height * (kd_frame_bit_depth(x) == 16 ? 6 : 3));
        assert_true(x->light.measured == y->light.measured);
        if (x->light.measured)
            assert_true(fabs(x->light.all.flux / y->light.all.flux - 1) <
                        1e-6); /* tolerance: this device sums the light in another order than the real one */
    }
    assert_memory_equal(a->crossings, b->crossings, sizeof a->crossings);
    assert_memory_equal(a->ends, b->ends, sizeof a->ends);
}

static void forget(struct answers *a)
{
    for (int k = 0; k < 3; k++)
        kd_frame_finish(&a->frames[k]);
}

static struct answers real;

static void answer_as(const struct fake_device *device)
{
    static struct answers answers;
    struct kd_renderer *renderer = NULL;
    fake_device_on(device);
    OK(open(&renderer, &error));
    ask(renderer, &answers);
    assert_int_equal(kd_renderer_validation_messages(renderer), 0);
    kd_renderer_destroy(renderer);
    fake_device_off();
    same(&real, &answers);
    forget(&answers);
}

/* The device allows fewer workgroups than a picture has blocks of pixels, while everything fits in one binding. */
static void test_groups(void **state)
{
    (void)state;
    /* 40 groups cover 10240 pixels of post.comp, and the picture has 18000 */
    answer_as(&(struct fake_device) { .groups = 40 });
}

/* The device allows only allocations smaller than a binding. The last picture then has two bands, with slices of half a
 * band. */
static void test_allocation(void **state)
{
    (void)state;
    answer_as(&(struct fake_device) { .allocation = 440 << 10, .heap = 64 << 20 });
}

static void test_binding(void **state)
{
    (void)state;
    answer_as(&(struct fake_device) { .binding = 700000 });
}

/* The device binds fewer texels than a band has, so that kernels read storage. */
static void test_texels(void **state)
{
    (void)state;
    answer_as(
        /* the emitters' tables take 4608 texels, and 18000 pixels take 13500 */
        &(struct fake_device) { .texels = 8192 });
}

static void test_incoherent(void **state)
{
    (void)state;
    answer_as(&(struct fake_device) { .incoherent = true });
}

/* A lost device is abandoned, together with all memory that the driver has allocated for it. This memory does not count
 * as leaked. */
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));

/* For each operation and each n, the device is lost at the n-th submission. The operation must end with an error that
 * says so, without a crash. */
static void test_lost(void **state)
{
    (void)state;
    if (__lsan_disable)
        __lsan_disable();
    for (int n = 1; n <= 9; n += 2) {
        struct kd_renderer *renderer = NULL;
        struct kd_frame frame = { 0 };
        fake_device_on(&(struct fake_device) { .lost_at = n });
        OK(open(&renderer, &error));
        struct kd_error why = { 0 };
        enum kd_status status = KD_OK;
        for (int k = 0; k < 3 && !status; k++) {
            kd_frame_finish(&frame);
            status = draw(renderer, k, &frame, &why);
        }
        assert_int_equal(status, KD_EDEVICE);
        assert_non_null(strstr(why.message, "VK_ERROR_DEVICE_LOST"));
        FAILS(KD_EDEVICE, "lost", draw(renderer, 1, &frame, &error)); /* the device stays lost */
        kd_renderer_destroy(renderer);
        fake_device_off();
    }
    if (__lsan_enable)
        __lsan_enable();
}

/* A picture too large for the heap is refused before anything is drawn. */
static void test_heap(void **state)
{
    (void)state;
    struct kd_renderer *renderer = NULL;
    struct kd_frame frame = { 0 };
    fake_device_on(&(struct fake_device) { .heap = 400 << 10 });
    OK(open(&renderer, &error));
    FAILS(KD_ETOOBIG, "GiB", draw(renderer, 0, &frame, &error));
    kd_renderer_destroy(renderer);
    fake_device_off();
}

/* Of a large heap, only the part that other programs leave free counts as available. */
static void test_budget(void **state)
{
    (void)state;
    struct kd_renderer *renderer = NULL;
    struct kd_frame frame = { 0 };
    fake_device_on(&(struct fake_device) { .budget = 400 << 10 });
    OK(open(&renderer, &error));
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    assert_true(capacity.memory_bytes > 0 && capacity.memory_bytes <= 400 << 10);
    FAILS(KD_ETOOBIG, "GiB", draw(renderer, 0, &frame, &error));
    kd_renderer_destroy(renderer);
    fake_device_off();
}

/* Limits of most GPUs: 65 535 workgroups, bindings of 4 GiB. */
static void test_large_pictures(void **state)
{
    (void)state;
    struct kd_capacity capacity = { 0 };
    struct kd_renderer *renderer = NULL;
    OK(open(&renderer, &error));
    kd_renderer_capacity(renderer, &capacity);
    capacity.max_binding_bytes = UINT32_MAX;
    capacity.max_allocation_bytes = UINT32_MAX;
    capacity.memory_bytes = 80ull << 30;
    capacity.max_groups_x = capacity.max_groups_y = 65535;
    static const struct {
        int width, height, samples;
    } sizes[] = {
        { 4096, 4096, 1 }, { 16384, 12288, 1 }, { 32768, 32768, 1 },
        { 4096, 4096, 8 }, { 1, 32768, 8 },     { 32768, 1, 8 },
    };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int k = 0; k < 3; k++) {
            struct kd_scene scene = scene_of(k);
            struct kd_plan plan;
            scene.image.width = sizes[i].width;
            scene.image.height = sizes[i].height;
            scene.image.samples = sizes[i].samples;
            scene.image.critical_factor = 8;
            struct kd_error error = { 0 };
            enum kd_status status = kd_plan_make(&scene, &capacity, &plan, &error);
            if (status == KD_ETOOBIG && sizes[i].width * sizes[i].height > 1 << 28)
                continue;
            assert_int_equal(status, KD_OK);
            uint64_t pixels = (uint64_t)plan.picture.width * plan.picture.band_rows,
                     at_curve = plan.lens.critical_part * plan.lens.critical;
            assert_true((pixels + 3) / 4 <= 65535ull * 64); /* post */
            /* workgroups of the trace pass along y, one for each row of rays */
            assert_true((uint64_t)plan.picture.band_rows * plan.lens.side <= 65535);
            assert_true((uint64_t)plan.picture.width * plan.lens.side <= 65535ull * 64);
            assert_true((at_curve + 63) / 64 <= 65535); /* workgroups of the trace pass at the critical curve */
            assert_true(4ull * plan.lens.planes * pixels * plan.lens.side * plan.lens.side + 16 <= UINT32_MAX);
            assert_true(kd_plan_pixel_bytes(&plan.light) * pixels <= UINT32_MAX);
            assert_true((uint64_t)plan.picture.bands * plan.picture.band_rows >= plan.picture.height);
        }
    kd_renderer_destroy(renderer);
}

int main(void)
{
    int skip = skip_without_device();
    if (skip)
        return skip;
    struct kd_renderer *renderer = NULL;
    struct kd_error error = { 0 };
    if (open(&renderer, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    ask(renderer, &real);
    kd_renderer_destroy(renderer);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_large_pictures), cmocka_unit_test(test_groups), cmocka_unit_test(test_allocation),
        cmocka_unit_test(test_binding),        cmocka_unit_test(test_texels), cmocka_unit_test(test_incoherent),
        cmocka_unit_test(test_heap),           cmocka_unit_test(test_budget), cmocka_unit_test(test_lost),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    forget(&real);
    return failed;
}
