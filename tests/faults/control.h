/* Shared memory between a test and the library that is preloaded into the program under test: faults to inject, and
 * counts. The memory is a file named by KD_FAULTS, which the test and the library map. faults.py has the same fields in
 * the same order. Any thread may use it. */
#ifndef KD_TESTS_FAULTS_CONTROL_H
#define KD_TESTS_FAULTS_CONTROL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_FAULT_BLOCKS = 1 << 16, KD_FAULT_STACKS = 1 << 12 };

/* Kinds of operations on files, for files_mask. */
enum {
    KD_FAULT_OPEN = 1,   /* opens an existing file or folder */
    KD_FAULT_CREATE = 2, /* creates a file or a folder */
    KD_FAULT_WRITE = 4,  /* writes to a regular file; the operations below are also on regular files */
    KD_FAULT_READ = 8,
    KD_FAULT_SYNC = 16, /* folders too */
    KD_FAULT_RENAME = 32,
    KD_FAULT_CLOSE = 64, /* closes a file opened for writing */
};

struct kd_faults {
    _Atomic int64_t fail_at;     /* number of allocations that succeed before one fails; negative: none fails */
    _Atomic int64_t fail_for;    /* number of successive allocations that fail; 0 counts as 1 */
    _Atomic int64_t allocations; /* number of allocations since the start */
    _Atomic int64_t failed;      /* number of failed allocations */
    /* 0: no effect. 1: each stack of an allocation is recorded in `stacks`. Any other value: fail_at counts only
     * allocations with this stack. */
    _Atomic int64_t by_stack;
    /* number of failed allocations by libmicrohttpd, which then closes the connection */
    _Atomic int64_t by_library;
    _Atomic int64_t failed_from; /* caller of the last failed allocation, in the form of `caller` in `blocks` */
    _Atomic int64_t files_mask;  /* bit mask of the kinds of file operations that are counted and may fail */
    _Atomic int64_t files_at;    /* number of file operations that succeed before one fails; negative: none fails */
    _Atomic int64_t files_for;   /* as fail_for */
    _Atomic int64_t files_errno; /* errno of a failed file operation */
    _Atomic int64_t files_count; /* number of file operations since the start */
    _Atomic int64_t files_failed;
    /* 1: opening a file for reading blocks until this field is 0. 2: fsync and unlink block too. */
    _Atomic int64_t files_slow;
    _Atomic int64_t files_waiting;  /* number of threads blocked by files_slow */
    _Atomic int64_t wall_s;         /* offset of the wall clock, s */
    _Atomic int64_t steady_ms;      /* offset of the monotonic clock, ms */
    _Atomic int64_t steady_step_ms; /* added to the monotonic clock's offset at each reading */
    _Atomic int64_t looks;          /* number of readings that returned a time ahead */
    _Atomic int64_t live;           /* number of allocated blocks that are not freed; `blocks` has their details */
    struct kd_fault_block {
        _Atomic uint64_t at; /* address of the block; 0: free slot */
        /* Caller: number of the object << 48 (0: the program), plus the return address within the object. */
        _Atomic uint64_t from;
    } blocks[KD_FAULT_BLOCKS];
    struct kd_fault_stack {
        _Atomic int64_t stack; /* hash of the stack's return addresses, equal in each process; 0: free slot */
        _Atomic uint64_t from; /* as in `blocks` */
        _Atomic int64_t count; /* allocations */
    } stacks[KD_FAULT_STACKS];
};

extern struct kd_faults *kd_faults; /* Never NULL. Without a file it points to a default that injects no fault. */

/* True if code at this address belongs to the program, or to a library that it is linked with, except the C library.
 * False for a driver that the program loads. *where: the address in the form of `caller` in `blocks`. */
bool kd_fault_ours(const void *caller, uint64_t *where);

/* Counts down to the next failure. Returns true if this operation must fail. */
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
