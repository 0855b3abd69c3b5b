/* The Vulkan types and flags of each kind of binding. Pure. */
#ifndef KD_VK_KIND_H
#define KD_VK_KIND_H

#include "vk/functions.h"
#include "vk/vk.h"

struct kd_vk_kind_info {
    VkDescriptorType descriptor;
    VkFormat format;      /* of its texels; every device reads these formats as uniform texels (Vulkan 1.2, table 61) */
    uint32_t texel_bytes; /* 0: it has none */
};

/* NULL: there is no such kind. */
const struct kd_vk_kind_info *kd_vk_kind_info(enum kd_vk_kind kind);

#endif
