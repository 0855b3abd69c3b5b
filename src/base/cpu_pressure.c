#include "base/cpu_pressure.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

static void add(struct kd_cpu_pressure *sum, int tasks, const char *task)
{
    char path[64], text[128];
    double ran, waited;
    if (*task == '.' || snprintf(path, sizeof path, "%s/schedstat", task) >= (int)sizeof path)
        return;
    int file = openat(tasks, path, O_RDONLY | O_CLOEXEC);
    ssize_t n = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0)
        close(file);
    if (n <= 0)
        return; /* the thread has ended since the folder was listed */
    text[n] = 0;
    if (sscanf(text, "%lf %lf", &ran, &waited) == 2) {
        sum->ran_ns += ran;
        sum->waited_ns += waited;
    }
}

struct kd_cpu_pressure kd_cpu_pressure_now(void)
{
    struct kd_cpu_pressure sum = { 0 };
    DIR *tasks = opendir("/proc/self/task");
    if (!tasks)
        return sum;
    /* readdir is thread-safe here, because only this function uses the stream */
    for (const struct dirent *task = readdir(tasks); task; task = readdir(tasks))
        add(&sum, dirfd(tasks), task->d_name);
    closedir(tasks);
    return sum;
}

double kd_cpu_pressure_share(const struct kd_cpu_pressure *since)
{
    struct kd_cpu_pressure now = kd_cpu_pressure_now();
    double ran = now.ran_ns - since->ran_ns, waited = now.waited_ns - since->waited_ns;
    /* a negative difference means that some threads have ended since the earlier reading */
    return ran > 0 && waited > 0 ? ran / (ran + waited) : 1;
}
