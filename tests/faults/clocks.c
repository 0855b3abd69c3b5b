/* Preloaded: sets clocks ahead when a test requests it (control.h), as seen by the program and the libraries that it is
 * linked with. A timed wait on such a clock lasts as long as it would without the fault. */
#include "control.h"

#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

static void put(struct timespec *t, int64_t ms)
{
    int64_t ns = t->tv_nsec + ms % 1000 * 1000000;
    t->tv_sec += ms / 1000 + (ns < 0 ? -1 : ns / 1000000000);
    t->tv_nsec = ns < 0 ? ns + 1000000000 : ns % 1000000000;
}

static int64_t ahead_ms(clockid_t clock, const void *caller)
{
    uint64_t where;
    const bool steady = clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_COARSE || clock == CLOCK_BOOTTIME;
    if ((!steady && clock != CLOCK_REALTIME) || !kd_fault_ours(caller, &where))
        return 0;
    atomic_fetch_add(&kd_faults->looks,
                     atomic_load(&kd_faults->wall_s) && !steady
                         ? 1
                         : steady && (atomic_load(&kd_faults->steady_ms) || atomic_load(&kd_faults->steady_step_ms)));
    return steady ? atomic_fetch_add(&kd_faults->steady_ms, atomic_load(&kd_faults->steady_step_ms))
                  : 1000 * atomic_load(&kd_faults->wall_s);
}

int clock_gettime(clockid_t clock, struct timespec *out)
{
    KD_FAULT_REAL(int, "clock_gettime", clockid_t, struct timespec *);
    int result = real(clock, out);
    put(out, ahead_ms(clock, __builtin_return_address(0)));
    return result;
}

time_t time(time_t *out)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    put(&t, ahead_ms(CLOCK_REALTIME, __builtin_return_address(0)));
    if (out)
        *out = t.tv_sec;
    return t.tv_sec;
}

int pthread_cond_clockwait(pthread_cond_t *condition, pthread_mutex_t *lock, clockid_t clock,
                           const struct timespec *until)
{
    KD_FAULT_REAL(int, "pthread_cond_clockwait", pthread_cond_t *, pthread_mutex_t *, clockid_t,
                  const struct timespec *);
    struct timespec t = *until;
    put(&t, -ahead_ms(clock, __builtin_return_address(0)));
    return real(condition, lock, clock, &t);
}

int pthread_mutex_clocklock(pthread_mutex_t *lock, clockid_t clock, const struct timespec *until)
{
    KD_FAULT_REAL(int, "pthread_mutex_clocklock", pthread_mutex_t *, clockid_t, const struct timespec *);
    struct timespec t = *until;
    put(&t, -ahead_ms(clock, __builtin_return_address(0)));
    return real(lock, clock, &t);
}
