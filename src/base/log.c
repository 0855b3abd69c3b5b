#include "base/log.h"

#include <stdarg.h>
#include <stdio.h>

static enum kd_log_level threshold = KD_LOG_WARN;

void kd_log_set_level(enum kd_log_level level) { threshold = level; }

void kd_log(enum kd_log_level level, const char *format, ...)
{
    static const char *const names[] = { "error", "warning", "info", "debug" };
    char line[1024];
    va_list args;

    if (level > threshold)
        return;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    fprintf(stderr, "kerrd: %s: %s\n", names[level], line); /* one call: lines do not interleave */
}
