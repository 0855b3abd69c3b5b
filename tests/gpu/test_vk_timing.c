/* Tests of device time by pass: the times are plausible by the clock, summed by name, and absent without timestamps. */
#include "support.h"

#include <time.h>

enum { n = 1 << 16 };
struct spin_push { uint32_t n, rounds; };

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static struct kd_vk_pipeline *make_spin(struct kd_vk *vk)
{
    struct kd_vk_pipeline *pipeline = NULL;
    OK(kd_vk_pipeline_create(vk,
                             &(struct kd_vk_pipeline_params) { .name = "spin",
                                                               .spirv = spin_spv,
                                                               .spirv_bytes = sizeof spin_spv,
                                                               .n_buffers = 1,
                                                               .push_bytes = sizeof(struct spin_push) },
                             &pipeline, &error));
    return pipeline;
}

static void spin(struct kd_vk *vk, const char *pass, struct kd_vk_pipeline *pipeline, struct kd_vk_buffer *buffer,
                 uint32_t rounds)
{
    const struct spin_push push = { n, rounds };
    OK(kd_vk_dispatch(vk,
                      &(struct kd_vk_dispatch) { .pass = pass,
                                                 .pipeline = pipeline,
                                                 .bindings = { { .buffer = buffer, .write = true } },
                                                 .push = &push,
                                                 .groups = { n / 64 } },
                      &error));
}

static struct kd_vk_time time_of(const struct kd_vk *vk, const char *pass)
{
    struct kd_vk_time times[KD_VK_MAX_PASSES];
    size_t count = kd_vk_times(vk, times);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(times[i].pass, pass))
            return times[i];
    return (struct kd_vk_time) { 0 };
}

static void plausible(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_time none[KD_VK_MAX_PASSES];
    if (!kd_vk_info(vk)->timestamps) {
        print_message("this device has no timestamps\n");
        return;
    }
    struct kd_vk_pipeline *pipeline = make_spin(vk);
    struct kd_vk_buffer *buffer = make_buffer(vk, n, KD_VK_DEVICE, "state");
    char name[] = "long"; /* names are compared by content, not by address */
    spin(vk, "warm", pipeline, buffer, 10);
    finish(vk);
    kd_vk_times_reset(vk);
    assert_int_equal(kd_vk_times(vk, none), 0);
    double start = now_ms();
    spin(vk, "short", pipeline, buffer, 1000);
    spin(vk, "long", pipeline, buffer, 10000);
    OK(kd_vk_submit(vk, NULL, &error));
    spin(vk, name, pipeline, buffer, 10000);
    finish(vk);
    double wall = now_ms() - start;
    struct kd_vk_time brief = time_of(vk, "short"), lengthy = time_of(vk, "long");
    print_message("short %.3f ms, long 2 x %.3f ms, wall %.3f ms\n", brief.ms, lengthy.ms / 2, wall);
    assert_int_equal(brief.dispatches, 1);
    assert_int_equal(lengthy.dispatches, 2);
    /* The bounds are wide, because other work shares the machine. 20 times the work takes at least twice as long. The
     * device cannot have been busy for longer than the clock ran, apart from the difference of the two clocks'
     * rates. */
    assert_true(brief.ms > 0 && lengthy.ms > 2 * brief.ms);
    assert_true(brief.ms + lengthy.ms < 1.05 * wall + 0.1);
    assert_true(brief.ms + lengthy.ms > 0.2 * wall);
    kd_vk_buffer_destroy(vk, buffer);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* Tests more changes of pass than one query pool holds, and more names than there are rows. */
static void many(void **state)
{
    struct kd_vk *vk = *state;
    char names[2 * KD_VK_MAX_PASSES][16];
    struct kd_vk_time times[KD_VK_MAX_PASSES];
    if (!kd_vk_info(vk)->timestamps)
        return;
    struct kd_vk_buffer *a = make_buffer(vk, 64, KD_VK_DEVICE, "a"), *b = make_buffer(vk, 64, KD_VK_DEVICE, "b");
    kd_vk_times_reset(vk);
    for (int i = 0; i < 300; i++)
        OK(kd_vk_copy(vk, i % 2 ? "odd" : "even", i % 2 ? a : b, 0, i % 2 ? b : a, 0, 256, &error));
    finish(vk);
    assert_int_equal(time_of(vk, "odd").dispatches, 150);
    assert_int_equal(time_of(vk, "even").dispatches, 150);
    for (int i = 0; i < 2 * KD_VK_MAX_PASSES; i++) {
        snprintf(names[i], sizeof names[i], "pass %d", i);
        OK(kd_vk_copy(vk, names[i], a, 0, b, 0, 256, &error));
    }
    finish(vk);
    memset(names, 0, sizeof names); /* names may be overwritten once the submission is done */
    uint32_t sum = 0;
    size_t count = kd_vk_times(vk, times);
    for (size_t i = 0; i < count; i++)
        sum += times[i].dispatches;
    assert_int_equal(count, KD_VK_MAX_PASSES - 3); /* "warm", "short" and "long" have no row left, "other" has many */
    assert_int_equal(sum, 300 + 2 * KD_VK_MAX_PASSES);
    assert_true(time_of(vk, "other").dispatches > 1);
    kd_vk_buffer_destroy(vk, a);
    kd_vk_buffer_destroy(vk, b);
}

/* Tests devices that reset queries only in command buffers, and devices without timestamps. */
static void lesser_devices(void **state)
{
    (void)state;
    for (int timestamps = 0; timestamps < 2; timestamps++) {
        struct kd_vk *vk = open_device(true);
        struct kd_vk_time times[KD_VK_MAX_PASSES];
        bool had = vk->core.physical.info.timestamps;
        struct kd_vk_buffer *a = make_buffer(vk, 64, KD_VK_READBACK, "a");
        vk->core.physical.host_query_reset = false;
        vk->core.physical.info.timestamps = had && timestamps;
        for (int i = 0; i < 10; i++) {
            OK(kd_vk_fill(vk, "fill", a, 0, 256, 1, &error));
            finish(vk);
        }
        assert_int_equal(kd_vk_times(vk, times), had && timestamps);
        if (had && timestamps)
            assert_int_equal(times[0].dispatches, 10);
        assert_int_equal(words(a)[63], 1);
        kd_vk_buffer_destroy(vk, a);
        assert_int_equal(kd_vk_validation_messages(vk), 0);
        kd_vk_destroy(vk);
    }
}

static void wrapping(void **state)
{
    (void)state;
    assert_float_equal(kd_vk_timing_ms(1000, 3000, 64, 1.0), 0.002, 1e-12);
    assert_float_equal(kd_vk_timing_ms(UINT64_MAX - 499, 1500, 64, 1.0), 0.002, 1e-12);
    assert_float_equal(kd_vk_timing_ms((UINT64_C(1) << 36) - 500, 1500, 36, 10.0), 0.02, 1e-12);
    assert_float_equal(kd_vk_timing_ms(0xffffff00u, 0x100u, 32, 0.5), 0.000256, 1e-12);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(plausible), cmocka_unit_test(many), cmocka_unit_test(lesser_devices),
                                  cmocka_unit_test(wrapping) };
    return RUN_ON_DEVICE(tests);
}
