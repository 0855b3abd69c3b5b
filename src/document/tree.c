#include "document/tree.h"

#include "base/pause.h"
#include "document/long_strings.h"
#include "document/number.h"
#include "document/scan.h"
#include "document/text.h"

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
    /* cJSON reports a lack of memory like invalid JSON. But malloc sets errno in that case, so errno tells them
     * apart. */
    *starved = !root && errno == ENOMEM;
    kd_number_locale_leave(locale);
    return root;
}

/* True while this thread reads or frees a large tree. That takes cJSON up to a second, so other requests may run in
 * between. */
static _Thread_local bool shares;
static _Thread_local uint64_t allocations;

static void pause_if_large(uint64_t n)
{
    const int kept = errno; /* errno is restored below, because the caller compares it with ENOMEM */
    if (shares && (n >= 65536 || ++allocations % 64 == 0))
        kd_pause();
    errno = kept;
}

static void *allocate(size_t n)
{
    pause_if_large(n);
    return malloc(n);
}

static void give_back(void *memory)
{
    pause_if_large(0);
    free(memory);
}

/* Runs before other threads start, because cJSON's hooks are global. */
__attribute__((constructor)) static void hook(void)
{
    cJSON_InitHooks(&(cJSON_Hooks) { .malloc_fn = allocate, .free_fn = give_back });
}

void kd_tree_free(cJSON *root)
{
    shares = true;
    cJSON_Delete(root);
    shares = false;
}

/* Parses text that contains no long strings. The byte after the text must be a NUL that length does not count,
 * because cJSON reads one byte beyond the end. */
static enum kd_status parse(const char *text, size_t length, const struct kd_long_strings *strings, cJSON **out,
                            struct kd_error *error)
{
    const char *end = text;
    struct kd_number_locale locale = kd_number_locale_enter();
    errno = 0;
    shares = true;
    cJSON *root = cJSON_ParseWithLengthOpts(text, length + 1, &end, 0);
    shares = false;
    bool starved = !root && errno == ENOMEM; /* see kd_tree_read */
    kd_number_locale_leave(locale);
    if (starved)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    size_t at = (size_t)(end - text);
    if (root)
        at += strspn(end, " \t\n\r");
    if (root && at >= length) {
        *out = root;
        return KD_OK;
    }
    const bool short_of = !root && at >= length;
    at = kd_long_strings_place(strings, at < length ? at : length);
    const struct kd_text_place place = kd_text_place_of(strings->text, at);
    if (short_of)
        return kd_error_set(error, KD_EINVAL,
                            "the document is not valid JSON: it ends too early, after %zu bytes, in line %zu", at,
                            place.line);
    if (!root)
        return kd_error_set(error, KD_EINVAL, "the document is not valid JSON near byte %zu, line %zu, column %zu", at,
                            place.line, place.column);
    kd_tree_free(root);
    return kd_error_set(error, KD_EINVAL, "text follows the document at byte %zu, line %zu, column %zu", at, place.line,
                        place.column);
}

enum kd_status kd_tree_parse(const char *text, size_t length, size_t most, size_t values, cJSON **out,
                             struct kd_error *error)
{
    struct kd_long_strings strings;
    cJSON *root = NULL;
    if (length > most)
        return kd_error_set(error, KD_EINVAL, "the document has %zu bytes; it must have at most %zu", length, most);
    if (!text)
        text = ""; /* adding 0 to a null pointer is undefined in C */
    kd_scan_skip_mark(&text, &length);
    enum kd_status status = kd_scan_json(text, length, values, error);
    if (status)
        return status;
    kd_long_strings_find(&strings, text, length);
    char *copy = malloc(strings.length + 1);
    if (!copy)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    kd_long_strings_cut(&strings, length, copy);
    copy[strings.length] = 0;
    status = parse(copy, strings.length, &strings, &root, error);
    free(copy);
    if (!status)
        status = kd_long_strings_fill(&strings, root, error);
    if (status)
        kd_tree_free(root);
    else
        *out = root;
    return status;
}
