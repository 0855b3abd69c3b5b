/* Linked into a kerrd under test (vulkan.py) instead of the table of Vulkan entry points. Calls through this table fail
 * as requested in a file named by KD_VULKAN_FAULTS, which the test maps too. Without this file no call fails. */
#include "vk/functions.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

/* Entry points that can fail. By the specification, vkResetDescriptorPool cannot fail. */
#define CREATES(X, object) CREATES_AS(X, object, object##CreateInfo)
#define CREATES_AS(X, object, info) \
    X(Create##object, (VkDevice a, const Vk##info *b, const VkAllocationCallbacks *c, Vk##object *d), (a, b, c, d))
#define RANGES(X, name) X(name, (VkDevice a, uint32_t b, const VkMappedMemoryRange *c), (a, b, c))
#define ENTRIES(X) \
    X(EnumerateInstanceVersion, (uint32_t *a), (a)) \
    X(EnumerateInstanceLayerProperties, (uint32_t *a, VkLayerProperties *b), (a, b)) \
    X(EnumerateInstanceExtensionProperties, (const char *a, uint32_t *b, VkExtensionProperties *c), (a, b, c)) \
    X(CreateInstance, (const VkInstanceCreateInfo *a, const VkAllocationCallbacks *b, VkInstance *c), (a, b, c)) \
    X(EnumeratePhysicalDevices, (VkInstance a, uint32_t *b, VkPhysicalDevice *c), (a, b, c)) \
    X(EnumerateDeviceExtensionProperties, (VkPhysicalDevice a, const char *b, uint32_t *c, VkExtensionProperties *d), \
      (a, b, c, d)) \
    X(CreateDevice, (VkPhysicalDevice a, const VkDeviceCreateInfo *b, const VkAllocationCallbacks *c, VkDevice *d), \
      (a, b, c, d)) \
    X(SetDebugUtilsObjectNameEXT, (VkDevice a, const VkDebugUtilsObjectNameInfoEXT *b), (a, b)) \
    X(DeviceWaitIdle, (VkDevice a), (a)) \
    X(AllocateMemory, (VkDevice a, const VkMemoryAllocateInfo *b, const VkAllocationCallbacks *c, VkDeviceMemory *d), \
      (a, b, c, d)) \
    X(MapMemory, (VkDevice a, VkDeviceMemory b, VkDeviceSize c, VkDeviceSize d, VkMemoryMapFlags e, void **f), \
      (a, b, c, d, e, f)) \
    RANGES(X, FlushMappedMemoryRanges) \
    RANGES(X, InvalidateMappedMemoryRanges) \
    CREATES(X, Buffer) \
    X(BindBufferMemory, (VkDevice a, VkBuffer b, VkDeviceMemory c, VkDeviceSize d), (a, b, c, d)) \
    CREATES(X, BufferView) \
    CREATES(X, ShaderModule) \
    CREATES(X, DescriptorSetLayout) \
    CREATES(X, PipelineLayout) \
    X(CreateComputePipelines, \
      (VkDevice a, VkPipelineCache b, uint32_t c, const VkComputePipelineCreateInfo *d, \
       const VkAllocationCallbacks *e, VkPipeline *f), \
      (a, b, c, d, e, f)) \
    CREATES(X, PipelineCache) \
    X(GetPipelineCacheData, (VkDevice a, VkPipelineCache b, size_t *c, void *d), (a, b, c, d)) \
    CREATES(X, DescriptorPool) \
    X(AllocateDescriptorSets, (VkDevice a, const VkDescriptorSetAllocateInfo *b, VkDescriptorSet *c), (a, b, c)) \
    CREATES(X, CommandPool) \
    X(ResetCommandPool, (VkDevice a, VkCommandPool b, VkCommandPoolResetFlags c), (a, b, c)) \
    X(AllocateCommandBuffers, (VkDevice a, const VkCommandBufferAllocateInfo *b, VkCommandBuffer *c), (a, b, c)) \
    X(BeginCommandBuffer, (VkCommandBuffer a, const VkCommandBufferBeginInfo *b), (a, b)) \
    X(EndCommandBuffer, (VkCommandBuffer a), (a)) \
    CREATES(X, Semaphore) \
    X(GetSemaphoreCounterValue, (VkDevice a, VkSemaphore b, uint64_t *c), (a, b, c)) \
    X(WaitSemaphores, (VkDevice a, const VkSemaphoreWaitInfo *b, uint64_t c), (a, b, c)) \
    X(QueueSubmit, (VkQueue a, uint32_t b, const VkSubmitInfo *c, VkFence d), (a, b, c, d)) \
    CREATES(X, QueryPool) \
    X(GetQueryPoolResults, \
      (VkDevice a, VkQueryPool b, uint32_t c, uint32_t d, size_t e, void *f, VkDeviceSize g, VkQueryResultFlags h), \
      (a, b, c, d, e, f, g, h))

/* Entry points that destroy objects created by the entry points above: name, parameters, arguments, the object, the
 * creating entry point. */
#define DESTROYS(X, object) \
    X(Destroy##object, (VkDevice a, Vk##object b, const VkAllocationCallbacks *c), (a, b, c), b, Create##object)
#define ENDS(X) \
    X(DestroyInstance, (VkInstance a, const VkAllocationCallbacks *b), (a, b), a, CreateInstance) \
    X(DestroyDevice, (VkDevice a, const VkAllocationCallbacks *b), (a, b), a, CreateDevice) \
    X(FreeMemory, (VkDevice a, VkDeviceMemory b, const VkAllocationCallbacks *c), (a, b, c), b, AllocateMemory) \
    X(DestroyPipeline, (VkDevice a, VkPipeline b, const VkAllocationCallbacks *c), (a, b, c), b, \
      CreateComputePipelines) \
    DESTROYS(X, Buffer) \
    DESTROYS(X, BufferView) \
    DESTROYS(X, ShaderModule) \
    DESTROYS(X, DescriptorSetLayout) \
    DESTROYS(X, PipelineLayout) \
    DESTROYS(X, PipelineCache) \
    DESTROYS(X, DescriptorPool) \
    DESTROYS(X, CommandPool) \
    DESTROYS(X, Semaphore) \
    DESTROYS(X, QueryPool)

#define NAME(name, parameters, arguments) AT_##name,
enum { ENTRIES(NAME) N_ENTRIES };
#undef NAME

/* Memory shared with vulkan.py: 64-bit words. */
struct control {
    /* When the countdown reaches 0, the call of this entry point returns the code and is not passed to the driver.
     * Negative: no call fails. */
    _Atomic int64_t entry, countdown, code;
    _Atomic int64_t injected; /* number of failures injected so far */
    /* 1: the device is lost; each call that can report this does so, until another device is created */
    _Atomic int64_t lost;
    _Atomic int64_t dead;       /* 1: no device can be created after the next loss of the device */
    _Atomic int64_t hang;       /* 1: submissions never complete; 2: the next submission does not return */
    _Atomic int64_t incoherent; /* 1, set at the start: memory is not coherent, so that the host must flush it */
    _Atomic int64_t calls[N_ENTRIES];
    /* Number of objects created and not yet destroyed. For an entry point that creates none: number of successful
     * calls. */
    _Atomic int64_t objects[N_ENTRIES];
};
static struct control unused = { .entry = -1 }, *control = &unused;

/* The driver's functions, which are the same for all open devices. With the last of these devices the loader unloads
 * the driver. Later it may load the driver at another address. */
#define REAL(name, parameters, arguments) static _Atomic(PFN_vk##name) real_##name;
ENTRIES(REAL)
#define REAL_END(name, parameters, arguments, object, maker) static _Atomic(PFN_vk##name) real_##name;
ENDS(REAL_END)
#undef REAL_END
#undef REAL
static _Atomic(PFN_vkGetPhysicalDeviceMemoryProperties) real_GetPhysicalDeviceMemoryProperties;

static void __attribute__((noreturn)) wait_for_ever(void)
{
    for (;;)
        nanosleep(&(struct timespec) { .tv_sec = 1 }, NULL);
}

/* Waits with a busy loop. The caller would extend its time limit if the thread used hardly any processor time. */
static VkResult hanging_wait(uint64_t timeout)
{
    struct timespec begun, now;
    clock_gettime(CLOCK_MONOTONIC, &begun);
    do
        clock_gettime(CLOCK_MONOTONIC, &now);
    while ((double)(now.tv_sec - begun.tv_sec) * 1e9 + (double)(now.tv_nsec - begun.tv_nsec) < (double)timeout);
    return VK_TIMEOUT;
}

static bool tells_of_loss(int entry)
{
    return entry == AT_DeviceWaitIdle || entry == AT_GetSemaphoreCounterValue || entry == AT_WaitSemaphores ||
           entry == AT_QueueSubmit || entry == AT_GetQueryPoolResults;
}

/* The code to return instead of calling the driver. VK_SUCCESS means that the driver is called. */
static VkResult fault(int entry)
{
    atomic_fetch_add(&control->calls[entry], 1);
    if (atomic_load(&control->entry) == entry && atomic_load(&control->countdown) >= 0 &&
        atomic_fetch_sub(&control->countdown, 1) == 0) {
        const VkResult code = (VkResult)atomic_load(&control->code);
        atomic_fetch_add(&control->injected, 1);
        if (code == VK_ERROR_DEVICE_LOST)
            atomic_store(&control->lost, 1);
        return code;
    }
    if (entry == AT_CreateDevice) {
        if (atomic_load(&control->lost) && atomic_load(&control->dead))
            return VK_ERROR_INITIALIZATION_FAILED;
        atomic_store(&control->lost, 0);
    }
    return atomic_load(&control->lost) && tells_of_loss(entry) ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

static VkResult before(int entry)
{
    const VkResult result = fault(entry);
    if (entry == AT_QueueSubmit && atomic_load(&control->hang) == 2)
        wait_for_ever();
    return result;
}

static bool hangs(void) { return atomic_load(&control->hang) == 1; }

#define DEFINE(name, parameters, arguments) \
    static VKAPI_ATTR VkResult VKAPI_CALL faulty_##name parameters \
    { \
        const VkResult result = before(AT_##name); \
        if (AT_##name == AT_DeviceWaitIdle) { /* waits for a lost device too */ \
            const VkResult real = atomic_load(&real_##name) arguments; \
            return result ? result : real; \
        } \
        const VkResult made = result ? result : atomic_load(&real_##name) arguments; \
        if (!made) \
            atomic_fetch_add(&control->objects[AT_##name], 1); /* pipelines are created one by one */ \
        return made; \
    }
ENTRIES(DEFINE)
#undef DEFINE

#define DEFINE_END(name, parameters, arguments, object, maker) \
    static VKAPI_ATTR void VKAPI_CALL counting_##name parameters \
    { \
        if (object) \
            atomic_fetch_sub(&control->objects[AT_##maker], 1); \
        atomic_load(&real_##name) arguments; \
    }
ENDS(DEFINE_END)
#undef DEFINE_END

static VKAPI_ATTR VkResult VKAPI_CALL hanging_WaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo *info,
                                                             uint64_t timeout)
{
    return hangs() ? hanging_wait(timeout) : faulty_WaitSemaphores(device, info, timeout);
}

static VKAPI_ATTR VkResult VKAPI_CALL hanging_GetSemaphoreCounterValue(VkDevice device, VkSemaphore semaphore,
                                                                       uint64_t *value)
{
    if (!hangs())
        return faulty_GetSemaphoreCounterValue(device, semaphore, value);
    *value = 0;
    return VK_SUCCESS;
}

static VKAPI_ATTR void VKAPI_CALL incoherent_GetPhysicalDeviceMemoryProperties(VkPhysicalDevice device,
                                                                               VkPhysicalDeviceMemoryProperties *out)
{
    atomic_load (&real_GetPhysicalDeviceMemoryProperties)(device, out);
    for (uint32_t i = 0; i < out->memoryTypeCount; i++)
        out->memoryTypes[i].propertyFlags &= ~(VkMemoryPropertyFlags)VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

/* Under a sanitizer the driver stays loaded after its last device is closed. Leaks are detected at exit, and the
 * driver's leaks are recognised by the driver's name. */
static void keep_driver(const struct kd_vk_functions *fn)
{
#ifdef __SANITIZE_ADDRESS__
    Dl_info from;
    void *entry = NULL;
    memcpy(&entry, &fn->CreateBuffer, sizeof entry);
    if (entry && dladdr(entry, &from) && from.dli_fname)
        dlopen(from.dli_fname, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
#else
    (void)fn;
#endif
}

/* Called after each of the three steps that load functions. A member that already has a function of this file was
 * copied from an earlier table. */
static void plant(struct kd_vk_functions *fn)
{
#define PLANT(name, parameters, arguments) \
    if (fn->name && fn->name != faulty_##name) \
        atomic_store(&real_##name, fn->name); \
    if (fn->name) \
        fn->name = faulty_##name;
    if (fn->CreateBuffer != faulty_CreateBuffer)
        keep_driver(fn);
    if (fn->WaitSemaphores == hanging_WaitSemaphores) {
        fn->WaitSemaphores = faulty_WaitSemaphores;
        fn->GetSemaphoreCounterValue = faulty_GetSemaphoreCounterValue;
    }
    ENTRIES(PLANT)
#undef PLANT
#define PLANT_END(name, parameters, arguments, object, maker) \
    if (fn->name && fn->name != counting_##name) \
        atomic_store(&real_##name, fn->name); \
    if (fn->name) \
        fn->name = counting_##name;
    ENDS(PLANT_END)
#undef PLANT_END
    if (fn->WaitSemaphores) {
        fn->WaitSemaphores = hanging_WaitSemaphores;
        fn->GetSemaphoreCounterValue = hanging_GetSemaphoreCounterValue;
    }
    if (!atomic_load(&control->incoherent) || !fn->GetPhysicalDeviceMemoryProperties)
        return;
    if (fn->GetPhysicalDeviceMemoryProperties != incoherent_GetPhysicalDeviceMemoryProperties)
        atomic_store(&real_GetPhysicalDeviceMemoryProperties, fn->GetPhysicalDeviceMemoryProperties);
    fn->GetPhysicalDeviceMemoryProperties = incoherent_GetPhysicalDeviceMemoryProperties;
}

__attribute__((constructor)) static void begin(void)
{
    const char *path = getenv("KD_VULKAN_FAULTS");
    const int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *map = fd < 0 ? MAP_FAILED : mmap(NULL, sizeof unused, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (fd >= 0)
        close(fd);
    if (map == MAP_FAILED)
        return;
    control = map;
    kd_vk_functions_hook = plant;
}
