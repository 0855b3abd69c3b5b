/* Encodes a text for use in a URL: deflate (RFC 1951) followed by base64url without padding (RFC 4648, section 5).
 * Pure; any thread. */
#ifndef KD_IMAGE_TEXT_CODE_H
#define KD_IMAGE_TEXT_CODE_H

#include "base/buffer.h"

/* Limits of the size of a code, and of the size of its text. They are checked before memory is allocated. */
enum { KD_TEXT_CODE_MOST = 2048, KD_TEXT_CODE_TEXT_MOST = 8192 };

/* Appends the code of a text of `size` bytes, and a NUL that out->size does not count. KD_ETOOBIG if the text or the
 * code exceeds these limits. KD_ENOMEM. */
enum kd_status kd_text_code_write(const void *text, size_t size, struct kd_buffer *out, struct kd_error *error);

/* Appends the text that a code contains, and a NUL that out->size does not count. The messages of KD_EINVAL and
 * KD_ETOOBIG describe the required form of a code. KD_ENOMEM. */
enum kd_status kd_text_code_read(const char *code, struct kd_buffer *out, struct kd_error *error);

#endif
