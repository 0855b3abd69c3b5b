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
static _Thread_local double turn_ms; /* the thread's processor time when the slice began */
static _Thread_local struct {
    const void *lock;
    double since_ms;
} held[HELD];
static _Thread_local unsigned n_held;
/* Hash table of locks by address. Its flags tell what happened while a lock was held. If two locks have the same slot,
 * the later one replaces the other, so that a violation may be missed. */
enum { ANSWERED = 1, SYNCED = 2 };
static _Atomic uintptr_t known[KNOWN]; /* the address of the lock, with the two flags in its lowest bits */

static double used_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* Whether KERRD_WATCH=tell is set, which means: report violations and continue. */
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

static void taken(const void *lock)
{
    if (answers && note(lock, ANSWERED) & SYNCED)
        broken("a thread that answers clients takes a lock that another thread has held during a disk write", 0);
    if (n_held < HELD) {
        held[n_held].lock = lock;
        held[n_held].since_ms = used_ms();
    }
    n_held++;
}

/* On a shared machine, time that others took may count as a thread's own. So a limit counts as broken only at four
 * times its value, or when a thread exceeds it for the third time. */
static void too_long(const char *rule, double ms, double most_ms)
{
    static _Thread_local unsigned times;
    if (ms > most_ms && (tells() || ms > 4 * most_ms || ++times >= 3))
        broken(rule, ms);
}

static void given(const void *lock)
{
    for (unsigned i = n_held < HELD ? n_held : HELD; i-- > 0;) {
        if (held[i].lock != lock)
            continue;
        const double ms = used_ms() - held[i].since_ms;
        memmove(held + i, held + i + 1, (size_t)(HELD - 1 - i) * sizeof *held);
        n_held--;
        too_long("a lock is held for too long", ms, LOCK_MS);
        return;
    }
}

static void disk(bool syncs)
{
    if (answers)
        broken("a thread that answers clients waits for a disk", 0);
    for (unsigned i = 0; syncs && i < n_held && i < HELD; i++)
        if (note(held[i].lock, SYNCED) & ANSWERED)
            broken("a thread waits for a disk and holds a lock that a thread needs to answer clients", 0);
}

void kd_watch_answers(void) { answers = true; }

void kd_watch_turn_begins(void) { turn_ms = used_ms(); }

void kd_watch_turn_ends(void) { too_long("a worker's turn is too long", used_ms() - turn_ms, TURN_MS); }

/* The linker's --wrap redirects our calls of NAME to __wrap_NAME, which calls __real_NAME. */
#define REAL(type, name, ...) \
    type __real_##name(__VA_ARGS__); \
    type __wrap_##name(__VA_ARGS__)
REAL(int, pthread_mutex_lock, pthread_mutex_t *lock);
REAL(int, pthread_mutex_clocklock, pthread_mutex_t *lock, clockid_t clock, const struct timespec *until);
REAL(int, pthread_mutex_unlock, pthread_mutex_t *lock);
REAL(int, pthread_mutex_destroy, pthread_mutex_t *lock);
REAL(int, pthread_cond_wait, pthread_cond_t *condition, pthread_mutex_t *lock);
REAL(int, pthread_cond_timedwait, pthread_cond_t *condition, pthread_mutex_t *lock, const struct timespec *until);
REAL(int, pthread_cond_clockwait, pthread_cond_t *condition, pthread_mutex_t *lock, clockid_t clock,
     const struct timespec *until);
REAL(int, fsync, int fd);
REAL(int, unlink, const char *path);
REAL(int, unlinkat, int folder, const char *path, int flags);

int __wrap_pthread_mutex_lock(pthread_mutex_t *lock)
{
    int code = __real_pthread_mutex_lock(lock);
    taken(lock);
    return code;
}

int __wrap_pthread_mutex_clocklock(pthread_mutex_t *lock, clockid_t clock, const struct timespec *until)
{
    int code = __real_pthread_mutex_clocklock(lock, clock, until);
    if (!code)
        taken(lock);
    return code;
}

int __wrap_pthread_mutex_unlock(pthread_mutex_t *lock)
{
    int code = __real_pthread_mutex_unlock(lock);
    given(lock);
    return code;
}

int __wrap_pthread_mutex_destroy(pthread_mutex_t *lock)
{
    atomic_store(place_of(lock), 0);
    return __real_pthread_mutex_destroy(lock);
}

int __wrap_pthread_cond_wait(pthread_cond_t *condition, pthread_mutex_t *lock)
{
    given(lock);
    int code = __real_pthread_cond_wait(condition, lock);
    taken(lock);
    return code;
}

int __wrap_pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *lock, const struct timespec *until)
{
    given(lock);
    int code = __real_pthread_cond_timedwait(condition, lock, until);
    taken(lock);
    return code;
}

int __wrap_pthread_cond_clockwait(pthread_cond_t *condition, pthread_mutex_t *lock, clockid_t clock,
                                  const struct timespec *until)
{
    given(lock);
    int code = __real_pthread_cond_clockwait(condition, lock, clock, until);
    taken(lock);
    return code;
}

int __wrap_fsync(int fd)
{
    disk(true);
    return __real_fsync(fd);
}

int __wrap_unlink(const char *path)
{
    disk(false);
    return __real_unlink(path);
}

int __wrap_unlinkat(int folder, const char *path, int flags)
{
    disk(false);
    return __real_unlinkat(folder, path, flags);
}
#else
typedef int kd_watch_is_off; /* a translation unit must not be empty (C11, 6.9) */
#endif
