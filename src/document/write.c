/* Writes documents, and their JSON Schema. */
#include "document/document_internal.h"

#include "base/schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Writes those words that are in a set, or all words. */
static void write_words(struct kd_json *json, const char *name, const char *words, uint32_t set)
{
    char word[KD_WORD_ROOM];
    kd_json_array(json, name);
    for (int i = 0; kd_word_at(words, i, word); i++)
        if (i >= 32 || set & 1u << i)
            kd_json_string(json, NULL, word);
    kd_json_end(json);
}

static void write_word(struct kd_json *json, const struct kd_row *row, const char *name, int stored)
{
    char word[KD_WORD_ROOM];
    if (kd_word_at(row->words, stored - row->first, word))
        kd_json_string(json, name, word);
}

static void write_series(struct kd_json *json, const char *name, const struct kd_row *row, const struct kd_words *words)
{
    kd_json_array(json, name);
    for (int i = 0; i < words->count && i < KD_WORDS_MOST; i++) {
        char word[KD_WORD_ROOM];
        kd_words_spell(row->words, words->at[i], word);
        kd_json_string(json, NULL, word);
    }
    kd_json_end(json);
}

void kd_row_write_value(struct kd_json *json, const char *name, const struct kd_row *row, double value)
{
    switch (row->kind) {
    case KD_KIND_BOOL: kd_json_bool(json, name, value != 0); break;
    case KD_KIND_WORD: write_word(json, row, name, (int)value + row->first); break;
    case KD_KIND_ASSET: kd_json_null(json, name); break;
    case KD_KIND_SERIES: write_series(json, name, row, &(struct kd_words) { 1, { { (int16_t)value, -1 } } }); break;
    default:
        if (row->words && (isinf(value) || (isnan(value) && isnan(row->stands))))
            kd_json_string(json, name, row->words);
        else
            kd_json_number(json, name, value);
    }
}

void kd_row_write_as(struct kd_json *json, const char *name, const struct kd_row *row, const void *from)
{
    const void *at = (const char *)from + row->offset;
    switch (row->kind) {
    case KD_KIND_WORDS: write_words(json, name, row->words, *(const uint32_t *)at); break;
    case KD_KIND_VECTOR:
        kd_json_array(json, name);
        for (size_t k = 0; k < row->room; k++)
            kd_json_number(json, NULL, ((const double *)at)[k]);
        kd_json_end(json);
        break;
    case KD_KIND_TEXT: kd_json_string(json, name, at); break;
    case KD_KIND_SERIES: write_series(json, name, row, at); break;
    case KD_KIND_JSON:
    case KD_KIND_LIST: break;
    case KD_KIND_ASSET:
        if (*(const char *)at) {
            kd_json_string(json, name, at);
            break;
        }
        /* fall through */
    default: kd_row_write_value(json, name, row, kd_row_get(row, from));
    }
}

void kd_row_write(struct kd_json *json, const struct kd_row *row, const void *from)
{
    kd_row_write_as(json, row->name, row, from);
}

static const char *member_of(const char *object)
{
    const char *dot = strrchr(object, '.');
    return dot ? dot + 1 : object;
}

static void write_object(struct kd_json *json, const struct kd_document *document, const char *object,
                         const void *from);

static void write_inner(struct kd_json *json, const struct kd_document *document, const char *object, const void *from)
{
    const struct kd_list *list = kd_document_list(document, object);
    const size_t n = list ? kd_list_size(list, from) : 1;
    if (list)
        kd_json_array(json, member_of(object));
    for (size_t i = 0; i < n; i++) {
        kd_json_object(json, list ? NULL : member_of(object));
        write_object(json, document, object, (const char *)from + (list ? i * list->stride : 0));
        kd_json_end(json);
    }
    if (list)
        kd_json_end(json);
}

static void write_object(struct kd_json *json, const struct kd_document *document, const char *object, const void *from)
{
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        if (kd_row_is_of(document, row, object))
            kd_row_write(json, row, from);
        else if (kd_row_is_of(document, row, row->object) && kd_row_opens(document, row, object))
            write_inner(json, document, row->object, from);
    }
}

void kd_document_write(struct kd_json *json, const struct kd_document *document, const void *from)
{
    write_object(json, document, "", from);
}

void kd_row_number_members(struct kd_json *json, const struct kd_row *row)
{
    const bool below = row->open == KD_OPEN || row->open == KD_OPEN_BELOW,
               above = row->open == KD_OPEN || row->open == KD_OPEN_ABOVE;
    kd_json_string(json, "type", row->kind == KD_KIND_INT ? "integer" : "number");
    kd_json_number(json, below ? "exclusiveMinimum" : "minimum", row->least);
    kd_json_number(json, above ? "exclusiveMaximum" : "maximum", row->most);
    if (row->above_0 > 0) {
        kd_json_object(json, "not");
        kd_json_number(json, "exclusiveMinimum", 0);
        kd_json_number(json, "exclusiveMaximum", row->above_0);
        kd_json_end(json);
    }
}

static void add_words(struct kd_json *json, const char *words)
{
    kd_json_string(json, "type", "string");
    write_words(json, "enum", words, UINT32_MAX);
}

static void add_array(struct kd_json *json, const struct kd_row *row)
{
    const bool words = row->kind == KD_KIND_WORDS;
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems",
                   words                         ? row->least
                   : row->kind == KD_KIND_VECTOR ? (double)row->room
                   : row->fewest                 ? (double)row->fewest
                                                 : 1);
    if (words)
        kd_json_bool(json, "uniqueItems", true);
    else
        kd_json_number(json, "maxItems", (double)row->room);
    kd_json_object(json, "items");
    if (words)
        add_words(json, row->words);
    else
        kd_row_number_members(json, row);
    kd_json_end(json);
}

static void add_number_or_word(struct kd_json *json, const struct kd_row *row)
{
    kd_json_array(json, "anyOf");
    kd_schema_word(json, NULL, row->words);
    kd_json_object(json, NULL);
    kd_row_number_members(json, row);
    kd_json_end(json);
    kd_json_end(json);
}

/* Appends words of a series as alternatives of a pattern. numbered: true selects the words that a number may follow,
 * false selects all others. */
static size_t add_roots(char *pattern, size_t used, size_t size, const char *words, bool numbered)
{
    const char *separator = "";
    for (int i = 0; i < kd_word_count(words); i++) {
        bool has;
        const struct kd_word root = kd_words_root(words, i, &has);
        if (has != numbered || used >= size)
            continue;
        used += (size_t)snprintf(pattern + used, size - used, "%s%.*s", separator, root.length, root.text);
        separator = "|";
    }
    return used;
}

static void add_series(struct kd_json *json, const char *words)
{
    char pattern[1024] = "^(";
    size_t used = add_roots(pattern, 2, sizeof pattern, words, false);
    if (strstr(words, "_N")) {
        used += (size_t)snprintf(pattern + used, sizeof pattern - used, "%s(", used > 2 ? "|" : "");
        used = add_roots(pattern, used, sizeof pattern, words, true);
        used += (size_t)snprintf(pattern + used, sizeof pattern - used, ")(_(0|[1-9][0-9]?))?");
    }
    if (used + sizeof ")$" > sizeof pattern)
        json->status = KD_EINVAL;
    else
        memcpy(pattern + used, ")$", sizeof ")$");
    kd_json_string(json, "type", "array");
    kd_json_number(json, "minItems", 1);
    kd_json_number(json, "maxItems", KD_WORDS_MOST);
    kd_json_bool(json, "uniqueItems", true);
    kd_json_object(json, "items");
    kd_json_string(json, "type", "string");
    kd_json_string(json, "pattern", pattern);
    kd_json_end(json);
    write_words(json, "x-words", words, UINT32_MAX);
}

void kd_row_type_members(struct kd_json *json, const struct kd_row *row)
{
    switch (row->kind) {
    case KD_KIND_REAL:
    case KD_KIND_INT:
        if (row->words)
            add_number_or_word(json, row);
        else
            kd_row_number_members(json, row);
        break;
    case KD_KIND_ASSET:
        kd_json_members(json,
                        "\"anyOf\":[{\"type\":\"null\"},{\"type\":\"string\",\"pattern\":\"^(|[A-Za-z][A-Za-z0-9._-]"
                        "{0,62}|[0-9a-f]{64})$\"}]");
        break;
    case KD_KIND_SERIES: add_series(json, row->words); break;
    case KD_KIND_JSON: break; /* any value: {} */
    case KD_KIND_BOOL: kd_json_string(json, "type", "boolean"); break;
    case KD_KIND_WORD: add_words(json, row->words); break;
    case KD_KIND_WORDS:
    case KD_KIND_LIST:
    case KD_KIND_VECTOR: add_array(json, row); break;
    case KD_KIND_TEXT:
        kd_json_string(json, "type", "string");
        kd_json_number(json, "maxLength", (double)row->room - 1);
        break;
    }
}

void kd_row_type(struct kd_json *json, const char *name, const struct kd_row *row)
{
    kd_json_object(json, name);
    kd_row_type_members(json, row);
    kd_json_end(json);
}

void kd_row_schema(struct kd_json *json, const char *name, const struct kd_row *row)
{
    const bool pure = !row->unit || !*row->unit || !strcmp(row->unit, "1");
    char help[400];
    snprintf(help, sizeof help, "%s%s%s%s", row->help ? row->help : "", pure ? "" : " [", pure ? "" : row->unit,
             pure ? "" : "]");
    kd_json_object(json, name);
    if (row->schema)
        kd_json_members(json, row->schema);
    else
        kd_row_type_members(json, row);
    if (*help)
        kd_json_string(json, "description", help);
    kd_json_end(json);
}

static bool needs(const struct kd_document *document, const char *object)
{
    for (size_t i = 0; i < document->n; i++)
        if (kd_row_is_of(document, &document->rows[i], object) && document->rows[i].needed)
            return true;
    return false;
}

static void add_required(struct kd_json *json, const struct kd_document *document, const char *object)
{
    const char *separator = NULL;
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        const bool own = kd_row_is_of(document, row, object) && row->needed,
                   inner = !object && row->object && kd_row_is_of(document, row, row->object) &&
                           kd_row_opens(document, row, "") && needs(document, row->object);
        if (!own && !inner)
            continue;
        if (!separator)
            kd_json_array(json, separator = "required");
        kd_json_string(json, NULL, own ? row->name : row->object);
    }
    if (separator)
        kd_json_end(json);
}

void kd_document_required(struct kd_json *json, const struct kd_document *document)
{
    add_required(json, document, NULL);
}

static void add_properties(struct kd_json *json, const struct kd_document *document, const char *object);

static void add_object(struct kd_json *json, const struct kd_document *document, const char *object)
{
    kd_json_object(json, member_of(object));
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    add_required(json, document, object);
    for (const struct kd_document_not *not= document->nots; not &&not->object; not ++)
        if (!strcmp(not->object, object))
            kd_schema_text(json, "not", not->schema);
    kd_json_object(json, "properties");
    add_properties(json, document, object);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_properties(struct kd_json *json, const struct kd_document *document, const char *object)
{
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        if (kd_row_is_of(document, row, object))
            kd_row_schema(json, row->name, row);
        else if (kd_row_is_of(document, row, row->object) && kd_row_opens(document, row, object))
            add_object(json, document, row->object);
    }
}

void kd_document_properties(struct kd_json *json, const struct kd_document *document)
{
    add_properties(json, document, "");
}

static void describe(struct kd_json *json, const struct kd_row *row)
{
    static const char *const types[] = {
        [KD_KIND_REAL] = "number", [KD_KIND_INT] = "integer", [KD_KIND_BOOL] = "boolean", [KD_KIND_WORD] = "string"
    };
    kd_json_object(json, NULL);
    kd_json_string(json, "name", row->name);
    kd_json_string(json, "type", types[row->kind]);
    if (row->kind == KD_KIND_BOOL) {
        kd_json_bool(json, "default", row->initial != 0);
    } else if (row->kind == KD_KIND_WORD) {
        write_word(json, row, "default", (int)row->initial);
        write_words(json, "words", row->words, UINT32_MAX);
    } else {
        kd_json_number(json, "default", row->initial);
        kd_json_number(json, "least", row->least);
        kd_json_number(json, "most", row->most);
    }
    if (row->fixed)
        kd_json_bool(json, "fixed", true);
    kd_json_string(json, "help", row->help);
    kd_json_end(json);
}

void kd_document_describe(struct kd_json *json, const char *name, const struct kd_document *document)
{
    kd_json_array(json, name);
    for (size_t i = 0; i < document->n; i++)
        if (document->rows[i].kind <= KD_KIND_WORD)
            describe(json, &document->rows[i]);
    kd_json_end(json);
}
