/* Flushes and invalidates mapped memory that is not coherent. A flush makes the host's writes visible to the device, an
 * invalidation the device's writes to the host. Before a submission this flushes the buffers that it reads, and when it
 * has finished it invalidates those that it wrote. With coherent memory the list is empty. */
#ifndef KD_VK_MAPPED_H
#define KD_VK_MAPPED_H

#include "vk/functions.h"

struct kd_vk;
struct kd_vk_buffer;

/* enter: adds a new buffer if its memory is not coherent; forget: removes it before it is destroyed. */
void kd_vk_mapped_enter(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void kd_vk_mapped_forget(struct kd_vk *vk, struct kd_vk_buffer *buffer);
/* Notes that the submission being recorded reads the buffer, or writes and perhaps reads it. */
void kd_vk_mapped_use(struct kd_vk *vk, struct kd_vk_buffer *buffer, bool write);
/* flush: before the submission of this number. invalidate: when kd_vk.done has grown. discard: after a recording was
 * dropped. */
VkResult kd_vk_mapped_flush(struct kd_vk *vk, uint64_t value);
VkResult kd_vk_mapped_invalidate(struct kd_vk *vk);
void kd_vk_mapped_discard(struct kd_vk *vk);

#endif
