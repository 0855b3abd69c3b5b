/* Escapes text for HTML and XML. Any thread. */
#ifndef KD_BASE_MARKUP_H
#define KD_BASE_MARKUP_H

#include "base/buffer.h"

/* Sets of characters to escape. The first set is for text between tags, the second for text in attributes as well. */
#define KD_MARKUP_CONTENT "&<>"
#define KD_MARKUP_ATTRIBUTE "&<>\"'"

/* Appends the text and a NUL. Each of the `characters` is replaced by a character reference. KD_ENOMEM. */
enum kd_status kd_markup_escape(const char *text, const char *characters, struct kd_buffer *out);

/* Reverses kd_markup_escape in place: replaces its character references by the characters. */
void kd_markup_unescape(struct kd_buffer *text);

#endif
