/* Checks values against rows, stores them, and says what a row allows. */
#include "document/internal.h"

#include "base/utf8.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool kd_row_holds(const struct kd_row *row, double x)
{
    const bool below = row->open == KD_OPEN || row->open == KD_OPEN_BELOW,
               above = row->open == KD_OPEN || row->open == KD_OPEN_ABOVE;
    return (below ? x > row->least : x >= row->least) && (above ? x < row->most : x <= row->most) &&
           !(x > 0 && x < row->above_0);
}

static void list_words(const char *words, char out[KD_ALLOWED_SIZE])
{
    char word[KD_WORD_ROOM], next[KD_WORD_ROOM];
    size_t used = 0;
    for (int i = 0; kd_word_at(words, i, word) && used < KD_ALLOWED_SIZE; i++)
        used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"",
                                 kd_text_or((size_t)i, (size_t)i + (kd_word_at(words, i + 1, next) ? 2 : 1)), word);
}

static void list_range(const struct kd_row *row, char out[KD_ALLOWED_SIZE])
{
    static const char *const ranges[] = { [KD_CLOSED] = "%s%s to %s%s%s",
                                          [KD_OPEN] = "%sa number above %s and below %s%s%s",
                                          [KD_OPEN_ABOVE] = "%s%s up to, not including, %s%s%s",
                                          [KD_OPEN_BELOW] = "%sa number above %s, up to %s%s%s" };
    char low[2 * KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    const bool pure = !row->unit || !*row->unit || !strcmp(row->unit, "1");
    kd_number_format(low, row->above_0 > 0 ? row->above_0 : row->least);
    kd_number_format(high, row->most);
    size_t used = (size_t)snprintf(out, KD_ALLOWED_SIZE, ranges[row->open],
                                   row->kind == KD_KIND_INT ? "a whole number from "
                                   : row->above_0 > 0       ? "0, or "
                                                            : "",
                                   low, high, pure ? "" : " ", pure ? "" : row->unit);
    if (row->words)
        snprintf(out + used, KD_ALLOWED_SIZE - used, ", or \"%s\"", row->words);
}

void kd_row_allowed(const struct kd_row *row, char out[KD_ALLOWED_SIZE])
{
    if (row->allowed)
        snprintf(out, KD_ALLOWED_SIZE, "%s", row->allowed);
    else if (row->kind == KD_KIND_BOOL)
        snprintf(out, KD_ALLOWED_SIZE, "true or false");
    else if (row->kind == KD_KIND_TEXT)
        snprintf(out, KD_ALLOWED_SIZE, "a string of at most %zu bytes", row->room - 1);
    else if (row->kind == KD_KIND_WORD || row->kind == KD_KIND_WORDS)
        list_words(row->words, out);
    else
        list_range(row, out);
}

static bool store(const struct kd_row *row, void *at, const struct kd_value *value)
{
    const bool string = value->kind == KD_VALUE_STRING,
               number = value->kind == KD_VALUE_NUMBER && isfinite(value->number) && kd_row_holds(row, value->number);
    switch (row->kind) {
    case KD_KIND_REAL:
        if (number || (string && row->words && !strcmp(value->text, row->words))) {
            *(double *)at = number ? value->number : row->stands;
            return true;
        }
        return false;
    case KD_KIND_INT:
        if (!number || value->number != floor(value->number))
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case KD_KIND_BOOL:
        if (value->kind == KD_VALUE_BOOL)
            *(bool *)at = value->number != 0;
        return value->kind == KD_VALUE_BOOL;
    case KD_KIND_WORD: {
        const int i = string ? kd_word_index(row->words, value->text) : -1, stored = i + row->first;
        if (i >= 0)
            memcpy(at, &stored, sizeof stored); /* every enumeration here is as wide as int */
        return i >= 0;
    }
    case KD_KIND_TEXT:
        if (!string || strlen(value->text) >= row->room || !kd_utf8_valid(value->text))
            return false;
        memset(at, 0, row->room);
        memcpy(at, value->text, strlen(value->text));
        return true;
    case KD_KIND_WORDS:
    case KD_KIND_LIST:
    case KD_KIND_VECTOR: break;
    }
    return false;
}

/* Whether a number was meant: the row has no words, or the text is a number in quotes. */
static bool wants_number(const struct kd_row *row, const struct kd_value *value)
{
    if (row->kind == KD_KIND_BOOL || row->kind == KD_KIND_TEXT || row->kind == KD_KIND_WORD ||
        row->kind == KD_KIND_WORDS)
        return false;
    return !row->words || (value->kind == KD_VALUE_STRING && kd_value_typed(value->text).kind == KD_VALUE_NUMBER);
}

enum kd_status kd_row_refuse(const struct kd_row *row, const struct kd_value *value, const char *called,
                             const char *pointer, struct kd_error *error)
{
    char given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    kd_value_describe(value, given);
    kd_row_allowed(row, allowed);
    return kd_error_field(error, pointer, "%s is %s%s; it must be %s", called, given,
                          wants_number(row, value) ? kd_value_unwanted(value) : "", allowed);
}

enum kd_status kd_row_put(const struct kd_row *row, void *to, const struct kd_value *value, const char *called,
                          const char *pointer, struct kd_error *error)
{
    return store(row, (char *)to + row->offset, value) ? KD_OK : kd_row_refuse(row, value, called, pointer, error);
}

enum kd_status kd_row_make_room(const struct kd_row *row, void *to, size_t n, const char *pointer,
                                struct kd_number_list **list, struct kd_error *error)
{
    const size_t fewest = row->fewest ? row->fewest : 1;
    *list = (struct kd_number_list *)(void *)((char *)to + row->offset);
    if (n < fewest || n > row->room)
        return kd_error_field(error, pointer, "%s has %zu number%s; it must have %zu to %zu", row->name, n,
                              n == 1 ? "" : "s", fewest, row->room);
    free((*list)->at);
    **list = (struct kd_number_list) { malloc(n * sizeof(double)), n };
    return (*list)->at ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %zu numbers", n);
}

void kd_document_defaults(const struct kd_document *document, void *to)
{
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        void *at = (char *)to + row->offset;
        const int word = row->kind == KD_KIND_WORD ? (int)row->initial : 0;
        switch (row->kind) {
        case KD_KIND_REAL: *(double *)at = row->initial; break;
        case KD_KIND_INT:
        case KD_KIND_WORDS: *(uint32_t *)at = (uint32_t)row->initial; break;
        case KD_KIND_BOOL: *(bool *)at = row->initial != 0; break;
        case KD_KIND_WORD: memcpy(at, &word, sizeof word); break;
        case KD_KIND_LIST: *(struct kd_number_list *)at = (struct kd_number_list) { 0 }; break;
        case KD_KIND_VECTOR:
            for (size_t k = 0; k < row->room; k++)
                ((double *)at)[k] = row->initial;
            break;
        case KD_KIND_TEXT: memset(at, 0, row->room); break;
        }
    }
}
