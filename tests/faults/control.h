/* Shared memory between a test and the library that is preloaded into the program under test: which faults to
 * inject, and their counts. It is a file named by KD_FAULTS, which both map (faults.py has the same fields in the
 * same order). Any thread. */
#ifndef KD_TESTS_FAULTS_CONTROL_H
#define KD_TESTS_FAULTS_CONTROL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_FAULT_BLOCKS = 1 << 16, KD_FAULT_STACKS = 1 << 12 };

/* Kinds of operations on files, for files_mask. */
enum {
    KD_FAULT_OPEN = 1,   /* an existing file or folder */
    KD_FAULT_CREATE = 2, /* creates a file or a folder */
    KD_FAULT_WRITE = 4,  /* writes to a regular file; the operations below are also on regular files */
    KD_FAULT_READ = 8,
    KD_FAULT_SYNC = 16, /* folders too */
    KD_FAULT_RENAME = 32,
    KD_FAULT_CLOSE = 64, /* closes a file opened for writing */
};

struct kd_faults {
    _Atomic int64_t fail_at;     /* allocations before one fails; negative: none fails */
    _Atomic int64_t fail_for;    /* number of successive failures; 0 counts as 1 */
    _Atomic int64_t allocations; /* number of allocations since the start */
    _Atomic int64_t failed;      /* number of failed allocations */
    /* 0: no effect. 1: each stack of an allocation is recorded in `stacks`. Any other value: fail_at counts only
     * allocations with this stack. */
    _Atomic int64_t by_stack;
    /* failed allocations that libmicrohttpd requested, after which it closes the connection */
    _Atomic int64_t by_library;
    _Atomic int64_t failed_from; /* caller of the last failed allocation, as in `blocks` */
    _Atomic int64_t files_mask;  /* bit mask of the file operations that count */
    _Atomic int64_t files_at;    /* operations before one fails; negative: none fails */
    _Atomic int64_t files_for;   /* as fail_for */
    _Atomic int64_t files_errno; /* the error to return */
    _Atomic int64_t files_count; /* operations counted since the start */
    _Atomic int64_t files_failed;
    /* 1: opening a file for reading blocks until this is 0 again. 2: so do fsync and unlink. */
    _Atomic int64_t files_slow;
    _Atomic int64_t files_waiting;  /* number of threads blocked by files_slow */
    _Atomic int64_t wall_s;         /* offset of the wall clock, s */
    _Atomic int64_t steady_ms;      /* offset of the monotonic clock, ms */
    _Atomic int64_t steady_step_ms; /* increase of the monotonic clock's offset at each reading */
    _Atomic int64_t looks;          /* number of readings of a clock that was ahead */
    _Atomic int64_t live;           /* number of blocks not freed; details follow */
    struct kd_fault_block {
        _Atomic uint64_t at; /* address of the block; 0: free slot */
        /* Caller: the number of the object << 48, 0 for the program, and the return address within it. */
        _Atomic uint64_t from;
    } blocks[KD_FAULT_BLOCKS];
    struct kd_fault_stack {
        _Atomic int64_t stack; /* hash of its return addresses, the same in each process; 0: free slot */
        _Atomic uint64_t from; /* as in `blocks` */
        _Atomic int64_t count; /* allocations */
    } stacks[KD_FAULT_STACKS];
};

extern struct kd_faults *kd_faults; /* never NULL: if there is no file, a default that injects no fault */

/* True if code at this address belongs to the program, or to a library that it is linked with, except the C library.
 * False for a driver that the program loads. *where: as in `blocks`. */
bool kd_fault_ours(const void *caller, uint64_t *where);

/* Counts down to the next failure; true if this operation must fail. */
static inline bool kd_fault_next(_Atomic int64_t *at, _Atomic int64_t *in_a_row)
{
    if (atomic_load(at) < 0)
        return false;
    int64_t before = atomic_fetch_sub(at, 1);
    if (before > 0)
        return false;
    int64_t most = atomic_load(in_a_row);
    if (before == 0 && most > 1)
        atomic_store(in_a_row, most - 1), atomic_store(at, 0);
    return before == 0;
}

#define KD_FAULT_REAL(result, name, ...) \
    static result (*real)(__VA_ARGS__); \
    if (!real) \
    real = (result (*)(__VA_ARGS__))(uintptr_t)dlsym(RTLD_NEXT, name)

#endif
