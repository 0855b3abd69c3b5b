/* Base64 (RFC 4648, section 4). Any thread. */
#ifndef KD_PLAYGROUND_BASE64_H
#define KD_PLAYGROUND_BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* Length of the Base64 of n bytes, without the final NUL. */
static inline size_t kd_base64_length(size_t n) { return (n + 2) / 3 * 4; }

/* Writes kd_base64_length(n) characters and a NUL. */
void kd_base64_write(char *to, const void *data, size_t n);
/* Decodes exactly n bytes. Returns false if the text is not the Base64 of n bytes. */
bool kd_base64_read(void *to, size_t n, const char *text);

#endif
