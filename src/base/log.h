/* Logs events to stderr, one per line. Any thread. Level and format are set once, at the start. In the text format a
 * line is "kerrd: LEVEL: MESSAGE". In the JSON format it is an object with time (RFC 3339, UTC, milliseconds),
 * level, event and the members of the event. kd_log writes an event named "message" with the member message. Control
 * characters and invalid UTF-8 become \xNN, so that an event is always one line. */
#ifndef KD_BASE_LOG_H
#define KD_BASE_LOG_H

#include <stdbool.h>
#include <stddef.h>

enum kd_log_level { KD_LOG_ERROR, KD_LOG_WARN, KD_LOG_INFO, KD_LOG_DEBUG };
enum kd_log_format { KD_LOG_TEXT, KD_LOG_JSON };

void kd_log_set_level(enum kd_log_level level);    /* default KD_LOG_WARN */
void kd_log_set_format(enum kd_log_format format); /* default KD_LOG_TEXT */
enum kd_log_format kd_log_get_format(void);
bool kd_log_tells(enum kd_log_level level); /* true if events of this level are written */

void kd_log(enum kd_log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A member of an event. Its value is `text` if text is not NULL, otherwise `number`. A member whose number is not
 * finite is left out. */
struct kd_log_member {
    const char *name, *text;
    double number;
};
/* Logs an event with a name. The JSON format contains the members; the text format contains the message. */
void kd_log_event(enum kd_log_level level, const char *event, const struct kd_log_member *members, size_t n,
                  const char *message);

#endif
