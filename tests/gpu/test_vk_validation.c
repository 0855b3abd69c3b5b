/* Checks that the validation layer is active: each kind of error that it must find is planted. Messages on stderr
 * are expected here. */
#include "support.h"

#include "vk/submit.h"

static VKAPI_ATTR void VKAPI_CALL no_barrier(VkCommandBuffer commands, VkPipelineStageFlags src,
                                             VkPipelineStageFlags dst, VkDependencyFlags flags, uint32_t n_memory,
                                             const VkMemoryBarrier *memory, uint32_t n_buffer,
                                             const VkBufferMemoryBarrier *buffer, uint32_t n_image,
                                             const VkImageMemoryBarrier *image)
{
    (void)commands, (void)src, (void)dst, (void)flags, (void)n_memory, (void)memory, (void)n_buffer;
    (void)buffer, (void)n_image, (void)image;
}

/* Number of messages about a buffer that is filled and to which a kernel then adds. */
static uint32_t fill_then_add(bool barriers)
{
    struct kd_vk *vk = open_device(true);
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0);
    struct kd_vk_buffer *x = make_buffer(vk, 64, KD_VK_DEVICE, "x"), *y = make_buffer(vk, 64, KD_VK_DEVICE, "y");
    if (!barriers)
        vk->core.fn.CmdPipelineBarrier = no_barrier;
    OK(kd_vk_fill(vk, "fill", x, 0, 256, 1, &error));
    OK(kd_vk_fill(vk, "fill", y, 0, 256, 1, &error));
    mix(vk, pipeline, x, y, 64, 1);
    finish(vk);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
    uint32_t messages = kd_vk_validation_messages(vk);
    kd_vk_destroy(vk);
    return messages;
}

/* Number of messages about a buffer that is filled and that a kernel then reads through binding k. The bindings are a
 * uniform block, texels of one float, of four, of one word, and of two. */
static uint32_t fill_then_read(int k, bool barriers)
{
    struct kd_vk *vk = open_device(true);
    struct kd_vk_pipeline *pipeline = make_kinds(vk);
    struct kd_vk_buffer *still = make_buffer(vk, 256, KD_VK_UPLOAD, "still"),
                        *x = make_buffer(vk, 256, KD_VK_DEVICE, "x"), *y = make_buffer(vk, 256, KD_VK_DEVICE, "y");
    memset(words(still), 0, 1024);
    if (!barriers)
        vk->core.fn.CmdPipelineBarrier = no_barrier;
    struct kd_vk_dispatch d = { .pipeline = pipeline,
                                .bindings = { { .buffer = still },
                                              { .buffer = still },
                                              { .buffer = still },
                                              { .buffer = y, .write = true },
                                              { .buffer = still },
                                              { .buffer = still } } };
    d.bindings[k].buffer = x;
    OK(kd_vk_fill(vk, "fill", x, 0, 1024, 0, &error));
    OK(kd_vk_dispatch(vk, &d, &error));
    finish(vk);
    kd_vk_buffer_destroy(vk, still);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_pipeline_destroy(vk, pipeline);
    uint32_t messages = kd_vk_validation_messages(vk);
    kd_vk_destroy(vk);
    return messages;
}

static void synchronisation(void **state)
{
    (void)state;
    assert_int_equal(fill_then_add(true), 0);
    assert_true(fill_then_add(false) > 0);
    for (int k = 0; k < 6; k++) {
        if (k == 3) /* skipped, because this binding is written */
            continue;
        assert_int_equal(fill_then_read(k, true), 0);
        assert_true(fill_then_read(k, false) > 0);
    }
}

/* Tests the core checks by an unaligned fill, which is discarded and not run. */
static void core(void **state)
{
    (void)state;
    struct kd_vk *vk = open_device(true);
    struct kd_vk_buffer *buffer = make_buffer(vk, 64, KD_VK_DEVICE, "x");
    struct kd_vk_slot *slot;
    OK(kd_vk_submit_slot(vk, &slot, &error));
    assert_int_equal(kd_vk_validation_messages(vk), 0);
    vk->core.fn.CmdFillBuffer(slot->commands, buffer->handle, 2, 4, 0);
    assert_true(kd_vk_validation_messages(vk) > 0);
    kd_vk_discard(vk);
    kd_vk_buffer_destroy(vk, buffer);
    kd_vk_destroy(vk);
}

static void by_environment(void **state)
{
    struct kd_vk *vk;
    (void)state;
    vk = open_device(false);
    assert_true(vk->instance.debug.messenger == VK_NULL_HANDLE);
    kd_vk_destroy(vk);
    setenv("KERRD_VALIDATE", "1", 1);
    vk = open_device(false);
    assert_true(vk->instance.debug.messenger != VK_NULL_HANDLE);
    kd_vk_destroy(vk);
    setenv("KERRD_VALIDATE", "0", 1);
    vk = open_device(false);
    assert_true(vk->instance.debug.messenger == VK_NULL_HANDLE);
    kd_vk_destroy(vk);
    unsetenv("KERRD_VALIDATE");
}

static VKAPI_ATTR VkResult VKAPI_CALL no_layers(uint32_t *count, VkLayerProperties *list)
{
    (void)list;
    *count = 0;
    return VK_SUCCESS;
}

static void hide_layers(struct kd_vk_functions *fn) { fn->EnumerateInstanceLayerProperties = no_layers; }

static void layer_missing(void **state)
{
    struct kd_vk *vk;
    (void)state;
    kd_vk_functions_hook = hide_layers;
    FAILS(KD_EDEVICE, "VK_LAYER_KHRONOS_validation is not installed",
          kd_vk_create(&(struct kd_vk_params) { .validate = true, .cache_dir = "" }, &vk, &error));
    kd_vk_functions_hook = NULL;
    assert_null(vk);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(synchronisation), cmocka_unit_test(core),
                                        cmocka_unit_test(by_environment), cmocka_unit_test(layer_missing) };
    if (skip_without_device())
        return SKIPPED;
    unsetenv("KERRD_VALIDATE");
    return cmocka_run_group_tests(tests, NULL, NULL) != 0;
}
