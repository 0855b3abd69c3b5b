/* Tests that a long-running process returns large blocks to the kernel, and that its threads share heaps. Both are
 * checked with the C library's own statistics. */
#include "base/allocator.h"
#include "base/cores.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#include <malloc.h>

#define MIB ((size_t)1 << 20)
#define THREADS 64

static size_t mapped(void) { return mallinfo2().hblks; }

/* The block is written to, so that the compiler does not remove the allocation. */
static void *block(size_t size)
{
    char *p = malloc(size);
    assert_non_null(p);
    *(volatile char *)p = 1;
    return p;
}

static void large_blocks_are_the_kernels_again(void **state)
{
    (void)state;
    const size_t before = mapped();
    free(block(16 * MIB)); /* after this, the C library would cache all smaller blocks by default */
    void *large = block(2 * MIB);
    assert_int_equal(mapped(), before + 1);
    free(large);
    assert_int_equal(mapped(), before);
}

static void *use(void *barrier)
{
    void *p = block(1000);
    pthread_barrier_wait(barrier);
    free(p);
    return NULL;
}

static unsigned heaps(void)
{
    char *text = NULL;
    size_t size = 0;
    unsigned n = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_int_equal(malloc_info(0, out), 0);
    fclose(out);
    for (const char *at = text; (at = strstr(at, "<heap nr=")); at++)
        n++;
    free(text);
    return n;
}

static void threads_share_heaps(void **state)
{
    (void)state;
    pthread_t threads[THREADS];
    pthread_barrier_t barrier;
    pthread_barrier_init(&barrier, NULL, THREADS);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, use, &barrier), 0);
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&barrier);
    assert_in_range(heaps(), 1, kd_cores() > 4 ? kd_cores() : 4);
}
#else
static void large_blocks_are_the_kernels_again(void **state) { (void)state, skip(); }
static void threads_share_heaps(void **state) { (void)state, skip(); }
#endif

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(large_blocks_are_the_kernels_again),
                                        cmocka_unit_test(threads_share_heaps) };
    unsetenv("MALLOC_ARENA_MAX"), unsetenv("MALLOC_MMAP_THRESHOLD_"), unsetenv("GLIBC_TUNABLES");
    kd_allocator_for_long();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
