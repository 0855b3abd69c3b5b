/* The memory that this process may use before the kernel kills it. Linux. Any thread.
 *
 * The limit is the smallest of several amounts. One is MemAvailable (proc_meminfo(5)). The others are the unused parts
 * of memory.max of each control group that contains the process, or of memory.limit_in_bytes in version 1
 * (Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst of Linux). Inactive file pages do not count as
 * used, because the kernel drops them first. */
#ifndef KD_BASE_MEMORY_LIMIT_H
#define KD_BASE_MEMORY_LIMIT_H

#include <stdbool.h>
#include <stdint.h>

struct kd_memory_limit {
    uint64_t left; /* bytes that the process may still allocate */
    uint64_t own;  /* bytes of resident memory not backed by files; 0 if unknown */
    /* Name of the limit that applies, for a message: "the memory that is available", "the memory.max of a control
     * group". */
    const char *by;
};

/* Bytes that the process may still allocate within the limits of address space (RLIMIT_AS, `ulimit -v`) and of data
 * (RLIMIT_DATA, `ulimit -d`). UINT64_MAX: neither limit is set, or the use cannot be read. */
uint64_t kd_address_space_left(void);

/* Returns false if not even MemAvailable can be read: no descriptors are left, or /proc is missing. root: prefix of
 * every path; "" except in tests. */
bool kd_memory_limit_read(const char *root, struct kd_memory_limit *out);

#endif
