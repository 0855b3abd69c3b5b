#include "scene/tree.h"

#include "base/pause.h"
#include "scene/number.h"
#include "scene/scan.h"
#include "scene/text.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct kd_value kd_tree_value(const cJSON *item)
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

cJSON *kd_tree_read(const char *text, size_t length, bool *starved)
{
    struct kd_number_locale locale = kd_number_locale_enter();
    errno = 0;
    cJSON *root = cJSON_ParseWithLength(text, length);
    *starved = !root && errno == ENOMEM; /* cJSON does not tell that from bad JSON; malloc does */
    kd_number_locale_leave(locale);
    return root;
}

/* text ends in a NUL that length does not count: cJSON peeks one byte past what it is told. */
static enum kd_status parse(const char *text, size_t length, cJSON **out, struct kd_error *error)
{
    const char *end = text;
    struct kd_number_locale locale = kd_number_locale_enter();
    errno = 0;
    cJSON *root = cJSON_ParseWithLengthOpts(text, length + 1, &end, 0);
    bool starved = !root && errno == ENOMEM; /* as above */
    kd_number_locale_leave(locale);
    if (starved)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    size_t at = (size_t)(end - text);
    struct kd_text_place place = kd_text_place_of(text, at < length ? at : length);
    if (!root && at >= length)
        return kd_error_set(error, KD_EINVAL,
                            "the document is not valid JSON: it ends too early, after %zu bytes, in line %zu", length,
                            place.line);
    if (!root)
        return kd_error_set(error, KD_EINVAL, "the document is not valid JSON near byte %zu, line %zu, column %zu", at,
                            place.line, place.column);
    at += strspn(end, " \t\n\r");
    if (at < length) {
        cJSON_Delete(root);
        place = kd_text_place_of(text, at);
        return kd_error_set(error, KD_EINVAL, "text follows the document at byte %zu, line %zu, column %zu", at,
                            place.line, place.column);
    }
    *out = root;
    return KD_OK;
}

enum kd_status kd_tree_parse(const char *text, size_t length, size_t most, size_t values, cJSON **out,
                             struct kd_error *error)
{
    if (length > most)
        return kd_error_set(error, KD_EINVAL, "the document has %zu bytes, allowed are %zu", length, most);
    kd_scan_skip_mark(&text, &length);
    enum kd_status status = kd_scan_json(text, length, values, error);
    if (status)
        return status;
    char *copy = malloc(length + 1);
    if (!copy)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    if (length)
        memcpy(copy, text, length);
    copy[length] = 0;
    kd_pause();
    status = parse(copy, length, out, error);
    kd_pause();
    free(copy);
    return status;
}
