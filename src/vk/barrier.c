#include "vk/barrier.h"

static void emit(const struct kd_vk_functions *fn, VkCommandBuffer commands, const struct kd_vk_barrier *barrier)
{
    const VkMemoryBarrier memory = { .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = barrier->src_access,
                                     .dstAccessMask = barrier->dst_access };
    fn->CmdPipelineBarrier(commands, barrier->src_stages, barrier->dst_stages, 0, 1, &memory, 0, NULL, 0, NULL);
}

void kd_vk_barrier_before(const struct kd_vk_functions *fn, struct kd_vk_hazards *hazards, VkCommandBuffer commands,
                          const struct kd_vk_access *accesses, size_t n)
{
    struct kd_vk_barrier barrier;
    if (kd_vk_hazards_add(hazards, accesses, n, &barrier))
        emit(fn, commands, &barrier);
}

void kd_vk_barrier_to_host(const struct kd_vk_functions *fn, struct kd_vk_hazards *hazards, VkCommandBuffer commands)
{
    struct kd_vk_barrier barrier;
    if (kd_vk_hazards_to_host(hazards, &barrier))
        emit(fn, commands, &barrier);
}
