/* Memory allocated by this process, for tests of what a refusal frees. One thread. */
#ifndef KD_TESTS_HELD_H
#define KD_TESTS_HELD_H

#include <malloc.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

/* Restarts the program with a heap whose count excludes a freed block at once; otherwise malloc counts blocks cached
 * for a thread as allocated. Must be the first statement of main. */
static inline void kd_held_begin(char **argv)
{
    if (!getenv("GLIBC_TUNABLES") && !setenv("GLIBC_TUNABLES", "glibc.malloc.tcache_count=0", 1))
        execv("/proc/self/exe", argv);
}

/* Bytes allocated by malloc and not freed; always 0 under a sanitizer, which looks for leaks itself. */
static inline size_t kd_held(void)
{
    const struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

#endif
