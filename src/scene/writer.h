/* Writes JSON text into a buffer. After the first failure nothing more is written, and `status` is that failure. */
#ifndef KD_SCENE_WRITER_H
#define KD_SCENE_WRITER_H

#include "scene/table.h"

struct kd_writer {
    struct kd_buffer *out;
    enum kd_status status;
};

#define kd_write(w, ...) ((void)((w)->status || ((w)->status = kd_buffer_printf((w)->out, __VA_ARGS__))))

/* Writes a JSON string with its quotes. text is UTF-8. */
void kd_write_string(struct kd_writer *writer, const char *text);
void kd_write_number(struct kd_writer *writer, double value);
/* Writes a value in the form that it has in a document. status becomes KD_EINVAL if the field cannot have it. */
void kd_write_value(struct kd_writer *writer, const struct kd_field *field, double value);
/* Writes the value that a field has in the scene. status becomes KD_EINVAL also if it is an unresolved name of an
 * asset. */
void kd_write_field(struct kd_writer *writer, const struct kd_scene *scene, const struct kd_field *field, size_t index);

#endif
