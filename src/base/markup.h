/* Text in HTML and XML. Any thread. */
#ifndef KD_BASE_MARKUP_H
#define KD_BASE_MARKUP_H

#include "base/buffer.h"

/* Sets of characters to escape: the first is for content only, the second for attributes and content. */
#define KD_MARKUP_CONTENT "&<>"
#define KD_MARKUP_ATTRIBUTE "&<>\"'"

/* Appends the text, with its `characters` replaced by references, and a NUL. KD_ENOMEM. */
enum kd_status kd_markup_escape(const char *text, const char *characters, struct kd_buffer *out);

/* Replaces the references that kd_markup_escape writes by their characters, in place. */
void kd_markup_unescape(struct kd_buffer *text);

#endif
