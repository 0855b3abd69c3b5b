/* Scene documents: JSON in. */
#include "scene/hint.h"
#include "scene/scan.h"
#include "scene/text.h"
#include "scene/tree.h"

#include <string.h>

struct reader {
    struct kd_scene scene; /* a copy, handed over when the whole document is right */
    bool seen_field[KD_FIELD_COUNT], seen_section[KD_SECTION_COUNT], seen_version;
    bool patch; /* null takes a field, or a section, back to its default */
    struct kd_error *error;
};

/* Once each: a second one would silently win. */
static enum kd_status once(struct reader *reader, bool *seen, const char *section, const char *name)
{
    if (!*seen) {
        *seen = true;
        return KD_OK;
    }
    char pointer[KD_PATH_SIZE] = "";
    if (*section)
        kd_text_pointer(pointer, sizeof pointer, section);
    kd_text_pointer(pointer, sizeof pointer, name);
    return kd_error_field(reader->error, pointer, "%s%s%s is given twice", section, *section ? "." : "",
                          name);
}

static enum kd_status read_field(struct reader *reader, const char *section, const cJSON *item)
{
    const struct kd_field *field = kd_field_find(section, item->string);
    if (!field)
        return kd_hint_unknown(reader->error, section, item->string);
    struct kd_value value = kd_tree_value(item);
    enum kd_status status = once(reader, &reader->seen_field[field - kd_fields], section, item->string);
    if (!status && reader->patch && cJSON_IsNull(item)) {
        kd_field_put(&reader->scene, field, field->initial);
        return KD_OK;
    }
    return status ? status : kd_value_store(&reader->scene, field, &value, reader->error);
}

static enum kd_status read_section(struct reader *reader, const struct kd_section *section,
                                   const cJSON *object)
{
    enum kd_status status = once(reader, &reader->seen_section[section - kd_sections], "", section->name);
    if (!status && reader->patch && cJSON_IsNull(object)) {
        for (size_t i = 0; i < section->count; i++)
            kd_field_put(&reader->scene, &kd_fields[section->first + i], kd_fields[section->first + i].initial);
        return KD_OK;
    }
    if (!status && !cJSON_IsObject(object)) {
        char pointer[KD_PATH_SIZE] = "", given[KD_VALUE_SIZE];
        struct kd_value value = kd_tree_value(object);
        kd_text_pointer(pointer, sizeof pointer, section->name);
        kd_value_describe(&value, given);
        status = kd_error_field(reader->error, pointer, "%s is %s, allowed is an object with fields",
                                section->name, given);
    }
    for (const cJSON *item = object->child; item && !status; item = item->next)
        status = read_field(reader, section->name, item);
    return status;
}

static enum kd_status read_member(struct reader *reader, const cJSON *item)
{
    if (!strcmp(item->string, "version")) {
        struct kd_value value = kd_tree_value(item);
        enum kd_status status = once(reader, &reader->seen_version, "", "version");
        return status ? status : kd_value_version(&value, reader->error);
    }
    const struct kd_section *section = *item->string ? kd_section_find(item->string) : NULL;
    return section ? read_section(reader, section, item) : read_field(reader, "", item);
}

static enum kd_status read_document(struct reader *reader, const cJSON *root)
{
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(root)) {
        char given[KD_VALUE_SIZE];
        struct kd_value value = kd_tree_value(root);
        kd_value_describe(&value, given);
        return kd_error_field(reader->error, "", "the document is %s, allowed is an object", given);
    }
    for (const cJSON *item = root->child; item && !status; item = item->next)
        status = read_member(reader, item);
    return status;
}

enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error)
{
    struct reader reader = { .scene = *scene, .patch = patch, .error = error };
    enum kd_status status = read_document(&reader, object);
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
