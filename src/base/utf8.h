/* This is what PNG chunks, requests and the log need of text encodings. Any thread. */
#ifndef KD_BASE_UTF8_H
#define KD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

bool kd_utf8_ascii(const char *text);
bool kd_utf8_valid(const char *text); /* RFC 3629: no overlong form, no surrogate, nothing past U+10FFFF */

/* Writes the text, cut to what fits, with nothing in it that is no printing character: a control character (C0, DEL, C1) and a byte that is not of
 * UTF-8 become \xNN, so that a line stays one line and a terminal takes no order from it. size: at least 1; four bytes for each of the text are enough. */
void kd_utf8_print(char *to, size_t size, const char *text);

/* Latin-1 to UTF-8: bytes needed with the NUL; copy, returning the byte after the NUL. */
size_t kd_latin1_size(const char *text);
char *kd_latin1_copy(char *to, const char *text);

#endif
