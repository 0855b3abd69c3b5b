/* An arena knows which bytes of one range are free: offsets only, no memory. First fit in address order; neighbours
 * coalesce. Pure bookkeeping, not thread-safe. */
#ifndef KD_VK_ARENA_H
#define KD_VK_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_vk_span { uint64_t begin, end; };

struct kd_vk_arena {
    struct kd_vk_span *free; /* ascending, never touching one another */
    size_t n_free, capacity;
    size_t live; /* allocations */
    uint64_t size;
};

bool kd_vk_arena_init(struct kd_vk_arena *arena, uint64_t size); /* false: no host memory */
void kd_vk_arena_finish(struct kd_vk_arena *arena);
/* alignment is a power of two. False when there is no such gap (or no host memory). */
bool kd_vk_arena_take(struct kd_vk_arena *arena, uint64_t size, uint64_t alignment, uint64_t *offset);
/* Give back exactly what was taken. Cannot fail: take has made room for the span. */
void kd_vk_arena_give(struct kd_vk_arena *arena, uint64_t offset, uint64_t size);

#endif
