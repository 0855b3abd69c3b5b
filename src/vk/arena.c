#include "vk/arena.h"

#include <stdlib.h>
#include <string.h>

/* Makes room for a number of gaps: n allocations leave at most n + 1. */
static bool reserve(struct kd_vk_arena *arena, size_t gaps)
{
    if (gaps <= arena->capacity)
        return true;
    size_t capacity = arena->capacity ? 2 * arena->capacity : 16;
    struct kd_vk_span *grown = realloc(arena->free, capacity * sizeof *grown);
    if (!grown)
        return false;
    arena->free = grown;
    arena->capacity = capacity;
    return true;
}

bool kd_vk_arena_init(struct kd_vk_arena *arena, uint64_t size)
{
    *arena = (struct kd_vk_arena) { .size = size };
    if (!reserve(arena, 1))
        return false;
    arena->free[0] = (struct kd_vk_span) { 0, size };
    arena->n_free = 1;
    return true;
}

void kd_vk_arena_finish(struct kd_vk_arena *arena)
{
    free(arena->free);
    *arena = (struct kd_vk_arena) { 0 };
}

static void insert(struct kd_vk_arena *arena, size_t at, struct kd_vk_span span)
{
    memmove(arena->free + at + 1, arena->free + at, (arena->n_free - at) * sizeof *arena->free);
    arena->free[at] = span;
    arena->n_free++;
}

static void erase(struct kd_vk_arena *arena, size_t at)
{
    arena->n_free--;
    memmove(arena->free + at, arena->free + at + 1, (arena->n_free - at) * sizeof *arena->free);
}

bool kd_vk_arena_take(struct kd_vk_arena *arena, uint64_t size, uint64_t alignment, uint64_t *offset)
{
    if (!reserve(arena, arena->live + 2))
        return false;
    for (size_t i = 0; i < arena->n_free; i++) {
        struct kd_vk_span gap = arena->free[i];
        uint64_t begin = (gap.begin + alignment - 1) & ~(alignment - 1);
        if (begin >= gap.end || gap.end - begin < size)
            continue;
        struct kd_vk_span before = { gap.begin, begin }, after = { begin + size, gap.end };
        erase(arena, i);
        if (after.begin < after.end)
            insert(arena, i, after);
        if (before.begin < before.end)
            insert(arena, i, before);
        arena->live++;
        *offset = begin;
        return true;
    }
    return false;
}

void kd_vk_arena_give(struct kd_vk_arena *arena, uint64_t offset, uint64_t size)
{
    size_t at = 0;
    while (at < arena->n_free && arena->free[at].begin < offset)
        at++;
    insert(arena, at, (struct kd_vk_span) { offset, offset + size });
    if (at + 1 < arena->n_free && arena->free[at].end == arena->free[at + 1].begin) {
        arena->free[at].end = arena->free[at + 1].end;
        erase(arena, at + 1);
    }
    if (at > 0 && arena->free[at - 1].end == arena->free[at].begin) {
        arena->free[at - 1].end = arena->free[at].end;
        erase(arena, at);
    }
    arena->live--;
}
