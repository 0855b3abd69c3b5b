/* Compiled only with -Dwatch=true. The linker then redirects calls that concern locks and disks to this file, which
 * reports them to base/watch.h. */
#include "base/watch.h"

#ifdef KD_WATCH
#include <pthread.h>
#include <unistd.h>

/* The linker's option --wrap redirects kerrd's calls of NAME to __wrap_NAME, which in turn calls __real_NAME. */
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
    kd_watch_taken(lock);
    return code;
}

int __wrap_pthread_mutex_clocklock(pthread_mutex_t *lock, clockid_t clock, const struct timespec *until)
{
    int code = __real_pthread_mutex_clocklock(lock, clock, until);
    if (!code)
        kd_watch_taken(lock);
    return code;
}

int __wrap_pthread_mutex_unlock(pthread_mutex_t *lock)
{
    int code = __real_pthread_mutex_unlock(lock);
    kd_watch_given(lock);
    return code;
}

int __wrap_pthread_mutex_destroy(pthread_mutex_t *lock)
{
    kd_watch_forget(lock);
    return __real_pthread_mutex_destroy(lock);
}

int __wrap_pthread_cond_wait(pthread_cond_t *condition, pthread_mutex_t *lock)
{
    kd_watch_given(lock);
    int code = __real_pthread_cond_wait(condition, lock);
    kd_watch_taken(lock);
    return code;
}

int __wrap_pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *lock, const struct timespec *until)
{
    kd_watch_given(lock);
    int code = __real_pthread_cond_timedwait(condition, lock, until);
    kd_watch_taken(lock);
    return code;
}

int __wrap_pthread_cond_clockwait(pthread_cond_t *condition, pthread_mutex_t *lock, clockid_t clock,
                                  const struct timespec *until)
{
    kd_watch_given(lock);
    int code = __real_pthread_cond_clockwait(condition, lock, clock, until);
    kd_watch_taken(lock);
    return code;
}

int __wrap_fsync(int fd)
{
    kd_watch_disk(true);
    return __real_fsync(fd);
}

int __wrap_unlink(const char *path)
{
    kd_watch_disk(false);
    return __real_unlink(path);
}

int __wrap_unlinkat(int folder, const char *path, int flags)
{
    kd_watch_disk(false);
    return __real_unlinkat(folder, path, flags);
}
#else
typedef int kd_watch_calls_are_off; /* a translation unit must not be empty (C11, section 6.9) */
#endif
