/* Reads documents and typed text according to tables of rows. */
#include "document/document_internal.h"

#include "document/tree.h"

#include <stdio.h>
#include <string.h>

/* Items of a JSON array, or of typed text with commas between the items. */
struct items {
    const cJSON *item; /* the next item of the JSON array; NULL if the items come from typed text */
    const char *text;
    size_t n;
    char one[KD_WORD_ROOM];
};

static struct items items_of(const cJSON *array, const char *text)
{
    struct items items = { array ? array->child : NULL, text, array ? (size_t)cJSON_GetArraySize(array) : !!*text, "" };
    for (; text && *text; text++)
        items.n += *text == ',';
    return items;
}

static struct kd_value next(struct items *items, bool words)
{
    if (items->text) {
        const size_t n = strcspn(items->text, ",");
        snprintf(items->one, sizeof items->one, "%.*s", (int)n, items->text);
        items->text += n + (items->text[n] == ',');
        return words ? (struct kd_value) { KD_VALUE_STRING, 0, items->one } : kd_value_typed(items->one);
    }
    const struct kd_value value = kd_tree_value(items->item);
    items->item = items->item->next;
    return value;
}

static enum kd_status read_words(const struct kd_row *row, void *to, struct items *items, const char *called,
                                 const char *pointer, struct kd_error *error)
{
    uint32_t *set = (uint32_t *)(void *)((char *)to + row->offset);
    *set = 0;
    if (!items->n && row->least > 0)
        return kd_error_field(error, pointer, "%s has no words; it must have at least one", called);
    for (size_t k = 0; k < items->n; k++) {
        const struct kd_value value = next(items, true);
        const int i = value.kind == KD_VALUE_STRING ? kd_word_index(row->words, value.text) : -1;
        if (i < 0)
            return kd_row_refuse(row, &value, called, pointer, error);
        if (*set & 1u << i)
            return kd_error_field(error, pointer, "%s has %s twice", called, value.text);
        *set |= 1u << i;
    }
    return KD_OK;
}

static enum kd_status read_numbers(const struct kd_row *row, void *to, struct items *items, const char *called,
                                   const char *pointer, struct kd_error *error)
{
    double *at = (double *)(void *)((char *)to + row->offset);
    if (row->kind == KD_KIND_LIST) {
        struct kd_number_list *list;
        enum kd_status status = kd_row_make_room(row, to, items->n, pointer, &list, error);
        if (status)
            return status;
        at = list->at;
    }
    for (size_t k = 0; k < items->n; k++) {
        const struct kd_value value = next(items, false);
        char place[sizeof error->pointer];
        snprintf(place, sizeof place, "%.130s/%zu", pointer, k);
        if (value.kind != KD_VALUE_NUMBER || !kd_row_holds(row, value.number))
            return kd_row_refuse(row, &value, called, place, error);
        at[k] = value.number == 0 ? 0 : value.number; /* stores 0 instead of -0, as kd_row_put_number does */
    }
    return KD_OK;
}

static enum kd_status read_series(const struct kd_row *row, void *to, const cJSON *array, const char *called,
                                  const char *pointer, struct kd_error *error)
{
    struct kd_words words = { 0 };
    const cJSON *bad = cJSON_IsArray(array) ? array->child : array;
    while (cJSON_IsArray(array) && bad && cJSON_IsString(bad) &&
           kd_words_add(row->words, bad->valuestring, strlen(bad->valuestring), &words))
        bad = bad->next;
    if (!bad && words.count) {
        *(struct kd_words *)(void *)((char *)to + row->offset) = words;
        return KD_OK;
    }
    char given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    const struct kd_value value = kd_tree_value(bad ? bad : array);
    kd_value_describe(&value, given);
    kd_row_allowed(row, allowed);
    return kd_error_field(error, pointer, "%s %s %s; it must be an array: %s", called,
                          cJSON_IsArray(array) && bad ? "holds" : "is", bad ? given : "an empty array", allowed);
}

/* Reads a row that is an array, from a JSON item or from typed text. */
static enum kd_status read_array_row(const struct kd_row *row, void *to, const cJSON *item, const char *text,
                                     const char *called, const char *pointer, struct kd_error *error)
{
    const bool words = row->kind == KD_KIND_WORDS, vector = row->kind == KD_KIND_VECTOR;
    const struct kd_value value = item ? kd_tree_value(item) : kd_value_typed(text);
    if (row->kind == KD_KIND_SERIES)
        return read_series(row, to, item, called, pointer, error);
    struct items items = { 0 };
    if (!item || cJSON_IsArray(item))
        items = items_of(item, text);
    if ((item && !cJSON_IsArray(item)) || (vector && items.n != row->room)) {
        char given[KD_VALUE_SIZE], count[24] = "";
        kd_value_describe(&value, given);
        if (vector)
            snprintf(count, sizeof count, "%zu ", row->room);
        return kd_error_field(error, pointer, "%s is %s; it must be an array of %s%s", called, given, count,
                              words ? "words" : "numbers");
    }
    return words ? read_words(row, to, &items, called, pointer, error)
                 : read_numbers(row, to, &items, called, pointer, error);
}

/* Reads a row from a JSON item or from typed text. named: name of the row in messages, if it differs from the row's
 * path. */
static enum kd_status read_row(const struct kd_row *row, void *to, const cJSON *item, const char *text,
                               const struct kd_object *object, const char *pointer, const char *named,
                               struct kd_error *error)
{
    const bool array = row->kind == KD_KIND_WORDS || row->kind == KD_KIND_VECTOR || row->kind == KD_KIND_LIST ||
                       (row->kind == KD_KIND_SERIES && item);
    const struct kd_value value = item ? kd_tree_value(item) : kd_value_typed(text);
    if (row->kind == KD_KIND_JSON && item) {
        *(const cJSON **)(void *)((char *)to + row->offset) = item;
        return KD_OK;
    }
    if (!array && kd_row_take(row, to, &value))
        return KD_OK;
    const struct kd_mention place = kd_mention_of(pointer, object, row->name);
    named = named ? named : place.called;
    return array ? read_array_row(row, to, item, text, named, place.pointer, error)
                 : kd_row_refuse(row, &value, named, place.pointer, error);
}

struct reader {
    const struct kd_document *document;
    void *to;
    const char *pointer; /* JSON pointer of the document */
    uint64_t *given;
    struct kd_error *error;
    bool patch; /* null resets */
};

static void note(const struct kd_document *document, const struct kd_row *row, uint64_t *given)
{
    const size_t i = (size_t)(row - document->rows);
    if (given)
        given[i / 64] |= UINT64_C(1) << i % 64;
}

static void *element_of(const struct reader *r, const struct kd_object *object)
{
    return (char *)r->to + (object->list ? object->index * object->list->stride : 0);
}

static enum kd_status refuse(const struct reader *r, const struct kd_object *object, const cJSON *item,
                             const char *allowed)
{
    char given[KD_VALUE_SIZE];
    const struct kd_value value = kd_tree_value(item);
    const struct kd_mention place = kd_mention_of(r->pointer, object, NULL);
    kd_value_describe(&value, given);
    return kd_error_field(r->error, place.pointer, "%s is %s; it must be %s",
                          *place.called ? place.called
                          : *r->pointer ? r->pointer + 1
                                        : "the document",
                          given, allowed);
}

static enum kd_status read_members(struct reader *r, const struct kd_object *object, const cJSON *members, bool patch);

/* Resets the fields of an object, and of the objects within it. */
static void reset(struct reader *r, const struct kd_object *object)
{
    const size_t n = strlen(object->name);
    for (size_t i = 0; i < r->document->n; i++) {
        const struct kd_row *row = &r->document->rows[i];
        const char *of = row->object ? row->object : "";
        if (strncmp(of, object->name, n) || (of[n] && of[n] != '.'))
            continue;
        kd_row_reset(row, element_of(r, object));
        note(r->document, row, r->given);
    }
}

static enum kd_status read_object(struct reader *r, const struct kd_object *object, const cJSON *item, bool patch)
{
    if (patch && cJSON_IsNull(item)) {
        reset(r, object);
        return KD_OK;
    }
    return cJSON_IsObject(item) ? read_members(r, object, item, patch)
                                : refuse(r, object, item, "an object with fields");
}

/* Reads an element of a list. The element is created if it does not exist, except by null. */
static enum kd_status read_element(struct reader *r, const struct kd_list *list, size_t index, const cJSON *item,
                                   bool patch)
{
    const struct kd_object object = { list->object, list, index };
    if (index >= kd_list_size(list, r->to)) {
        if (patch && cJSON_IsNull(item))
            return KD_OK;
        kd_list_resize(r->document, list, r->to, index + 1);
    }
    return read_object(r, &object, item, patch);
}

/* Reads an array, which replaces all elements of the list. */
static enum kd_status read_array(struct reader *r, const struct kd_list *list, const cJSON *array)
{
    size_t index = 0;
    enum kd_status status;
    KD_TRY(kd_list_check(list, (size_t)cJSON_GetArraySize(array), r->error));
    kd_list_resize(r->document, list, r->to, 0);
    for (const cJSON *item = array->child; item; item = item->next)
        KD_TRY(read_element(r, list, index++, item, false));
done:
    return status;
}

static enum kd_status once(struct reader *r, const struct kd_object *object, const cJSON *members, const cJSON *item)
{
    for (const cJSON *before = members->child; before != item; before = before->next)
        if (!strcmp(before->string, item->string)) {
            const struct kd_mention place = kd_mention_of(r->pointer, object, item->string);
            return kd_error_field(r->error, place.pointer, "%s is given twice", place.called);
        }
    return KD_OK;
}

/* Reads {"0": {...}}, which changes elements by index, in any order. New elements must continue the list without a
 * gap. */
static enum kd_status read_indices(struct reader *r, const struct kd_list *list, const cJSON *elements)
{
    const struct kd_object object = { .name = list->object };
    const size_t before = kd_list_size(list, r->to);
    size_t last = before;
    enum kd_status status = KD_OK;
    for (const cJSON *item = elements->child; item; item = item->next) {
        size_t index = 0;
        KD_TRY(kd_list_index(list, item->string, r->pointer, &index, r->error));
        KD_TRY(once(r, &object, elements, item));
        last = index >= last ? index + 1 : last;
    }
    for (size_t i = 0; i < last; i++) {
        char token[24];
        snprintf(token, sizeof token, "%zu", i);
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(elements, token);
        if (item)
            KD_TRY(read_element(r, list, i, item, r->patch));
        else if (i >= before)
            KD_TRY(kd_list_reach(list, i, last - 1, r->pointer, r->error));
    }
done:
    return status;
}

static enum kd_status both_names(struct reader *r, const struct kd_former *former)
{
    const struct kd_object whole = { .name = "" };
    return kd_error_field(r->error, kd_mention_of(r->pointer, &whole, former->name).pointer,
                          "%s is an old name of %s.%zu, and cannot be used with %s", former->name, former->object,
                          former->index, former->object);
}

static enum kd_status read_list(struct reader *r, const struct kd_list *list, const cJSON *members, const cJSON *item)
{
    char allowed[96];
    const struct kd_object object = { .name = list->object };
    for (const cJSON *before = members->child; before != item; before = before->next) {
        const struct kd_former *former = kd_find_former(r->document, before->string);
        if (former && !strcmp(former->object, list->object))
            return both_names(r, former);
    }
    if (cJSON_IsArray(item))
        return read_array(r, list, item);
    if (cJSON_IsObject(item))
        return read_indices(r, list, item);
    if (r->patch && cJSON_IsNull(item)) {
        kd_list_resize(r->document, list, r->to, 0);
        return KD_OK;
    }
    snprintf(allowed, sizeof allowed, "an array of up to %zu objects with fields", list->most);
    return refuse(r, &object, item, allowed);
}

/* Creates the element to which a former name refers. If it lies beyond the next free index, the elements before it
 * are created with defaults. */
static enum kd_status read_former(struct reader *r, const struct kd_former *former, const cJSON *members,
                                  const cJSON *item)
{
    const struct kd_list *list = kd_document_list(r->document, former->object);
    const size_t size = kd_list_size(list, r->to);
    for (const cJSON *before = members->child; before != item; before = before->next)
        if (!strcmp(before->string, former->object))
            return both_names(r, former);
    enum kd_status status = read_element(r, list, former->index, item, r->patch);
    kd_list_trim(r->document, list, r->to, size);
    return status;
}

/* Reads a member that is not a field. */
static enum kd_status read_part(struct reader *r, const struct kd_object *object, const cJSON *members,
                                const cJSON *item, bool patch)
{
    const bool top = !*object->name;
    const char *inner = object->list ? NULL : kd_find_object(r->document, object->name, item->string);
    const struct kd_former *former = top ? kd_find_former(r->document, item->string) : NULL;
    const bool other = top && r->document->others && kd_word_index(r->document->others, item->string) >= 0;
    if (!inner && !former && !other)
        return kd_unknown(r->document, object, item->string, false,
                          kd_mention_of(r->pointer, object, item->string).pointer, r->error);
    enum kd_status status = once(r, object, members, item);
    if (status || other)
        return status;
    if (former)
        return read_former(r, former, members, item);
    const struct kd_list *list = kd_document_list(r->document, inner);
    return list ? read_list(r, list, members, item)
                : read_object(r, &(struct kd_object) { .name = inner }, item, patch);
}

static enum kd_status read_members(struct reader *r, const struct kd_object *object, const cJSON *members, bool patch)
{
    enum kd_status status = KD_OK;
    /* last: the row that was given last; highest: the highest row that was given so far. A row above `highest`
     * cannot have been given before. */
    const struct kd_row *last = NULL, *highest = NULL;
    for (const cJSON *item = members->child; item && !status; item = item->next) {
        const struct kd_row *row = kd_find_row(r->document, object->name, item->string, last);
        if (!row) {
            status = read_part(r, object, members, item, patch);
            continue;
        }
        last = row;
        note(r->document, row, r->given);
        status = highest && row <= highest ? once(r, object, members, item) : KD_OK;
        highest = highest && row <= highest ? highest : row;
        if (!status && patch && cJSON_IsNull(item))
            kd_row_reset(row, element_of(r, object));
        else if (!status)
            status = read_row(row, element_of(r, object), item, NULL, object, r->pointer, NULL, r->error);
    }
    return status;
}

static enum kd_status read_whole(struct reader *r, const cJSON *item)
{
    const struct kd_object whole = { .name = "" };
    return cJSON_IsObject(item) ? read_members(r, &whole, item, r->patch)
                                : refuse(r, &whole, item, "an object with fields");
}

enum kd_status kd_document_read(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                uint64_t *given, struct kd_error *error)
{
    struct reader reader = { document, to, pointer, given, error, false };
    return read_whole(&reader, object);
}

enum kd_status kd_document_patch(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                 uint64_t *given, struct kd_error *error)
{
    struct reader reader = { document, to, pointer, given, error, true };
    return read_whole(&reader, object);
}

/* Sets a field of an element. If the element would be the next one after the end of the list, it is created. */
static enum kd_status set_in_list(const struct kd_document *document, void *to, const struct kd_typed_place *place,
                                  const char *text, struct kd_error *error)
{
    const struct kd_list *list = place->list;
    const struct kd_object object = { list->object, list, place->index };
    const size_t size = kd_list_size(list, to);
    enum kd_status status = place->former ? KD_OK : kd_list_reach(list, size, place->index, "", error);
    if (status)
        return status;
    if (place->index >= size)
        kd_list_resize(document, list, to, place->index + 1);
    status = read_row(place->row, (char *)to + place->index * list->stride, NULL, text, &object, "", NULL, error);
    if (status && place->index >= size)
        kd_list_resize(document, list, to, size);
    if (place->former)
        kd_list_trim(document, list, to, size);
    return status;
}

enum kd_status kd_document_set(const struct kd_document *document, void *to, const char *name, const char *text,
                               uint64_t *given, struct kd_error *error)
{
    struct kd_typed_place place = { .row = document->paths ? NULL : kd_document_find(document, name) };
    enum kd_status status = place.row         ? KD_OK
                            : document->paths ? kd_document_place(document, name, &place, error)
                                              : kd_document_unknown(document, name, error);
    if (status)
        return status;
    note(document, place.row, given);
    if (place.list)
        return set_in_list(document, to, &place, text, error);
    const struct kd_object object = { .name = place.row->object ? place.row->object : "" };
    return read_row(place.row, to, NULL, text, &object, "", name, error);
}
