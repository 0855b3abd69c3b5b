#include "vk/core.h"

#include "base/log.h"

#include <stdarg.h>
#include <stdio.h>

enum kd_status kd_vk_alive(const struct kd_vk_core *core, struct kd_error *error)
{
    return core->lost[0] ? kd_error_set(error, KD_EDEVICE, "the device is lost: %s", core->lost) : KD_OK;
}

enum kd_status kd_vk_lose(struct kd_vk_core *core, struct kd_error *error, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(core->lost, sizeof core->lost, format, args);
    va_end(args);
    kd_log(KD_LOG_ERROR, "device lost: %s", core->lost);
    return kd_vk_alive(core, error);
}

void kd_vk_name(const struct kd_vk_core *core, VkObjectType type, uint64_t handle, const char *format, ...)
{
    char name[128];
    va_list args;
    if (!core->fn.SetDebugUtilsObjectNameEXT || !handle)
        return;
    va_start(args, format);
    vsnprintf(name, sizeof name, format, args);
    va_end(args);
    const VkDebugUtilsObjectNameInfoEXT info = { .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                                 .objectType = type,
                                                 .objectHandle = handle,
                                                 .pObjectName = name };
    kd_vk_loader_lock();
    core->fn.SetDebugUtilsObjectNameEXT(core->device, &info); /* failure is ignored: a missing name does no harm */
    kd_vk_loader_unlock();
}
