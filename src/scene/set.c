/* Sets one field by its dotted path, for --set and query parameters. */
#include "scene/element.h"
#include "scene/hint.h"
#include "scene/sky_scale.h"
#include "scene/style.h"
#include "document/text.h"
#include "scene/table.h"

#include <stdio.h>
#include <string.h>

/* A parsed path: the section ("" for the document itself), its element if the section is a list, and the name that
 * follows. */
struct place {
    const struct kd_section *section;
    size_t index;
    const char *name; /* the part of the path after section and index */
    bool old;         /* the path uses an old name of an element, which may lie beyond the next free index */
};

static enum kd_status whole_section(const struct kd_section *section, struct kd_error *error)
{
    char pointer[KD_PATH_SIZE], path[KD_PATH_SIZE];
    kd_section_pointer(section, pointer);
    kd_field_path(&kd_fields[section->first], 0, path);
    return section->most ? kd_error_field(error, pointer, "%s is a list; name a field of one of its elements, as in %s",
                                          section->name, path)
                         : kd_error_field(error, pointer, "%s is a section; name one of its fields, as in %s",
                                          section->name, path);
}

static enum kd_status whole_element(const struct kd_section *list, size_t index, struct kd_error *error)
{
    char pointer[KD_PATH_SIZE], path[KD_PATH_SIZE];
    kd_element_pointer(list, index, pointer);
    kd_field_path(&kd_fields[list->first], index, path);
    return kd_error_field(error, pointer, "%s.%zu is an element; name one of its fields, as in %s", list->name, index,
                          path);
}

/* Copies the part of the path before the next dot; "" if there is no dot or the part is too long. *rest is what follows
 * the dot. */
static void next_token(const char **rest, char out[KD_PATH_SIZE])
{
    const char *dot = strchr(*rest, '.');
    size_t length = dot ? (size_t)(dot - *rest) : 0;
    out[0] = 0;
    if (!length || length >= KD_PATH_SIZE)
        return;
    memcpy(out, *rest, length);
    out[length] = 0;
    *rest = dot + 1;
}

static enum kd_status in_list(struct place *place, struct kd_error *error)
{
    char token[KD_PATH_SIZE];
    next_token(&place->name, token);
    bool whole = !*token;
    enum kd_status status = kd_element_find(place->section, whole ? place->name : token, &place->index, error);
    return status || !whole ? status : whole_element(place->section, place->index, error);
}

static enum kd_status find_place(const char *path, struct place *place, struct kd_error *error)
{
    char token[KD_PATH_SIZE];
    const char *rest = path;
    next_token(&rest, token);
    const struct kd_old_name *old = kd_old_name_find(*token ? token : path);
    if (old) {
        *place = (struct place) { kd_section_find(old->section), old->index, rest, true };
        return *token ? KD_OK : whole_element(place->section, old->index, error);
    }
    const struct kd_section *whole = *token || !*path ? NULL : kd_section_find(path);
    if (whole)
        return whole_section(whole, error);
    *place = (struct place) { kd_section_find(token), 0, rest, false };
    if (!place->section)
        return kd_hint_unknown(error, token, 0, rest);
    next_token(&rest, token);
    const struct kd_section *part = kd_section_part(place->section, *token ? token : rest);
    if (part && !*token)
        return whole_section(part, error);
    if (part)
        *place = (struct place) { part, 0, rest, false };
    return place->section->most ? in_list(place, error) : KD_OK;
}

/* If the path uses an old name, replaces it by its list and index. */
static void renew(const char *path, char out[2 * KD_PATH_SIZE])
{
    char token[KD_PATH_SIZE];
    const char *rest = path;
    next_token(&rest, token);
    const struct kd_old_name *old = kd_old_name_find(token);
    if (old)
        snprintf(out, 2 * KD_PATH_SIZE, "%s.%zu.%s", old->section, old->index, rest);
    else
        snprintf(out, 2 * KD_PATH_SIZE, "%s", path);
}

bool kd_scene_same_path(const char *a, const char *b)
{
    char one[2 * KD_PATH_SIZE], other[2 * KD_PATH_SIZE];
    if (!strcmp(a, b))
        return true;
    renew(a, one);
    renew(b, other);
    return !strcmp(one, other);
}

static enum kd_status find_field(const char *path, struct place *place, const struct kd_row **out,
                                 struct kd_error *error)
{
    enum kd_status status = find_place(path, place, error);
    if (status)
        return status;
    *out = kd_field_find(place->section->name, place->name);
    return *out ? KD_OK : kd_hint_unknown(error, place->section->name, place->index, place->name);
}

enum kd_status kd_field_at(const char *path, const struct kd_row **out, size_t *index, struct kd_error *error)
{
    struct place place;
    enum kd_status status = find_field(path, &place, out, error);
    *index = status ? 0 : place.index;
    return status;
}

enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *text, struct kd_error *error)
{
    struct kd_value value = kd_value_typed(text);
    const struct kd_row *field;
    struct place place;
    bool given[KD_FIELD_COUNT] = { false };
    if (!strcmp(path, "version"))
        return kd_scene_version(&value, error);
    enum kd_status status;
    KD_TRY(find_field(path, &place, &field, error));

    struct kd_scene grown = *scene;
    size_t size = kd_section_size(scene, place.section);
    if (!place.old && place.section->most)
        KD_TRY(kd_element_reach(place.section, size, place.index, error));
    if (place.index >= size)
        kd_section_resize(&grown, place.section, place.index + 1);
    KD_TRY(kd_field_store(&grown, field, place.index, &value, error));
    if (field == kd_style_field())
        kd_style_apply(&grown, NULL);
    given[field - kd_fields] = true;
    kd_scene_settle(&grown, given);
    if (place.old)
        kd_section_trim(&grown, place.section, size);
    *scene = grown;
done:
    return status;
}
