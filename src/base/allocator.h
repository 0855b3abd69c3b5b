/* Settings of the C library's allocator for a process that runs for long and whose threads allocate and free large
 * blocks all the time. */
#ifndef KD_BASE_ALLOCATOR_H
#define KD_BASE_ALLOCATOR_H

#include <stddef.h>

/* Blocks of 1 MiB and more go back to the kernel when they are freed, and threads share as many heaps as there are
 * processors, at least 4. By itself glibc raises the first limit up to 32 MiB once such a block has been freed, and
 * lets threads have 8 heaps a processor, in each of which holes stay: a server that did everything at full speed for
 * half an hour (bench/soak.py) then held 1.3 GiB, of which a tenth had come after the first quarter; so it is 0.95
 * GiB. Nothing where the environment (MALLOC_ARENA_MAX, MALLOC_MMAP_THRESHOLD_, GLIBC_TUNABLES) says otherwise, or
 * the library is another one. At the start, before there are threads. */
void kd_allocator_for_long(void);
/* Gives free memory of all heaps back to the kernel: tens of milliseconds, for when there is nothing to do. Any
 * thread. */
void kd_allocator_trim(void);
/* Bytes of all heaps that are in use, without blocks that were mapped by themselves; 0 where the library does not tell.
 * It goes through the free blocks: up to some milliseconds. Any thread. */
size_t kd_allocator_used(void);

#endif
