/* Tests of device memory: shared blocks, reuse, release, and refusal. */
#include "support.h"

static void small_ones_share_a_block(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 200 };
    struct kd_vk_buffer *buffers[n];
    for (int i = 0; i < n; i++) {
        OK(kd_vk_buffer_create(vk, 1 + (unsigned)i * 37, KD_VK_UPLOAD, "small", &buffers[i], &error));
        assert_int_equal(kd_vk_buffer_size(buffers[i]), 1 + i * 37);
        assert_int_equal((uintptr_t)kd_vk_buffer_map(buffers[i]) % 64, 0);
        memset(kd_vk_buffer_map(buffers[i]), i, 1 + (unsigned)i * 37);
    }
    uint64_t held = kd_vk_allocated(vk);
    assert_true(held > 0 && held <= KD_VK_BLOCK_BYTES);
    for (int i = 0; i < n; i++)
        for (int b = 0; b < 1 + i * 37; b++)
            assert_int_equal(((uint8_t *)kd_vk_buffer_map(buffers[i]))[b], i & 255);
    for (int i = 0; i < n; i += 2)
        kd_vk_buffer_destroy(vk, buffers[i]);
    for (int i = 0; i < n; i += 2)
        OK(kd_vk_buffer_create(vk, 1 + (unsigned)i * 37, KD_VK_UPLOAD, "again", &buffers[i], &error));
    assert_int_equal(kd_vk_allocated(vk), held); /* the new buffers fit into the gaps */
    for (int i = 0; i < n; i++)
        kd_vk_buffer_destroy(vk, buffers[i]);
    kd_vk_buffer_destroy(vk, NULL);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

static void large_ones_have_their_own(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_buffer *small, *large;
    uint64_t bytes = KD_VK_BLOCK_BYTES + 4096;
    OK(kd_vk_buffer_create(vk, 4096, KD_VK_DEVICE, "small", &small, &error));
    uint64_t held = kd_vk_allocated(vk);
    OK(kd_vk_buffer_create(vk, bytes, KD_VK_DEVICE, "large", &large, &error));
    assert_int_equal(kd_vk_allocated(vk), held + bytes);
    kd_vk_buffer_destroy(vk, large);
    assert_int_equal(kd_vk_allocated(vk), held);
    kd_vk_buffer_destroy(vk, small);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

static void oversized(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_buffer *none, *part[64];
    size_t n = 0;
    FAILS(KD_EINTERNAL, "no bytes", kd_vk_buffer_create(vk, 0, KD_VK_DEVICE, "empty", &none, &error));
    FAILS(KD_ENOMEM, "'huge'", kd_vk_buffer_create(vk, UINT64_MAX, KD_VK_DEVICE, "huge", &none, &error));
    FAILS(KD_ENOMEM, "MiB", kd_vk_buffer_create(vk, UINT64_C(1) << 50, KD_VK_READBACK, "huge", &none, &error));
    assert_null(none);
    assert_int_equal(kd_vk_allocated(vk), 0);
    /* When a heap is full, an error is reported. When buffers are destroyed, memory is available again. The test
     * simulates a small heap, because the real one may be too large to fill. */
    VkPhysicalDeviceMemoryProperties *memory = &vk->heap.properties;
    VkMemoryHeap *heap = &memory->memoryHeaps[memory->memoryTypes[vk->heap.types[KD_VK_DEVICE]].heapIndex];
    uint64_t truth = heap->size, bytes = UINT64_C(8) << 20;
    heap->size = 16 * bytes;
    while (n < 64 && !kd_vk_buffer_create(vk, bytes, KD_VK_DEVICE, "part", &part[n], NULL))
        n++;
    assert_int_equal(n, 16);
    FAILS(KD_ENOMEM, "are in use", kd_vk_buffer_create(vk, bytes, KD_VK_DEVICE, "one more", &none, &error));
    while (n)
        kd_vk_buffer_destroy(vk, part[--n]);
    heap->size = truth;
    assert_int_equal(kd_vk_allocated(vk), 0);
}

/* A buffer that is destroyed while the device may use it is freed later. Until then it counts as allocated. */
static void destroyed_in_flight(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 4096 };
    struct kd_vk_buffer *back = make_buffer(vk, n, KD_VK_READBACK, "back");
    struct kd_vk_pipeline *pipeline = make_mix(vk, 1);
    struct kd_vk_buffer *x = make_buffer(vk, n, KD_VK_UPLOAD, "x"), *y = make_buffer(vk, n, KD_VK_DEVICE, "y");
    for (uint32_t i = 0; i < n; i++)
        words(x)[i] = i;
    OK(kd_vk_fill(vk, "fill", y, 0, n * 4, 2, &error));
    mix(vk, pipeline, x, y, n, 5);
    OK(kd_vk_copy(vk, "readback", back, 0, y, 0, n * 4, &error));
    kd_vk_pipeline_destroy(vk, pipeline); /* destroyed while its commands are recorded but not submitted */
    kd_vk_buffer_destroy(vk, x);
    OK(kd_vk_submit(vk, NULL, &error));
    kd_vk_buffer_destroy(vk, y);
    OK(kd_vk_wait(vk, 0, &error));
    assert_null(vk->retired);
    for (uint32_t i = 0; i < n; i++)
        assert_int_equal(words(back)[i], 2 * 5 + i + 1);
    kd_vk_buffer_destroy(vk, back);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(small_ones_share_a_block),
                                  cmocka_unit_test(large_ones_have_their_own), cmocka_unit_test(oversized),
                                  cmocka_unit_test(destroyed_in_flight) };
    return RUN_ON_DEVICE(tests);
}
