/* The memory that this process may still use before the kernel kills it. Linux. Any thread. It is the minimum of
 * several amounts: MemAvailable (proc_meminfo(5)), and, for each control group that contains the process, the unused
 * part of memory.max (in version 1: memory.limit_in_bytes; Documentation/admin-guide/cgroup-v2.rst and
 * cgroup-v1/memory.rst of Linux). Inactive file pages count as unused, because the kernel drops them first. */
#ifndef KD_BASE_MEMORY_LIMIT_H
#define KD_BASE_MEMORY_LIMIT_H

#include <stdbool.h>
#include <stdint.h>

struct kd_memory_limit {
    uint64_t left; /* number of bytes that the process may still allocate */
    uint64_t own;  /* resident memory in bytes that is not backed by files; 0 if unknown */
    /* Name of the limit that applies, for a message: "the memory that is available", or "the memory.max of a control
     * group". */
    const char *by;
};

/* Number of bytes that the process may still allocate within the limits of its address space (RLIMIT_AS, `ulimit
 * -v`) and of its data (RLIMIT_DATA, `ulimit -d`). UINT64_MAX if neither limit is set, or if the use cannot be read. */
uint64_t kd_address_space_left(void);

/* Returns false if MemAvailable cannot be read, because no descriptors are left or /proc is missing. root: prefix of
 * all paths; it is "" except in tests. */
bool kd_memory_limit_read(const char *root, struct kd_memory_limit *out);

#endif
