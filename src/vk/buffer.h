/* The inside of a buffer. */
#ifndef KD_VK_BUFFER_H
#define KD_VK_BUFFER_H

#include "vk/memory.h"
#include "vk/retire.h"

struct kd_vk_buffer {
    struct kd_vk_retired retired; /* first: retire.c knows only this part */
    VkBuffer handle;
    struct kd_vk_slice slice;
    uint64_t id, size;
    char name[64];
};

#endif
