/* Checks values against rows, stores them, and describes the values that a row accepts. */
#include "document/document_internal.h"

#include "base/utf8.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_in_range(const struct kd_row *row, double x)
{
    const bool below = row->open == KD_OPEN || row->open == KD_OPEN_BELOW,
               above = row->open == KD_OPEN || row->open == KD_OPEN_ABOVE;
    return (below ? x > row->least : x >= row->least) && (above ? x < row->most : x <= row->most) &&
           !(x > 0 && x < row->above_0);
}

bool kd_row_holds(const struct kd_row *row, double x)
{
    switch (row->kind) {
    case KD_KIND_INT: return (row->words && x == INFINITY) || (is_in_range(row, x) && x == floor(x));
    case KD_KIND_BOOL:
    case KD_KIND_ASSET: return x == 0 || x == 1;
    case KD_KIND_WORD:
    case KD_KIND_SERIES: return x >= 0 && x < kd_word_count(row->words) && x == floor(x);
    default: return is_in_range(row, x) || (row->words && x == row->stands);
    }
}

static double alone(const struct kd_words *words)
{
    return words->count == 1 && words->at[0].number < 0 ? words->at[0].word : NAN;
}

double kd_row_get(const struct kd_row *row, const void *from)
{
    const void *at = (const char *)from + row->offset;
    switch (row->kind) {
    case KD_KIND_REAL: return *(const double *)at;
    case KD_KIND_INT: return row->words && !*(const uint32_t *)at ? (double)INFINITY : *(const uint32_t *)at;
    case KD_KIND_BOOL: return *(const bool *)at;
    case KD_KIND_WORD: {
        int word;
        memcpy(&word, at, sizeof word); /* all enumerations in these structs have the width of int */
        return word - row->first;
    }
    case KD_KIND_ASSET: return *(const char *)at != 0;
    case KD_KIND_SERIES: return alone(at);
    case KD_KIND_WORDS:
    case KD_KIND_LIST:
    case KD_KIND_VECTOR:
    case KD_KIND_JSON:
    case KD_KIND_TEXT: break;
    }
    return NAN;
}

void kd_row_put_number(const struct kd_row *row, void *to, double value)
{
    void *at = (char *)to + row->offset;
    switch (row->kind) {
    case KD_KIND_REAL:
        *(double *)at = value == 0 ? 0 : value;
        break; /* 0 is stored instead of -0, so that equal documents have equal texts */
    case KD_KIND_INT: *(uint32_t *)at = isinf(value) ? 0 : (uint32_t)(int64_t)value; break;
    case KD_KIND_BOOL: *(bool *)at = value != 0; break;
    case KD_KIND_WORD: memcpy(at, &(int) { (int)value + row->first }, sizeof(int)); break;
    case KD_KIND_ASSET:
        if (value == 0)
            memset(at, 0, KD_ASSET_NAME);
        break;
    case KD_KIND_SERIES: *(struct kd_words *)at = (struct kd_words) { 1, { { (int16_t)value, -1 } } }; break;
    case KD_KIND_WORDS:
    case KD_KIND_LIST:
    case KD_KIND_VECTOR:
    case KD_KIND_JSON:
    case KD_KIND_TEXT: break;
    }
}

static void list_words(const char *words, char out[KD_ALLOWED_SIZE])
{
    char word[KD_WORD_ROOM], next[KD_WORD_ROOM];
    size_t used = 0;
    for (int i = 0; kd_word_at(words, i, word) && used < KD_ALLOWED_SIZE; i++)
        used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"",
                                 kd_text_or((size_t)i, (size_t)i + (kd_word_at(words, i + 1, next) ? 2 : 1)), word);
}

/* Describes the words of a series, for example as "1 to 3 of a, b[_N] and c, each once, N a number". */
static void list_series(const char *words, char out[KD_ALLOWED_SIZE])
{
    const int count = kd_word_count(words);
    int used = snprintf(out, KD_ALLOWED_SIZE, "1 to %d of ", count < KD_WORDS_MOST ? count : KD_WORDS_MOST);
    bool any = false, numbered = false;
    for (int i = 0; i < count && used < KD_ALLOWED_SIZE; i++) {
        const struct kd_word root = kd_words_root(words, i, &numbered);
        any |= numbered;
        used += snprintf(out + used, (size_t)(KD_ALLOWED_SIZE - used), "%s%.*s%s",
                         i == 0          ? ""
                         : i + 1 < count ? ", "
                                         : " and ",
                         root.length, root.text, numbered ? "[_N]" : "");
    }
    if (used < KD_ALLOWED_SIZE)
        snprintf(out + used, (size_t)(KD_ALLOWED_SIZE - used), ", each once%s", any ? ", N a number" : "");
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
    else if (row->kind == KD_KIND_SERIES)
        list_series(row->words, out);
    else if (row->kind == KD_KIND_ASSET)
        snprintf(out, KD_ALLOWED_SIZE,
                 "null, the SHA-256 of an asset as 64 hexadecimal digits, or a name: a letter, then letters, digits, "
                 ". _ and -");
    else
        list_range(row, out);
}

/* Converts the value to the number that the row stores; NAN if the value has the wrong type, or is none of the row's
 * words. */
static double convert(const struct kd_row *row, const struct kd_value *value)
{
    const bool string = value->kind == KD_VALUE_STRING;
    switch (row->kind) {
    case KD_KIND_REAL:
    case KD_KIND_INT:
        if (string && row->words && !strcmp(value->text, row->words))
            return row->kind == KD_KIND_INT ? INFINITY : row->stands;
        return value->kind == KD_VALUE_NUMBER && isfinite(value->number) ? value->number : NAN;
    case KD_KIND_BOOL: return value->kind == KD_VALUE_BOOL ? value->number : NAN;
    case KD_KIND_WORD: return string ? kd_word_index(row->words, value->text) : NAN;
    case KD_KIND_ASSET: return value->kind == KD_VALUE_NULL || (string && !*value->text) ? 0 : NAN;
    default: return NAN;
    }
}

static bool put_text(void *at, size_t room, const char *text)
{
    memset(at, 0, room); /* the rest of the array is set to 0, so that equal texts have equal bytes */
    memcpy(at, text, strlen(text));
    return true;
}

bool kd_row_take(const struct kd_row *row, void *to, const struct kd_value *value)
{
    const double number = convert(row, value);
    void *at = (char *)to + row->offset;
    const bool word =
        row->kind == KD_KIND_REAL && row->words && value->kind == KD_VALUE_STRING && !strcmp(value->text, row->words);
    if (word || kd_row_holds(row, number)) {
        kd_row_put_number(row, to, number);
        return true;
    }
    if (value->kind != KD_VALUE_STRING)
        return false;
    switch (row->kind) {
    case KD_KIND_TEXT:
        return strlen(value->text) < row->room && kd_utf8_valid(value->text) && put_text(at, row->room, value->text);
    case KD_KIND_ASSET:
        return (kd_asset_is_hash(value->text) || kd_asset_is_name(value->text)) &&
               put_text(at, KD_ASSET_NAME, value->text);
    case KD_KIND_SERIES: return kd_words_read(row->words, value->text, at);
    default: return false;
    }
}

/* True if the user probably meant a number: the row has no words, or the text is a number in quotes. */
static bool wants_number(const struct kd_row *row, const struct kd_value *value)
{
    if (row->kind != KD_KIND_REAL && row->kind != KD_KIND_INT && row->kind != KD_KIND_LIST &&
        row->kind != KD_KIND_VECTOR)
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
    return kd_row_take(row, to, value) ? KD_OK : kd_row_refuse(row, value, called, pointer, error);
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

void kd_row_reset(const struct kd_row *row, void *to)
{
    void *at = (char *)to + row->offset;
    switch (row->kind) {
    case KD_KIND_WORDS: *(uint32_t *)at = (uint32_t)row->initial; break;
    case KD_KIND_LIST: *(struct kd_number_list *)at = (struct kd_number_list) { 0 }; break;
    case KD_KIND_VECTOR:
        for (size_t k = 0; k < row->room; k++)
            ((double *)at)[k] = row->initial;
        break;
    case KD_KIND_TEXT: memset(at, 0, row->room); break;
    case KD_KIND_JSON: *(const cJSON **)at = NULL; break;
    case KD_KIND_WORD: memcpy(at, &(int) { (int)row->initial }, sizeof(int)); break;
    default: kd_row_put_number(row, to, row->initial);
    }
}

void kd_document_defaults(const struct kd_document *document, void *to)
{
    for (size_t i = 0; i < document->n; i++)
        kd_row_reset(&document->rows[i], to);
    for (size_t i = 0; i < document->n_lists; i++) {
        *(size_t *)(void *)((char *)to + document->lists[i].size_at) = 0;
        kd_list_resize(document, &document->lists[i], to, 0);
    }
}
