#include "base/allocator.h"

#include "base/cores.h"

#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#define LARGE (1 << 20)
#define LEAST_HEAPS 4

void kd_allocator_for_long(void)
{
#ifdef __GLIBC__
    if (getenv("MALLOC_ARENA_MAX") || getenv("MALLOC_MMAP_THRESHOLD_") || getenv("GLIBC_TUNABLES"))
        return;
    const int cores = (int)kd_cores();
    mallopt(M_ARENA_MAX, cores > LEAST_HEAPS ? cores : LEAST_HEAPS);
    mallopt(M_MMAP_THRESHOLD, LARGE);
    mallopt(M_TRIM_THRESHOLD, 2 * LARGE);
#endif
}

void kd_allocator_trim(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

size_t kd_allocator_used(void)
{
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    return mallinfo2().uordblks;
#else
    return 0;
#endif
}
