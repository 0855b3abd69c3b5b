/* Struct of a buffer, private to this layer. */
#ifndef KD_VK_BUFFER_H
#define KD_VK_BUFFER_H

#include "vk/memory.h"
#include "vk/retire.h"
#include "vk/vk.h"

struct kd_vk_buffer {
    struct kd_vk_retired retired; /* must be the first member, because retire.c knows only this part */
    VkBuffer handle;
    struct kd_vk_slice slice;
    uint64_t id, size;
    enum kd_vk_memory memory;
    struct kd_vk_buffer *next_mapped; /* next buffer in the list kd_vk.mapped */
    uint64_t read, written, seen;     /* used by mapped.h */
    struct kd_vk_view *views;         /* cached texel views (view.h) */
    char name[64];
};

#endif
