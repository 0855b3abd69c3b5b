#include "base/buffer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `extra` more bytes and for a NUL at the end. */
static enum kd_status reserve(struct kd_buffer *buffer, size_t extra)
{
    if (extra >= SIZE_MAX / 2 - buffer->size)
        return KD_ENOMEM;
    size_t need = buffer->size + extra + 1;
    if (need <= buffer->capacity)
        return KD_OK;
    size_t capacity = buffer->capacity ? buffer->capacity : 256;
    while (capacity < need)
        capacity *= 2;
    uint8_t *data = realloc(buffer->data, capacity);
    if (!data)
        return KD_ENOMEM;
    buffer->data = data;
    buffer->capacity = capacity;
    return KD_OK;
}

enum kd_status kd_buffer_append(struct kd_buffer *buffer, const void *data, size_t size)
{
    enum kd_status status = reserve(buffer, size);
    if (status)
        return status;
    if (size)
        memcpy(buffer->data + buffer->size, data, size);
    buffer->size += size;
    buffer->data[buffer->size] = 0;
    return KD_OK;
}

enum kd_status kd_buffer_printf(struct kd_buffer *buffer, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    enum kd_status status = n < 0 ? KD_ENOMEM : reserve(buffer, (size_t)n);
    if (!status) {
        vsnprintf((char *)buffer->data + buffer->size, (size_t)n + 1, format, again);
        buffer->size += (size_t)n;
    }
    va_end(again);
    return status;
}

void kd_buffer_finish(struct kd_buffer *buffer)
{
    free(buffer->data);
    *buffer = (struct kd_buffer) { 0 };
}
