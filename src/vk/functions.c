#include "vk/functions.h"

#include "base/watch.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static pthread_mutex_t loader = PTHREAD_MUTEX_INITIALIZER;

void kd_vk_loader_lock(void)
{
    pthread_mutex_lock(&loader);
    kd_watch_slow_lock();
}

void kd_vk_loader_unlock(void) { pthread_mutex_unlock(&loader); }

void (*kd_vk_functions_hook)(struct kd_vk_functions *fn);

static void hook(struct kd_vk_functions *fn)
{
    if (kd_vk_functions_hook)
        kd_vk_functions_hook(fn);
}

static enum kd_status absent(struct kd_error *error, const char *name)
{
    return kd_error_set(error, KD_EDEVICE, "the Vulkan library has no %s", name);
}

/* Loads the functions that need no instance, by the library's entry point of this name. */
static enum kd_status load(struct kd_vk_functions *fn, void *library, const char *entry, struct kd_error *error)
{
    void *symbol = dlsym(library, entry);
    if (!symbol)
        return absent(error, entry);
    /* ISO C has no cast from an object pointer to a function pointer; in POSIX they have the same representation. */
    memcpy(&fn->GetInstanceProcAddr, &symbol, sizeof symbol);
    fn->EnumerateInstanceVersion =
        (PFN_vkEnumerateInstanceVersion)fn->GetInstanceProcAddr(NULL, "vkEnumerateInstanceVersion");
    uint32_t version = VK_API_VERSION_1_0; /* a loader that lacks the function has version 1.0 */
    if (fn->EnumerateInstanceVersion) {
        enum kd_status status =
            kd_vk_result_error(error, fn->EnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion");
        if (status)
            return status;
    }
    if (version < VK_API_VERSION_1_2)
        return kd_error_set(error, KD_EDEVICE, "the Vulkan loader has version %u.%u; kerrd needs 1.2",
                            VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
#define LOAD(name) \
    fn->name = (PFN_vk##name)fn->GetInstanceProcAddr(NULL, "vk" #name); \
    if (!fn->name) \
        return absent(error, "vk" #name);
    KD_VK_GLOBAL_FUNCTIONS(LOAD)
#undef LOAD
    hook(fn);
    return KD_OK;
}

enum kd_status kd_vk_functions_load(struct kd_vk_functions *fn, struct kd_error *error)
{
    void *library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return kd_error_set(error, KD_EDEVICE, "no Vulkan loader: %s; " KD_VK_INSTALL, dlerror());
    return load(fn, library, "vkGetInstanceProcAddr", error);
}

enum kd_status kd_vk_functions_load_own(struct kd_vk_functions *fn, const char *path, struct kd_error *error)
{
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return kd_error_set(error, KD_EDEVICE,
                            "the system has no device of Vulkan 1.2, and kerrd's own driver cannot be used: %s",
                            dlerror());
    return load(fn, library, "vk_icdGetInstanceProcAddr", error);
}

enum kd_status kd_vk_functions_instance(struct kd_vk_functions *fn, VkInstance instance, struct kd_error *error)
{
#define OPTIONAL(name) fn->name = (PFN_vk##name)fn->GetInstanceProcAddr(instance, "vk" #name);
#define LOAD(name) \
    OPTIONAL(name) \
    if (!fn->name) \
        return absent(error, "vk" #name);
    KD_VK_DEBUG_FUNCTIONS(OPTIONAL)
    KD_VK_INSTANCE_FUNCTIONS(LOAD)
#undef LOAD
#undef OPTIONAL
    hook(fn);
    return KD_OK;
}

enum kd_status kd_vk_functions_device(struct kd_vk_functions *fn, VkDevice device, struct kd_error *error)
{
#define LOAD(name) \
    fn->name = (PFN_vk##name)fn->GetDeviceProcAddr(device, "vk" #name); \
    if (!fn->name) \
        return absent(error, "vk" #name);
    KD_VK_DEVICE_FUNCTIONS(LOAD)
#undef LOAD
    hook(fn);
    return KD_OK;
}

const char *kd_vk_result_name(VkResult result)
{
    switch (result) {
#define NAME(r) \
    case r: return #r;
        NAME(VK_SUCCESS)
        NAME(VK_NOT_READY)
        NAME(VK_TIMEOUT)
        NAME(VK_INCOMPLETE)
        NAME(VK_ERROR_OUT_OF_HOST_MEMORY)
        NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY)
        NAME(VK_ERROR_INITIALIZATION_FAILED)
        NAME(VK_ERROR_DEVICE_LOST)
        NAME(VK_ERROR_MEMORY_MAP_FAILED)
        NAME(VK_ERROR_LAYER_NOT_PRESENT)
        NAME(VK_ERROR_EXTENSION_NOT_PRESENT)
        NAME(VK_ERROR_FEATURE_NOT_PRESENT)
        NAME(VK_ERROR_INCOMPATIBLE_DRIVER)
        NAME(VK_ERROR_TOO_MANY_OBJECTS)
        NAME(VK_ERROR_FRAGMENTED_POOL)
        NAME(VK_ERROR_OUT_OF_POOL_MEMORY)
        NAME(VK_ERROR_FRAGMENTATION)
        NAME(VK_ERROR_INVALID_SHADER_NV)
#undef NAME
    default: return "an unknown VkResult";
    }
}

enum kd_status kd_vk_result_error(struct kd_error *error, VkResult result, const char *call)
{
    if (result >= 0)
        return KD_OK;
    bool memory = result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return kd_error_set(error, memory ? KD_ENOMEM : KD_EDEVICE, "%s: %s (%d)", call, kd_vk_result_name(result),
                        (int)result);
}
