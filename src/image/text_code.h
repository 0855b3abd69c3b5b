/* Encodes a text for use in a URL: deflated (RFC 1951) and in base64url without padding (RFC 4648, 5). Pure; any
 * thread. */
#ifndef KD_IMAGE_TEXT_CODE_H
#define KD_IMAGE_TEXT_CODE_H

#include "base/buffer.h"

/* Limits of the size of a code, and of the text that it unpacks to. They are checked before anything is allocated. */
enum { KD_TEXT_CODE_MOST = 2048, KD_TEXT_CODE_TEXT_MOST = 8192 };

/* Appends the code of `size` bytes, and a NUL that out->size does not count. KD_ETOOBIG if text or code exceed these
 * limits. KD_ENOMEM. */
enum kd_status kd_text_code_write(const void *text, size_t size, struct kd_buffer *out, struct kd_error *error);

/* Appends the text of a code, and a NUL that out->size does not count. KD_EINVAL and KD_ETOOBIG have a message about
 * the required form of a code. KD_ENOMEM. */
enum kd_status kd_text_code_read(const char *code, struct kd_buffer *out, struct kd_error *error);

#endif
