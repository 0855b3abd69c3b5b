#include "base/watch.h"

#ifdef KD_WATCH
#include <execinfo.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define TURN_MS 50.0
#define LOCK_MS 2.0
enum { HELD = 16, KNOWN = 1 << 14, DEPTH = 24 };

static _Thread_local bool answers;
static _Thread_local double turn_ms; /* processor time of this thread at the start of its slice */
static _Thread_local struct {
    const void *lock;
    double since_ms;
    bool slow;
} held[HELD];
static _Thread_local unsigned n_held;
/* Hash table of locks, by address. The flags of a lock record what happened while it was held: ANSWERED, a thread
 * that answers requests has taken it; SYNCED, fsync was called. If two locks have the same slot, the later one
 * replaces the earlier one, so that a violation may be missed. */
enum { ANSWERED = 1, SYNCED = 2 };
static _Atomic uintptr_t known[KNOWN]; /* address of the lock; its two lowest bits hold the flags */

static double used_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* True if KERRD_WATCH=tell is set. Violations are then reported, and the program continues. */
static bool tells(void)
{
    const char *how = getenv("KERRD_WATCH");
    return how && !strcmp(how, "tell");
}

static void broken(const char *rule, double ms)
{
    char line[200];
    void *calls[DEPTH];
    int n = snprintf(line, sizeof line, ms > 0 ? "kerrd: watch: %s: %.1f ms\n" : "kerrd: watch: %s\n", rule, ms);
    if (write(STDERR_FILENO, line, (size_t)n) == n)
        backtrace_symbols_fd(calls, backtrace(calls, DEPTH), STDERR_FILENO);
    if (!tells())
        abort();
}

static _Atomic uintptr_t *place_of(const void *lock) { return &known[((uintptr_t)lock >> 4) * 2654435761u % KNOWN]; }

/* Sets a flag of a lock and returns all its flags. */
static unsigned note(const void *lock, unsigned what)
{
    _Atomic uintptr_t *place = place_of(lock);
    const uintptr_t at = atomic_load(place), mine = (uintptr_t)lock & ~(uintptr_t)3;
    if ((at & ~(uintptr_t)3) != mine)
        atomic_store(place, mine | what);
    else if (what & ~at)
        atomic_fetch_or(place, what);
    return (unsigned)((at & ~(uintptr_t)3) == mine ? (at & 3) | what : what);
}

void kd_watch_taken(const void *lock)
{
    if (answers && note(lock, ANSWERED) & SYNCED)
        broken("a thread that answers clients takes a lock that another thread has held during a disk write", 0);
    if (n_held < HELD) {
        held[n_held].lock = lock;
        held[n_held].since_ms = used_ms();
        held[n_held].slow = false;
    }
    n_held++;
}

/* On a shared machine, time of other processes may be counted as a thread's own. A violation is therefore reported
 * only if a thread exceeds the limit for the third time, or exceeds four times the limit once. */
static void too_long(const char *rule, double ms, double most_ms)
{
    static _Thread_local unsigned times;
    if (ms > most_ms && (tells() || ms > 4 * most_ms || ++times >= 3))
        broken(rule, ms);
}

void kd_watch_given(const void *lock)
{
    for (unsigned i = n_held < HELD ? n_held : HELD; i-- > 0;) {
        if (held[i].lock != lock)
            continue;
        const double ms = held[i].slow ? 0 : used_ms() - held[i].since_ms;
        memmove(held + i, held + i + 1, (size_t)(HELD - 1 - i) * sizeof *held);
        n_held--;
        too_long("a lock is held for too long", ms, LOCK_MS);
        return;
    }
}

void kd_watch_disk(bool syncs)
{
    if (answers)
        broken("a thread that answers clients waits for a disk", 0);
    for (unsigned i = 0; syncs && i < n_held && i < HELD; i++)
        if (note(held[i].lock, SYNCED) & ANSWERED)
            broken("a thread waits for a disk and holds a lock that a thread needs to answer clients", 0);
}

void kd_watch_forget(const void *lock) { atomic_store(place_of(lock), 0); }

void kd_watch_answers(void) { answers = true; }

void kd_watch_turn_begins(void) { turn_ms = used_ms(); }

void kd_watch_turn_ends(void) { too_long("a worker's turn is too long", used_ms() - turn_ms, TURN_MS); }

void kd_watch_slow_lock(void)
{
    if (answers)
        broken("a thread that answers clients takes a lock that is held while a device is opened", 0);
    if (n_held > 0 && n_held <= HELD)
        held[n_held - 1].slow = true;
}
#else
typedef int kd_watch_is_off; /* a translation unit must not be empty (C11, section 6.9) */
#endif
