/* Shared by the tests of src/vk: opening a device or skipping the test, kernels, and buffers with contents. */
#ifndef KD_TEST_GPU_SUPPORT_H
#define KD_TEST_GPU_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "vk/buffer.h"
#include "vk/device.h"
#include "vk/pipeline.h"
#include "vk/vk.h"

#include "kinds_spv.h"
#include "mix_spv.h"
#include "spin_spv.h"

#define SKIPPED 77

/* Asserts success, and prints the message otherwise. */
#define OK(call) \
    do { \
        struct kd_error error = { 0 }; \
        enum kd_status got = (call); \
        if (got) \
            fail_msg("%s: %s: %s", #call, kd_status_name(got), error.message); \
    } while (0)

/* Asserts that the status is this one, and that the message contains `part`. */
#define FAILS(status_, part, call) \
    do { \
        struct kd_error error = { 0 }; \
        enum kd_status got = (call); \
        if (got != (status_) || error.status != (status_) || !strstr(error.message, part)) \
            fail_msg("%s: got %s: '%s'", #call, kd_status_name(got), error.message); \
        assert_null(strchr(error.message, '\n')); \
    } while (0)

/* Keeps drivers and layers loaded until the end. Otherwise the loader would unload them with the last instance, and a
 * leak checker could not suppress their leaks by name. */
static inline void keep_drivers_loaded(void)
{
    static struct kd_vk_instance keeper;
    if (kd_vk_instance_init(&keeper, true, NULL))
        kd_vk_instance_init(&keeper, false, NULL);
}

/* Returns 0 if there is a device. Otherwise prints the reason and returns 77. */
static inline int skip_without_device(void)
{
    keep_drivers_loaded();
    struct kd_vk_info *infos;
    struct kd_error error = { 0 };
    size_t n;
    if (kd_vk_list(&infos, &n, &error)) {
        printf("SKIP: %s\n", error.message);
        return SKIPPED;
    }
    free(infos);
    return 0;
}

static inline struct kd_vk *open_device(bool validate)
{
    struct kd_vk *vk = NULL;
    const char *device = getenv("KERRD_TEST_DEVICE");
    OK(kd_vk_create(
        &(struct kd_vk_params) { .device = device ? device : "auto", .cache_dir = "", .validate = validate }, &vk,
        &error));
    return vk;
}

struct mix_push { uint32_t n, mul; };
#define MIX_GROUP 64

static inline struct kd_vk_pipeline *make_mix(struct kd_vk *vk, uint32_t bias)
{
    struct kd_vk_pipeline *pipeline = NULL;
    const struct kd_vk_spec spec[] = { { 0, MIX_GROUP }, { 1, bias } };
    OK(kd_vk_pipeline_create(vk,
                             &(struct kd_vk_pipeline_params) { .name = "mix",
                                                               .spirv = mix_spv,
                                                               .spirv_bytes = sizeof mix_spv,
                                                               .n_buffers = 2,
                                                               .push_bytes = sizeof(struct mix_push),
                                                               .spec = spec,
                                                               .n_spec = 2 },
                             &pipeline, &error));
    return pipeline;
}

/* Sets y to y * mul + x + bias for n elements. */
static inline void mix(struct kd_vk *vk, const struct kd_vk_pipeline *pipeline, struct kd_vk_buffer *x,
                       struct kd_vk_buffer *y, uint32_t n, uint32_t mul)
{
    const struct mix_push push = { n, mul };
    OK(kd_vk_dispatch(vk,
                      &(struct kd_vk_dispatch) { .pass = "mix",
                                                 .pipeline = pipeline,
                                                 .bindings = { { .buffer = x }, { .buffer = y, .write = true } },
                                                 .push = &push,
                                                 .groups = { (n + MIX_GROUP - 1) / MIX_GROUP } },
                      &error));
}

/* The bindings of kinds.comp: a uniform block; texels of 1 float; texels of 4 floats; storage; texels of 1 word; texels
 * of 2 words. */
struct kinds_block {
    uint32_t n;
    float scale, table[6];
};
#define KINDS_PARAMS \
    { \
        .name = "kinds", .spirv = kinds_spv, .spirv_bytes = sizeof kinds_spv, \
        .n_buffers = 6, .kinds = { KD_VK_UNIFORM, KD_VK_TEXELS_R,    KD_VK_TEXELS_RGBA, \
                                   KD_VK_STORAGE, KD_VK_TEXELS_WORD, KD_VK_TEXELS_PAIR } \
    }

static inline struct kd_vk_pipeline *make_kinds(struct kd_vk *vk)
{
    struct kd_vk_pipeline *pipeline = NULL;
    OK(kd_vk_pipeline_create(vk, &(struct kd_vk_pipeline_params)KINDS_PARAMS, &pipeline, &error));
    return pipeline;
}

static inline struct kd_vk_buffer *make_buffer(struct kd_vk *vk, uint32_t n, enum kd_vk_memory memory, const char *name)
{
    struct kd_vk_buffer *buffer = NULL;
    OK(kd_vk_buffer_create(vk, (uint64_t)n * 4, memory, name, &buffer, &error));
    return buffer;
}

static inline uint32_t *words(struct kd_vk_buffer *buffer)
{
    uint32_t *map = kd_vk_buffer_map(buffer);
    assert_non_null(map);
    return map;
}

static inline void finish(struct kd_vk *vk)
{
    OK(kd_vk_submit(vk, NULL, &error));
    OK(kd_vk_wait(vk, 0, &error));
}

/* Runs the tests on one device with validation. The last test checks that validation has reported nothing. */
static inline int run_on_device(struct CMUnitTest *tests, size_t n)
{
    int skipped = skip_without_device();
    if (skipped)
        return skipped;
    struct kd_vk *vk = open_device(true);
    for (size_t i = 0; i < n; i++)
        tests[i].initial_state = vk;
    int failed = _cmocka_run_group_tests("on a device", tests, n, NULL, NULL);
    uint32_t messages = kd_vk_validation_messages(vk);
    if (messages)
        printf("FAILED: %u messages of the validation layer\n", messages);
    kd_vk_destroy(vk);
    return failed || messages;
}
#define RUN_ON_DEVICE(tests) run_on_device(tests, sizeof(tests) / sizeof *(tests))

#endif
