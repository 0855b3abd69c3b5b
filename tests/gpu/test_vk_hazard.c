/* Tests of the placement of barriers, without a device: first of cases written by hand, then of random programs, whose
 * barriers are compared with those that follow from the definition of a hazard. */
#include "support.h"

#include "vk/hazard.h"

#define COMPUTE VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT
#define TRANSFER VK_PIPELINE_STAGE_TRANSFER_BIT

static struct kd_vk_hazards table;
static struct kd_vk_barrier barrier;

static bool add(uint64_t buffer, uint64_t begin, uint64_t end, VkPipelineStageFlags stage, bool write)
{
    const struct kd_vk_access access = { .buffer = buffer, .begin = begin, .end = end, .stage = stage, .write = write };
    return kd_vk_hazards_add(&table, &access, 1, &barrier);
}

static int reset(void **state)
{
    (void)state;
    memset(&table, 0, sizeof table);
    memset(&barrier, 0, sizeof barrier);
    return 0;
}

static void pairs(void **state)
{
    const VkPipelineStageFlags stages[] = { COMPUTE, TRANSFER };
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            for (int w = 0; w < 4; w++) {
                bool first = w & 1, second = w >> 1;
                reset(state);
                assert_false(add(1, 0, 100, stages[a], first));
                assert_int_equal(add(1, 50, 60, stages[b], second), first || second);
                if (!first && !second)
                    continue;
                assert_int_equal(barrier.src_stages, stages[a]);
                /* Only writes are flushed. A write after a read needs an execution dependency only. */
                assert_int_equal(barrier.src_access, !first                 ? 0
                                                     : stages[a] == COMPUTE ? VK_ACCESS_SHADER_WRITE_BIT
                                                                            : VK_ACCESS_TRANSFER_WRITE_BIT);
                assert_true(barrier.dst_stages & stages[b]);
                assert_true(barrier.dst_access &
                            (stages[b] == COMPUTE ? second ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT
                             : second             ? VK_ACCESS_TRANSFER_WRITE_BIT
                                                  : VK_ACCESS_TRANSFER_READ_BIT));
                if (stages[b] == COMPUTE && !second) /* texels are read like storage, uniform blocks are not */
                    assert_true(barrier.dst_access & VK_ACCESS_UNIFORM_READ_BIT);
            }
}

static void apart(void **state)
{
    (void)state;
    assert_false(add(1, 0, 100, COMPUTE, true));
    assert_false(add(1, 100, 200, COMPUTE, true)); /* adjacent */
    assert_false(add(2, 0, 200, COMPUTE, true));   /* no hazard: another buffer is used */
    assert_false(add(3, 0, 200, COMPUTE, false));
    assert_false(add(3, 0, 200, TRANSFER, false));
    assert_true(add(1, 199, 300, COMPUTE, true)); /* the ranges overlap by one byte */
}

static void emptied_by_a_barrier(void **state)
{
    (void)state;
    assert_false(add(1, 0, 100, COMPUTE, true));
    assert_false(add(2, 0, 100, TRANSFER, true));
    assert_true(add(1, 0, 100, COMPUTE, false));
    assert_int_equal(barrier.src_stages, COMPUTE | TRANSFER);
    assert_int_equal(barrier.src_access, VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT);
    assert_false(add(2, 0, 100, COMPUTE, false)); /* no barrier, because the last barrier served buffer 2 as well */
    assert_false(add(1, 0, 100, TRANSFER, false));
    assert_true(add(1, 0, 4, TRANSFER, true)); /* a write after two readers */
    assert_int_equal(barrier.src_stages, COMPUTE | TRANSFER);
    assert_int_equal(barrier.src_access, 0);
}

/* One command may bind a buffer twice without a hazard within itself, but both bindings count for the next command. */
static void one_command(void **state)
{
    (void)state;
    const struct kd_vk_access both[] = {
        { .buffer = 1, .begin = 0, .end = 100, .stage = COMPUTE },
        { .buffer = 1, .begin = 0, .end = 100, .stage = COMPUTE, .write = true },
    };
    assert_false(kd_vk_hazards_add(&table, both, 2, &barrier));
    assert_true(kd_vk_hazards_add(&table, both, 2, &barrier));
    assert_true(add(1, 0, 1, COMPUTE, false));
}

static void tiles_stay_one_entry(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 10000; i++) {
        assert_false(add(1, i * 256, i * 256 + 256, COMPUTE, true));
        assert_false(add(2, 0, 4096, COMPUTE, false));
    }
    assert_int_equal(table.count, 2);
    assert_true(add(1, 5000 * 256, 5000 * 256 + 1, COMPUTE, false));
}

static void overflow(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < KD_VK_MAX_ACCESSES; i++)
        assert_false(add(1, i * 512, i * 512 + 256, COMPUTE, true));
    assert_true(add(2, 0, 1, COMPUTE, false)); /* the table is full, and a barrier empties it */
    assert_int_equal(table.count, 1);
    assert_false(add(1, 0, 1, COMPUTE, false));
}

static void to_host(void **state)
{
    (void)state;
    struct kd_vk_access a = { .buffer = 1, .end = 4, .stage = TRANSFER, .write = true, .host = true };
    assert_false(kd_vk_hazards_to_host(&table, &barrier));
    assert_false(kd_vk_hazards_add(&table, &a, 1, &barrier));
    assert_true(add(1, 0, 4, COMPUTE, false)); /* a barrier between kernels does not make writes visible to the host */
    assert_true(kd_vk_hazards_to_host(&table, &barrier));
    assert_int_equal(barrier.src_stages, TRANSFER);
    assert_int_equal(barrier.src_access, VK_ACCESS_TRANSFER_WRITE_BIT);
    assert_int_equal(barrier.dst_stages, VK_PIPELINE_STAGE_HOST_BIT);
    assert_int_equal(barrier.dst_access, VK_ACCESS_HOST_READ_BIT);
    assert_false(kd_vk_hazards_to_host(&table, &barrier));
    a.write = false;
    kd_vk_hazards_add(&table, &a, 1, &barrier);
    assert_false(kd_vk_hazards_to_host(&table, &barrier));
}

/* The definition: two conflicting commands have a barrier between them, and each barrier separates at least one
 * conflicting pair that no earlier barrier did. */
static void random_programs(void **state)
{
    enum { length = 60 };
    srand(2);
    for (int round = 0; round < 2000; round++) {
        struct kd_vk_access program[length];
        int epoch[length], epochs = 0; /* number of barriers before the command */
        reset(state);
        for (int i = 0; i < length; i++) {
            uint64_t begin = (uint64_t)rand() % 64;
            program[i] = (struct kd_vk_access) { .buffer = (uint64_t)rand() % 4,
                                                 .begin = begin,
                                                 .end = begin + 1 + (uint64_t)rand() % 16,
                                                 .stage = rand() % 2 ? COMPUTE : TRANSFER,
                                                 .write = rand() % 3 == 0 };
            bool conflicting = false;
            for (int j = 0; j < i; j++)
                conflicting |= epoch[j] == epochs && program[j].buffer == program[i].buffer &&
                               (program[j].write || program[i].write) && program[j].begin < program[i].end &&
                               program[i].begin < program[j].end;
            assert_int_equal(kd_vk_hazards_add(&table, &program[i], 1, &barrier), conflicting);
            epochs += conflicting;
            epoch[i] = epochs;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(pairs, reset),       cmocka_unit_test_setup(apart, reset),
        cmocka_unit_test_setup(one_command, reset), cmocka_unit_test_setup(emptied_by_a_barrier, reset),
        cmocka_unit_test_setup(overflow, reset),    cmocka_unit_test_setup(tiles_stay_one_entry, reset),
        cmocka_unit_test_setup(to_host, reset),     cmocka_unit_test_setup(random_programs, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
