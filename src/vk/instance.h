/* Creates a Vulkan instance with its function table and optionally the validation layer. */
#ifndef KD_VK_INSTANCE_H
#define KD_VK_INSTANCE_H

#include "vk/debug.h"
#include "vk/functions.h"

struct kd_vk_instance {
    struct kd_vk_functions fn;
    VkInstance handle;
    struct kd_vk_debug debug;
};

/* validate without an installed layer is KD_EDEVICE, because missing messages would be taken for success. The struct
 * must not move afterwards: the messenger points into it. */
enum kd_status kd_vk_instance_init(struct kd_vk_instance *instance, bool validate, struct kd_error *error);
void kd_vk_instance_finish(struct kd_vk_instance *instance);

#endif
