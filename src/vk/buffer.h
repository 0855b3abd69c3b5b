/* Struct of a buffer, private to this layer. */
#ifndef KD_VK_BUFFER_H
#define KD_VK_BUFFER_H

#include "vk/mapped.h"
#include "vk/memory.h"
#include "vk/retire.h"
#include "vk/view.h"
#include "vk/vk.h"

struct kd_vk_buffer {
    struct kd_vk_retired retired; /* must be the first member, because retire.c accesses only this part */
    VkBuffer handle;
    struct kd_vk_slice slice;
    uint64_t id, size;
    enum kd_vk_memory memory;
    struct kd_vk_mapped mapped;
    struct kd_vk_views views; /* cached texel views */
    char name[64];
};

#endif
