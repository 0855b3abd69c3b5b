/* Table of Vulkan entry points, loaded at run time from libvulkan.so.1.
 *
 * All calls of this layer go through a struct kd_vk_functions, so that a test can replace a member to imitate a failing
 * driver. The library stays loaded until the process ends, because drivers leave threads and thread-local data that
 * outlive a dlclose. */
#ifndef KD_VK_FUNCTIONS_H
#define KD_VK_FUNCTIONS_H

#include "base/error.h"

#include <stdbool.h>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

/* End of the message about a missing loader or driver. apt and dnf know the package by this name. */
#define KD_VK_INSTALL "install mesa-vulkan-drivers, whose driver works on any machine"

#define KD_VK_GLOBAL_FUNCTIONS(X) \
    X(EnumerateInstanceVersion) \
    X(EnumerateInstanceLayerProperties) \
    X(EnumerateInstanceExtensionProperties) \
    X(CreateInstance)

#define KD_VK_INSTANCE_FUNCTIONS(X) \
    X(DestroyInstance) \
    X(EnumeratePhysicalDevices) \
    X(EnumerateDeviceExtensionProperties) \
    X(GetPhysicalDeviceProperties) \
    X(GetPhysicalDeviceProperties2) \
    X(GetPhysicalDeviceFeatures2) \
    X(GetPhysicalDeviceMemoryProperties) \
    X(GetPhysicalDeviceMemoryProperties2) \
    X(GetPhysicalDeviceQueueFamilyProperties) \
    X(CreateDevice) \
    X(GetDeviceProcAddr)

/* Entry points of VK_EXT_debug_utils; NULL if the extension is not enabled. */
#define KD_VK_DEBUG_FUNCTIONS(X) \
    X(CreateDebugUtilsMessengerEXT) \
    X(DestroyDebugUtilsMessengerEXT) \
    X(SetDebugUtilsObjectNameEXT)

#define KD_VK_DEVICE_FUNCTIONS(X) \
    X(DestroyDevice) \
    X(GetDeviceQueue) \
    X(DeviceWaitIdle) \
    X(AllocateMemory) \
    X(FreeMemory) \
    X(MapMemory) \
    X(FlushMappedMemoryRanges) \
    X(InvalidateMappedMemoryRanges) \
    X(CreateBuffer) \
    X(DestroyBuffer) \
    X(GetBufferMemoryRequirements) \
    X(BindBufferMemory) \
    X(CreateBufferView) \
    X(DestroyBufferView) \
    X(CreateShaderModule) \
    X(DestroyShaderModule) \
    X(CreateDescriptorSetLayout) \
    X(DestroyDescriptorSetLayout) \
    X(CreatePipelineLayout) \
    X(DestroyPipelineLayout) \
    X(CreateComputePipelines) \
    X(DestroyPipeline) \
    X(CreatePipelineCache) \
    X(DestroyPipelineCache) \
    X(GetPipelineCacheData) \
    X(CreateDescriptorPool) \
    X(DestroyDescriptorPool) \
    X(ResetDescriptorPool) \
    X(AllocateDescriptorSets) \
    X(UpdateDescriptorSets) \
    X(CreateCommandPool) \
    X(DestroyCommandPool) \
    X(ResetCommandPool) \
    X(AllocateCommandBuffers) \
    X(BeginCommandBuffer) \
    X(EndCommandBuffer) \
    X(CreateSemaphore) \
    X(DestroySemaphore) \
    X(GetSemaphoreCounterValue) \
    X(WaitSemaphores) \
    X(QueueSubmit) \
    X(CreateQueryPool) \
    X(DestroyQueryPool) \
    X(ResetQueryPool) \
    X(GetQueryPoolResults) \
    X(CmdResetQueryPool) \
    X(CmdWriteTimestamp) \
    X(CmdPipelineBarrier) \
    X(CmdBindPipeline) \
    X(CmdBindDescriptorSets) \
    X(CmdPushConstants) \
    X(CmdDispatch) \
    X(CmdDispatchIndirect) \
    X(CmdCopyBuffer) \
    X(CmdFillBuffer)

struct kd_vk_functions {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr;
#define KD_VK_MEMBER(name) PFN_vk##name name;
    KD_VK_GLOBAL_FUNCTIONS(KD_VK_MEMBER)
    KD_VK_INSTANCE_FUNCTIONS(KD_VK_MEMBER)
    KD_VK_DEBUG_FUNCTIONS(KD_VK_MEMBER)
    KD_VK_DEVICE_FUNCTIONS(KD_VK_MEMBER)
#undef KD_VK_MEMBER
};

/* The three steps of loading, in this order. With KD_EDEVICE the message names what is missing. */
enum kd_status kd_vk_functions_load(struct kd_vk_functions *fn, struct kd_error *error);
enum kd_status kd_vk_functions_instance(struct kd_vk_functions *fn, VkInstance instance, struct kd_error *error);
enum kd_status kd_vk_functions_device(struct kd_vk_functions *fn, VkDevice device, struct kd_error *error);

/* Like kd_vk_functions_load, but without a loader: all calls go to this driver (own_driver.h). */
enum kd_status kd_vk_functions_load_own(struct kd_vk_functions *fn, const char *path, struct kd_error *error);

/* Every thread holds this lock while it creates or destroys an instance or a device, loads its functions, or names an
 * object. Vulkan permits an application to make these calls at the same time on different devices. The loader does
 * not support that: it has one list of all devices of the process, and changes this list without a lock
 * (KhronosGroup/Vulkan-Loader issue 2018, up to 1.4.341 at least). */
void kd_vk_loader_lock(void);
void kd_vk_loader_unlock(void);

/* Hook for tests; otherwise NULL. It is called after each step of loading, and may replace members of the table
 * (tests/gpu/fake_device.h). */
extern void (*kd_vk_functions_hook)(struct kd_vk_functions *fn);

const char *kd_vk_result_name(VkResult result); /* such as "VK_ERROR_DEVICE_LOST"; never NULL */
/* Returns KD_OK for a success, KD_ENOMEM for the two out-of-memory results, KD_EDEVICE for all others. */
enum kd_status kd_vk_result_error(struct kd_error *error, VkResult result, const char *call);

/* Calls fn->name(...). On failure it fills the `error` in scope and jumps to `done`, like KD_TRY. */
#define KD_VK_TRY(fn, name, ...) KD_TRY(kd_vk_result_error(error, (fn)->name(__VA_ARGS__), "vk" #name))

#endif
