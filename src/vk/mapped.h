/* Mapped memory may not be coherent: what the host writes reaches the device by a flush, what the device writes
 * reaches the host by an invalidation. The layer does both, so that nobody else has to know: before a submission it
 * flushes the buffers that are read in it, and when one is seen finished it invalidates those that were written.
 * Where memory is coherent the list is empty. */
#ifndef KD_VK_MAPPED_H
#define KD_VK_MAPPED_H

#include "vk/functions.h"

struct kd_vk;
struct kd_vk_buffer;

/* Enter a new buffer if its memory asks for it; forget it before it is destroyed. */
void kd_vk_mapped_enter(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void kd_vk_mapped_forget(struct kd_vk *vk, struct kd_vk_buffer *buffer);
/* Says that the submission that is being recorded reads the buffer, or writes it and may read it. */
void kd_vk_mapped_use(struct kd_vk *vk, struct kd_vk_buffer *buffer, bool write);
/* Called before the submission of this number; after the last that kd_vk.done counts; after one was dropped. */
VkResult kd_vk_mapped_flush(struct kd_vk *vk, uint64_t value);
VkResult kd_vk_mapped_invalidate(struct kd_vk *vk);
void kd_vk_mapped_discard(struct kd_vk *vk);

#endif
