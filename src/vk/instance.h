/* Creates a Vulkan instance with its function table and, if wanted, the validation layer. */
#ifndef KD_VK_INSTANCE_H
#define KD_VK_INSTANCE_H

#include "vk/debug.h"
#include "vk/functions.h"

struct kd_vk_instance {
    struct kd_vk_functions fn;
    VkInstance handle;
    struct kd_vk_debug debug;
    /* true if the driver installed with the program is used, because the system has no device of Vulkan 1.2 */
    bool own_driver;
};

/* Returns KD_EDEVICE if validate is true and no layer is installed. Otherwise the absence of messages would be taken
 * for success. After the call the struct must not move, because the messenger refers to it. */
enum kd_status kd_vk_instance_init(struct kd_vk_instance *instance, bool validate, struct kd_error *error);
/* Like kd_vk_instance_init, but without validation and with the system's drivers only. */
enum kd_status kd_vk_instance_init_system(struct kd_vk_instance *instance, struct kd_error *error);
/* True if the instance has a device of Vulkan 1.2. */
bool kd_vk_instance_has_device(const struct kd_vk_instance *instance);
void kd_vk_instance_finish(struct kd_vk_instance *instance);

#endif
