#include "vk/instance.h"

#include "base/cores.h"
#include "base/memory_limit.h"
#include "vk/own_driver.h"

#include <stdlib.h>
#include <string.h>

#define VALIDATION_LAYER "VK_LAYER_KHRONOS_validation"

#ifndef VK_EXT_layer_settings /* headers before 1.3.272, such as those of Debian 12 */
#define VK_EXT_LAYER_SETTINGS_EXTENSION_NAME "VK_EXT_layer_settings"
#define VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT ((VkStructureType)1000496000)
#define VK_LAYER_SETTING_TYPE_BOOL32_EXT 0
typedef struct {
    const char *pLayerName, *pSettingName;
    int type;
    uint32_t valueCount;
    const void *pValues;
} VkLayerSettingEXT;
typedef struct {
    VkStructureType sType;
    const void *pNext;
    uint32_t settingCount;
    const VkLayerSettingEXT *pSettings;
} VkLayerSettingsCreateInfoEXT;
#endif

static bool has_layer(const struct kd_vk_functions *fn, const char *name)
{
    uint32_t n = 0;
    bool found = false;
    if (fn->EnumerateInstanceLayerProperties(&n, NULL) < 0 || !n)
        return false;
    VkLayerProperties *list = calloc(n, sizeof *list);
    if (list && fn->EnumerateInstanceLayerProperties(&n, list) >= 0)
        for (uint32_t i = 0; i < n && !found; i++)
            found = !strcmp(list[i].layerName, name);
    free(list);
    return found;
}

/* True if a layer has an extension. If layer is NULL: true if the loader or a driver has it. */
static bool has_extension(const struct kd_vk_functions *fn, const char *layer, const char *name)
{
    uint32_t n = 0;
    bool found = false;
    if (fn->EnumerateInstanceExtensionProperties(layer, &n, NULL) < 0 || !n)
        return false;
    VkExtensionProperties *list = calloc(n, sizeof *list);
    if (list && fn->EnumerateInstanceExtensionProperties(layer, &n, list) >= 0)
        for (uint32_t i = 0; i < n && !found; i++)
            found = !strcmp(list[i].extensionName, name);
    free(list);
    return found;
}

static enum kd_status check_validation(const struct kd_vk_functions *fn, struct kd_error *error)
{
    if (!has_layer(fn, VALIDATION_LAYER))
        return kd_error_set(error, KD_EDEVICE, "validation was requested, but %s is not installed", VALIDATION_LAYER);
    if (!has_extension(fn, VALIDATION_LAYER, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME))
        return kd_error_set(error, KD_EDEVICE, "validation was requested, but this %s cannot validate synchronisation",
                            VALIDATION_LAYER);
    return KD_OK;
}

static enum kd_status create(struct kd_vk_instance *instance, const VkInstanceCreateInfo *info, struct kd_error *error)
{
    kd_vk_loader_lock();
    VkResult result = instance->fn.CreateInstance(info, NULL, &instance->handle);
    kd_vk_loader_unlock();
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return kd_error_set(error, KD_EDEVICE,
                            "no Vulkan device: no driver is installed, or none works here; " KD_VK_INSTALL);
    if (result < 0)
        return kd_vk_result_error(error, result, "vkCreateInstance");
    return kd_vk_functions_instance(&instance->fn, instance->handle, error);
}

/* Checks that there is enough address space, because a driver that runs out of it kills the process (lavapipe, LLVM).
 * Measured with lavapipe on two cores: pictures and volumes fail below 0.8 GiB and work with 1.2 GiB. Each further
 * thread reserves a stack of 8 MiB and a heap of 64 MiB. */
static enum kd_status check_address_space(struct kd_error *error)
{
    const uint64_t left = kd_address_space_left(), needed = (UINT64_C(1) << 30) + kd_cores() * (UINT64_C(72) << 20);
    if (left >= needed)
        return KD_OK;
    return kd_error_set(error, KD_ENOMEM,
                        "the limit of this process's memory (ulimit -v, ulimit -d) leaves %llu MiB; a Vulkan driver "
                        "needs %llu MiB here",
                        (unsigned long long)(left >> 20), (unsigned long long)(needed >> 20));
}

/* The functions that need no instance are loaded already. */
static enum kd_status make(struct kd_vk_instance *instance, bool validate, struct kd_error *error)
{
    struct kd_vk_functions *fn = &instance->fn;
    enum kd_status status;
    if (validate)
        KD_TRY(check_validation(fn, error));

    const char *extensions[4];
    uint32_t n = 0;
    bool debug_utils = validate && (has_extension(fn, NULL, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                                    has_extension(fn, VALIDATION_LAYER, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    bool portability = has_extension(fn, NULL, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (debug_utils)
        extensions[n++] = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    if (portability)
        extensions[n++] = VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME;
    if (validate)
        extensions[n++] = VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME;
    bool settings = validate && has_extension(fn, VALIDATION_LAYER, VK_EXT_LAYER_SETTINGS_EXTENSION_NAME);
    if (settings)
        extensions[n++] = VK_EXT_LAYER_SETTINGS_EXTENSION_NAME;

    const char *layer = VALIDATION_LAYER;
    const VkApplicationInfo application = { .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                            .pApplicationName = "kerrd",
                                            .apiVersion = VK_API_VERSION_1_2 };
    /* The messenger is chained here, so that it also receives messages of vkCreateInstance and vkDestroyInstance. */
    VkDebugUtilsMessengerCreateInfoEXT messenger = kd_vk_debug_messenger(&instance->debug);
    const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features = { .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                               .pNext = debug_utils ? &messenger : NULL,
                                               .enabledValidationFeatureCount = 1,
                                               .pEnabledValidationFeatures = &enable };
    /* By default newer layers (such as Debian 13's 1.4) exclude shader accesses from synchronisation validation. All
     * our hazards involve a shader. */
    const VkBool32 yes = VK_TRUE;
    const VkLayerSettingEXT heuristic = { VALIDATION_LAYER, "syncval_shader_accesses_heuristic",
                                          VK_LAYER_SETTING_TYPE_BOOL32_EXT, 1, &yes };
    const VkLayerSettingsCreateInfoEXT more = { .sType = VK_STRUCTURE_TYPE_LAYER_SETTINGS_CREATE_INFO_EXT,
                                                .pNext = &features,
                                                .settingCount = 1,
                                                .pSettings = &heuristic };
    const VkInstanceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = settings   ? (const void *)&more
                 : validate ? &features
                            : NULL,
        .flags = portability ? VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR : 0,
        .pApplicationInfo = &application,
        .enabledLayerCount = validate,
        .ppEnabledLayerNames = &layer,
        .enabledExtensionCount = n,
        .ppEnabledExtensionNames = extensions,
    };
    KD_TRY(create(instance, &info, error));
    if (validate)
        KD_TRY(kd_vk_debug_listen(&instance->debug, fn, instance->handle, error));
done:
    if (status)
        kd_vk_instance_finish(instance);
    return status;
}

bool kd_vk_instance_has_device(const struct kd_vk_instance *instance)
{
    VkPhysicalDevice handles[64];
    uint32_t n = 64; /* if there are more devices the result is VK_INCOMPLETE, which is a success code */
    if (instance->fn.EnumeratePhysicalDevices(instance->handle, &n, handles) < 0)
        return false;
    for (uint32_t i = 0; i < n; i++) {
        VkPhysicalDeviceProperties properties;
        instance->fn.GetPhysicalDeviceProperties(handles[i], &properties);
        if (properties.apiVersion >= VK_API_VERSION_1_2)
            return true;
    }
    return false;
}

static enum kd_status make_system(struct kd_vk_instance *instance, bool validate, struct kd_error *error)
{
    *instance = (struct kd_vk_instance) { 0 };
    const enum kd_status status = kd_vk_functions_load(&instance->fn, error);
    return status ? status : make(instance, validate, error);
}

enum kd_status kd_vk_instance_init_system(struct kd_vk_instance *instance, struct kd_error *error)
{
    return make_system(instance, false, error);
}

static enum kd_status make_own(struct kd_vk_instance *instance, const char *path, struct kd_error *error)
{
    *instance = (struct kd_vk_instance) { .own_driver = true };
    const enum kd_status status = kd_vk_functions_load_own(&instance->fn, path, error);
    return status ? status : make(instance, false, error);
}

enum kd_status kd_vk_instance_init(struct kd_vk_instance *instance, bool validate, struct kd_error *error)
{
    char path[KD_VK_PATH];
    *instance = (struct kd_vk_instance) { 0 };
    enum kd_status status = check_address_space(error);
    if (status)
        return status;
    const bool own = !validate && kd_vk_own_driver(path); /* the validation layer needs a loader */
    /* the system's drivers were tried before the program entered its driver's C library */
    if (own && kd_vk_own_entered())
        return make_own(instance, path, error);
    status = make_system(instance, validate, error);
    if (!own || (status && status != KD_EDEVICE) || (!status && kd_vk_instance_has_device(instance)))
        return status;
    kd_vk_instance_finish(instance);
    return make_own(instance, path, error);
}

void kd_vk_instance_finish(struct kd_vk_instance *instance)
{
    if (!instance->handle)
        return;
    kd_vk_debug_finish(&instance->debug, &instance->fn, instance->handle);
    kd_vk_loader_lock();
    if (instance->fn.DestroyInstance)
        instance->fn.DestroyInstance(instance->handle, NULL);
    kd_vk_loader_unlock();
    instance->handle = NULL;
}
