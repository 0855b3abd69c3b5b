/* Names of the types of devices. */
#include "render/device/renderer.h"
#include "vk/vk.h"

const char *kd_renderer_type_name(size_t i) { return i <= KD_VK_DISCRETE ? kd_vk_type_name((enum kd_vk_type)i) : NULL; }
