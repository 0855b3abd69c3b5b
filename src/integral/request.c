#include "integral/internal.h"
#include "integral/request.h"

#include "base/spelling.h"
#include "document/members.h"
#include "document/number.h"
#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void kd_integral_request_finish(struct kd_integral_request *request)
{
    struct kd_integral_list *const lists[] = { &request->edges,          &request->radii,     &request->g_star,
                                               &request->frequencies_hz, &request->u,         &request->v,
                                               &request->lengths,        &request->angles_deg };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        free(lists[i]->at);
        *lists[i] = (struct kd_integral_list) { 0 };
    }
    free(request->scene);
    request->scene = NULL;
    kd_integral_drop_observation(request);
}

static bool has(const struct kd_integral_request *request, const struct kd_integral_field *field)
{
    return field->of & 1u << request->what;
}

static enum kd_status unknown(const struct kd_integral_request *request, const char *name, const char *pointer,
                              struct kd_error *error)
{
    char shown[60], known[400] = ""; /* kd_error_field truncates longer text */
    struct kd_spelling_best meant = { 0 };
    if (request->what == KD_INTEGRAL_SPECTRUM && !strcmp(name, "volume"))
        return kd_error_field(error, pointer,
                              "volume cannot be a member here; it belongs to a scene, as in \"scene\": {\"volume\": "
                              "...}, or a preset such as \"preset\": \"riaf\"");
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0; i < kd_n_integral_fields; i++) {
        const struct kd_integral_field *f = &kd_integral_fields[i];
        size_t used = strlen(known);
        if (!has(request, f))
            continue;
        kd_spelling_offer(&meant, name, f->name);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", f->name);
    }
    return kd_error_field(error, pointer, "there is no field %s here%s%s; known are %s", shown,
                          meant.name ? "; did you mean " : "", meant.name ? meant.name : "", known);
}

/* Copies the text up to `mark`, truncated to the buffer. */
static const char *part(const char *text, const char *mark, char out[64])
{
    size_t length = strcspn(text, mark);
    length = length < 63 ? length : 63;
    memcpy(out, text, length);
    out[length] = 0;
    return out;
}

static void describe_allowed(const struct kd_integral_field *f, char out[KD_ALLOWED_SIZE])
{
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    kd_number_format(low, f->least);
    kd_number_format(high, f->most);
    if (f->kind == KD_INTEGRAL_WORD || f->kind == KD_INTEGRAL_WORDS) {
        char one[64];
        size_t used = 0;
        for (const char *word = f->words; *word;
             word += word[strcspn(word, "|")] ? strcspn(word, "|") + 1 : strlen(word))
            used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"",
                                     !used               ? ""
                                     : strchr(word, '|') ? ", "
                                                         : " or ",
                                     part(word, "|", one));
        return;
    }
    snprintf(out, KD_ALLOWED_SIZE, f->open ? "%sa number above %s and below %s%s%s%s" : "%s%s to %s%s%s%s",
             f->kind == KD_INTEGRAL_INT ? "a whole number from " : "", low, high, f->words ? ", or \"" : "",
             f->words ? f->words : "", f->words ? "\"" : "");
}

static enum kd_status refuse(const struct kd_integral_field *f, const struct kd_value *value, const char *pointer,
                             struct kd_error *error)
{
    char given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    kd_value_describe(value, given);
    describe_allowed(f, allowed);
    return kd_error_field(error, pointer, "%s is %s%s; it must be %s", f->name, given,
                          f->kind == KD_INTEGRAL_WORD || f->kind == KD_INTEGRAL_WORDS ? "" : kd_value_unwanted(value),
                          allowed);
}

static bool inside(const struct kd_integral_field *f, const struct kd_value *value)
{
    double x = value->number;
    if (value->kind != KD_VALUE_NUMBER)
        return false;
    return f->open ? x > f->least && x < f->most : x >= f->least && x <= f->most;
}

/* Index of a word in "a|b|c"; -1: none of them. */
static int word_place(const char *words, const char *text)
{
    int i = 0;
    for (const char *word = words; *word; i++) {
        size_t n = strcspn(word, "|");
        if (strlen(text) == n && !strncmp(word, text, n))
            return i;
        word += n + (word[n] == '|');
    }
    return -1;
}

static bool store_word(void *at, const char *words, const char *text)
{
    const int i = word_place(words, text);
    if (i >= 0)
        memcpy(at, &i, sizeof i); /* every enum here is as wide as int */
    return i >= 0;
}

static bool store(struct kd_integral_request *request, const struct kd_integral_field *f, const struct kd_value *value)
{
    void *at = (char *)request + f->offset;
    switch (f->kind) {
    case KD_INTEGRAL_REAL:
        if (f->words && value->kind == KD_VALUE_STRING && !strcmp(value->text, f->words)) {
            *(double *)at = NAN;
            return true;
        }
        if (inside(f, value))
            *(double *)at = value->number;
        return inside(f, value);
    case KD_INTEGRAL_INT:
        if (!inside(f, value) || value->number != floor(value->number))
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case KD_INTEGRAL_WORD: return value->kind == KD_VALUE_STRING && store_word(at, f->words, value->text);
    case KD_INTEGRAL_WORDS:
    case KD_INTEGRAL_NUMBERS: break;
    }
    return false;
}

/* Replaces a list by room for n numbers. */
enum kd_status kd_integral_make_room(struct kd_integral_request *request, const struct kd_integral_field *f, size_t n,
                                     const char *pointer, struct kd_integral_list **list, struct kd_error *error)
{
    *list = (struct kd_integral_list *)(void *)((char *)request + f->offset);
    if (!n || n > KD_INTEGRAL_LIST)
        return kd_error_field(error, pointer, "%s has %zu numbers; it must have 1 to %u", f->name, n, KD_INTEGRAL_LIST);
    free((*list)->at);
    **list = (struct kd_integral_list) { malloc(n * sizeof(double)), n };
    return (*list)->at ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %zu numbers", n);
}

static enum kd_status put_number(struct kd_integral_list *list, size_t i, const struct kd_integral_field *f,
                                 const struct kd_value *value, const char *pointer, struct kd_error *error)
{
    char at[sizeof error->pointer];
    snprintf(at, sizeof at, "%s/%zu", pointer, i);
    if (!inside(f, value))
        return refuse(f, value, at, error);
    list->at[i] = value->number;
    return KD_OK;
}

static enum kd_status read_list(struct kd_integral_request *request, const struct kd_integral_field *f,
                                const cJSON *item, const char *pointer, struct kd_error *error)
{
    struct kd_integral_list *list;
    size_t i = 0;
    enum kd_status status = KD_OK;
    if (!cJSON_IsArray(item)) {
        char given[KD_VALUE_SIZE];
        struct kd_value value = kd_tree_value(item);
        kd_value_describe(&value, given);
        return kd_error_field(error, pointer, "%s is %s; it must be an array of numbers", f->name, given);
    }
    KD_TRY(kd_integral_make_room(request, f, (size_t)cJSON_GetArraySize(item), pointer, &list, error));
    for (const cJSON *one = item->child; one; one = one->next, i++) {
        struct kd_value value = kd_tree_value(one);
        KD_TRY(put_number(list, i, f, &value, pointer, error));
    }
done:
    return status;
}

/* Reads numbers separated by commas. */
static enum kd_status read_typed(struct kd_integral_request *request, const struct kd_integral_field *f,
                                 const char *text, const char *pointer, struct kd_error *error)
{
    struct kd_integral_list *list;
    size_t n = 1, i = 0;
    enum kd_status status = KD_OK;
    for (const char *c = text; *c; c++)
        n += *c == ',';
    KD_TRY(kd_integral_make_room(request, f, n, pointer, &list, error));
    for (const char *c = text; i < n; i++, c += strcspn(c, ",") + 1) {
        char one[64];
        struct kd_value value = kd_value_typed(part(c, ",", one));
        KD_TRY(put_number(list, i, f, &value, pointer, error));
    }
done:
    return status;
}

/* Adds a word to a set. */
static enum kd_status put_word(struct kd_integral_request *request, const struct kd_integral_field *f,
                               const struct kd_value *value, const char *pointer, struct kd_error *error)
{
    uint32_t *set = (uint32_t *)(void *)((char *)request + f->offset);
    const int i = value->kind == KD_VALUE_STRING ? word_place(f->words, value->text) : -1;
    if (i < 0)
        return refuse(f, value, pointer, error);
    if (*set & 1u << i)
        return kd_error_field(error, pointer, "%s has %s twice", f->name, value->text);
    *set |= 1u << i;
    return KD_OK;
}

/* Reads words from an array, or separated by commas. */
static enum kd_status read_words(struct kd_integral_request *request, const struct kd_integral_field *f,
                                 const cJSON *item, const char *text, const char *pointer, struct kd_error *error)
{
    uint32_t *set = (uint32_t *)(void *)((char *)request + f->offset);
    enum kd_status status = KD_OK;
    *set = 0;
    if (item && !cJSON_IsArray(item)) {
        struct kd_value value = kd_tree_value(item);
        char given[KD_VALUE_SIZE];
        kd_value_describe(&value, given);
        return kd_error_field(error, pointer, "%s is %s; it must be an array of words", f->name, given);
    }
    for (const cJSON *one = item ? item->child : NULL; one; one = one->next) {
        struct kd_value value = kd_tree_value(one);
        KD_TRY(put_word(request, f, &value, pointer, error));
    }
    for (const char *c = text; c && *c; c += strcspn(c, ","), c += *c == ',') {
        char one[64];
        const struct kd_value value = { .kind = KD_VALUE_STRING, .text = part(c, ",", one) };
        KD_TRY(put_word(request, f, &value, pointer, error));
    }
    if (!*set && f->least > 0)
        return kd_error_field(error, pointer, "%s has no words; it must have at least one", f->name);
done:
    return status;
}

const struct kd_integral_field *kd_integral_field_named(const struct kd_integral_request *request, const char *name)
{
    for (size_t i = 0; i < kd_n_integral_fields; i++)
        if (has(request, &kd_integral_fields[i]) && !strcmp(kd_integral_fields[i].name, name))
            return &kd_integral_fields[i];
    return NULL;
}

/* Reads a field by its name, which is OBJECT.NAME for a member of an object. */
static enum kd_status read_named(struct kd_integral_request *request, const cJSON *item, const char *name,
                                 const char *pointer, struct kd_error *error)
{
    const struct kd_integral_field *f = kd_integral_field_named(request, name);
    if (!f)
        return unknown(request, name, pointer, error);
    uint64_t bit = UINT64_C(1) << (f - kd_integral_fields);
    if (request->seen & bit)
        return kd_error_field(error, pointer, "%s is given twice", f->name);
    request->seen |= bit;
    if (f->kind == KD_INTEGRAL_NUMBERS)
        return read_list(request, f, item, pointer, error);
    if (f->kind == KD_INTEGRAL_WORDS)
        return read_words(request, f, item, NULL, pointer, error);
    struct kd_value value = kd_tree_value(item);
    return store(request, f, &value) ? KD_OK : refuse(f, &value, pointer, error);
}

static bool is_object(const struct kd_integral_request *request, const char *name)
{
    const size_t n = strlen(name);
    for (size_t i = 0; i < kd_n_integral_fields; i++)
        if (has(request, &kd_integral_fields[i]) && !strncmp(kd_integral_fields[i].name, name, n) &&
            kd_integral_fields[i].name[n] == '.')
            return true;
    return false;
}

static enum kd_status read_item(struct kd_integral_request *request, const cJSON *item, struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "", name[80];
    enum kd_status status = KD_OK;
    kd_text_pointer(pointer, sizeof pointer, item->string);
    if (strchr(item->string, '.'))
        return unknown(request, item->string, pointer, error);
    if (!is_object(request, item->string))
        return read_named(request, item, item->string, pointer, error);
    if (!cJSON_IsObject(item))
        return kd_member_refuse(item, pointer, "an object", error);
    for (const cJSON *one = item->child; one; one = one->next) {
        char inner[sizeof pointer] = "";
        snprintf(name, sizeof name, "%s.%.60s", item->string, one->string);
        kd_text_pointer(inner, sizeof inner, one->string);
        KD_TRY(read_named(request, one, name, inner, error));
    }
done:
    if (status)
        kd_error_inside(error, pointer);
    return status;
}

enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(kd_tree_parse(text, length, KD_INTEGRAL_BODY_MAX, 4 * KD_INTEGRAL_LIST, &root, error));
    if (!cJSON_IsObject(root))
        KD_TRY(kd_error_field(error, "", "the document must be an object with fields"));
    KD_TRY(kd_integral_read_scene(request, root, error));
    KD_TRY(kd_integral_read_observation(request, root, error));
    for (const cJSON *item = root->child; item; item = item->next)
        if (!kd_integral_is_scene_member(request, item->string) && !kd_integral_is_observation(request, item->string))
            KD_TRY(read_item(request, item, error));
done:
    kd_tree_free(root);
    return status;
}

enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error)
{
    enum kd_status status = kd_integral_request_read(request, text, length, error);
    return status ? status : kd_integral_request_check(request, error);
}

enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text,
                                       struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "";
    kd_text_pointer(pointer, sizeof pointer, name);
    const struct kd_integral_field *f = kd_integral_field_named(request, name);
    if (!f)
        return unknown(request, name, pointer, error);
    request->seen |= UINT64_C(1) << (f - kd_integral_fields);
    if (f->kind == KD_INTEGRAL_NUMBERS)
        return read_typed(request, f, text, pointer, error);
    if (f->kind == KD_INTEGRAL_WORDS)
        return read_words(request, f, NULL, text, pointer, error);
    struct kd_value value = kd_value_typed(text);
    return store(request, f, &value) ? KD_OK : refuse(f, &value, pointer, error);
}
