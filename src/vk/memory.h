/* Device memory: a few large blocks, from which buffers get their slices. */
#ifndef KD_VK_MEMORY_H
#define KD_VK_MEMORY_H

#include "vk/arena.h"
#include "vk/core.h"
#include "vk/vk.h"

/* Vulkan guarantees 4096 allocations. With blocks of this size far fewer are needed. A larger buffer gets a block of
 * its own. */
#define KD_VK_BLOCK_BYTES (UINT64_C(64) << 20)
/* Not less than any nonCoherentAtomSize (Vulkan 1.2, table 53), so that no two buffers share an atom. Also not less
 * than any min{Storage,Uniform,Texel}BufferOffsetAlignment, so that bindings of all kinds may start at each multiple
 * of this number. */
#define KD_VK_ALIGNMENT 256
#define KD_VK_BUFFER_USAGE \
    (VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | \
     VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | \
     VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT)

struct kd_vk_block {
    struct kd_vk_block *next;
    VkDeviceMemory memory;
    uint32_t type;
    struct kd_vk_arena arena;
    uint8_t *map; /* address of the block for the host; NULL: the host does not see the block */
    bool coherent;
};

struct kd_vk_heap {
    VkPhysicalDeviceMemoryProperties properties;
    uint32_t types[3]; /* index of the memory type for each enum kd_vk_memory */
    struct kd_vk_block *blocks;
    uint64_t used[VK_MAX_MEMORY_HEAPS]; /* bytes allocated from each heap */
};

struct kd_vk_slice {
    struct kd_vk_block *block;
    uint64_t offset, size;
};

enum kd_status kd_vk_heap_init(struct kd_vk_heap *heap, const struct kd_vk_core *core, struct kd_error *error);
void kd_vk_heap_finish(struct kd_vk_heap *heap, const struct kd_vk_core *core);
/* Returns KD_ENOMEM if the heap is full at present. */
enum kd_status kd_vk_heap_take(struct kd_vk_heap *heap, const struct kd_vk_core *core, enum kd_vk_memory memory,
                               uint64_t size, uint64_t alignment, struct kd_vk_slice *out, struct kd_error *error);
void kd_vk_heap_give(struct kd_vk_heap *heap, const struct kd_vk_core *core, const struct kd_vk_slice *slice);
/* Bytes allocated from the device. */
uint64_t kd_vk_heap_bytes(const struct kd_vk_heap *heap);

/* Chooses the best memory type among `allowed`, which has one bit for each; -1: none. Pure. host_near: the device's
 * memory is the host's (CPU, integrated GPU), so that mapping costs nothing. */
int kd_vk_memory_type(const VkPhysicalDeviceMemoryProperties *properties, uint32_t allowed, enum kd_vk_memory memory,
                      bool host_near);

#endif
