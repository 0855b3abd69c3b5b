/* Checks that external text is UTF-8 (RFC 3629: shortest form, no surrogates, nothing beyond U+10FFFF). Makes such
 * text printable, and converts text to and from Latin-1. Any thread. */
#ifndef KD_BASE_UTF8_H
#define KD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Length in bytes (1 to 4) of the valid sequence that starts at text; 0 if there is none. */
size_t kd_utf8_sequence(const char *text, size_t length);
/* True if the n bytes at text are a control character: C0, DEL or C1. */
bool kd_utf8_is_control(const char *text, size_t n);

bool kd_utf8_ascii(const char *text);
bool kd_utf8_valid(const char *text);

/* Replaces each byte that is not part of valid UTF-8 by "?". */
void kd_utf8_sanitize(char *text);
/* Like kd_utf8_sanitize, but also replaces control characters: line feed, tab and carriage return become a blank,
 * and all others become "?". */
void kd_utf8_show(char *text);

/* Copies as many whole characters of text as fit into size bytes. Each byte of a control character or of invalid
 * UTF-8 becomes \xNN, so that a line stays one line, and terminals find no escape sequence to execute. size is at
 * least 1. Four bytes for each byte of text, plus one for the NUL, are always enough. */
void kd_utf8_print(char *to, size_t size, const char *text);

/* Convert Latin-1 to UTF-8. kd_latin1_size returns how many bytes are needed, including the NUL. kd_latin1_copy returns
 * the position after the NUL. */
size_t kd_latin1_size(const char *text);
char *kd_latin1_copy(char *to, const char *text);

#endif
