/* The monotonic clock, in milliseconds. */
#ifndef KD_BASE_CLOCK_H
#define KD_BASE_CLOCK_H

#include <pthread.h>
#include <stdbool.h>
#include <time.h>
#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

static inline double kd_clock_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Takes the lock. Returns false if this takes longer than `ms` milliseconds. */
static inline bool kd_clock_lock(pthread_mutex_t *lock, double ms)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    long long ns = t.tv_nsec + (long long)(ms * 1e6);
    t.tv_sec += (time_t)(ns / 1000000000);
    t.tv_nsec = (long)(ns % 1000000000);
#ifdef __SANITIZE_THREAD__ /* gcc's thread sanitizer does not intercept pthread_mutex_clocklock */
    __tsan_mutex_pre_lock(lock, __tsan_mutex_try_lock);
    const bool locked = !pthread_mutex_clocklock(lock, CLOCK_MONOTONIC, &t);
    __tsan_mutex_post_lock(lock, __tsan_mutex_try_lock | (locked ? 0 : __tsan_mutex_try_lock_failed), 0);
    return locked;
#else
    return !pthread_mutex_clocklock(lock, CLOCK_MONOTONIC, &t);
#endif
}

#endif
