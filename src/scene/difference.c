#include "scene/difference.h"

#include "scene/style.h"

#include <string.h>

/* State while a difference is written. `base` is the base scene, with all fields that were written so far applied. */
struct telling {
    const struct kd_scene *scene;
    struct kd_scene made;
    char between;
    size_t before; /* size of *out before the difference was written */
    struct kd_buffer *out, value;
};

/* Converts a value from its form in a document to its form in --set, which has no quotes and brackets. */
static void strip(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (!strchr("[]\"", *from))
            *to++ = *from;
    *to = 0;
}

/* Compares values instead of their texts. Writing texts would take most of the time, because making a link compares
 * 30 presets. */
static bool same(const struct kd_scene *a, const struct kd_scene *b, const struct kd_row *field, size_t index)
{
    if (field->kind == KD_KIND_ASSET)
        return !strcmp(kd_field_asset(a, field, index), kd_field_asset(b, field, index));
    if (field->kind == KD_KIND_SERIES)
        return !memcmp((const char *)kd_field_in(a, field, index) + field->offset,
                       (const char *)kd_field_in(b, field, index) + field->offset, sizeof(struct kd_words));
    return kd_field_get(a, field, index) == kd_field_get(b, field, index);
}

static bool all_same(const struct kd_scene *a, const struct kd_scene *b)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        const struct kd_section *section = &kd_sections[i];
        const size_t size = kd_section_size(a, section);
        if (size != kd_section_size(b, section))
            return false;
        for (size_t k = 0; k < size; k++)
            for (size_t n = 0; n < section->count; n++)
                if (!same(a, b, &kd_fields[section->first + n], k))
                    return false;
    }
    return true;
}

static enum kd_status tell(struct telling *t, const struct kd_row *field, size_t index)
{
    char path[KD_PATH_SIZE];
    t->value.size = 0;
    struct kd_json json = kd_scene_json(&t->value);
    kd_field_path(field, index, path);
    kd_row_write_as(&json, NULL, field, kd_field_in(t->scene, field, index));
    if (!kd_field_is_sound(t->scene, field, index) || kd_json_finish(&json))
        return json.status ? json.status : KD_EINVAL;
    char *value = (char *)t->value.data;
    strip(value);
    enum kd_status status = kd_scene_set(&t->made, path, value, NULL);
    if (!status && t->out->size > t->before)
        status = kd_buffer_printf(t->out, "%c", t->between);
    return status ? status : kd_buffer_printf(t->out, "%s=%s", path, value);
}

/* Writes those fields of a section or list element that differ. If the base has no such element, the first field is
 * written even if it has its default, because this creates the element. */
static enum kd_status tell_fields(struct telling *t, const struct kd_section *section, size_t index)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < section->count && !status; i++) {
        const struct kd_row *field = &kd_fields[section->first + i];
        const bool missing = index >= kd_section_size(&t->made, section);
        if (missing || !same(&t->made, t->scene, field, index))
            status = tell(t, field, index);
    }
    return status;
}

/* Writes the difference. The style comes first because it sets other fields, as in a document. */
static enum kd_status tell_all(struct telling *t)
{
    enum kd_status status = KD_OK;
    const struct kd_row *style = kd_style_field();
    if (style && !same(&t->made, t->scene, style, 0))
        status = tell(t, style, 0);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        for (size_t k = 0; k < kd_section_size(t->scene, &kd_sections[i]) && !status; k++)
            status = tell_fields(t, &kd_sections[i], k);
    return status;
}

enum kd_status kd_scene_difference(const struct kd_scene *base, const struct kd_scene *scene, char between,
                                   struct kd_buffer *out)
{
    struct telling t = { .scene = scene, .made = *base, .between = between, .before = out->size, .out = out };
    enum kd_status status = tell_all(&t);
    if (!status && !all_same(&t.made, scene))
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
