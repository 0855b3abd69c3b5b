/* Reads scene documents from JSON. */
#include "scene/element.h"
#include "scene/hint.h"
#include "document/scan.h"
#include "scene/sky_scale.h"
#include "scene/style.h"
#include "document/text.h"
#include "scene/tree.h"
#include "scene/table.h"

#include <stdio.h>
#include <string.h>

struct reader {
    struct kd_scene scene;      /* working copy; it becomes the result when the whole document is valid */
    bool given[KD_FIELD_COUNT]; /* fields that the document has, in sections that are not lists */
    bool seen_section[KD_SECTION_COUNT], seen_version;
    /* for each list: an old name by which the document has named one of its elements */
    const struct kd_old_name *old[KD_SECTION_COUNT];
    bool seen_old[KD_OLD_NAME_COUNT];
    bool patch; /* the document is a merge patch: null resets a field or a section to its default */
    struct kd_error *error;
};

/* The object that is being read: a section, an element of a list, or the document itself. */
struct object {
    const struct kd_section *section;
    size_t index;
    bool patch;
    bool seen[KD_FIELD_COUNT];
};

/* Rejects a name that occurs twice, because one of the values would be ignored without notice. */
static enum kd_status once(struct reader *reader, bool *seen, const char *pointer)
{
    if (!*seen) {
        *seen = true;
        return KD_OK;
    }
    char path[KD_PATH_SIZE];
    snprintf(path, sizeof path, "%s", pointer + 1);
    for (char *c = path; *c; c++)
        *c = *c == '/' ? '.' : *c;
    return kd_error_field(reader->error, pointer, "%s is given twice", path);
}

/* Reports the value found at this pointer and what is allowed there. */
static enum kd_status not_a(struct reader *reader, const cJSON *item, const char *pointer, const char *allowed)
{
    char given[KD_VALUE_SIZE], path[KD_PATH_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    snprintf(path, sizeof path, "%s", pointer + 1);
    for (char *c = path; *c; c++)
        *c = *c == '/' ? '.' : *c;
    return kd_error_field(reader->error, pointer, "%s is %s; it must be %s", path, given, allowed);
}

static enum kd_status read_section(struct reader *reader, const struct kd_section *section, const cJSON *item);

/* Returns the first item that is not a word of the field, occurs twice, or exceeds the room; NULL: there is none. */
static const cJSON *read_words(const char *known, const cJSON *array, struct kd_words *out)
{
    *out = (struct kd_words) { 0 };
    for (const cJSON *item = array->child; item; item = item->next)
        if (!cJSON_IsString(item) || !kd_words_add(known, item->valuestring, strlen(item->valuestring), out))
            return item;
    return NULL;
}

static enum kd_status store_words(struct reader *reader, const struct kd_row *field, size_t index, const cJSON *item)
{
    char pointer[KD_PATH_SIZE], path[KD_PATH_SIZE], given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    struct kd_words words = { 0 };
    const cJSON *bad = cJSON_IsArray(item) ? read_words(field->words, item, &words) : item;
    if (!bad && words.count) {
        *(struct kd_words *)(void *)((char *)kd_field_in(&reader->scene, field, index) + field->offset) = words;
        return KD_OK;
    }
    struct kd_value value = kd_tree_value(bad ? bad : item);
    kd_field_pointer(field, index, pointer);
    kd_field_path(field, index, path);
    kd_value_describe(&value, given);
    kd_row_allowed(field, allowed);
    return kd_error_field(reader->error, pointer, "%s %s %s; it must be an array: %s", path,
                          cJSON_IsArray(item) && bad ? "holds" : "is", bad ? given : "an empty array", allowed);
}

static enum kd_status read_field(struct reader *reader, struct object *object, const cJSON *item)
{
    const struct kd_row *field = kd_field_find(object->section->name, item->string);
    const struct kd_section *part = field ? NULL : kd_section_part(object->section, item->string);
    if (part)
        return read_section(reader, part, item);
    if (!field)
        return kd_hint_unknown(reader->error, object->section->name, object->index, item->string);
    char pointer[KD_PATH_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_field_pointer(field, object->index, pointer);
    enum kd_status status = once(reader, &object->seen[field - kd_fields], pointer);
    reader->given[field - kd_fields] = true;
    if (!status && object->patch && cJSON_IsNull(item)) {
        kd_field_put(&reader->scene, field, object->index, field->initial);
        return KD_OK;
    }
    if (!status && field->kind == KD_KIND_SERIES)
        return store_words(reader, field, object->index, item);
    return status ? status : kd_field_store(&reader->scene, field, object->index, &value, reader->error);
}

static void reset(struct reader *reader, const struct kd_section *section, size_t index)
{
    kd_section_reset(&reader->scene, section, index);
    for (size_t i = section->first; i < section->first + section->count; i++)
        reader->given[i] = true;
}

/* Reads a section, or an existing element of a list. */
static enum kd_status read_object(struct reader *reader, const struct kd_section *section, size_t index,
                                  const char *pointer, const cJSON *item, bool patch)
{
    struct object object = { .section = section, .index = index, .patch = patch };
    if (patch && cJSON_IsNull(item)) {
        reset(reader, section, index);
        for (size_t i = 0; i < KD_SECTION_COUNT; i++)
            if (kd_section_is_part(&kd_sections[i], section))
                reset(reader, &kd_sections[i], 0);
        return KD_OK;
    }
    if (!cJSON_IsObject(item))
        return not_a(reader, item, pointer, "an object with fields");
    enum kd_status status = KD_OK;
    for (const cJSON *field = item->child; field && !status; field = field->next)
        status = read_field(reader, &object, field);
    return status;
}

/* Reads an element, and creates it if it does not exist; null does not create one. */
static enum kd_status read_element(struct reader *reader, const struct kd_section *list, size_t index,
                                   const cJSON *item, bool patch)
{
    char pointer[KD_PATH_SIZE];
    size_t size = kd_section_size(&reader->scene, list);
    kd_element_pointer(list, index, pointer);
    if (index >= size && patch && cJSON_IsNull(item))
        return KD_OK;
    if (index >= size)
        kd_section_resize(&reader->scene, list, index + 1);
    return read_object(reader, list, index, pointer, item, patch);
}

/* Reads an array, which replaces the whole list. */
static enum kd_status read_array(struct reader *reader, const struct kd_section *list, const cJSON *array)
{
    size_t index = 0;
    enum kd_status status;
    KD_TRY(kd_element_count(list, (size_t)cJSON_GetArraySize(array), reader->error));
    kd_section_resize(&reader->scene, list, 0);
    for (const cJSON *item = array->child; item; item = item->next)
        KD_TRY(read_element(reader, list, index++, item, false));
done:
    return status;
}

/* Reads {"0": {...}}, which changes elements by index, in any order. New elements must continue the list without a
 * gap. */
static enum kd_status read_indices(struct reader *reader, const struct kd_section *list, const cJSON *object)
{
    size_t before = kd_section_size(&reader->scene, list), last = before;
    const cJSON *given[KD_LIST_MOST] = { NULL };
    enum kd_status status = KD_OK;
    for (const cJSON *item = object->child; item; item = item->next) {
        size_t index = 0;
        char pointer[KD_PATH_SIZE];
        KD_TRY(kd_element_find(list, item->string, &index, reader->error));
        kd_element_pointer(list, index, pointer);
        bool seen = given[index];
        KD_TRY(once(reader, &seen, pointer));
        given[index] = item;
        last = index >= last ? index + 1 : last;
    }
    for (size_t i = 0; i < last; i++) {
        if (given[i])
            KD_TRY(read_element(reader, list, i, given[i], reader->patch));
        else if (i >= before)
            KD_TRY(kd_element_reach(list, i, last - 1, reader->error));
    }
done:
    return status;
}

static enum kd_status both_names(struct reader *reader, const struct kd_old_name *old)
{
    char pointer[KD_PATH_SIZE];
    snprintf(pointer, sizeof pointer, "/%s", old->name);
    return kd_error_field(reader->error, pointer, "%s is an old name of %s.%zu, and cannot be used with %s", old->name,
                          old->section, old->index, old->section);
}

static enum kd_status read_list(struct reader *reader, const struct kd_section *list, const char *pointer,
                                const cJSON *item)
{
    char allowed[96];
    if (reader->old[list - kd_sections])
        return both_names(reader, reader->old[list - kd_sections]);
    if (cJSON_IsArray(item))
        return read_array(reader, list, item);
    if (cJSON_IsObject(item))
        return read_indices(reader, list, item);
    if (reader->patch && cJSON_IsNull(item)) {
        kd_section_resize(&reader->scene, list, 0);
        return KD_OK;
    }
    snprintf(allowed, sizeof allowed, "an array of up to %zu objects with fields", list->most);
    return not_a(reader, item, pointer, allowed);
}

static enum kd_status read_section(struct reader *reader, const struct kd_section *section, const cJSON *item)
{
    char pointer[KD_PATH_SIZE];
    kd_section_pointer(section, pointer);
    enum kd_status status = once(reader, &reader->seen_section[section - kd_sections], pointer);
    if (status)
        return status;
    return section->most ? read_list(reader, section, pointer, item)
                         : read_object(reader, section, 0, pointer, item, reader->patch);
}

/* Reads an element by an old name. It may lie beyond the next free index; then the elements in between are created with
 * defaults. */
static enum kd_status read_old(struct reader *reader, const struct kd_old_name *old, const cJSON *item)
{
    const struct kd_section *list = kd_section_find(old->section);
    char pointer[KD_PATH_SIZE];
    snprintf(pointer, sizeof pointer, "/%s", old->name);
    enum kd_status status;
    KD_TRY(once(reader, &reader->seen_old[old - kd_old_names], pointer));
    if (reader->seen_section[list - kd_sections])
        KD_TRY(both_names(reader, old));
    reader->old[list - kd_sections] = old;
    KD_TRY(read_element(reader, list, old->index, item, reader->patch));
done:
    return status;
}

static enum kd_status read_member(struct reader *reader, struct object *top, const cJSON *item)
{
    if (!strcmp(item->string, "version")) {
        struct kd_value value = kd_tree_value(item);
        enum kd_status status = once(reader, &reader->seen_version, "/version");
        return status ? status : kd_scene_version(&value, reader->error);
    }
    const struct kd_section *section =
        *item->string && !strchr(item->string, '.') ? kd_section_find(item->string) : NULL;
    const struct kd_old_name *old = kd_old_name_find(item->string);
    return section ? read_section(reader, section, item)
           : old   ? read_old(reader, old, item)
                   : read_field(reader, top, item);
}

static enum kd_status read_document(struct reader *reader, const struct kd_scene *before, const cJSON *root)
{
    struct object top = { .section = kd_section_find(""), .patch = reader->patch };
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(root)) {
        char given[KD_VALUE_SIZE];
        struct kd_value value = kd_tree_value(root);
        kd_value_describe(&value, given);
        return kd_error_field(reader->error, "", "the document is %s; it must be an object", given);
    }
    for (const cJSON *item = root->child; item && !status; item = item->next)
        status = read_member(reader, &top, item);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (reader->old[i])
            kd_section_trim(&reader->scene, &kd_sections[i], kd_section_size(before, &kd_sections[i]));
    if (kd_style_field() && reader->given[kd_style_field() - kd_fields])
        kd_style_apply(&reader->scene, reader->given);
    kd_scene_settle(&reader->scene, reader->given);
    return status;
}

enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error)
{
    struct reader reader = { .scene = *scene, .patch = patch, .error = error };
    enum kd_status status = read_document(&reader, scene, object);
    if (!status)
        *scene = reader.scene;
    return status;
}

static enum kd_status merge(struct kd_scene *scene, const char *text, size_t length, bool patch, struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status = kd_tree_parse(text, length, KD_SCENE_JSON_MAX, KD_SCAN_FEW, &root, error);
    if (!status)
        status = kd_scene_from_tree(scene, root, patch, error);
    cJSON_Delete(root);
    return status;
}

enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error)
{
    return merge(scene, text, length, false, error);
}

enum kd_status kd_scene_patch(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error)
{
    return merge(scene, text, length, true, error);
}
