/* Tunes the C library's allocator for a process that runs for a long time and whose threads often allocate and free
 * large blocks. */
#ifndef KD_BASE_ALLOCATOR_H
#define KD_BASE_ALLOCATOR_H

#include <stddef.h>

/* Call it at the start, before there are threads. Blocks of 1 MiB and more then return to the kernel when they are
 * freed, and threads share as many heaps as there are processors, at least 4.
 *
 * By default glibc raises this size limit, up to 32 MiB, whenever such a block is freed. It also allows 8 heaps for
 * each processor, and each heap becomes fragmented. With these defaults a server held 1.3 GiB after half an hour at
 * full load (bench/soak.py); a tenth of that was added in the last three quarters of the time. With the settings of
 * this function it holds 0.95 GiB. Does nothing if the environment sets its own values (MALLOC_ARENA_MAX,
 * MALLOC_MMAP_THRESHOLD_, GLIBC_TUNABLES), or with another C library. */
void kd_allocator_for_long(void);
/* Returns the free memory of all heaps to the kernel. That takes tens of milliseconds, so call it when idle. Any
 * thread. */
void kd_allocator_trim(void);
/* Bytes in use in all heaps, not counting blocks that were mapped individually; 0 if the library does not report
 * them. The count visits all free blocks, which can take some milliseconds. Any thread. */
size_t kd_allocator_used(void);

#endif
