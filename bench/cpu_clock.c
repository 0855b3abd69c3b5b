/* A library that makes passes be timed in processor time instead of wall time, for a machine on which other programs
 * run. The library is preloaded into kd_bench_frame:
 *
 *     LD_PRELOAD=build/bench/libkd_bench_cpu_clock.so LP_NUM_THREADS=1 build/bench/kd_bench_frame -s SCENE.json
 *
 * lavapipe reads its timestamps from CLOCK_MONOTONIC on threads of its own. On these threads the library returns the
 * process's processor time instead. On the main thread CLOCK_MONOTONIC is unchanged, because that thread waits with
 * deadlines. */
#include <stdbool.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, struct timespec *out)
{
    static _Thread_local int thread; /* kind of the calling thread; 0: not determined yet */
    if (!thread)
        thread = (int)syscall(SYS_gettid);
    const bool own = thread == getpid();
    return (int)syscall(SYS_clock_gettime, clock == CLOCK_MONOTONIC && !own ? CLOCK_PROCESS_CPUTIME_ID : clock, out);
}
