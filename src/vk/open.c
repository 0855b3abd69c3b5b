/* Opens a device and closes it. */
#include "base/log.h"
#include "vk/choose.h"
#include "vk/device.h"
#include "vk/submit.h"

#include <stdlib.h>
#include <string.h>

/* Devices that were hanging when they were destroyed. They are not freed, because a driver may crash if a device is
 * closed while it works; lavapipe does. The list keeps them reachable for leak checkers. */
static struct kd_vk *graveyard;

static enum kd_status choose(struct kd_vk *vk, const char *wish, struct kd_error *error)
{
    struct kd_vk_physical *list = NULL;
    size_t n = 0, index = 0;
    struct kd_vk_info *infos = NULL;
    enum kd_status status;
    KD_TRY(kd_vk_physical_list(&vk->instance, &list, &n, error));
    if (!(infos = calloc(n, sizeof *infos)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "no memory for a list of %zu devices", n));
    for (size_t i = 0; i < n; i++)
        infos[i] = list[i].info;
    KD_TRY(kd_vk_choose(infos, n, wish, &index, vk->choice, sizeof vk->choice, error));
    vk->core.physical = list[index];
done:
    free(infos);
    free(list);
    return status;
}

static enum kd_status create(struct kd_vk *vk, const VkDeviceCreateInfo *info, struct kd_error *error)
{
    kd_vk_loader_lock();
    enum kd_status status = kd_vk_result_error(
        error, vk->core.fn.CreateDevice(vk->core.physical.handle, info, NULL, &vk->core.device), "vkCreateDevice");
    if (!status)
        status = kd_vk_functions_device(&vk->core.fn, vk->core.device, error);
    kd_vk_loader_unlock();
    return status;
}

static void destroy(struct kd_vk *vk)
{
    kd_vk_loader_lock();
    vk->core.fn.DestroyDevice(vk->core.device, NULL);
    kd_vk_loader_unlock();
}

/* Enables the required features, and all optional features that exist. Users must check kd_vk_info before they rely on
 * an optional one. */
static enum kd_status open_device(struct kd_vk *vk, struct kd_error *error)
{
    enum kd_status status;
    const float priority = 1;
    const char *extensions[2];
    uint32_t n_extensions = 0;
    if (vk->core.physical.portability_subset)
        extensions[n_extensions++] = KD_VK_PORTABILITY_SUBSET;
    if (vk->core.physical.memory_budget)
        extensions[n_extensions++] = VK_EXT_MEMORY_BUDGET_EXTENSION_NAME;
    const VkDeviceQueueCreateInfo queue = { .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = vk->core.physical.family,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority };
    VkPhysicalDeviceVulkan12Features f12 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
        .timelineSemaphore = VK_TRUE,
        .uniformBufferStandardLayout = VK_TRUE,
        .hostQueryReset = vk->core.physical.host_query_reset,
        .shaderSubgroupExtendedTypes = vk->core.physical.subgroup_extended_types,
    };
    const VkPhysicalDeviceFeatures2 features = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
        .pNext = &f12,
        .features = { .shaderFloat64 = vk->core.physical.info.float64, .shaderInt64 = vk->core.physical.int64 },
    };
    const VkDeviceCreateInfo info = { .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                      .pNext = &features,
                                      .queueCreateInfoCount = 1,
                                      .pQueueCreateInfos = &queue,
                                      .enabledExtensionCount = n_extensions,
                                      .ppEnabledExtensionNames = extensions };
    KD_TRY(create(vk, &info, error));
    vk->core.fn.GetDeviceQueue(vk->core.device, vk->core.physical.family, 0, &vk->core.queue);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_QUEUE, KD_VK_HANDLE(vk->core.queue), "queue");
done:
    if (!status)
        return KD_OK;
    if (vk->core.device && vk->core.fn.DestroyDevice)
        destroy(vk);
    vk->core.device =
        VK_NULL_HANDLE; /* later code relies on this: if there is a device, all its functions are loaded */
    return status;
}

static bool validation_wanted(const struct kd_vk_params *params)
{
    const char *value = getenv("KERRD_VALIDATE");
    return params->validate || (value && value[0] && strcmp(value, "0"));
}

enum kd_status kd_vk_create(const struct kd_vk_params *params, struct kd_vk **out, struct kd_error *error)
{
    *out = NULL;
    struct kd_vk *vk = calloc(1, sizeof *vk);
    if (!vk)
        return kd_error_set(error, KD_ENOMEM, "no memory for a device");
    vk->core.compiles_only = params->compiles_only;
    vk->core.pipelines_only = params->pipelines_only;
    vk->deadline_ns = (params->deadline_ms ? params->deadline_ms : 60000) * UINT64_C(1000000);
    enum kd_status status;
    KD_TRY(kd_vk_instance_init(&vk->instance, validation_wanted(params), error));
    vk->core.fn = vk->instance.fn;
    KD_TRY(choose(vk, params->device, error));
    KD_TRY(open_device(vk, error));
    KD_TRY(kd_vk_cache_init(&vk->cache, &vk->core, params->cache_dir, error));
    if (!params->pipelines_only) {
        KD_TRY(kd_vk_heap_init(&vk->heap, &vk->core, error));
        KD_TRY(kd_vk_submit_init(vk, error));
    }
    *out = vk;
done:
    if (status)
        kd_vk_destroy(vk);
    return status;
}

/* number of attempts if memory runs out; several are made because a device that stays open leaks all its memory */
#define IDLE_TRIES 3

/* True if the objects may be destroyed. By the specification, objects of a lost device may be destroyed once
 * vkDeviceWaitIdle has returned. Objects of a hanging device may never be destroyed. */
static bool is_idle(struct kd_vk *vk)
{
    if (vk->core.pipelines_only)
        return true;
    const enum kd_status waited = kd_vk_wait(vk, 0, NULL); /* cannot hang, because the wait has a deadline */
    if (vk->core.hangs)
        return false;
    VkResult idle = vk->core.fn.DeviceWaitIdle(vk->core.device);
    for (int i = 1; i < IDLE_TRIES && (idle == VK_ERROR_OUT_OF_HOST_MEMORY || idle == VK_ERROR_OUT_OF_DEVICE_MEMORY);
         i++)
        idle = vk->core.fn.DeviceWaitIdle(vk->core.device);
    return !waited || idle >= 0 || idle == VK_ERROR_DEVICE_LOST;
}

static void close_device(struct kd_vk *vk)
{
    vk->done = vk->submitted;
    kd_vk_retired_free(&vk->retired, vk, UINT64_MAX);
    if (vk->n_buffers || vk->n_pipelines)
        kd_log(KD_LOG_WARN, "closing a device with %u buffers and %u pipelines that still exist", vk->n_buffers,
               vk->n_pipelines);
    if (!vk->core.pipelines_only)
        kd_vk_submit_finish(vk);
    kd_vk_cache_finish(&vk->cache, &vk->core);
    kd_vk_heap_finish(&vk->heap, &vk->core);
    destroy(vk);
}

void kd_vk_destroy(struct kd_vk *vk)
{
    if (!vk)
        return;
    if (vk->core.device && !is_idle(vk)) {
        vk->next_lost = graveyard;
        graveyard = vk;
        return;
    }
    if (vk->core.device)
        close_device(vk);
    kd_vk_instance_finish(&vk->instance);
    free(vk);
}
