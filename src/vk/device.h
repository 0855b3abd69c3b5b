/* This is the inside of struct kd_vk, for the files of this layer and for tests that inject faults. */
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

/* One submission's worth of recycled objects. */
struct kd_vk_slot {
    VkCommandPool pool;
    VkCommandBuffer commands;
    struct kd_vk_descriptors descriptors;
    struct kd_vk_stamps stamps;
    uint64_t submitted_ns;
};

/* One slot more than submissions may be under way, for the one that is being recorded. */
#define KD_VK_SLOTS (KD_VK_IN_FLIGHT + 1)

struct kd_vk {
    struct kd_vk_functions fn; /* complete; instance.fn lacks the device's part */
    struct kd_vk_instance instance;
    struct kd_vk_physical physical;
    char choice[640];
    bool compiles_only, pipelines_only; /* as kd_vk_params */
    VkDevice device;
    VkQueue queue;

    struct kd_vk_heap heap;
    struct kd_vk_cache cache;
    struct kd_vk_retired *retired; /* destroyed by the caller, perhaps still used by the device */
    struct kd_vk_buffer *mapped;   /* those that the host sees and whose memory is not coherent */
    uint64_t next_buffer_id;
    uint32_t n_buffers;
    atomic_uint n_pipelines; /* alive, for the warning at the end */

    VkSemaphore timeline;
    struct kd_vk_slot slots[KD_VK_SLOTS];
    bool recording;
    uint64_t submitted, done; /* timeline values: last submitted, last seen finished */
    uint64_t progress_ns;     /* when `done` last grew: the next submission's deadline starts there */
    uint64_t deadline_ns;
    struct kd_vk_hazards hazards, hazards_before; /* now, and when recording began */
    struct kd_vk_timing timing;

    char lost[256]; /* why the device cannot be used any more, "" while it can */
    bool hangs;     /* it is lost because it missed a deadline: what is under way may never end */
    struct kd_vk *next_lost;
};

/* KD_EDEVICE, with the reason, once the device is lost. */
enum kd_status kd_vk_alive(const struct kd_vk *vk, struct kd_error *error);
/* Declare it lost for good; returns KD_EDEVICE. */
enum kd_status kd_vk_lose(struct kd_vk *vk, struct kd_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The timeline value that the commands now being recorded will have. */
static inline uint64_t kd_vk_current(const struct kd_vk *vk) { return vk->submitted + 1; }

#endif
