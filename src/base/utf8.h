/* Checks that text from outside is UTF-8 (RFC 3629: shortest form, no surrogates, nothing beyond U+10FFFF), makes it
 * printable, and converts it to Latin-1 for PNG chunks. Any thread. */
#ifndef KD_BASE_UTF8_H
#define KD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Counts the bytes (1 to 4) of the well-formed sequence at text, 0 if none. */
size_t kd_utf8_sequence(const char *text, size_t length);
/* Says whether the sequence is a control character: C0, DEL, C1. */
bool kd_utf8_is_control(const char *text, size_t n);

bool kd_utf8_ascii(const char *text);
bool kd_utf8_valid(const char *text);

/* Puts "?" in the place of each byte of what is no UTF-8. */
void kd_utf8_mend(char *text);
/* The same, and of control characters; a blank in that of each line feed, tab and carriage return. */
void kd_utf8_show(char *text);

/* Writes the text, cut to what fits, with nothing in it that is no printing character: a control character and a
 * byte that is not of UTF-8 become \xNN, so that a line stays one line and a terminal takes no order from it. size:
 * at least 1; four bytes for each of the text are enough. */
void kd_utf8_print(char *to, size_t size, const char *text);

/* Latin-1 to UTF-8: bytes needed with the NUL; copy, returning the byte after the NUL. */
size_t kd_latin1_size(const char *text);
char *kd_latin1_copy(char *to, const char *text);

#endif
