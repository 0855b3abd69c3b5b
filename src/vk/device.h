/* struct kd_vk, for the files of this layer and for tests that simulate failures. */
#ifndef KD_VK_DEVICE_H
#define KD_VK_DEVICE_H

#include "vk/cache.h"
#include "vk/core.h"
#include "vk/descriptors.h"
#include "vk/hazard.h"
#include "vk/instance.h"
#include "vk/mapped.h"
#include "vk/memory.h"
#include "vk/retire.h"
#include "vk/timing.h"
#include "vk/vk.h"

/* Objects of one submission. They are reused for later submissions. */
struct kd_vk_slot {
    VkCommandPool pool;
    VkCommandBuffer commands;
    struct kd_vk_descriptors descriptors;
    struct kd_vk_stamps stamps;
    uint64_t submitted_ns;
};

/* One more than the limit of submissions under way, for the one that is being recorded. */
#define KD_VK_SLOTS (KD_VK_IN_FLIGHT + 1)

struct kd_vk {
    struct kd_vk_instance instance;
    struct kd_vk_core core;
    char choice[640];

    struct kd_vk_heap heap;
    struct kd_vk_cache cache;
    struct kd_vk_retired *retired; /* objects that the caller has destroyed but the device may still use */
    struct kd_vk_mapped *mapped;   /* buffers that are mapped in memory that is not coherent */
    uint64_t next_buffer_id;
    uint32_t n_buffers;
    atomic_uint n_pipelines; /* number of pipelines that exist; for the warning at the end */

    VkSemaphore timeline;
    struct kd_vk_slot slots[KD_VK_SLOTS];
    bool recording;
    /* timeline values. submitted: of the latest submission; done: of the latest submission that is known to be
     * finished */
    uint64_t submitted, done;
    /* time at which `done` last increased; the deadline of the next submission counts from this time */
    uint64_t progress_ns;
    uint64_t deadline_ns;
    /* hazards: present state; hazards_before: state when recording began */
    struct kd_vk_hazards hazards, hazards_before;
    struct kd_vk_timing timing;

    struct kd_vk *next_lost;
};

/* Frees the object now if it is idle, otherwise when it becomes idle. On a lost device it is freed when the device is
 * closed. */
void kd_vk_retire(struct kd_vk *vk, struct kd_vk_retired *object);

/* Timeline value of the commands being recorded. */
static inline uint64_t kd_vk_current(const struct kd_vk *vk) { return vk->submitted + 1; }

#endif
