#include "vk/descriptors.h"

#include <stdlib.h>

/* Adds a pool. Each pool has room for KD_VK_SETS_PER_POOL sets of the largest size. So a pool is full when it has
 * that number of sets, whatever their size. */
static enum kd_status grow(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors, struct kd_error *error)
{
    enum kd_status status;
    VkDescriptorPool pool;
    VkDescriptorPool *pools = realloc(descriptors->pools, (descriptors->n_pools + 1) * sizeof *pools);
    if (!pools)
        return kd_error_set(error, KD_ENOMEM, "no memory for descriptor pools");
    descriptors->pools = pools;
    const uint32_t most = KD_VK_SETS_PER_POOL * KD_VK_MAX_BINDINGS;
    const VkDescriptorPoolSize sizes[] = { { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, most },
                                           { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, most },
                                           { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, most } };
    const VkDescriptorPoolCreateInfo info = { .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = KD_VK_SETS_PER_POOL,
                                              .poolSizeCount = sizeof sizes / sizeof *sizes,
                                              .pPoolSizes = sizes };
    KD_VK_TRY(&core->fn, CreateDescriptorPool, core->device, &info, NULL, &pool);
    kd_vk_name(core, VK_OBJECT_TYPE_DESCRIPTOR_POOL, KD_VK_HANDLE(pool), "descriptor pool %zu", descriptors->n_pools);
    pools[descriptors->n_pools++] = pool;
done:
    return status;
}

enum kd_status kd_vk_descriptors_take(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors,
                                      VkDescriptorSetLayout layout, VkDescriptorSet *out, struct kd_error *error)
{
    enum kd_status status;
    size_t pool = descriptors->used / KD_VK_SETS_PER_POOL;
    if (pool == descriptors->n_pools && (status = grow(core, descriptors, error)))
        return status;
    const VkDescriptorSetAllocateInfo info = { .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                               .descriptorPool = descriptors->pools[pool],
                                               .descriptorSetCount = 1,
                                               .pSetLayouts = &layout };
    KD_VK_TRY(&core->fn, AllocateDescriptorSets, core->device, &info, out);
    descriptors->used++;
done:
    return status;
}

void kd_vk_descriptors_reset(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors)
{
    for (size_t i = 0; i * KD_VK_SETS_PER_POOL < descriptors->used; i++)
        core->fn.ResetDescriptorPool(core->device, descriptors->pools[i], 0); /* cannot fail */
    descriptors->used = 0;
}

void kd_vk_descriptors_finish(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors)
{
    for (size_t i = 0; i < descriptors->n_pools; i++)
        core->fn.DestroyDescriptorPool(core->device, descriptors->pools[i], NULL);
    free(descriptors->pools);
    *descriptors = (struct kd_vk_descriptors) { 0 };
}
