/* Writes formatted text into a buffer. After the first failure nothing more is written, and `status` keeps that
   failure. */
#ifndef KD_DOCUMENT_WRITER_H
#define KD_DOCUMENT_WRITER_H

#include "base/buffer.h"

struct kd_writer {
    struct kd_buffer *out;
    enum kd_status status;
};

#define kd_write(w, ...) ((void)((w)->status || ((w)->status = kd_buffer_printf((w)->out, __VA_ARGS__))))

/* Writes a JSON string with its quotes. text is UTF-8. */
void kd_write_string(struct kd_writer *writer, const char *text);
void kd_write_number(struct kd_writer *writer, double value);

#endif
