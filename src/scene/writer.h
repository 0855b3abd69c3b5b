/* Writes text into a buffer; after a first failure nothing more is written and status holds it. */
#ifndef KD_SCENE_WRITER_H
#define KD_SCENE_WRITER_H

#include "scene/table.h"

struct kd_writer {
    struct kd_buffer *out;
    enum kd_status status;
};

#define kd_write(w, ...) ((void)((w)->status || ((w)->status = kd_buffer_printf((w)->out, __VA_ARGS__))))

/* Writes a JSON string with its quotes; text is UTF-8. */
void kd_write_string(struct kd_writer *writer, const char *text);
void kd_write_number(struct kd_writer *writer, double value);
/* Writes a field's value as a document holds it; KD_EINVAL in status when the field cannot hold it. */
void kd_write_value(struct kd_writer *writer, const struct kd_field *field, double value);
/* Writes the value that the scene has; KD_EINVAL in status for the name of an asset that nobody has resolved, too. */
void kd_write_field(struct kd_writer *writer, const struct kd_scene *scene, const struct kd_field *field, size_t index);

#endif
