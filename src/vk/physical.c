#include "vk/physical.h"

#include "vk/instance.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

const char *kd_vk_type_name(enum kd_vk_type type)
{
    switch (type) {
    case KD_VK_OTHER: break;
    case KD_VK_CPU: return "CPU";
    case KD_VK_VIRTUAL: return "virtual GPU";
    case KD_VK_INTEGRATED: return "integrated GPU";
    case KD_VK_DISCRETE: return "discrete GPU";
    }
    return "other device";
}

static enum kd_vk_type type_of(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return KD_VK_CPU;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return KD_VK_VIRTUAL;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return KD_VK_INTEGRATED;
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return KD_VK_DISCRETE;
    default: return KD_VK_OTHER;
    }
}

static void lacks(struct kd_vk_info *info, const char *what)
{
    size_t used = strlen(info->missing);
    snprintf(info->missing + used, sizeof info->missing - used, "%s%s", used ? ", " : "", what);
}

/* Score of a queue family. The family must support compute. A family with timestamps is better. Among equals a family
 * without graphics is better, because there our work and the desktop's frames do not wait for each other. Among equal
 * families the first is used. */
static int family_points(const VkQueueFamilyProperties *family)
{
    if (!(family->queueFlags & VK_QUEUE_COMPUTE_BIT) || !family->queueCount)
        return 0;
    return 1 + 2 * (family->timestampValidBits > 0) + !(family->queueFlags & VK_QUEUE_GRAPHICS_BIT);
}

static void choose_family(const struct kd_vk_functions *fn, struct kd_vk_physical *device)
{
    VkQueueFamilyProperties families[32];
    uint32_t n = 32;
    int best = 0;
    fn->GetPhysicalDeviceQueueFamilyProperties(device->handle, &n, families);
    for (uint32_t i = 0; i < n; i++) {
        if (family_points(&families[i]) <= best)
            continue;
        best = family_points(&families[i]);
        device->family = i;
        device->timestamp_bits = families[i].timestampValidBits;
    }
    if (!best)
        lacks(&device->info, "a compute queue");
    if (device->properties.limits.timestampPeriod <= 0)
        device->timestamp_bits = 0;
    device->info.timestamps = device->timestamp_bits > 0;
}

static void read_limits(struct kd_vk_physical *device)
{
    const VkPhysicalDeviceLimits *limits = &device->properties.limits;
    struct kd_vk_info *info = &device->info;
    snprintf(info->name, sizeof info->name, "%s", device->properties.deviceName);
    info->type = type_of(device->properties.deviceType);
    info->api_version = device->properties.apiVersion;
    info->driver_version = device->properties.driverVersion;
    info->max_binding_bytes = limits->maxStorageBufferRange;
    info->max_uniform_bytes = limits->maxUniformBufferRange;
    info->max_texels = limits->maxTexelBufferElements;
    info->max_push_bytes = limits->maxPushConstantsSize;
    info->max_groups_x = limits->maxComputeWorkGroupCount[0];
    info->max_groups_y = limits->maxComputeWorkGroupCount[1];
    info->max_workgroup = limits->maxComputeWorkGroupInvocations;
    _Static_assert(KD_VK_MAX_STORAGE == 8, "as the next sentence says");
    if (limits->maxPerStageDescriptorStorageBuffers < KD_VK_MAX_STORAGE)
        lacks(info, "8 storage buffers a shader");
}

static void read_heaps(const struct kd_vk_functions *fn, struct kd_vk_physical *device)
{
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT
    };
    VkPhysicalDeviceMemoryProperties2 all = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
                                              .pNext = device->memory_budget ? &budget : NULL };
    const VkPhysicalDeviceMemoryProperties *memory = &all.memoryProperties;
    if (device->memory_budget)
        fn->GetPhysicalDeviceMemoryProperties2(device->handle, &all);
    else
        fn->GetPhysicalDeviceMemoryProperties(device->handle, &all.memoryProperties);
    for (uint32_t i = 0; i < memory->memoryHeapCount; i++)
        if ((memory->memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) &&
            memory->memoryHeaps[i].size > device->info.heap_bytes) {
            device->info.heap_bytes = memory->memoryHeaps[i].size;
            device->info.budget_bytes = budget.heapBudget[i];
        }
}

/* Reads the properties of a device of version 1.2; only such a device supports the structures used here. */
static void read_1_2(const struct kd_vk_functions *fn, struct kd_vk_physical *device)
{
    struct kd_vk_info *info = &device->info;
    VkPhysicalDeviceVulkan12Properties p12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES };
    VkPhysicalDeviceVulkan11Properties p11 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                               .pNext = &p12 };
    VkPhysicalDeviceProperties2 p = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &p11 };
    VkPhysicalDeviceVulkan12Features f12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES };
    VkPhysicalDeviceFeatures2 f = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &f12 };
    fn->GetPhysicalDeviceProperties2(device->handle, &p);
    fn->GetPhysicalDeviceFeatures2(device->handle, &f);
    snprintf(info->driver, sizeof info->driver, "%s", p12.driverName);
    snprintf(info->driver_info, sizeof info->driver_info, "%s", p12.driverInfo);
    info->max_allocation_bytes = p11.maxMemoryAllocationSize;
    info->subgroup_size = p11.subgroupSize;
    memcpy(info->uuid, p11.deviceUUID, sizeof info->uuid);
    info->float64 = f.features.shaderFloat64;
    device->int64 = f.features.shaderInt64;
    device->host_query_reset = f12.hostQueryReset;
    device->subgroup_extended_types = f12.shaderSubgroupExtendedTypes;
    if (!f12.timelineSemaphore)
        lacks(info, "timeline semaphores");
    if (!f12.uniformBufferStandardLayout) /* required by Vulkan 1.2, like the semaphores */
        lacks(info, "uniform buffers of standard layout");
}

/* Mesa's llvmpipe keeps all memory of a device in one anonymous file. It does not check whether the file can grow, so
 * beyond `ulimit -f` the first access is a SIGBUS. Mesa 25.0 does this and 22.3 does not. The versions between are
 * treated like 25.0. Only driver_info has Mesa's version, as in "Mesa 25.0.7-2 (LLVM 19.1.7)". */
static void read_file_limit(struct kd_vk_physical *device)
{
    struct rlimit limit;
    unsigned version;
    char text[192];
    if (strcmp(device->info.driver, "llvmpipe") || sscanf(device->info.driver_info, "Mesa %u.", &version) != 1 ||
        version < 23 || getrlimit(RLIMIT_FSIZE, &limit) < 0 || limit.rlim_cur == RLIM_INFINITY ||
        limit.rlim_cur >= device->info.heap_bytes)
        return;
    snprintf(text, sizeof text,
             "files as large as its memory (ulimit -f allows %ju bytes; it must be unlimited, or at least %ju)",
             (uintmax_t)limit.rlim_cur, (uintmax_t)device->info.heap_bytes);
    lacks(&device->info, text);
}

/* VK_KHR_portability_subset must be enabled if a device lists it. Layered drivers list it, such as those for Vulkan
 * on top of Metal. */
static void read_extensions(const struct kd_vk_functions *fn, struct kd_vk_physical *device)
{
    uint32_t n = 0;
    if (fn->EnumerateDeviceExtensionProperties(device->handle, NULL, &n, NULL) < 0 || !n)
        return;
    VkExtensionProperties *list = calloc(n, sizeof *list);
    if (list && fn->EnumerateDeviceExtensionProperties(device->handle, NULL, &n, list) >= 0)
        for (uint32_t i = 0; i < n; i++) {
            device->portability_subset |= !strcmp(list[i].extensionName, KD_VK_PORTABILITY_SUBSET);
            device->memory_budget |= !strcmp(list[i].extensionName, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
        }
    free(list);
}

static void inspect(const struct kd_vk_functions *fn, uint32_t index, struct kd_vk_physical *device)
{
    char text[64];
    device->info.index = index;
    fn->GetPhysicalDeviceProperties(device->handle, &device->properties);
    uint32_t version = device->properties.apiVersion;
    if (version < VK_API_VERSION_1_2) {
        snprintf(text, sizeof text, "Vulkan 1.2 (it has %u.%u)", VK_API_VERSION_MAJOR(version),
                 VK_API_VERSION_MINOR(version));
        lacks(&device->info, text);
    }
    read_limits(device);
    read_extensions(fn, device);
    read_heaps(fn, device);
    choose_family(fn, device);
    if (version >= VK_API_VERSION_1_2)
        read_1_2(fn, device);
    read_file_limit(device);
}

enum kd_status kd_vk_physical_list(const struct kd_vk_instance *instance, struct kd_vk_physical **out, size_t *count,
                                   struct kd_error *error)
{
    const struct kd_vk_functions *fn = &instance->fn;
    enum kd_status status;
    VkPhysicalDevice handles[64];
    uint32_t n = 64; /* if there are more devices the result is VK_INCOMPLETE, which is a success code */
    struct kd_vk_physical *list;

    KD_VK_TRY(fn, EnumeratePhysicalDevices, instance->handle, &n, handles);
    if (!n)
        return kd_error_set(error, KD_EDEVICE,
                            "no Vulkan device: the loader found no driver that works; " KD_VK_INSTALL);
    list = calloc(n, sizeof *list);
    if (!list)
        return kd_error_set(error, KD_ENOMEM, "no memory for a list of %u devices", n);
    for (uint32_t i = 0; i < n; i++) {
        list[i].handle = handles[i];
        inspect(fn, i, &list[i]);
        list[i].info.own_driver = instance->own_driver;
    }
    *out = list;
    *count = n;
done:
    return status;
}

enum kd_status kd_vk_list(struct kd_vk_info **out, size_t *count, struct kd_error *error)
{
    struct kd_vk_instance instance = { 0 };
    struct kd_vk_physical *list = NULL;
    size_t n = 0;
    *out = NULL;
    *count = 0;
    enum kd_status status;
    KD_TRY(kd_vk_instance_init(&instance, false, error));
    KD_TRY(kd_vk_physical_list(&instance, &list, &n, error));
    if (!(*out = calloc(n, sizeof **out)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "no memory for a list of %zu devices", n));
    for (size_t i = 0; i < n; i++)
        (*out)[i] = list[i].info;
    *count = n;
done:
    free(list);
    kd_vk_instance_finish(&instance);
    return status;
}
