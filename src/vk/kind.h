/* The Vulkan types and flags for each kind of binding. Pure. */
#ifndef KD_VK_KIND_H
#define KD_VK_KIND_H

#include "vk/functions.h"
#include "vk/vk.h"

struct kd_vk_kind_info {
    VkDescriptorType descriptor;
    /* Format of texels. Every device supports these formats for uniform texel buffers (Vulkan 1.2, table 61). */
    VkFormat format;
    uint32_t texel_bytes; /* size of a texel in bytes; 0: the binding is not texels */
};

/* Returns the types and flags of a kind; NULL if the kind is unknown. */
const struct kd_vk_kind_info *kd_vk_kind_info(enum kd_vk_kind kind);

#endif
