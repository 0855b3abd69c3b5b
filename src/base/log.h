/* An event is one line on stderr. Any thread. Level and format are set once, at start.
 *
 * A line of text is "kerrd: LEVEL: MESSAGE". A line of JSON is an object with time (RFC 3339, UTC, milliseconds),
 * level, event, and what the event has; that of kd_log is "message" and has the member message. Whatever a message
 * holds, it stays one line: control characters, and bytes that are not of UTF-8, become \xNN. */
#ifndef KD_BASE_LOG_H
#define KD_BASE_LOG_H

#include <stdbool.h>
#include <stddef.h>

enum kd_log_level { KD_LOG_ERROR, KD_LOG_WARN, KD_LOG_INFO, KD_LOG_DEBUG };
enum kd_log_format { KD_LOG_TEXT, KD_LOG_JSON };

void kd_log_set_level(enum kd_log_level level);    /* default KD_LOG_WARN */
void kd_log_set_format(enum kd_log_format format); /* default KD_LOG_TEXT */
enum kd_log_format kd_log_get_format(void);
bool kd_log_tells(enum kd_log_level level); /* whether an event of this level is told */

void kd_log(enum kd_log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A member of an event: a text, where it is not NULL, else a number, where it is one. */
struct kd_log_member {
    const char *name, *text;
    double number;
};
/* An event of its own kind. Lines of JSON have its members, lines of text have its message. */
void kd_log_event(enum kd_log_level level, const char *event, const struct kd_log_member *members, size_t n,
                  const char *message);

#endif
