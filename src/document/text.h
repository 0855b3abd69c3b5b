/* Prepares external text for quotation in messages. Any thread. */
#ifndef KD_DOCUMENT_TEXT_H
#define KD_DOCUMENT_TEXT_H

#include <stddef.h>

/* Copies text for display. Control characters and invalid UTF-8 become '?'. If the text is too long, it is truncated
 * and ends with "...". size is at least 8. */
void kd_text_clip(char *out, size_t size, const char *text);

/* Returns the separator before item i of n, as in "a, b or c". */
const char *kd_text_or(size_t i, size_t n);

/* Appends "/token" to a JSON pointer (RFC 6901: ~ and / are escaped). If the token does not fit, it is left out, and
 * the pointer leads to the token's parent. */
void kd_text_pointer(char *pointer, size_t size, const char *token);

/* Line and column of a byte in a text, both counted from 1. Columns are counted in characters. */
struct kd_text_place { size_t line, column; };
struct kd_text_place kd_text_place_of(const char *text, size_t at);

#endif
