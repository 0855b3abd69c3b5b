/* struct kd_vk, for the files of this layer and for tests that simulate failures. */
#ifndef KD_VK_DEVICE_H
#define KD_VK_DEVICE_H

#include "vk/cache.h"
#include "vk/descriptors.h"
#include "vk/functions.h"
#include "vk/hazard.h"
#include "vk/instance.h"
#include "vk/memory.h"
#include "vk/physical.h"
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
    struct kd_vk_functions fn; /* the complete table; instance.fn lacks the functions of the device */
    struct kd_vk_instance instance;
    struct kd_vk_physical physical;
    char choice[640];
    bool compiles_only, pipelines_only; /* see kd_vk_params */
    VkDevice device;
    VkQueue queue;

    struct kd_vk_heap heap;
    struct kd_vk_cache cache;
    struct kd_vk_retired *retired; /* objects that the caller has destroyed but the device may still use */
    struct kd_vk_buffer *mapped;   /* buffers that are mapped in memory that is not coherent */
    uint64_t next_buffer_id;
    uint32_t n_buffers;
    atomic_uint n_pipelines; /* number of pipelines that exist; for the warning at the end */

    VkSemaphore timeline;
    struct kd_vk_slot slots[KD_VK_SLOTS];
    bool recording;
    /* timeline values: of the latest submission, and of the latest that is known to be finished */
    uint64_t submitted, done;
    /* when `done` last increased; the deadline of the next submission counts from this time */
    uint64_t progress_ns;
    uint64_t deadline_ns;
    struct kd_vk_hazards hazards, hazards_before; /* present state, and the state when recording began */
    struct kd_vk_timing timing;

    char lost[256]; /* why the device is lost; "" if it is not lost */
    bool hangs;     /* the device is lost because a deadline has passed: work under way may never end */
    struct kd_vk *next_lost;
};

/* Returns KD_EDEVICE with the reason if the device is lost. */
enum kd_status kd_vk_alive(const struct kd_vk *vk, struct kd_error *error);
/* Marks the device as lost for good. Returns KD_EDEVICE. */
enum kd_status kd_vk_lose(struct kd_vk *vk, struct kd_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Timeline value of the commands being recorded. */
static inline uint64_t kd_vk_current(const struct kd_vk *vk) { return vk->submitted + 1; }

#endif
