/* Counts and logs the validation layer's messages, and names objects. */
#ifndef KD_VK_DEBUG_H
#define KD_VK_DEBUG_H

#include "vk/functions.h"

#include <stdatomic.h>
#include <stdint.h>

struct kd_vk;

struct kd_vk_debug {
    VkDebugUtilsMessengerEXT messenger;
    atomic_uint messages; /* number of warnings and errors; layers may report them from any thread */
};

VkDebugUtilsMessengerCreateInfoEXT kd_vk_debug_messenger(struct kd_vk_debug *debug);
/* Starts counting messages. Returns KD_EDEVICE without VK_EXT_debug_utils, because no message would be received. */
enum kd_status kd_vk_debug_listen(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance,
                                  struct kd_error *error);
void kd_vk_debug_finish(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance);

/* Names an object for messages and captures. Has no effect without validation. */
void kd_vk_debug_name(struct kd_vk *vk, VkObjectType type, uint64_t handle, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define KD_VK_HANDLE(handle) ((uint64_t)(handle))

#endif
