#include "vk/mapped.h"

#include "vk/buffer.h"
#include "vk/device.h"

void kd_vk_mapped_enter(struct kd_vk *vk, struct kd_vk_buffer *buffer)
{
    if (buffer->slice.block->coherent || !kd_vk_buffer_map(buffer))
        return;
    buffer->next_mapped = vk->mapped;
    vk->mapped = buffer;
}

void kd_vk_mapped_forget(struct kd_vk *vk, struct kd_vk_buffer *buffer)
{
    for (struct kd_vk_buffer **link = &vk->mapped; *link; link = &(*link)->next_mapped)
        if (*link == buffer) {
            *link = buffer->next_mapped;
            return;
        }
}

void kd_vk_mapped_use(struct kd_vk *vk, struct kd_vk_buffer *buffer, bool write)
{
    buffer->read = kd_vk_current(vk);
    if (write)
        buffer->written = kd_vk_current(vk);
}

/* Part of the memory that a buffer occupies. Offset and size are multiples of every nonCoherentAtomSize, because
 * heap_take uses KD_VK_ALIGNMENT. */
static VkMappedMemoryRange range_of(const struct kd_vk_buffer *buffer)
{
    return (VkMappedMemoryRange) { .sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
                                   .memory = buffer->slice.block->memory,
                                   .offset = buffer->slice.offset,
                                   .size = buffer->slice.size };
}

/* Skips READBACK buffers. The host does not write to them, and the host's old copy must not overwrite what the device
 * wrote. */
VkResult kd_vk_mapped_flush(struct kd_vk *vk, uint64_t value)
{
    VkResult result = VK_SUCCESS;
    for (struct kd_vk_buffer *b = vk->mapped; b && result >= 0; b = b->next_mapped)
        if (b->read == value && b->memory == KD_VK_UPLOAD) {
            const VkMappedMemoryRange range = range_of(b);
            result = vk->fn.FlushMappedMemoryRanges(vk->device, 1, &range);
        }
    return result;
}

VkResult kd_vk_mapped_invalidate(struct kd_vk *vk)
{
    VkResult result = VK_SUCCESS;
    for (struct kd_vk_buffer *b = vk->mapped; b && result >= 0; b = b->next_mapped)
        if (b->written > b->seen && vk->done > b->seen) {
            const VkMappedMemoryRange range = range_of(b);
            result = vk->fn.InvalidateMappedMemoryRanges(vk->device, 1, &range);
            b->seen = vk->done;
        }
    return result;
}

void kd_vk_mapped_discard(struct kd_vk *vk)
{
    for (struct kd_vk_buffer *b = vk->mapped; b; b = b->next_mapped)
        if (b->written > vk->submitted)
            b->written = b->seen > vk->submitted ? b->seen : vk->submitted;
}
