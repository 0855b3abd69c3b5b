#include "vk/barrier.h"

#include "vk/device.h"

static void emit(struct kd_vk *vk, VkCommandBuffer commands, const struct kd_vk_barrier *barrier)
{
    const VkMemoryBarrier memory = { .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = barrier->src_access,
                                     .dstAccessMask = barrier->dst_access };
    vk->fn.CmdPipelineBarrier(commands, barrier->src_stages, barrier->dst_stages, 0, 1, &memory, 0, NULL, 0, NULL);
}

void kd_vk_barrier_before(struct kd_vk *vk, VkCommandBuffer commands, const struct kd_vk_access *accesses, size_t n)
{
    struct kd_vk_barrier barrier;
    if (kd_vk_hazards_add(&vk->hazards, accesses, n, &barrier))
        emit(vk, commands, &barrier);
}

void kd_vk_barrier_to_host(struct kd_vk *vk, VkCommandBuffer commands)
{
    struct kd_vk_barrier barrier;
    if (kd_vk_hazards_to_host(&vk->hazards, &barrier))
        emit(vk, commands, &barrier);
}
