#include "scene/difference.h"

#include "scene/style.h"
#include "scene/writer.h"

#include <string.h>

/* The fields told so far, and the scene that they have made of the base. */
struct telling {
    const struct kd_scene *scene;
    struct kd_scene made;
    char between;
    size_t before; /* bytes of *out before the first */
    struct kd_buffer *out, value;
};

/* A value as --set takes it: a document's, without its quotes and brackets. */
static void strip(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (!strchr("[]\"", *from))
            *to++ = *from;
    *to = 0;
}

static enum kd_status write_value(const struct kd_scene *scene, const struct kd_field *field, size_t index,
                                  struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out };
    out->size = 0;
    kd_write_field(&writer, scene, field, index);
    return writer.status;
}

/* Whether the field still differs; its value is then in t->value. A failure counts as a difference. */
static bool differs(struct telling *t, const struct kd_field *field, size_t index, enum kd_status *status)
{
    struct kd_buffer made = { 0 };
    *status = write_value(&t->made, field, index, &made);
    if (!*status)
        *status = write_value(t->scene, field, index, &t->value);
    const bool same = !*status && !strcmp((const char *)made.data, (const char *)t->value.data);
    kd_buffer_finish(&made);
    return !same;
}

static enum kd_status tell(struct telling *t, const struct kd_field *field, size_t index)
{
    char path[KD_PATH_SIZE], *value = (char *)t->value.data;
    kd_field_path(field, index, path);
    strip(value);
    enum kd_status status = kd_scene_set(&t->made, path, value, NULL);
    if (!status && t->out->size > t->before)
        status = kd_buffer_printf(t->out, "%c", t->between);
    return status ? status : kd_buffer_printf(t->out, "%s=%s", path, value);
}

/* An element that the base has not is told even where nothing of it differs: its first field makes it. */
static enum kd_status tell_fields(struct telling *t, const struct kd_section *section, size_t index)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < section->count && !status; i++) {
        const struct kd_field *field = &kd_fields[section->first + i];
        const bool missing = index >= kd_section_size(&t->made, section);
        if (differs(t, field, index, &status) || missing)
            status = status ? status : tell(t, field, index);
    }
    return status;
}

/* The style first: it sets other fields, as a document's does. */
static enum kd_status tell_all(struct telling *t)
{
    enum kd_status status = KD_OK;
    const struct kd_field *style = kd_style_field();
    if (style && differs(t, style, 0, &status))
        status = status ? status : tell(t, style, 0);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        for (size_t k = 0; k < kd_section_size(t->scene, &kd_sections[i]) && !status; k++)
            status = tell_fields(t, &kd_sections[i], k);
    return status;
}

enum kd_status kd_scene_difference(const struct kd_scene *base, const struct kd_scene *scene, char between,
                                   struct kd_buffer *out)
{
    struct telling t = { .scene = scene, .made = *base, .between = between, .before = out->size, .out = out };
    t.made.crowd = scene->crowd; /* no field has it */
    enum kd_status status = tell_all(&t);
    if (!status && memcmp(&t.made, scene, sizeof *scene))
        status = KD_EINVAL;
    if (status)
        out->size = t.before;
    kd_buffer_finish(&t.value);
    return status;
}

enum kd_status kd_scene_line(const struct kd_scene *scene, struct kd_buffer *out)
{
    struct kd_scene plain;
    const size_t before = out->size;
    kd_scene_defaults(&plain);
    enum kd_status status = kd_scene_difference(&plain, scene, ' ', out);
    return status || out->size > before ? status : kd_buffer_printf(out, "the default scene");
}
