#include "vk/debug.h"

#include "base/log.h"

static VKAPI_ATTR VkBool32 VKAPI_CALL heard(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                            VkDebugUtilsMessageTypeFlagsEXT types,
                                            const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
    struct kd_vk_debug *debug = user;
    bool failed = severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    (void)types;
    atomic_fetch_add(&debug->messages, 1);
    kd_log(failed ? KD_LOG_ERROR : KD_LOG_WARN, "vulkan: %s", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT kd_vk_debug_messenger(struct kd_vk_debug *debug)
{
    return (VkDebugUtilsMessengerCreateInfoEXT) {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = heard,
        .pUserData = debug,
    };
}

enum kd_status kd_vk_debug_listen(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance,
                                  struct kd_error *error)
{
    enum kd_status status;
    VkDebugUtilsMessengerCreateInfoEXT info = kd_vk_debug_messenger(debug);
    if (!fn->CreateDebugUtilsMessengerEXT || !fn->DestroyDebugUtilsMessengerEXT)
        return kd_error_set(error, KD_EDEVICE,
                            "validation was requested, but %s, which reports its messages, is missing",
                            VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    KD_VK_TRY(fn, CreateDebugUtilsMessengerEXT, instance, &info, NULL, &debug->messenger);
done:
    return status;
}

void kd_vk_debug_finish(struct kd_vk_debug *debug, const struct kd_vk_functions *fn, VkInstance instance)
{
    if (debug->messenger)
        fn->DestroyDebugUtilsMessengerEXT(instance, debug->messenger, NULL);
    debug->messenger = VK_NULL_HANDLE;
}
