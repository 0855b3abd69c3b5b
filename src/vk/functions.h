/* The one table of Vulkan entry points is filled at run time from libvulkan.so.1.
 *
 * Every call of this layer goes through a struct kd_vk_functions, so a test can replace a member and
 * see what a failing or lying driver does. The library stays loaded for the life of the process:
 * drivers leave threads and thread-local data behind that outlive a dlclose. */
#ifndef KD_VK_FUNCTIONS_H
#define KD_VK_FUNCTIONS_H

#include "base/error.h"

#include <stdbool.h>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

/* The end of an error where a loader or a driver is missing. apt and dnf know the package by this name. */
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

/* These belong to VK_EXT_debug_utils and are NULL where the extension is not enabled. */
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

/* Three steps, each needing what the one before made possible. KD_EDEVICE names what is absent. */
enum kd_status kd_vk_functions_load(struct kd_vk_functions *fn, struct kd_error *error);
enum kd_status kd_vk_functions_instance(struct kd_vk_functions *fn, VkInstance instance, struct kd_error *error);
enum kd_status kd_vk_functions_device(struct kd_vk_functions *fn, VkDevice device, struct kd_error *error);

/* For tests alone: called after each step, to replace members (tests/gpu/fake_device.h). NULL otherwise. */
extern void (*kd_vk_functions_hook)(struct kd_vk_functions *fn);

const char *kd_vk_result_name(VkResult result); /* "VK_ERROR_DEVICE_LOST", ... never NULL */
/* KD_OK for a success, KD_ENOMEM for the two out-of-memory results, KD_EDEVICE for any other. */
enum kd_status kd_vk_result_error(struct kd_error *error, VkResult result, const char *call);

/* A step of Vulkan: calls fn->name(...), fills the `error` in scope, and is a KD_TRY. */
#define KD_VK_TRY(fn, name, ...) KD_TRY(kd_vk_result_error(error, (fn)->name(__VA_ARGS__), "vk" #name))

#endif
