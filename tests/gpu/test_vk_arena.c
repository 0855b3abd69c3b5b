/* Compares the suballocator with a map of bytes: blocks must not overlap, and all memory must be recovered. */
#include "support.h"

#include "vk/arena.h"

enum { size = 4096, unit = 16, most = 64 };

struct taken { uint64_t offset, size; };

static void check(const struct kd_vk_arena *arena, const struct taken *taken, size_t n)
{
    uint8_t owner[size] = { 0 };
    uint64_t last = 0;
    for (size_t i = 0; i < n; i++)
        for (uint64_t b = taken[i].offset; b < taken[i].offset + taken[i].size; b++)
            assert_int_equal(owner[b]++, 0);
    for (size_t i = 0; i < arena->n_free; i++) {
        assert_true(arena->free[i].begin < arena->free[i].end);
        assert_true(i == 0 || arena->free[i].begin > last); /* neighbours have coalesced */
        last = arena->free[i].end;
        for (uint64_t b = arena->free[i].begin; b < last; b++)
            assert_int_equal(owner[b]++, 0);
    }
    for (size_t b = 0; b < size; b++)
        assert_int_equal(owner[b], 1);
    assert_int_equal(arena->live, n);
}

static void random_use(void **state)
{
    (void)state;
    srand(1);
    for (int round = 0; round < 20; round++) {
        struct kd_vk_arena arena;
        struct taken taken[most];
        size_t n = 0;
        int refused = 0;
        assert_true(kd_vk_arena_init(&arena, size));
        for (int step = 0; step < 400; step++) {
            uint64_t bytes = (uint64_t)unit * (1 + (unsigned)rand() % 24), align = (uint64_t)unit << rand() % 4;
            if (n < most && rand() % 3) {
                if (kd_vk_arena_take(&arena, bytes, align, &taken[n].offset)) {
                    assert_int_equal(taken[n].offset % align, 0);
                    taken[n++].size = bytes;
                } else {
                    refused++;
                }
            } else if (n) {
                size_t i = (size_t)rand() % n;
                kd_vk_arena_give(&arena, taken[i].offset, taken[i].size);
                taken[i] = taken[--n];
            }
            check(&arena, taken, n);
        }
        assert_true(refused > 0); /* checks that the sizes were large enough to fill the memory */
        while (n)
            n--, kd_vk_arena_give(&arena, taken[n].offset, taken[n].size);
        check(&arena, taken, 0);
        assert_int_equal(arena.n_free, 1);
        kd_vk_arena_finish(&arena);
    }
}

static void exact_fit(void **state)
{
    struct kd_vk_arena arena;
    uint64_t offset;
    (void)state;
    assert_true(kd_vk_arena_init(&arena, size));
    assert_false(kd_vk_arena_take(&arena, size + 1, 1, &offset));
    assert_false(kd_vk_arena_take(&arena, UINT64_MAX, 1, &offset));
    assert_true(kd_vk_arena_take(&arena, size, 256, &offset));
    assert_int_equal(arena.n_free, 0);
    assert_false(kd_vk_arena_take(&arena, 1, 1, &offset));
    kd_vk_arena_give(&arena, 0, size);
    assert_int_equal(arena.n_free, 1);
    kd_vk_arena_finish(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(random_use), cmocka_unit_test(exact_fit) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
