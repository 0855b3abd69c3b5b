/* Flushes and invalidates mapped memory that is not coherent. A flush makes the host's writes visible to the device; an
 * invalidation makes the device's writes visible to the host. Buffers that a submission reads are flushed before it.
 * Buffers that it writes are invalidated when it has finished. If the memory is coherent, the list is empty. */
#ifndef KD_VK_MAPPED_H
#define KD_VK_MAPPED_H

#include "vk/functions.h"

struct kd_vk;
struct kd_vk_buffer;

/* kd_vk_mapped_enter adds a new buffer if its memory is not coherent. kd_vk_mapped_forget removes it before it is
 * destroyed. */
void kd_vk_mapped_enter(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void kd_vk_mapped_forget(struct kd_vk *vk, struct kd_vk_buffer *buffer);
/* Notes that the submission being recorded reads the buffer. write: it writes the buffer, and may read it. */
void kd_vk_mapped_use(struct kd_vk *vk, struct kd_vk_buffer *buffer, bool write);
/* kd_vk_mapped_flush is called before the submission with this number. kd_vk_mapped_invalidate is called when
 * kd_vk.done has grown. kd_vk_mapped_discard is called when a recording was dropped. */
VkResult kd_vk_mapped_flush(struct kd_vk *vk, uint64_t value);
VkResult kd_vk_mapped_invalidate(struct kd_vk *vk);
void kd_vk_mapped_discard(struct kd_vk *vk);

#endif
