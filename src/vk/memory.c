#include "vk/memory.h"

#include <stdlib.h>

#define LOCAL VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
#define VISIBLE VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT
#define COHERENT VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
#define CACHED VK_MEMORY_PROPERTY_HOST_CACHED_BIT

/* True if a memory type has ordinary flags only. Types that need a feature are never used: AMD's uncached ones,
 * protected ones, lazily allocated ones. */
static bool plain(VkMemoryPropertyFlags flags)
{
    return !(flags & ~(VkMemoryPropertyFlags)(LOCAL | VISIBLE | COHERENT | CACHED));
}

/* Score of a memory type; -1 if it is unsuitable. READBACK: the host reads uncached memory ten times more slowly, so
 * cached memory is better, even if it needs invalidation. UPLOAD bypasses the cache, so coherent memory is better. Host
 * memory outside the device's is preferred, because on a discrete card only 256 MiB of the device's memory may be
 * mappable. */
static int points(VkMemoryPropertyFlags flags, enum kd_vk_memory memory, bool host_near)
{
    bool visible = flags & VISIBLE, local = flags & LOCAL, cached = flags & CACHED, coherent = flags & COHERENT;
    if (!plain(flags))
        return -1;
    switch (memory) {
    case KD_VK_DEVICE: return local ? 1 + 2 * (visible == host_near) + coherent : -1;
    case KD_VK_UPLOAD: return visible ? 1 + 4 * coherent + 2 * !local + !cached : -1;
    case KD_VK_READBACK: return visible ? 1 + 4 * cached + 2 * coherent + !local : -1;
    }
    return -1;
}

int kd_vk_memory_type(const VkPhysicalDeviceMemoryProperties *properties, uint32_t allowed, enum kd_vk_memory memory,
                      bool host_near)
{
    int best = -1, best_points = 0;
    for (uint32_t i = 0; i < properties->memoryTypeCount; i++) {
        int p = allowed >> i & 1 ? points(properties->memoryTypes[i].propertyFlags, memory, host_near) : -1;
        if (p > best_points) {
            best = (int)i;
            best_points = p;
        }
    }
    return best;
}

/* Finds the allowed memory types. Every buffer has the same usage and therefore the same allowed types, so they are
 * queried once, with a small buffer. */
static enum kd_status allowed_types(const struct kd_vk_core *core, uint32_t *allowed, struct kd_error *error)
{
    enum kd_status status;
    VkBuffer probe;
    VkMemoryRequirements requirements;
    const VkBufferCreateInfo info = { .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .size = KD_VK_ALIGNMENT,
                                      .usage = KD_VK_BUFFER_USAGE };
    KD_VK_TRY(&core->fn, CreateBuffer, core->device, &info, NULL, &probe);
    core->fn.GetBufferMemoryRequirements(core->device, probe, &requirements);
    core->fn.DestroyBuffer(core->device, probe, NULL);
    *allowed = requirements.memoryTypeBits;
done:
    return status;
}

enum kd_status kd_vk_heap_init(struct kd_vk_heap *heap, const struct kd_vk_core *core, struct kd_error *error)
{
    enum kd_vk_type device = core->physical.info.type;
    uint32_t allowed = 0;
    enum kd_status status = allowed_types(core, &allowed, error);
    if (status)
        return status;
    core->fn.GetPhysicalDeviceMemoryProperties(core->physical.handle, &heap->properties);
    for (int m = KD_VK_DEVICE; m <= KD_VK_READBACK; m++) {
        int type = kd_vk_memory_type(&heap->properties, allowed, (enum kd_vk_memory)m,
                                     device == KD_VK_CPU || device == KD_VK_INTEGRATED);
        if (type < 0)
            return kd_error_set(error, KD_EDEVICE, "%s has no %s memory for buffers", core->physical.info.name,
                                m == KD_VK_DEVICE ? "device-local" : "host-visible");
        heap->types[m] = (uint32_t)type;
    }
    return KD_OK;
}

static void block_free(struct kd_vk_heap *heap, const struct kd_vk_core *core, struct kd_vk_block *block)
{
    heap->used[heap->properties.memoryTypes[block->type].heapIndex] -= block->arena.size;
    core->fn.FreeMemory(core->device, block->memory, NULL); /* also unmaps the memory */
    kd_vk_arena_finish(&block->arena);
    free(block);
}

void kd_vk_heap_finish(struct kd_vk_heap *heap, const struct kd_vk_core *core)
{
    while (heap->blocks) {
        struct kd_vk_block *block = heap->blocks;
        heap->blocks = block->next;
        block_free(heap, core, block);
    }
}

static enum kd_status block_fill(struct kd_vk_heap *heap, const struct kd_vk_core *core, struct kd_vk_block *block,
                                 uint64_t size, struct kd_error *error)
{
    enum kd_status status;
    VkMemoryPropertyFlags flags = heap->properties.memoryTypes[block->type].propertyFlags;
    const VkMemoryAllocateInfo info = { .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .allocationSize = size,
                                        .memoryTypeIndex = block->type };
    void *map = NULL;
    KD_VK_TRY(&core->fn, AllocateMemory, core->device, &info, NULL, &block->memory);
    kd_vk_name(core, VK_OBJECT_TYPE_DEVICE_MEMORY, KD_VK_HANDLE(block->memory), "block of type %u", block->type);
    block->coherent = flags & COHERENT;
    if (flags & VISIBLE)
        KD_VK_TRY(&core->fn, MapMemory, core->device, block->memory, 0, VK_WHOLE_SIZE, 0, &map);
    block->map = map;
done:
    return status;
}

/* Appends a block to the list. Buffers are taken from the oldest block with room, so that the latest blocks become
 * empty. */
static enum kd_status block_create(struct kd_vk_heap *heap, const struct kd_vk_core *core, uint32_t type, uint64_t size,
                                   struct kd_error *error)
{
    uint32_t index = heap->properties.memoryTypes[type].heapIndex;
    uint64_t limit = heap->properties.memoryHeaps[index].size;
    if (size > core->physical.info.max_allocation_bytes || size > limit || heap->used[index] > limit - size)
        return kd_error_set(error, KD_ENOMEM, "beyond the device's limits");
    struct kd_vk_block *block = calloc(1, sizeof *block);
    if (!block || !kd_vk_arena_init(&block->arena, size)) {
        free(block);
        return kd_error_set(error, KD_ENOMEM, "out of host memory");
    }
    block->type = type;
    heap->used[index] += size;
    enum kd_status status = block_fill(heap, core, block, size, error);
    if (status) {
        block_free(heap, core, block);
        return status;
    }
    struct kd_vk_block **end = &heap->blocks;
    while (*end)
        end = &(*end)->next;
    *end = block;
    return KD_OK;
}

static bool take(struct kd_vk_heap *heap, uint32_t type, uint64_t size, uint64_t alignment, struct kd_vk_slice *out)
{
    for (struct kd_vk_block *block = heap->blocks; block; block = block->next)
        if (block->type == type && kd_vk_arena_take(&block->arena, size, alignment, &out->offset)) {
            out->block = block;
            out->size = size;
            return true;
        }
    return false;
}

/* Takes a slice from a block with room, or from a new block of the usual size if there is no such block. If a block
 * of that size cannot be allocated, the new block has just the size that is needed. */
static enum kd_status take_or_grow(struct kd_vk_heap *heap, const struct kd_vk_core *core, uint32_t type, uint64_t size,
                                   uint64_t alignment, struct kd_vk_slice *out, struct kd_error *error)
{
    uint64_t usual = heap->properties.memoryHeaps[heap->properties.memoryTypes[type].heapIndex].size / 8;
    usual = usual > KD_VK_BLOCK_BYTES ? KD_VK_BLOCK_BYTES : usual & ~(uint64_t)(KD_VK_ALIGNMENT - 1);
    if (take(heap, type, size, alignment, out))
        return KD_OK;
    enum kd_status status = block_create(heap, core, type, size > usual ? size : usual, error);
    if (status == KD_ENOMEM && size < usual)
        status = block_create(heap, core, type, size, error);
    if (!status && !take(heap, type, size, alignment, out))
        status = kd_error_set(error, KD_ENOMEM, "out of host memory");
    return status;
}

enum kd_status kd_vk_heap_take(struct kd_vk_heap *heap, const struct kd_vk_core *core, enum kd_vk_memory memory,
                               uint64_t size, uint64_t alignment, struct kd_vk_slice *out, struct kd_error *error)
{
    uint32_t type = heap->types[memory];
    struct kd_error why = { 0 };
    if (core->pipelines_only)
        return kd_error_set(error, KD_EINTERNAL, "the device was opened only for pipelines");
    if (alignment < KD_VK_ALIGNMENT)
        alignment = KD_VK_ALIGNMENT;
    size = size > UINT64_MAX - alignment ? size : (size + KD_VK_ALIGNMENT - 1) & ~(uint64_t)(KD_VK_ALIGNMENT - 1);
    enum kd_status status = take_or_grow(heap, core, type, size, alignment, out, &why);
    if (!status)
        return KD_OK;
    return kd_error_set(
        error, status, "cannot allocate %.2f MiB of %s memory: %.200s (%.2f MiB are in use, the heap has %.0f MiB)",
        (double)size / 0x1p20,
        memory == KD_VK_DEVICE   ? "device"
        : memory == KD_VK_UPLOAD ? "upload"
                                 : "readback",
        why.message, (double)kd_vk_heap_bytes(heap) / 0x1p20,
        (double)heap->properties.memoryHeaps[heap->properties.memoryTypes[type].heapIndex].size / 0x1p20);
}

void kd_vk_heap_give(struct kd_vk_heap *heap, const struct kd_vk_core *core, const struct kd_vk_slice *slice)
{
    kd_vk_arena_give(&slice->block->arena, slice->offset, slice->size);
    if (slice->block->arena.live)
        return;
    for (struct kd_vk_block **link = &heap->blocks; *link; link = &(*link)->next)
        if (*link == slice->block) {
            *link = slice->block->next;
            block_free(heap, core, slice->block);
            return;
        }
}

uint64_t kd_vk_heap_bytes(const struct kd_vk_heap *heap)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < VK_MAX_MEMORY_HEAPS; i++)
        sum += heap->used[i];
    return sum;
}
