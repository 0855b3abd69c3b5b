#include "cli/scene_line.h"

#include "scene/writer.h"

#include <string.h>

/* A value as --set takes it: a document's, without its quotes and brackets. */
static void strip(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (!strchr("[]\"", *from))
            *to++ = *from;
    *to = 0;
}

/* Whether the field is not as in a default one; its value is then the text in *value. */
static bool differs(const struct kd_scene *scene, const struct kd_field *field, size_t index, struct kd_buffer *value,
                    struct kd_writer *w)
{
    struct kd_buffer initial = { 0 };
    struct kd_writer own = { .out = &initial };
    value->size = 0;
    w->out = value;
    kd_write_field(w, scene, field, index);
    kd_write_value(&own, field, field->initial);
    if (own.status && !w->status)
        w->status = own.status;
    const bool is = !w->status && strcmp((const char *)value->data, (const char *)initial.data);
    kd_buffer_finish(&initial);
    if (!w->status)
        strip((char *)value->data);
    return is;
}

/* An element of a list that is there is told, also where nothing of it differs: its first field makes it. */
static enum kd_status add_element(const struct kd_scene *scene, const struct kd_section *section, size_t index,
                                  struct kd_buffer *out)
{
    struct kd_buffer value = { 0 };
    struct kd_writer w = { 0 };
    bool told = !section->most;
    for (size_t i = 0; i < section->count && !w.status; i++) {
        const struct kd_field *field = &kd_fields[section->first + i];
        char path[KD_PATH_SIZE];
        if (!differs(scene, field, index, &value, &w) && (told || i + 1 < section->count))
            continue;
        kd_field_path(field, index, path);
        if (!w.status)
            w.status = kd_buffer_printf(out, "%s%s=%s", out->size ? " " : "", path, (const char *)value.data);
        told = true;
    }
    kd_buffer_finish(&value);
    return w.status;
}

enum kd_status kd_scene_line(const struct kd_scene *scene, struct kd_buffer *out)
{
    struct kd_buffer line = { 0 };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        for (size_t k = 0; k < kd_section_size(scene, &kd_sections[i]) && !status; k++)
            status = add_element(scene, &kd_sections[i], k, &line);
    if (!status)
        status = kd_buffer_printf(out, "%s", line.size ? (const char *)line.data : "the default scene");
    kd_buffer_finish(&line);
    return status;
}
