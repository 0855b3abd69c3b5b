#include "vk/mapped.h"

void kd_vk_mapped_enter(struct kd_vk_mapped **list, struct kd_vk_mapped *mapped)
{
    mapped->next = *list;
    *list = mapped;
}

void kd_vk_mapped_forget(struct kd_vk_mapped **list, const struct kd_vk_mapped *mapped)
{
    for (struct kd_vk_mapped **link = list; *link; link = &(*link)->next)
        if (*link == mapped) {
            *link = mapped->next;
            return;
        }
}

void kd_vk_mapped_use(struct kd_vk_mapped *mapped, uint64_t value, bool write)
{
    mapped->read = value;
    if (write)
        mapped->written = value;
}

/* Part of the memory that a buffer occupies. Offset and size are multiples of every nonCoherentAtomSize, because
 * heap_take uses KD_VK_ALIGNMENT. */
static VkMappedMemoryRange range_of(const struct kd_vk_mapped *mapped)
{
    return (VkMappedMemoryRange) { .sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
                                   .memory = mapped->slice->block->memory,
                                   .offset = mapped->slice->offset,
                                   .size = mapped->slice->size };
}

/* Skips READBACK buffers. The host does not write to them, and the host's old copy must not overwrite what the device
 * wrote. */
VkResult kd_vk_mapped_flush(struct kd_vk_mapped *list, const struct kd_vk_core *core, uint64_t value)
{
    VkResult result = VK_SUCCESS;
    for (struct kd_vk_mapped *m = list; m && result >= 0; m = m->next)
        if (m->read == value && m->memory == KD_VK_UPLOAD) {
            const VkMappedMemoryRange range = range_of(m);
            result = core->fn.FlushMappedMemoryRanges(core->device, 1, &range);
        }
    return result;
}

VkResult kd_vk_mapped_invalidate(struct kd_vk_mapped *list, const struct kd_vk_core *core, uint64_t done)
{
    VkResult result = VK_SUCCESS;
    for (struct kd_vk_mapped *m = list; m && result >= 0; m = m->next)
        if (m->written > m->seen && done > m->seen) {
            const VkMappedMemoryRange range = range_of(m);
            result = core->fn.InvalidateMappedMemoryRanges(core->device, 1, &range);
            m->seen = done;
        }
    return result;
}

void kd_vk_mapped_discard(struct kd_vk_mapped *list, uint64_t submitted)
{
    for (struct kd_vk_mapped *m = list; m; m = m->next)
        if (m->written > submitted)
            m->written = m->seen > submitted ? m->seen : submitted;
}
