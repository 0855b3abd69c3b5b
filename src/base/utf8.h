/* This looks at text from outside: whether it is UTF-8 (RFC 3629: shortest form, no surrogates, nothing past U+10FFFF), and makes it fit to be shown. Any thread. */
#ifndef KD_BASE_UTF8_H
#define KD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Counts the bytes (1 to 4) of the well-formed sequence at text, 0 if none. */
size_t kd_utf8_sequence(const char *text, size_t length);

/* Says whether the sequence is a control character. */
bool kd_utf8_is_control(const char *text, size_t n);

/* Puts "?" in the place of each byte of what is no UTF-8. */
void kd_utf8_mend(char *text);
/* The same, and of control characters; a blank in that of each line feed, tab and carriage return. */
void kd_utf8_show(char *text);

#endif
