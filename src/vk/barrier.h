/* Records pipeline barriers. No other file records any. */
#ifndef KD_VK_BARRIER_H
#define KD_VK_BARRIER_H

#include "vk/hazard.h"

/* Called before a command with these accesses is recorded. */
void kd_vk_barrier_before(const struct kd_vk_functions *fn, struct kd_vk_hazards *hazards, VkCommandBuffer commands,
                          const struct kd_vk_access *accesses, size_t n);
/* Called before a command buffer ends. */
void kd_vk_barrier_to_host(const struct kd_vk_functions *fn, struct kd_vk_hazards *hazards, VkCommandBuffer commands);

#endif
