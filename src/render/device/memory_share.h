/* Memory limit for pictures. It is the least of two or three numbers: the device's memory, the --memory option and,
 * if the device uses host memory, the memory that the host has left. */
#ifndef KD_RENDER_DEVICE_MEMORY_SHARE_H
#define KD_RENDER_DEVICE_MEMORY_SHARE_H

#include "base/memory_limit.h"
#include "render/plan/plan.h"

/* The part of a memory limit for which pictures are planned: two thirds. Large pictures that are rendered concurrently
 * share these two thirds. The last third is for small pictures and for caches (server/render/queue.h, frame/frame.c).
 * Pure. */
static inline uint64_t kd_memory_main(uint64_t all) { return all / 3 * 2; }

/* Reduces a capacity to what the host has left. Three quarters of what is left are the memory limit, of which pictures
 * get kd_memory_main. The last quarter is for finished frames, bodies and responses. If device memory is host memory,
 * memory_bytes is reduced to the pictures' part; plans then count their frames as well (plan/room.c). If the device has
 * memory of its own, the pictures' part becomes host_bytes, which is for frames only. held: bytes of the process's
 * device buffers, which the next picture reuses. Pure. */
void kd_memory_narrow(struct kd_capacity *capacity, const struct kd_memory_limit *host, uint64_t held);

/* Gets the host's memory limit. A limit that was read less than KD_MEMORY_FRESH_MS ago is returned again. If it
 * cannot be read because no file descriptor is free, the last known limit is returned. One thread at a time.
 * Initialise the watch with zeros. */
#define KD_MEMORY_FRESH_MS 250.0
struct kd_memory_watch {
    struct kd_memory_limit limit;
    bool known;
    double read_ms;
};
void kd_memory_watch(struct kd_memory_watch *watch, double now_ms);

#endif
