/* Says which commands must not overlap: it is a pure table, with no Vulkan call in it.
 *
 * It lists the accesses since the last barrier, in recorded order and across submissions (a pipeline barrier
 * also orders earlier submissions of its queue). A command conflicts when one of its ranges overlaps a listed
 * range of the same buffer and either of the two writes. The barrier that follows orders everything before it
 * against everything after it, in all stages we use and for each kind of binding, so it empties the table: on
 * hardware a barrier of one buffer costs what a global one costs, since caches are flushed whole. */
#ifndef KD_VK_HAZARD_H
#define KD_VK_HAZARD_H

#include "vk/functions.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_vk_access {
    uint64_t buffer;            /* an identity, never reused */
    uint64_t begin, end;        /* bytes */
    VkPipelineStageFlags stage; /* compute shader, transfer or the reading of counts, one bit */
    bool write;                 /* writes, and may read as well */
    bool host;                  /* of memory that the host has mapped */
};

/* After this many separate ranges without a barrier one is emitted, to start afresh. */
#define KD_VK_MAX_ACCESSES 128

struct kd_vk_hazards {
    struct kd_vk_access list[KD_VK_MAX_ACCESSES];
    size_t count;
    VkPipelineStageFlags host_stages; /* that wrote mapped memory since the last barrier towards the host */
};

struct kd_vk_barrier {
    VkPipelineStageFlags src_stages, dst_stages;
    VkAccessFlags src_access, dst_access;
};

/* Enter one command with its n <= KD_VK_MAX_ACCESSES accesses; those of one command do not conflict with each
 * other. True: *barrier has to be recorded before the command. */
bool kd_vk_hazards_add(struct kd_vk_hazards *hazards, const struct kd_vk_access *accesses, size_t n,
                       struct kd_vk_barrier *barrier);

/* Called at the end of a submission: true if *barrier has to be recorded for the host to see what was written. The
 * other direction needs none: vkQueueSubmit itself makes earlier host writes visible to the device. */
bool kd_vk_hazards_to_host(struct kd_vk_hazards *hazards, struct kd_vk_barrier *barrier);

#endif
