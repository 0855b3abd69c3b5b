/* An event is one line on stderr. Any thread. The level is set once, at start. */
#ifndef KD_BASE_LOG_H
#define KD_BASE_LOG_H

enum kd_log_level { KD_LOG_ERROR, KD_LOG_WARN, KD_LOG_INFO, KD_LOG_DEBUG };

void kd_log_set_level(enum kd_log_level level); /* default KD_LOG_WARN */
void kd_log(enum kd_log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
