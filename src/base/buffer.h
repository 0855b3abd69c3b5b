/* A growing byte buffer. The code that initialises a buffer owns it. Not thread-safe.
 *
 *     struct kd_buffer b = { 0 };
 *     if (kd_buffer_append(&b, data, n)) ... KD_ENOMEM ...
 *     kd_buffer_finish(&b); */
#ifndef KD_BASE_BUFFER_H
#define KD_BASE_BUFFER_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

struct kd_buffer {
    uint8_t *data;
    size_t size, capacity;
};

enum kd_status kd_buffer_append(struct kd_buffer *buffer, const void *data, size_t size);
/* Appends printf output, followed by a NUL that `size` does not count. */
enum kd_status kd_buffer_printf(struct kd_buffer *buffer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void kd_buffer_finish(struct kd_buffer *buffer); /* frees the memory; the buffer may be used again */

#endif
