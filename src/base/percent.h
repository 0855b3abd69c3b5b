/* Percent-encodes text for addresses (RFC 3986 2.1). */
#ifndef KD_BASE_PERCENT_H
#define KD_BASE_PERCENT_H

#include "base/buffer.h"

/* Appends the bytes. Unreserved characters (RFC 3986 2.3) and the characters in `also` stay as they are; all others
 * are escaped, with upper-case hexadecimal digits. Adds a NUL, which out->size does not count. Any thread. */
enum kd_status kd_percent_append(const void *bytes, size_t size, const char *also, struct kd_buffer *out);

#endif
