#include "base/cores.h"

#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <unistd.h>

unsigned kd_cores(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) ? 1 : (unsigned)CPU_COUNT(&set);
}

/* Number of runnable threads, including this one. /proc/loadavg reads like "0.20 0.18 0.12 1/80 11206"; the number
 * is the one before the slash. */
static long running(void)
{
    char text[128];
    long n = 1;
    const int file = open("/proc/loadavg", O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0)
        close(file);
    if (size <= 0)
        return 1;
    text[size] = 0;
    return sscanf(text, "%*s %*s %*s %ld", &n) == 1 && n > 1 ? n : 1;
}

int kd_cores_idle(void)
{
    const long own = kd_cores(), online = sysconf(_SC_NPROCESSORS_ONLN), all = online > own ? online : own;
    return (int)((all - running()) * own / all);
}
