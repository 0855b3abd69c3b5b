/* Tests of the choice of a device on simulated machines, and of a memory type on simulated heaps. */
#include "support.h"

#include "vk/choose.h"

static const struct kd_vk_info machine[] = {
    { .index = 0, .name = "llvmpipe (LLVM 15.0.6)", .type = KD_VK_CPU },
    { .index = 1, .name = "Ancient GPU", .type = KD_VK_DISCRETE, .missing = "Vulkan 1.2 (it has 1.1)" },
    { .index = 2, .name = "Integrated Thing", .type = KD_VK_INTEGRATED },
    { .index = 3, .name = "GeForce A", .type = KD_VK_DISCRETE },
    { .index = 4, .name = "GeForce B", .type = KD_VK_DISCRETE },
};

static enum kd_status choose(size_t n, const char *wanted, size_t *index, char why[640], struct kd_error *error)
{
    return kd_vk_choose(machine, n, wanted, index, why, 640, error);
}

static void chosen(void **state)
{
    static const struct {
        size_t n;
        const char *wanted;
        size_t index;
        const char *why;
    } cases[] = {
        { 5, "auto", 3, "discrete GPU among 4 usable" },
        { 5, NULL, 3, "discrete" },
        { 3, "auto", 2, "integrated GPU among 2" },
        { 2, "", 0, "the only usable device" },
        { 5, "0", 0, "by its index" },
        { 5, "4", 4, "by its index" },
        { 5, "geforce b", 4, "'geforce b'" },
        { 5, "GEFORCE", 3, "best of those" },
        { 5, "llvm", 0, "its name contains 'llvm'" },
        { 5, "thing", 2, "thing" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t index = 99;
        char why[640] = "";
        OK(choose(cases[i].n, cases[i].wanted, &index, why, &error));
        assert_int_equal(index, cases[i].index);
        assert_non_null(strstr(why, cases[i].why));
        assert_non_null(strstr(why, machine[index].name));
    }
}

/* SwiftShader, which is part of Chromium, and lavapipe are both drivers for the CPU. */
static void among_equals(void **state)
{
    static const struct kd_vk_info equals[] = {
        { .index = 0, .name = "four lanes", .type = KD_VK_CPU, .subgroup_size = 4 },
        { .index = 1, .name = "many lanes", .type = KD_VK_CPU, .subgroup_size = 64 },
        { .index = 2, .name = "f64, four lanes", .type = KD_VK_CPU, .float64 = true, .subgroup_size = 4 },
        { .index = 3, .name = "f64, eight lanes", .type = KD_VK_CPU, .float64 = true, .subgroup_size = 8 },
        { .index = 4, .name = "f64, eight again", .type = KD_VK_CPU, .float64 = true, .subgroup_size = 8 },
        { .index = 5,
          .name = "f64, broken",
          .type = KD_VK_CPU,
          .float64 = true,
          .subgroup_size = 16,
          .missing = "all" },
        { .index = 6, .name = "a GPU without", .type = KD_VK_INTEGRATED, .subgroup_size = 1 },
    };
    static const struct {
        size_t n;
        const char *wanted;
        size_t index;
    } cases[] = { { 1, "auto", 0 }, { 2, "auto", 1 }, { 3, "auto", 2 },
                  { 6, "auto", 3 }, { 7, "auto", 6 }, { 7, "lanes", 3 } };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t index = 99;
        char why[640];
        OK(kd_vk_choose(equals, cases[i].n, cases[i].wanted, &index, why, sizeof why, &error));
        assert_int_equal(index, cases[i].index);
    }
}

static void refused(void **state)
{
    size_t index;
    char why[640];
    (void)state;
    FAILS(KD_EINVAL, "there is no device 5; there are 0: llvmpipe", choose(5, "5", &index, why, &error));
    FAILS(KD_EINVAL, "there is no device 99999999999999999999", choose(5, "99999999999999999999", &index, why, &error));
    FAILS(KD_EINVAL, "1: Ancient GPU (unusable)", choose(5, "radeon", &index, why, &error));
    FAILS(KD_EDEVICE, "device 1 (Ancient GPU) lacks Vulkan 1.2", choose(5, "1", &index, why, &error));
    FAILS(KD_EDEVICE, "lacks Vulkan 1.2", choose(5, "gpu", &index, why, &error));
    FAILS(KD_EDEVICE, "no Vulkan device", choose(0, "auto", &index, why, &error));
}

#define L VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
#define V VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT
#define C VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
#define K VK_MEMORY_PROPERTY_HOST_CACHED_BIT

static void memory_types(void **state)
{
    static const struct {
        const char *what;
        VkMemoryPropertyFlags flags[8];
        bool near;
        int want[3];
    } cases[] = {
        { "discrete", { 0, L, V | C, V | C | K, L | V | C }, false, { 1, 2, 3 } },
        { "with uncached types first",
          { L | V | C | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD, L, L | V | C, V | C, V | C | K },
          false,
          { 1, 3, 4 } },
        { "integrated", { L, L | V | C, L | V | C | K }, true, { 1, 1, 2 } },
        { "CPU", { L | V | C | K }, true, { 0, 0, 0 } },
        { "cached but not coherent",
          { L, V | K, V | C },
          false,
          { 0, 2, 1 } }, /* for reading back, cached memory is preferred, although the host must invalidate it */
        { "nothing coherent", { L, V, V | K, L | V }, false, { 0, 1, 2 } },
        { "not local", { V | C }, false, { -1, 0, 0 } },
        { "not visible", { L }, false, { 0, -1, -1 } },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        VkPhysicalDeviceMemoryProperties properties = { .memoryTypeCount = 8 };
        for (int t = 0; t < 8; t++)
            properties.memoryTypes[t].propertyFlags = cases[i].flags[t];
        for (int m = 0; m < 3; m++) {
            int got = kd_vk_memory_type(&properties, 0xff, (enum kd_vk_memory)m, cases[i].near);
            if (got != cases[i].want[m])
                fail_msg("%s, purpose %d: type %d instead of %d", cases[i].what, m, got, cases[i].want[m]);
        }
        assert_int_equal(kd_vk_memory_type(&properties, 0, KD_VK_DEVICE, false), -1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(chosen), cmocka_unit_test(among_equals),
                                        cmocka_unit_test(refused), cmocka_unit_test(memory_types) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
