/* Hazard table: decides which commands need a barrier between them. Pure, without Vulkan calls.
 *
 * The table lists the accesses since the last barrier, in the order of recording. The accesses may belong to several
 * submissions, because a pipeline barrier also orders earlier submissions of its queue. A command conflicts if one of
 * its ranges overlaps a listed range of the same buffer and at least one of the two accesses writes. A barrier orders
 * all commands before it against all commands after it, in all stages that we use and for each kind of binding. So the
 * table is empty after a barrier. On hardware a barrier for one buffer costs as much as a global one, because caches
 * are flushed completely. */
#ifndef KD_VK_HAZARD_H
#define KD_VK_HAZARD_H

#include "vk/functions.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_vk_access {
    uint64_t buffer;            /* number that identifies the buffer; never reused */
    uint64_t begin, end;        /* range in bytes */
    VkPipelineStageFlags stage; /* one bit: compute shader, transfer or indirect dispatch */
    bool write;                 /* true if the command writes the buffer; it may also read it */
    bool host;                  /* true if the memory is mapped by the host */
};

/* limit of separate ranges in the list; beyond it a barrier is recorded, which empties the table */
#define KD_VK_MAX_ACCESSES 128

struct kd_vk_hazards {
    struct kd_vk_access list[KD_VK_MAX_ACCESSES];
    size_t count;
    VkPipelineStageFlags host_stages; /* stages that have written mapped memory since the last barrier to the host */
};

struct kd_vk_barrier {
    VkPipelineStageFlags src_stages, dst_stages;
    VkAccessFlags src_access, dst_access;
};

/* Adds a command with n <= KD_VK_MAX_ACCESSES accesses, which must not conflict with each other. Returns true if
 * *barrier must be recorded before the command. */
bool kd_vk_hazards_add(struct kd_vk_hazards *hazards, const struct kd_vk_access *accesses, size_t n,
                       struct kd_vk_barrier *barrier);

/* Called at the end of a submission. Returns true if *barrier must be recorded so that the host sees what was written.
 * The other direction needs no barrier: vkQueueSubmit makes earlier writes of the host visible to the device. */
bool kd_vk_hazards_to_host(struct kd_vk_hazards *hazards, struct kd_vk_barrier *barrier);

#endif
