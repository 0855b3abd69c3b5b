/* Descriptor sets of one submission: allocated one by one, and freed together when the slot is reused. */
#ifndef KD_VK_DESCRIPTORS_H
#define KD_VK_DESCRIPTORS_H

#include "vk/core.h"

#include <stddef.h>

#define KD_VK_SETS_PER_POOL 64

struct kd_vk_descriptors {
    VkDescriptorPool *pools; /* pools for the largest submission so far */
    size_t n_pools, used;    /* used: number of sets in all pools */
};

enum kd_status kd_vk_descriptors_take(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors,
                                      VkDescriptorSetLayout layout, VkDescriptorSet *out, struct kd_error *error);
void kd_vk_descriptors_reset(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors);
void kd_vk_descriptors_finish(const struct kd_vk_core *core, struct kd_vk_descriptors *descriptors);

#endif
