/* Flushes and invalidates mapped memory that is not coherent. A flush makes the host's writes visible to the device;
 * an invalidation makes the device's writes visible to the host. Buffers that a submission reads are flushed before
 * the submission. Buffers that a submission writes are invalidated when it has finished. If the memory is coherent,
 * the list is empty. */
#ifndef KD_VK_MAPPED_H
#define KD_VK_MAPPED_H

#include "vk/core.h"
#include "vk/memory.h"

/* Member of a buffer in mapped memory. */
struct kd_vk_mapped {
    struct kd_vk_mapped *next;
    const struct kd_vk_slice *slice;
    enum kd_vk_memory memory;
    /* numbers of the last submissions that read and that write the buffer, recorded or submitted */
    uint64_t read, written;
    uint64_t seen; /* number of the submission up to which the host sees what was written */
};

/* kd_vk_mapped_enter adds a buffer's memory to a list. kd_vk_mapped_forget removes it, if it is there, before the
 * buffer is destroyed. */
void kd_vk_mapped_enter(struct kd_vk_mapped **list, struct kd_vk_mapped *mapped);
void kd_vk_mapped_forget(struct kd_vk_mapped **list, const struct kd_vk_mapped *mapped);
/* Notes that the submission with this number reads the buffer. write: the submission writes the buffer, and may read
 * it. */
void kd_vk_mapped_use(struct kd_vk_mapped *mapped, uint64_t value, bool write);
/* kd_vk_mapped_flush is called before the submission with this number. kd_vk_mapped_invalidate is called when the
 * submissions up to `done` have finished. kd_vk_mapped_discard is called when the recording of the submission after
 * `submitted` was dropped. */
VkResult kd_vk_mapped_flush(struct kd_vk_mapped *list, const struct kd_vk_core *core, uint64_t value);
VkResult kd_vk_mapped_invalidate(struct kd_vk_mapped *list, const struct kd_vk_core *core, uint64_t done);
void kd_vk_mapped_discard(struct kd_vk_mapped *list, uint64_t submitted);

#endif
