/* Memory that this process holds, for tests of what a refusal gives back. One thread. */
#ifndef KD_TESTS_HELD_H
#define KD_TESTS_HELD_H

#include <malloc.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

/* Begins the program again with a heap that counts a block as free as soon as it is: malloc counts those that it
 * keeps for a thread as given out. First thing in main. */
static inline void kd_held_begin(char **argv)
{
    if (!getenv("GLIBC_TUNABLES") && !setenv("GLIBC_TUNABLES", "glibc.malloc.tcache_count=0", 1))
        execv("/proc/self/exe", argv);
}

/* Bytes that malloc has given out and that are not freed; 0 always under a sanitizer, which looks for leaks itself. */
static inline size_t kd_held(void)
{
    const struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

#endif
