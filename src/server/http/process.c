#include "server/http/process.h"

#include "server/http/descriptors.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

struct process { double cpu_s, start_s, virtual_bytes, resident_bytes; /* NAN: unknown */ };

/* Files of /proc report size 0, so kd_read_file cannot read them. */
static bool read_text(const char *path, char *out, size_t size)
{
    FILE *file = fopen(path, "re");
    if (!file)
        return false;
    const size_t n = fread(out, 1, size - 1, file);
    fclose(file);
    out[n] = 0;
    return n > 0;
}

static double boot_time_s(void)
{
    char line[256];
    double s = NAN;
    FILE *file = fopen("/proc/stat", "re");
    while (file && isnan(s) && fgets(line, sizeof line, file))
        sscanf(line, "btime %lf", &s);
    if (file)
        fclose(file);
    return s;
}

/* Reads /proc/self/stat (proc(5)). The process name may contain any text and is skipped. The fields that are used
 * are numbers 14, 15 and 22 to 24. */
static struct process look(void)
{
    struct process p = { NAN, NAN, NAN, NAN };
    char text[1024];
    const double tick = (double)sysconf(_SC_CLK_TCK), page = (double)sysconf(_SC_PAGESIZE);
    double user, system, start, virtual_bytes, pages;
    const char *behind = read_text("/proc/self/stat", text, sizeof text) ? strrchr(text, ')') : NULL;
    if (!behind ||
        sscanf(behind + 1, " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lf %lf %*d %*d %*d %*d %*d %*d %lf %lf %lf",
               &user, &system, &start, &virtual_bytes, &pages) != 5)
        return p;
    return (struct process) { (user + system) / tick, boot_time_s() + start / tick, virtual_bytes, pages * page };
}

static double most_descriptors(void)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_NOFILE, &limit) || limit.rlim_cur == RLIM_INFINITY ? NAN : (double)limit.rlim_cur;
}

enum kd_status kd_process_write(struct kd_buffer *out)
{
    const struct process p = look();
    const struct {
        const char *name, *type, *help;
        double value;
    } rows[] = {
        { "cpu_seconds_total", "counter", "Processor time, user and system.", p.cpu_s },
        { "open_fds", "gauge", "Open file descriptors.", kd_descriptors_open() },
        { "max_fds", "gauge", "Limit of open file descriptors.", most_descriptors() },
        { "virtual_memory_bytes", "gauge", "Virtual memory.", p.virtual_bytes },
        { "resident_memory_bytes", "gauge", "Resident memory.", p.resident_bytes },
        { "start_time_seconds", "gauge", "Start time in seconds since 1970.", p.start_s },
    };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof rows / sizeof *rows && !status; i++)
        if (!isnan(rows[i].value))
            status =
                kd_buffer_printf(out, "# HELP process_%s %s\n# TYPE process_%s %s\nprocess_%s %.17g\n", rows[i].name,
                                 rows[i].help, rows[i].name, rows[i].type, rows[i].name, rows[i].value);
    return status;
}
