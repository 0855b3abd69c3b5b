/* What a test says of faults, and what has come of it, in a file that KD_FAULTS names and both have mapped
 * (faults.py has the same fields in the same order). Private to the library that is preloaded into a program under
 * test; any thread. */
#ifndef KD_TESTS_FAULTS_CONTROL_H
#define KD_TESTS_FAULTS_CONTROL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_FAULT_BLOCKS = 1 << 16, KD_FAULT_STACKS = 1 << 12 };

/* Operations on files, for files_mask. */
enum {
    KD_FAULT_OPEN = 1,   /* what is there, folders too */
    KD_FAULT_CREATE = 2, /* a file or a folder */
    KD_FAULT_WRITE = 4,  /* to a regular file, as those below */
    KD_FAULT_READ = 8,
    KD_FAULT_SYNC = 16, /* folders too */
    KD_FAULT_RENAME = 32,
    KD_FAULT_CLOSE = 64, /* what was open for writing */
};

struct kd_faults {
    _Atomic int64_t fail_at;     /* allocations before one fails; below 0: none does */
    _Atomic int64_t fail_for;    /* how many then fail in a row; 0 is as 1 */
    _Atomic int64_t allocations; /* since the start */
    _Atomic int64_t failed;      /* of them */
    _Atomic int64_t by_stack;   /* 1: each stack by which an allocation is asked for is noted in `stacks`; else, but for
                                   0, fail_at counts those by this stack alone */
    _Atomic int64_t by_library; /* of those: asked for by libmicrohttpd, which then closes the connection */
    _Atomic int64_t failed_from; /* where the last that failed was asked for, as in `blocks` */
    _Atomic int64_t files_mask;  /* the operations on files that are counted */
    _Atomic int64_t files_at;    /* of them before one fails; below 0: none does */
    _Atomic int64_t files_for;   /* as fail_for */
    _Atomic int64_t files_errno; /* with which */
    _Atomic int64_t files_count; /* operations counted since the start */
    _Atomic int64_t files_failed;
    _Atomic int64_t files_slow; /* 1: files are not opened for reading before it is 0 again; 2: nothing is written down
                                   or removed (fsync, unlink) */
    _Atomic int64_t files_waiting;  /* for that */
    _Atomic int64_t wall_s;         /* how far the clock on the wall is put forward */
    _Atomic int64_t steady_ms;      /* and the one that nobody sets, */
    _Atomic int64_t steady_step_ms; /* and how much further each time somebody looks at it */
    _Atomic int64_t looks;          /* at a clock that was ahead */
    _Atomic int64_t live;           /* blocks that are not freed: */
    struct kd_fault_block {
        _Atomic uint64_t at; /* 0: none here */
        _Atomic uint64_t
            from; /* the number of the object that asked for it << 48, 0 the program, and the return address within */
    } blocks[KD_FAULT_BLOCKS];
    struct kd_fault_stack {
        _Atomic int64_t stack; /* a number made of its return addresses, the same in each process; 0: none here */
        _Atomic uint64_t from; /* as in `blocks` */
        _Atomic int64_t count; /* allocations */
    } stacks[KD_FAULT_STACKS];
};

extern struct kd_faults *kd_faults; /* never NULL: without a file one that lets nothing fail */

/* Whether code at this address is of the program, or of a library that it is linked with, the C library's own aside:
 * not of a driver that it loads. Where: as in `blocks`. */
bool kd_fault_ours(const void *caller, uint64_t *where);

/* Counts down to the next one that fails. */
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
