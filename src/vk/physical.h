/* Properties of a physical device, and whether kerrd can use it. */
#ifndef KD_VK_PHYSICAL_H
#define KD_VK_PHYSICAL_H

#include "vk/instance.h"
#include "vk/vk.h"

/* Defined in vulkan_beta.h, which needs a macro to be included. */
#define KD_VK_PORTABILITY_SUBSET "VK_KHR_portability_subset"

struct kd_vk_physical {
    VkPhysicalDevice handle;
    struct kd_vk_info info;
    VkPhysicalDeviceProperties properties;
    uint32_t family;         /* queue family for submissions */
    uint32_t timestamp_bits; /* number of valid bits of a timestamp; 0: there are no timestamps */
    bool int64, host_query_reset, subgroup_extended_types;
    bool portability_subset, memory_budget; /* true if the device lists the extension of this name */
};

/* Lists the physical devices of the instance; *out is malloc'd. Returns KD_EDEVICE if there is none. */
enum kd_status kd_vk_physical_list(const struct kd_vk_instance *instance, struct kd_vk_physical **out, size_t *count,
                                   struct kd_error *error);

#endif
