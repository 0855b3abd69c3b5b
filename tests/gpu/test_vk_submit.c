/* Tests of submissions: many in bounded memory, tickets, discarding, and their cost. */
#include "support.h"

#include <time.h>

static double now_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

static size_t pools(const struct kd_vk *vk)
{
    size_t sum = 0;
    for (int i = 0; i < KD_VK_SLOTS; i++)
        sum += vk->slots[i].descriptors.n_pools + vk->slots[i].stamps.n_pools;
    return sum;
}

static void many(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 64, submissions = 1000, each = 3 };
    struct kd_vk_pipeline *pipeline = make_mix(vk, 1);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_READBACK, "y");
    uint64_t first, last = 0, held = kd_vk_allocated(vk);
    size_t settled = 0;
    memset(words(x), 0, n * 4);
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 0, &error));
    OK(kd_vk_submit(vk, &first, &error));
    for (int i = 0; i < submissions; i++) {
        uint64_t ticket;
        for (int k = 0; k < each; k++)
            mix(vk, pipeline, x, y, n, 1);
        OK(kd_vk_submit(vk, &ticket, &error));
        assert_int_equal(ticket, first + 1 + (uint64_t)i);
        assert_true(vk->submitted - vk->done <= KD_VK_IN_FLIGHT);
        if (i == 2 * KD_VK_SLOTS)
            settled = pools(vk);
        last = ticket;
    }
    assert_int_equal(pools(vk), settled);
    assert_int_equal(kd_vk_allocated(vk), held);
    OK(kd_vk_wait(vk, first, &error)); /* returns at once, because these submissions were completed long ago */
    OK(kd_vk_wait(vk, last, &error));
    for (int i = 0; i < n; i++)
        assert_int_equal(words(y)[i], submissions * each);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* More dispatches than one descriptor pool or the hazard table holds. */
static void one_large(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 64, dispatches = 1000 };
    struct kd_vk_pipeline *pipeline = make_mix(vk, 1);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_READBACK, "y");
    memset(words(x), 0, n * 4);
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 0, &error));
    for (int i = 0; i < dispatches; i++)
        mix(vk, pipeline, x, y, n, 1);
    finish(vk);
    assert_int_equal(words(y)[n - 1], dispatches);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
}

static void nothing_and_discarded(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 64 };
    uint64_t before, after;
    struct kd_vk_buffer *y = make_buffer(vk, n, KD_VK_READBACK, "y");
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 1, &error));
    OK(kd_vk_submit(vk, &before, &error));
    OK(kd_vk_submit(vk, &after, &error)); /* no command is recorded */
    assert_int_equal(before, after);
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 2, &error));
    kd_vk_discard(vk);
    kd_vk_discard(vk);
    OK(kd_vk_submit(vk, &after, &error));
    assert_int_equal(before, after);
    OK(kd_vk_wait(vk, 0, &error));
    assert_int_equal(words(y)[0], 1);
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 3, &error));
    finish(vk);
    assert_int_equal(words(y)[0], 3);
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 4, &error));
    kd_vk_buffer_destroy(vk, y); /* recorded and then discarded: the buffer is freed nevertheless */
    kd_vk_discard(vk);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

/* Prints the cost of a submission without validation, and tests no bound. */
static void cost(void **state)
{
    (void)state;
    enum { n = 64, dispatches = 2000, submissions = 500 };
    struct kd_vk *vk = open_device(false);
    struct kd_vk_pipeline *pipeline = make_mix(vk, 1);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_DEVICE, "x"), *y = make_buffer(vk, n, KD_VK_DEVICE, "y");
    mix(vk, pipeline, x, y, n, 1);
    finish(vk); /* drivers compile at the first dispatch */
    double start = now_us();
    for (int i = 0; i < dispatches; i++)
        mix(vk, pipeline, x, y, n, 1);
    double recorded = now_us();
    finish(vk);
    double finished = now_us();
    for (int i = 0; i < submissions; i++) {
        mix(vk, pipeline, x, y, n, 1);
        finish(vk);
    }
    double round_trips = now_us();
    print_message("one dispatch: %.2f us to record, %.2f us in all; submit and wait: %.1f us\n",
                  (recorded - start) / dispatches, (finished - start) / dispatches,
                  (round_trips - finished) / submissions);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
    kd_vk_destroy(vk);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(many), cmocka_unit_test(one_large),
                                  cmocka_unit_test(nothing_and_discarded), cmocka_unit_test(cost) };
    return RUN_ON_DEVICE(tests);
}
