#include "render/device/memory_share.h"

void kd_memory_narrow(struct kd_capacity *capacity, const struct kd_memory_limit *host, uint64_t held)
{
    /* only the resident part of device buffers counts, because pages that were never written use no memory yet */
    uint64_t reused = held < host->own ? held : host->own;
    uint64_t left = host->left > UINT64_MAX - reused ? UINT64_MAX : host->left + reused;
    uint64_t most = kd_memory_main(left / 4 * 3);
    if (!capacity->host_memory)
        capacity->host_bytes = most;
    else if (most < capacity->memory_bytes) {
        capacity->memory_bytes = most;
        capacity->memory_by = host->by;
    }
}

void kd_memory_watch(struct kd_memory_watch *watch, double now_ms)
{
    if (watch->known && now_ms - watch->read_ms < KD_MEMORY_FRESH_MS)
        return;
    watch->known = kd_memory_limit_read("", &watch->limit) || watch->known;
    watch->read_ms = now_ms;
}
