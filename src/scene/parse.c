/* Scene documents: JSON in. */
#include "scene/hint.h"
#include "scene/number.h"
#include "scene/scan.h"
#include "scene/text.h"
#include "scene/value.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    struct kd_scene scene; /* a copy, handed over when the whole document is right */
    bool seen_field[KD_FIELD_COUNT], seen_section[KD_SECTION_COUNT], seen_version;
    struct kd_error *error;
};

static struct kd_value value_of(const cJSON *item)
{
    switch (item->type & 0xff) {
    case cJSON_Number: return (struct kd_value) { KD_VALUE_NUMBER, item->valuedouble, NULL };
    case cJSON_String: return (struct kd_value) { KD_VALUE_STRING, 0, item->valuestring };
    case cJSON_True: return (struct kd_value) { KD_VALUE_BOOL, 1, NULL };
    case cJSON_False: return (struct kd_value) { KD_VALUE_BOOL, 0, NULL };
    case cJSON_Array: return (struct kd_value) { KD_VALUE_ARRAY, 0, NULL };
    case cJSON_Object: return (struct kd_value) { KD_VALUE_OBJECT, 0, NULL };
    default: return (struct kd_value) { KD_VALUE_NULL, 0, NULL };
    }
}

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
    struct kd_value value = value_of(item);
    enum kd_status status = once(reader, &reader->seen_field[field - kd_fields], section, item->string);
    return status ? status : kd_value_store(&reader->scene, field, &value, reader->error);
}

static enum kd_status read_section(struct reader *reader, const struct kd_section *section,
                                   const cJSON *object)
{
    enum kd_status status = once(reader, &reader->seen_section[section - kd_sections], "", section->name);
    if (!status && !cJSON_IsObject(object)) {
        char pointer[KD_PATH_SIZE] = "", given[KD_VALUE_SIZE];
        struct kd_value value = value_of(object);
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
        struct kd_value value = value_of(item);
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
        struct kd_value value = value_of(root);
        kd_value_describe(&value, given);
        return kd_error_field(reader->error, "", "the document is %s, allowed is an object", given);
    }
    for (const cJSON *item = root->child; item && !status; item = item->next)
        status = read_member(reader, item);
    return status;
}

/* text ends in a NUL that length does not count: cJSON peeks one byte past what it is told. */
static enum kd_status parse(const char *text, size_t length, cJSON **out, struct kd_error *error)
{
    const char *end = text;
    struct kd_number_locale locale = kd_number_locale_enter();
    cJSON *root = cJSON_ParseWithLengthOpts(text, length + 1, &end, 0);
    kd_number_locale_leave(locale);
    size_t at = (size_t)(end - text);
    if (!root && at >= length)
        return kd_error_set(error, KD_EINVAL,
                            "the document is not valid JSON: it ends too early, after %zu bytes", length);
    if (!root)
        return kd_error_set(error, KD_EINVAL, "the document is not valid JSON near byte %zu", at);
    at += strspn(end, " \t\n\r");
    if (at < length) {
        cJSON_Delete(root);
        return kd_error_set(error, KD_EINVAL, "text follows the document at byte %zu", at);
    }
    *out = root;
    return KD_OK;
}

enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length,
                                  struct kd_error *error)
{
    if (length > KD_SCENE_JSON_MAX)
        return kd_error_set(error, KD_EINVAL, "the document has %zu bytes, allowed are %u", length,
                            KD_SCENE_JSON_MAX);
    enum kd_status status = kd_scan_json(text, length, error);
    if (status)
        return status;
    char *copy = malloc(length + 1);
    if (!copy)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    if (length)
        memcpy(copy, text, length);
    copy[length] = 0;

    cJSON *root = NULL;
    struct reader reader = { .scene = *scene, .error = error };
    status = parse(copy, length, &root, error);
    if (!status)
        status = read_document(&reader, root);
    if (!status)
        *scene = reader.scene;
    cJSON_Delete(root);
    free(copy);
    return status;
}
