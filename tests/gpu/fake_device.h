/* Simulates a device with properties that no driver here has: lower limits, incoherent memory, a lost device. After
 * `fake_device_on`, the functions of the simulated device replace the real driver's in the function table of src/vk.
 * One thread. */
#ifndef KD_TEST_FAKE_DEVICE_H
#define KD_TEST_FAKE_DEVICE_H

#include "support.h"

#include "vk/functions.h"

/* members below: 0 means the driver's own value */
struct fake_device {
    uint32_t groups;                    /* largest number of workgroups of a dispatch along x and y */
    uint64_t binding, allocation, heap; /* bytes */
    /* budget of each heap in bytes; if set, the device also has VK_EXT_memory_budget */
    uint64_t budget;
    uint32_t texels, uniform; /* largest number of texels, and of bytes, of a binding */
    /* true: no memory is coherent; the host sees a copy, which only flushes and invalidations update */
    bool incoherent;
    int lost_at; /* number, from 1, of the submission at which the device is lost */
};

static struct fake_device fake;
static struct kd_vk_functions fake_real;
static int fake_submissions;
static unsigned fake_flushes, fake_invalidations;

/* The host's copy of a block. It is first filled with garbage. */
static struct fake_memory {
    VkDeviceMemory memory;
    VkDeviceSize size;
    uint8_t *device, *host;
} fake_memory[256];
enum { FAKE_MEMORIES = sizeof fake_memory / sizeof *fake_memory };

static struct fake_memory *fake_find(VkDeviceMemory memory)
{
    for (size_t i = 0; i < FAKE_MEMORIES; i++)
        if (fake_memory[i].memory == memory)
            return &fake_memory[i];
    return NULL;
}

static void fake_limits(VkPhysicalDeviceProperties *p)
{
    if (fake.groups)
        p->limits.maxComputeWorkGroupCount[0] = p->limits.maxComputeWorkGroupCount[1] = fake.groups;
    if (fake.binding)
        p->limits.maxStorageBufferRange = (uint32_t)fake.binding;
    if (fake.texels)
        p->limits.maxTexelBufferElements = fake.texels;
    if (fake.uniform)
        p->limits.maxUniformBufferRange = fake.uniform;
}

static void fake_types(VkPhysicalDeviceMemoryProperties *p)
{
    for (uint32_t i = 0; i < p->memoryHeapCount && fake.heap; i++)
        p->memoryHeaps[i].size = fake.heap;
    for (uint32_t i = 0; i < p->memoryTypeCount && fake.incoherent; i++)
        p->memoryTypes[i].propertyFlags &= ~(VkMemoryPropertyFlags)VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

static VKAPI_ATTR void VKAPI_CALL fake_Properties(VkPhysicalDevice device, VkPhysicalDeviceProperties *out)
{
    fake_real.GetPhysicalDeviceProperties(device, out);
    fake_limits(out);
}

static VKAPI_ATTR void VKAPI_CALL fake_Properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2 *out)
{
    fake_real.GetPhysicalDeviceProperties2(device, out);
    fake_limits(&out->properties);
    for (VkBaseOutStructure *s = out->pNext; s; s = s->pNext)
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES && fake.allocation)
            ((VkPhysicalDeviceVulkan11Properties *)s)->maxMemoryAllocationSize = fake.allocation;
}

static VKAPI_ATTR void VKAPI_CALL fake_Memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties *out)
{
    fake_real.GetPhysicalDeviceMemoryProperties(device, out);
    fake_types(out);
}

static VKAPI_ATTR void VKAPI_CALL fake_Memory2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2 *out)
{
    fake_real.GetPhysicalDeviceMemoryProperties2(device, out);
    fake_types(&out->memoryProperties);
    for (VkBaseOutStructure *s = out->pNext; s; s = s->pNext)
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT && (fake.budget || fake.heap))
            for (uint32_t i = 0; i < VK_MAX_MEMORY_HEAPS; i++)
                ((VkPhysicalDeviceMemoryBudgetPropertiesEXT *)s)->heapBudget[i] = fake.budget ? fake.budget : fake.heap;
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Extensions(VkPhysicalDevice device, const char *layer, uint32_t *n,
                                                      VkExtensionProperties *out)
{
    uint32_t room = *n;
    VkResult result = fake_real.EnumerateDeviceExtensionProperties(device, layer, n, out);
    if (result < 0 || !fake.budget)
        return result;
    if (out && *n < room)
        out[*n] = (VkExtensionProperties) { .extensionName = VK_EXT_MEMORY_BUDGET_EXTENSION_NAME };
    ++*n;
    return result;
}

/* Removes the simulated extension from a request, because the driver may not have it. */
static VKAPI_ATTR VkResult VKAPI_CALL fake_CreateDevice(VkPhysicalDevice device, const VkDeviceCreateInfo *info,
                                                        const VkAllocationCallbacks *allocator, VkDevice *out)
{
    const char *names[32];
    VkDeviceCreateInfo own = *info;
    own.ppEnabledExtensionNames = names;
    own.enabledExtensionCount = 0;
    assert_true(info->enabledExtensionCount <= 32);
    for (uint32_t i = 0; i < info->enabledExtensionCount; i++)
        if (!fake.budget || strcmp(info->ppEnabledExtensionNames[i], VK_EXT_MEMORY_BUDGET_EXTENSION_NAME))
            names[own.enabledExtensionCount++] = info->ppEnabledExtensionNames[i];
    return fake_real.CreateDevice(device, &own, allocator, out);
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Allocate(VkDevice device, const VkMemoryAllocateInfo *info,
                                                    const VkAllocationCallbacks *allocator, VkDeviceMemory *out)
{
    assert_true(!fake.allocation || info->allocationSize <= fake.allocation);
    VkResult result = fake_real.AllocateMemory(device, info, allocator, out);
    struct fake_memory *m = result || !fake.incoherent ? NULL : fake_find(VK_NULL_HANDLE);
    if (m)
        *m = (struct fake_memory) { *out, info->allocationSize, NULL, NULL };
    return result;
}

static VKAPI_ATTR void VKAPI_CALL fake_Free(VkDevice device, VkDeviceMemory memory,
                                            const VkAllocationCallbacks *allocator)
{
    struct fake_memory *m = memory ? fake_find(memory) : NULL;
    if (m) {
        free(m->host);
        *m = (struct fake_memory) { 0 };
    }
    fake_real.FreeMemory(device, memory, allocator);
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Map(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                               VkDeviceSize size, VkMemoryMapFlags flags, void **out)
{
    VkResult result = fake_real.MapMemory(device, memory, offset, size, flags, out);
    struct fake_memory *m = result ? NULL : fake_find(memory);
    if (!m)
        return result;
    m->device = *out;
    m->host = aligned_alloc(4096, (m->size + 4095) & ~(VkDeviceSize)4095);
    assert_non_null(m->host);
    memset(m->host, 0xcd, m->size);
    *out = m->host;
    return result;
}

/* Checks that a range is inside its block and consists of whole atoms, of the largest size that Vulkan allows. */
static struct fake_memory *fake_range(const VkMappedMemoryRange *range)
{
    struct fake_memory *m = fake_find(range->memory);
    assert_non_null(m);
    assert_true(range->offset % 256 == 0 && range->offset + range->size <= m->size);
    assert_true(range->size % 256 == 0 || range->offset + range->size == m->size);
    return m;
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Flush(VkDevice device, uint32_t n, const VkMappedMemoryRange *ranges)
{
    (void)device;
    for (uint32_t i = 0; i < n; i++) {
        struct fake_memory *m = fake_range(&ranges[i]);
        memcpy(m->device + ranges[i].offset, m->host + ranges[i].offset, ranges[i].size);
    }
    fake_flushes += n;
    return VK_SUCCESS;
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Invalidate(VkDevice device, uint32_t n, const VkMappedMemoryRange *ranges)
{
    (void)device;
    for (uint32_t i = 0; i < n; i++) {
        struct fake_memory *m = fake_range(&ranges[i]);
        memcpy(m->host + ranges[i].offset, m->device + ranges[i].offset, ranges[i].size);
    }
    fake_invalidations += n;
    return VK_SUCCESS;
}

static VKAPI_ATTR VkResult VKAPI_CALL fake_Submit(VkQueue queue, uint32_t n, const VkSubmitInfo *infos, VkFence fence)
{
    if (++fake_submissions == fake.lost_at)
        return VK_ERROR_DEVICE_LOST;
    return fake_real.QueueSubmit(queue, n, infos, fence);
}

#define FAKE_REPLACE(name, by) \
    if (fn->name && fn->name != (by)) { \
        fake_real.name = fn->name; \
        fn->name = (by); \
    }

/* Called when the functions of the instance are loaded, and again when those of the device are. */
static void fake_plant(struct kd_vk_functions *fn)
{
    FAKE_REPLACE(GetPhysicalDeviceProperties, fake_Properties)
    FAKE_REPLACE(GetPhysicalDeviceProperties2, fake_Properties2)
    FAKE_REPLACE(GetPhysicalDeviceMemoryProperties, fake_Memory)
    FAKE_REPLACE(GetPhysicalDeviceMemoryProperties2, fake_Memory2)
    FAKE_REPLACE(EnumerateDeviceExtensionProperties, fake_Extensions)
    FAKE_REPLACE(CreateDevice, fake_CreateDevice)
    if (!fn->CmdFillBuffer)
        return;
    FAKE_REPLACE(AllocateMemory, fake_Allocate)
    FAKE_REPLACE(FreeMemory, fake_Free)
    FAKE_REPLACE(QueueSubmit, fake_Submit)
    if (!fake.incoherent)
        return;
    FAKE_REPLACE(MapMemory, fake_Map)
    FAKE_REPLACE(FlushMappedMemoryRanges, fake_Flush)
    FAKE_REPLACE(InvalidateMappedMemoryRanges, fake_Invalidate)
}

/* Devices opened from now on have these properties. All these devices must be closed before the next call. */
static inline void fake_device_on(const struct fake_device *device)
{
    fake = *device;
    fake_submissions = 0;
    fake_flushes = fake_invalidations = 0;
    kd_vk_functions_hook = fake_plant;
}
static inline void fake_device_off(void)
{
    kd_vk_functions_hook = NULL;
    fake = (struct fake_device) { 0 };
}

#endif
