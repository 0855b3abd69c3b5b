/* One field by its dotted path: --set and query parameters. */
#include "scene/hint.h"
#include "scene/text.h"
#include "scene/value.h"

#include <string.h>

static enum kd_status whole_section(const struct kd_section *section, struct kd_error *error)
{
    char pointer[KD_PATH_SIZE] = "";
    kd_text_pointer(pointer, sizeof pointer, section->name);
    return kd_error_field(error, pointer, "%s is a section; name one of its fields, as in %s.%s",
                          section->name, section->name, kd_fields[section->first].name);
}

enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *text,
                            struct kd_error *error)
{
    struct kd_value value = kd_value_typed(text);
    if (!strcmp(path, "version"))
        return kd_value_version(&value, error);

    char section[KD_PATH_SIZE] = "";
    const char *dot = strchr(path, '.'), *name = dot ? dot + 1 : path;
    size_t length = dot ? (size_t)(dot - path) : 0;
    if (length >= sizeof section || dot == path)
        return kd_hint_unknown(error, "", path);
    memcpy(section, path, length);

    const struct kd_field *field = kd_field_find(section, name);
    if (field)
        return kd_value_store(scene, field, &value, error);
    const struct kd_section *whole = dot || !*path ? NULL : kd_section_find(path);
    return whole ? whole_section(whole, error) : kd_hint_unknown(error, section, name);
}
