#include "base/log.h"

#include "base/json.h"
#include "base/utf8.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <time.h>

enum { MESSAGE = 1024 };

static enum kd_log_level threshold = KD_LOG_WARN;
static enum kd_log_format lines = KD_LOG_TEXT;
static const char *const names[] = { "error", "warning", "info", "debug" };

void kd_log_set_level(enum kd_log_level level) { threshold = level; }
void kd_log_set_format(enum kd_log_format format) { lines = format; }
enum kd_log_format kd_log_get_format(void) { return lines; }
bool kd_log_tells(enum kd_log_level level) { return level <= threshold; }

static void add_time(struct kd_json *json)
{
    struct timespec now;
    struct tm parts;
    char day[40], text[60];
    clock_gettime(CLOCK_REALTIME, &now);
    strftime(day, sizeof day, "%Y-%m-%dT%H:%M:%S", gmtime_r(&now.tv_sec, &parts));
    snprintf(text, sizeof text, "%s.%03dZ", day, (int)(now.tv_nsec / 1000000));
    kd_json_string(json, "time", text);
}

static void write_json(enum kd_log_level level, const char *event, const struct kd_log_member *members, size_t n)
{
    struct kd_buffer line = { 0 };
    struct kd_json json = kd_json_begin(&line);
    kd_json_object(&json, NULL);
    add_time(&json);
    kd_json_string(&json, "level", names[level]);
    kd_json_string(&json, "event", event);
    for (size_t i = 0; i < n; i++) {
        char text[4 * MESSAGE];
        if (members[i].text) {
            kd_utf8_print(text, sizeof text, members[i].text);
            kd_json_string(&json, members[i].name, text);
        } else if (isfinite(members[i].number)) {
            kd_json_number(&json, members[i].name, members[i].number);
        }
    }
    kd_json_end(&json);
    if (kd_json_finish_line(&json))
        fprintf(
            stderr,
            "{\"level\":\"error\",\"event\":\"message\",\"message\":\"there was no memory for a line of the log\"}\n");
    else
        fwrite(line.data, 1, line.size, stderr); /* one call, so that lines of different threads do not mix */
    kd_buffer_finish(&line);
}

static void write_text(enum kd_log_level level, const char *message)
{
    char line[4 * MESSAGE];
    kd_utf8_print(line, sizeof line, message);
    /* one call, so that lines of different threads do not mix */
    fprintf(stderr, "kerrd: %s: %s\n", names[level], line);
}

void kd_log(enum kd_log_level level, const char *format, ...)
{
    char message[MESSAGE];
    va_list args;

    if (!kd_log_tells(level))
        return;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    kd_log_event(level, "message", &(struct kd_log_member) { "message", message, 0 }, 1, message);
}

void kd_log_event(enum kd_log_level level, const char *event, const struct kd_log_member *members, size_t n,
                  const char *message)
{
    if (!kd_log_tells(level))
        return;
    if (lines == KD_LOG_JSON)
        write_json(level, event, members, n);
    else
        write_text(level, message);
}
