/* Counts and logs the validation layer's messages. */
#ifndef KD_VK_DEBUG_H
#define KD_VK_DEBUG_H

#include "vk/functions.h"

#include <stdatomic.h>

struct kd_vk_debug {
    VkDebugUtilsMessengerEXT messenger;
    atomic_uint messages; /* number of warnings and errors; layers may report them from any thread */
};

VkDebugUtilsMessengerCreateInfoEXT kd_vk_debug_messenger(struct kd_vk_debug *debug);
/* Starts counting messages. Returns KD_EDEVICE without VK_EXT_debug_utils, because no message would be received. */
enum kd_status kd_vk_debug_listen(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance,
                                  struct kd_error *error);
void kd_vk_debug_finish(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance);

#endif
