/* The memory limit for pictures: the minimum of what the device has, what --memory allows, and, where the device uses
 * the host's memory, what the host has left. */
#ifndef KD_RENDER_DEVICE_MEMORY_SHARE_H
#define KD_RENDER_DEVICE_MEMORY_SHARE_H

#include "base/memory_limit.h"
#include "render/plan/plan.h"

/* Two thirds of what pictures may take in all are what one may be planned with, its capacity. Large ones that are
 * rendered side by side have no more than that between them; a third is for small ones, and for what is kept from
 * earlier ones (server/render/queue.h, frame/frame.c). Pure. */
static inline uint64_t kd_memory_main(uint64_t all) { return all / 3 * 2; }

/* Narrows a capacity to what the host leaves. Where the device's memory is the host's, pictures get three quarters
 * of it, and frames on their way to a file or client count, too; the rest is for those already rendered, bodies and
 * answers. Elsewhere only the frames lie in the host's memory. held: of what the process holds already, the bytes of
 * device buffers, which a next picture takes over. Pure. */
void kd_memory_narrow(struct kd_capacity *capacity, const struct kd_memory_limit *host, uint64_t held);

/* The host's limit as it was at most KD_MEMORY_FRESH_MS ago; the last one known where it cannot be read, out of
 * descriptors. One thread at a time. Starts as zeros. */
#define KD_MEMORY_FRESH_MS 250.0
struct kd_memory_watch {
    struct kd_memory_limit limit;
    bool known;
    double read_ms;
};
void kd_memory_watch(struct kd_memory_watch *watch, double now_ms);

#endif
