/* Reads documents and typed text by tables of rows. */
#include "document/internal.h"

#include "base/spelling.h"
#include "document/members.h"
#include "document/text.h"
#include "document/tree.h"

#include <stdio.h>
#include <string.h>

bool kd_row_is_of(const struct kd_document *document, const struct kd_row *row, const char *object)
{
    return (!document->of || !row->of || row->of & document->of) &&
           (object && row->object ? !strcmp(object, row->object) : object == row->object);
}

/* The first row of an object, by its name; NULL: the document has no such object. */
static const struct kd_row *find_object(const struct kd_document *document, const char *name)
{
    for (size_t i = 0; i < document->n; i++)
        if (kd_row_is_of(document, &document->rows[i], name))
            return &document->rows[i];
    return NULL;
}

static const struct kd_row *find(const struct kd_document *document, const char *object, const char *name)
{
    for (size_t i = 0; i < document->n; i++)
        if (kd_row_is_of(document, &document->rows[i], object) && !strcmp(document->rows[i].name, name))
            return &document->rows[i];
    return NULL;
}

const struct kd_row *kd_document_find(const struct kd_document *document, const char *name)
{
    const char *dot = strchr(name, '.');
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        if (!kd_row_is_of(document, row, row->object) || strcmp(row->name, dot ? dot + 1 : name))
            continue;
        if (!dot || (row->object && strlen(row->object) == (size_t)(dot - name) &&
                     !strncmp(row->object, name, (size_t)(dot - name))))
            return row;
    }
    return NULL;
}

struct known {
    const char *name; /* that was given */
    struct kd_spelling_best meant;
    char list[400];
};

static void add_known(struct known *known, const char *name)
{
    const size_t used = strlen(known->list);
    kd_spelling_offer(&known->meant, known->name, name);
    snprintf(known->list + used, sizeof known->list - used, "%s%s", used ? ", " : "", name);
}

/* parameter: the name was typed, and names any field; otherwise it is a member of an object. */
static enum kd_status unknown(const struct kd_document *document, const char *object, const char *name, bool parameter,
                              const char *pointer, struct kd_error *error)
{
    struct known known = { .name = name };
    char shown[60], other[4][KD_WORD_ROOM];
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        if (kd_row_is_of(document, row, parameter ? row->object : object))
            add_known(&known, row->name);
        else if (!object && row->object && row == find_object(document, row->object))
            add_known(&known, row->object);
    }
    for (int i = 0; !parameter && !object && i < 4 && kd_word_at(document->others, i, other[i]); i++)
        add_known(&known, other[i]);
    return kd_error_field(error, pointer, "there is no %s %.50s%s%s%s%s%s%s %s", parameter ? "parameter" : "field",
                          object ? object : "", object ? "." : "", shown, parameter ? "" : " here",
                          known.meant.name ? "; did you mean " : "", known.meant.name ? known.meant.name : "",
                          known.meant.name ? "? Known are" : "; known are", known.list);
}

enum kd_status kd_document_unknown(const struct kd_document *document, const char *name, struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "";
    kd_text_pointer(pointer, sizeof pointer, name);
    return unknown(document, NULL, name, true, pointer, error);
}

/* Items of an array, or of typed text with commas. */
struct items {
    const cJSON *item; /* the next one; NULL: those of the text */
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
        at[k] = value.number;
    }
    return KD_OK;
}

/* Reads a row from an item, or from typed text. */
static enum kd_status read_row(const struct kd_row *row, void *to, const cJSON *item, const char *text,
                               const char *called, const char *pointer, struct kd_error *error)
{
    const bool words = row->kind == KD_KIND_WORDS, vector = row->kind == KD_KIND_VECTOR;
    const struct kd_value value = item ? kd_tree_value(item) : kd_value_typed(text);
    if (!words && !vector && row->kind != KD_KIND_LIST)
        return kd_row_put(row, to, &value, called, pointer, error);
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

/* A place in a document: its pointer, and its name in messages. */
struct place { char pointer[sizeof((struct kd_error *)0)->pointer], called[120]; };

static struct place place_of(const char *pointer, const char *object, const char *name)
{
    struct place place;
    char shown[60];
    snprintf(place.pointer, sizeof place.pointer, "%s", pointer);
    if (object)
        kd_text_pointer(place.pointer, sizeof place.pointer, object);
    kd_text_pointer(place.pointer, sizeof place.pointer, name);
    kd_text_clip(shown, sizeof shown, name);
    snprintf(place.called, sizeof place.called, "%.50s%s%s", object ? object : "", object ? "." : "", shown);
    return place;
}

static void note(const struct kd_document *document, const struct kd_row *row, uint64_t *given)
{
    if (given)
        *given |= UINT64_C(1) << (row - document->rows);
}

/* Reads the members of the document itself (object NULL), or of one of its objects. */
static enum kd_status read_members(const struct kd_document *document, void *to, const cJSON *members,
                                   const char *object, const char *pointer, uint64_t *given, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (const cJSON *item = members->child; item && !status; item = item->next) {
        const struct place place = place_of(pointer, object, item->string);
        const struct kd_row *row = find(document, object, item->string);
        const bool inner = !object && !row && find_object(document, item->string),
                   other = !object && document->others && kd_word_index(document->others, item->string) >= 0;
        if (!row && !inner && !other)
            return unknown(document, object, item->string, false, place.pointer, error);
        for (const cJSON *before = members->child; before != item; before = before->next)
            if (!strcmp(before->string, item->string))
                return kd_error_field(error, place.pointer, "%s is given twice", place.called);
        if (inner && !cJSON_IsObject(item))
            return kd_member_refuse(item, place.pointer, "an object with fields", error);
        if (row)
            note(document, row, given);
        status = row     ? read_row(row, to, item, NULL, place.called, place.pointer, error)
                 : inner ? read_members(document, to, item, item->string, pointer, given, error)
                         : KD_OK;
    }
    return status;
}

enum kd_status kd_document_read(const struct kd_document *document, void *to, const cJSON *object, const char *pointer,
                                uint64_t *given, struct kd_error *error)
{
    return cJSON_IsObject(object) ? read_members(document, to, object, NULL, pointer, given, error)
                                  : kd_member_refuse(object, pointer, "an object with fields", error);
}

enum kd_status kd_document_set(const struct kd_document *document, void *to, const char *name, const char *text,
                               uint64_t *given, struct kd_error *error)
{
    const struct kd_row *row = kd_document_find(document, name);
    if (!row)
        return kd_document_unknown(document, name, error);
    const struct place place = place_of("", row->object, row->name);
    note(document, row, given);
    return read_row(row, to, NULL, text, name, place.pointer, error);
}
