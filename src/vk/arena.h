/* Arena: records which bytes of a range are free. It deals with offsets only, not with memory. It takes the first gap
 * that fits, in order of addresses; adjacent gaps are merged. Not thread-safe. */
#ifndef KD_VK_ARENA_H
#define KD_VK_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_vk_span { uint64_t begin, end; };

struct kd_vk_arena {
    struct kd_vk_span *free; /* the gaps, sorted by offset; no two of them touch */
    size_t n_free, capacity;
    size_t live; /* number of allocations */
    uint64_t size;
};

bool kd_vk_arena_init(struct kd_vk_arena *arena, uint64_t size); /* returns false when out of host memory */
void kd_vk_arena_finish(struct kd_vk_arena *arena);
/* Takes a range. alignment is a power of two. Returns false if no gap is large enough, or if host memory runs out. */
bool kd_vk_arena_take(struct kd_vk_arena *arena, uint64_t size, uint64_t alignment, uint64_t *offset);
/* Returns exactly the range that was taken. This cannot fail, because kd_vk_arena_take has reserved room for the
 * span. */
void kd_vk_arena_give(struct kd_vk_arena *arena, uint64_t offset, uint64_t size);

#endif
