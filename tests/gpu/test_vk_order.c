/* Tests that chains of commands which read and write the same buffers give correct results, with barriers only where
 * they are necessary. Barriers are counted, because a device that runs everything in order would be correct without
 * any. */
#include "support.h"

enum { n = 2048 };
static PFN_vkCmdPipelineBarrier real_barrier;
static int barriers;

static VKAPI_ATTR void VKAPI_CALL counting(VkCommandBuffer commands, VkPipelineStageFlags src, VkPipelineStageFlags dst,
                                           VkDependencyFlags flags, uint32_t n_memory, const VkMemoryBarrier *memory,
                                           uint32_t n_buffer, const VkBufferMemoryBarrier *buffer, uint32_t n_image,
                                           const VkImageMemoryBarrier *image)
{
    barriers += dst != VK_PIPELINE_STAGE_HOST_BIT;
    real_barrier(commands, src, dst, flags, n_memory, memory, n_buffer, buffer, n_image, image);
}

static void count_from_here(struct kd_vk *vk)
{
    finish(vk);
    vk->hazards.count = 0; /* removes the hazards of earlier tests */
    barriers = 0;
}

static void counted(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_pipeline *pipeline = make_mix(vk, 0);
    struct kd_vk_buffer *b[4];
    for (int i = 0; i < 4; i++)
        b[i] = make_buffer(vk, n, KD_VK_DEVICE, "b");
    for (int i = 0; i < 4; i++)
        OK(kd_vk_fill(vk, "fill", b[i], 0, n * 4, 1, &error));
    real_barrier = vk->core.fn.CmdPipelineBarrier;
    vk->core.fn.CmdPipelineBarrier = counting;

    count_from_here(vk);
    mix(vk, pipeline, b[0], b[1], n, 1);
    mix(vk, pipeline, b[0], b[2], n, 1); /* both commands only read the shared buffer */
    assert_int_equal(barriers, 0);
    mix(vk, pipeline, b[1], b[3], n, 1); /* read after write */
    assert_int_equal(barriers, 1);
    mix(vk, pipeline, b[2], b[3], n, 1); /* write after write; b[2] needs no further barrier */
    assert_int_equal(barriers, 2);
    mix(vk, pipeline, b[3], b[1], n, 1); /* b[3] is read after it was written */
    assert_int_equal(barriers, 3);
    mix(vk, pipeline, b[2], b[0], n, 1);
    assert_int_equal(barriers, 3);
    OK(kd_vk_fill(vk, "fill", b[2], 0, n * 4, 0, &error)); /* write after read, in another stage */
    assert_int_equal(barriers, 4);

    count_from_here(vk);
    OK(kd_vk_copy(vk, "c", b[1], 0, b[0], 0, n * 2, &error));
    OK(kd_vk_copy(vk, "c", b[1], n * 2, b[0], n * 2, n * 2, &error)); /* copies the other half */
    assert_int_equal(barriers, 0);
    OK(kd_vk_submit(vk, NULL, &error));
    OK(kd_vk_copy(vk, "c", b[3], 0, b[1], 0, n * 4, &error)); /* hazard with a command of the previous submission */
    assert_int_equal(barriers, 1);
    kd_vk_discard(vk);
    /* no barrier is pending, because it was discarded with its commands */
    OK(kd_vk_copy(vk, "c", b[2], 0, b[1], 0, n * 4, &error));
    assert_int_equal(barriers, 2);

    finish(vk);
    vk->core.fn.CmdPipelineBarrier = real_barrier;
    for (int i = 0; i < 4; i++)
        kd_vk_buffer_destroy(vk, b[i]);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* One random command, on the device and in the model. Ranges are multiples of 64 words (256 bytes). */
static void random_command(struct kd_vk *vk, const struct kd_vk_pipeline *pipeline, struct kd_vk_buffer *b[4],
                           uint32_t model[4][n])
{
    uint32_t from = (uint32_t)rand() % 4, to = (from + 1 + (uint32_t)rand() % 3) % 4, value = (uint32_t)rand();
    uint32_t at = (uint32_t)rand() % (n / 64) * 64, words_left = n - at;
    uint32_t count = 64 * (1 + (uint32_t)rand() % (words_left / 64));
    const struct mix_push push = { count, value | 1 };
    switch (rand() % 4) {
    case 0:
        OK(kd_vk_fill(vk, "fill", b[to], at * 4, count * 4, value, &error));
        for (uint32_t i = 0; i < count; i++)
            model[to][at + i] = value;
        break;
    case 1:
        OK(kd_vk_copy(vk, "copy", b[to], at * 4, b[from], at * 4, count * 4, &error));
        memcpy(&model[to][at], &model[from][at], count * 4);
        break;
    default:
        OK(kd_vk_dispatch(vk,
                          &(struct kd_vk_dispatch) {
                              .pass = "mix",
                              .pipeline = pipeline,
                              .bindings = { { b[from], at * 4, count * 4, false }, { b[to], at * 4, count * 4, true } },
                              .push = &push,
                              .groups = { count / MIX_GROUP } },
                          &error));
        for (uint32_t i = 0; i < count; i++)
            model[to][at + i] = model[to][at + i] * push.mul + model[from][at + i] + 3;
    }
}

static void random_programs(void **state)
{
    static uint32_t model[4][n];
    struct kd_vk *vk = *state;
    struct kd_vk_pipeline *pipeline = make_mix(vk, 3);
    struct kd_vk_buffer *b[4];
    srand(3);
    for (int i = 0; i < 4; i++) { /* makes buffers of every memory kind; b[2] and b[3] are checked through a copy */
        b[i] = make_buffer(vk, n, i == 0 ? KD_VK_UPLOAD : i == 1 ? KD_VK_READBACK : KD_VK_DEVICE, "b");
        OK(kd_vk_fill(vk, "fill", b[i], 0, n * 4, 0, &error));
    }
    struct kd_vk_buffer *back = make_buffer(vk, n, KD_VK_READBACK, "back");
    memset(model, 0, sizeof model);
    for (int round = 0; round < 30; round++) {
        for (int step = 0; step < 40; step++) {
            random_command(vk, pipeline, b, model);
            if (rand() % 8 == 0)
                OK(kd_vk_submit(vk, NULL, &error));
        }
        for (int i = 0; i < 4; i++) {
            OK(kd_vk_copy(vk, "readback", back, 0, b[i], 0, n * 4, &error));
            finish(vk);
            assert_memory_equal(words(back), model[i], sizeof model[i]);
        }
    }
    for (int i = 0; i < 4; i++)
        kd_vk_buffer_destroy(vk, b[i]);
    kd_vk_buffer_destroy(vk, back);
    kd_vk_pipeline_destroy(vk, pipeline);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(counted), cmocka_unit_test(random_programs) };
    return RUN_ON_DEVICE(tests);
}
