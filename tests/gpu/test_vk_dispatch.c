/* Compares the result of a kernel with specialisation and push constants with the same arithmetic on the host. Also
 * tests refused dispatches. */
#include "support.h"

static void sizes(void **state)
{
    struct kd_vk *vk = *state;
    static const uint32_t counts[] = { 1, 63, 64, 65, 1000, 4096, 100003, 1u << 20 };
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        uint32_t n = counts[c], bias = 7 + (uint32_t)c, mul = 3;
        struct kd_vk_pipeline *pipeline = make_mix(vk, bias);
        struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_DEVICE, "y");
        struct kd_vk_buffer *back = make_buffer(vk, n, KD_VK_READBACK, "back");
        for (uint32_t i = 0; i < n; i++)
            words(x)[i] = i * 2654435761u;
        OK(kd_vk_fill(vk, "fill", y, 0, (uint64_t)n * 4, 11, &error));
        mix(vk, pipeline, x, y, n, mul);
        OK(kd_vk_copy(vk, "readback", back, 0, y, 0, (uint64_t)n * 4, &error));
        finish(vk);
        for (uint32_t i = 0; i < n; i++)
            assert_int_equal(words(back)[i], 11 * mul + i * 2654435761u + bias);
        kd_vk_buffer_destroy(vk, x);
        kd_vk_buffer_destroy(vk, y);
        kd_vk_buffer_destroy(vk, back);
        kd_vk_pipeline_destroy(vk, pipeline);
    }
    assert_int_equal(kd_vk_allocated(vk), 0);
}

/* The device writes the size of a dispatch just before the dispatch. With size 0 nothing is executed. */
static void sizes_of_a_buffer(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 256 };
    const struct mix_push push = { n, 10 };
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_READBACK, "y");
    struct kd_vk_buffer *counts = make_buffer(vk, 4, KD_VK_DEVICE, "counts");
    struct kd_vk_dispatch d = { .pipeline = pipeline,
                                .bindings = { { .buffer = x }, { .buffer = y, .write = true } },
                                .push = &push,
                                .counts = counts,
                                .counts_at = 4 };
    for (uint32_t i = 0; i < n; i++)
        words(x)[i] = i;
    for (uint32_t groups = 0; groups <= n / MIX_GROUP; groups += n / MIX_GROUP) {
        OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 1, &error));
        OK(kd_vk_fill(vk, "fill", counts, 4, 4, groups, &error));
        OK(kd_vk_fill(vk, "fill", counts, 8, 8, 1, &error));
        OK(kd_vk_dispatch(vk, &d, &error));
        finish(vk);
        for (uint32_t i = 0; i < n; i++)
            assert_int_equal(words(y)[i], groups ? 10 + i : 1);
    }
    d.counts_at = 8;
    FAILS(KD_EINTERNAL, "counts at 8", kd_vk_dispatch(vk, &d, &error));
    d.counts_at = 2;
    FAILS(KD_EINTERNAL, "multiple of 4", kd_vk_dispatch(vk, &d, &error));
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_buffer_destroy(vk, counts);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* Tests parts of buffers: offsets in bindings, copies and fills affect only the given range. */
static void ranges(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 1024, part = 256 };
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_READBACK, "y");
    const struct mix_push push = { part, 10 };
    for (uint32_t i = 0; i < n; i++)
        words(x)[i] = i;
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 1, &error));
    OK(kd_vk_fill(vk, "fill", y, 512 * 4, 4, 5, &error));
    OK(kd_vk_copy(vk, NULL, y, 768 * 4, x, 100 * 4, 8, &error));
    OK(kd_vk_dispatch(
        vk,
        &(struct kd_vk_dispatch) { .pipeline = pipeline,
                                   .bindings = { { .buffer = x, .offset = 512 * 4, .size = part * 4 },
                                                 { .buffer = y, .offset = 256 * 4, .size = part * 4, .write = true } },
                                   .push = &push,
                                   .groups = { part / MIX_GROUP } },
        &error));
    finish(vk);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t want = i >= 256 && i < 512 ? 10 + i + 256 : i == 512 ? 5 : i == 768 ? 100 : i == 769 ? 101 : 1;
        assert_int_equal(words(y)[i], want);
    }
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
}

static void refused(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0), *none;
    struct kd_vk_buffer *x = make_buffer(vk, 64, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, 64, KD_VK_DEVICE, "y");
    const struct mix_push push = { 64, 1 };
    const struct kd_vk_dispatch good = { .pass = "bad",
                                         .pipeline = pipeline,
                                         .bindings = { { .buffer = x }, { .buffer = y, .write = true } },
                                         .push = &push };
    struct kd_vk_dispatch bad = good;
    bad.pipeline = NULL;
    FAILS(KD_EINTERNAL, "without a pipeline", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[1].buffer = NULL;
    FAILS(KD_EINTERNAL, "binding 1 has no buffer", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[0].offset = 4;
    FAILS(KD_EINTERNAL, "multiple of 256", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[0].size = 260;
    FAILS(KD_EINTERNAL, "inside it", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[0].offset = UINT64_MAX - 255;
    FAILS(KD_EINTERNAL, "inside it", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.push = NULL;
    FAILS(KD_EINTERNAL, "push constants", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.groups[1] = UINT32_MAX;
    FAILS(KD_ETOOBIG, "along axis 1", kd_vk_dispatch(vk, &bad, &error));
    FAILS(KD_EINTERNAL, "reach outside", kd_vk_copy(vk, "c", y, 8, x, 0, 256, &error));
    FAILS(KD_EINTERNAL, "overlap", kd_vk_copy(vk, "c", y, 8, y, 0, 16, &error));
    FAILS(KD_EINTERNAL, "multiples of 4", kd_vk_fill(vk, "fill", y, 2, 4, 0, &error));
    FAILS(KD_EINTERNAL, "no submission", kd_vk_wait(vk, UINT64_MAX, &error));

    struct kd_vk_pipeline_params params = { .name = "p", .spirv = mix_spv, .spirv_bytes = sizeof mix_spv - 1 };
    FAILS(KD_EINTERNAL, "not SPIR-V", kd_vk_pipeline_create(vk, &params, &none, &error));
    params.spirv_bytes++, params.n_buffers = KD_VK_MAX_BINDINGS + 1;
    FAILS(KD_EINTERNAL, "13 buffers; there must be at most 12", kd_vk_pipeline_create(vk, &params, &none, &error));
    params.n_buffers = 2, params.push_bytes = 1u << 20;
    FAILS(KD_EINTERNAL, "push constants", kd_vk_pipeline_create(vk, &params, &none, &error));
    assert_null(none);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* Tests a buffer that is larger than one binding. Skipped if the device's memory is too small for such a buffer. */
static void wide_binding(void **state)
{
    struct kd_vk *vk = *state;
    uint64_t most = kd_vk_info(vk)->max_binding_bytes;
    struct kd_vk_buffer *big = NULL;
    if (kd_vk_buffer_create(vk, most + 256, KD_VK_DEVICE, "big", &big, NULL)) {
        print_message("no memory for a buffer wider than a binding: not tried\n");
        return;
    }
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0);
    const struct mix_push push = { 1, 1 };
    struct kd_vk_dispatch d = { .pass = "wide",
                                .pipeline = pipeline,
                                .bindings = { { .buffer = big }, { .buffer = big, .size = 256, .write = true } },
                                .push = &push };
    FAILS(KD_ETOOBIG, "on this device it must have at most", kd_vk_dispatch(vk, &d, &error));
    kd_vk_buffer_destroy(vk, big);
    kd_vk_pipeline_destroy(vk, pipeline);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(sizes), cmocka_unit_test(sizes_of_a_buffer),
                                  cmocka_unit_test(ranges), cmocka_unit_test(refused), cmocka_unit_test(wide_binding) };
    return RUN_ON_DEVICE(tests);
}
