/* Device memory is a few large blocks, cut into buffers. */
#ifndef KD_VK_MEMORY_H
#define KD_VK_MEMORY_H

#include "vk/arena.h"
#include "vk/functions.h"
#include "vk/vk.h"

/* Vulkan guarantees 4096 allocations; a block this large keeps us far below. A larger buffer gets a block of
 * its own. */
#define KD_VK_BLOCK_BYTES (UINT64_C(64) << 20)
/* No nonCoherentAtomSize is larger (Vulkan 1.2, table 53): buffers share no atom. No
 * min{Storage,Uniform,Texel}BufferOffsetAlignment is larger either: a binding of any kind may begin at each
 * multiple. */
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
    uint8_t *map; /* NULL if the host cannot see it */
    bool coherent;
};

struct kd_vk_heap {
    VkPhysicalDeviceMemoryProperties properties;
    uint32_t types[3]; /* memory type by enum kd_vk_memory */
    struct kd_vk_block *blocks;
    uint64_t used[VK_MAX_MEMORY_HEAPS]; /* bytes held, by heap */
};

struct kd_vk_slice {
    struct kd_vk_block *block;
    uint64_t offset, size;
};

enum kd_status kd_vk_heap_init(struct kd_vk *vk, struct kd_error *error);
void kd_vk_heap_finish(struct kd_vk *vk);
enum kd_status kd_vk_heap_take(struct kd_vk *vk, enum kd_vk_memory memory, uint64_t size, uint64_t alignment,
                               struct kd_vk_slice *out, struct kd_error *error);
void kd_vk_heap_give(struct kd_vk *vk, const struct kd_vk_slice *slice);

/* The best of the memory types in `allowed` (a bit each) for a purpose, or -1. Pure. host_near: the device's
 * own memory is the host's too (CPU, integrated), so mapping it costs nothing. */
int kd_vk_memory_type(const VkPhysicalDeviceMemoryProperties *properties, uint32_t allowed, enum kd_vk_memory memory,
                      bool host_near);

#endif
