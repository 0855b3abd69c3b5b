/* Tunes the C library's allocator for a long-running process whose threads often allocate and free large blocks. */
#ifndef KD_BASE_ALLOCATOR_H
#define KD_BASE_ALLOCATOR_H

#include <stddef.h>

/* Call this at the start, before there are threads. It has two effects: blocks of 1 MiB and more return to the
 * kernel when they are freed, and all threads share as many heaps as there are processors, at least 4.
 * glibc's defaults differ. Whenever such a block is freed, glibc raises the size limit, up to 32 MiB. It also
 * permits 8 heaps for each processor, and each heap becomes fragmented. With these defaults a server held 1.3 GiB
 * after half an hour at full load (bench/soak.py), and a tenth of this was added in the last three quarters of the
 * time. With the settings of this function it holds 0.95 GiB.
 * The function does nothing if the environment sets its own values (MALLOC_ARENA_MAX, MALLOC_MMAP_THRESHOLD_,
 * GLIBC_TUNABLES), or if the C library is not glibc. */
void kd_allocator_for_long(void);
/* Returns the free memory of all heaps to the kernel. This takes tens of milliseconds, so call it while the process
 * is idle. Any thread. */
void kd_allocator_trim(void);
/* Number of bytes in use in all heaps, without blocks that were mapped individually; 0 if the library does not
 * report it. The count visits all free blocks, which can take some milliseconds. Any thread. */
size_t kd_allocator_used(void);

#endif
