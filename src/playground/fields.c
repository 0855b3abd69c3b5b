#include "playground/fields.h"

#include "document/number.h"
#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const struct kd_playground_setting *kd_playground_row(const struct kd_playground_setting *table, size_t n,
                                                      const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(table[i].name, name))
            return &table[i];
    return NULL;
}

static bool store(void *at, const struct kd_playground_setting *row, const struct kd_value *value)
{
    char word[40];
    const bool inside = value->kind == KD_VALUE_NUMBER && value->number >= row->least && value->number <= row->most &&
                        !(value->number > 0 && value->number < row->above_0);
    switch (row->kind) {
    case KD_SETTING_REAL:
        if (inside)
            *(double *)at = value->number;
        return inside;
    case KD_SETTING_INT:
        if (!inside || value->number != floor(value->number))
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case KD_SETTING_BOOL:
        if (value->kind == KD_VALUE_BOOL)
            *(bool *)at = value->number != 0;
        return value->kind == KD_VALUE_BOOL;
    case KD_SETTING_WORD:
        for (int i = 0; value->kind == KD_VALUE_STRING && kd_playground_word(row->words, i, word, sizeof word); i++)
            if (!strcmp(value->text, word)) {
                *(int *)at = i;
                return true;
            }
        return false;
    }
    return false;
}

static void allowed(const struct kd_playground_setting *row, char out[KD_ALLOWED_SIZE])
{
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE], above[KD_NUMBER_SIZE], word[40];
    size_t used = 0;
    kd_number_format(low, row->least);
    kd_number_format(high, row->most);
    kd_number_format(above, row->above_0);
    if (row->above_0 > 0)
        snprintf(out, KD_ALLOWED_SIZE, "%s, or %s to %s", low, above, high);
    else if (row->kind == KD_SETTING_BOOL)
        snprintf(out, KD_ALLOWED_SIZE, "true or false");
    else if (row->kind != KD_SETTING_WORD)
        snprintf(out, KD_ALLOWED_SIZE, "%s%s to %s", row->kind == KD_SETTING_INT ? "a whole number from " : "", low,
                 high);
    size_t words = 0;
    while (row->kind == KD_SETTING_WORD && kd_playground_word(row->words, (int)words, word, sizeof word))
        words++;
    for (size_t i = 0; i < words && kd_playground_word(row->words, (int)i, word, sizeof word); i++)
        used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"", kd_text_or(i, words), word);
}

enum kd_status kd_playground_put(void *to, const struct kd_playground_setting *row, const struct kd_value *value,
                                 const char *pointer, struct kd_error *error)
{
    char given[KD_VALUE_SIZE], may[KD_ALLOWED_SIZE];
    if (store((char *)to + row->offset, row, value))
        return KD_OK;
    kd_value_describe(value, given);
    allowed(row, may);
    return kd_error_field(error, pointer, "%s is %s%s; it must be %s", row->name, given,
                          row->kind == KD_SETTING_REAL || row->kind == KD_SETTING_INT ? kd_value_unwanted(value) : "",
                          may);
}

void kd_playground_tell(const void *from, const struct kd_playground_setting *row, struct kd_json *json)
{
    const void *at = (const char *)from + row->offset;
    char word[40];
    switch (row->kind) {
    case KD_SETTING_REAL: kd_json_number(json, row->name, *(const double *)at); break;
    case KD_SETTING_INT: kd_json_number(json, row->name, *(const uint32_t *)at); break;
    case KD_SETTING_BOOL: kd_json_bool(json, row->name, *(const bool *)at); break;
    case KD_SETTING_WORD:
        if (kd_playground_word(row->words, *(const int *)at, word, sizeof word))
            kd_json_string(json, row->name, word);
    }
}

void kd_playground_pointer(char to[160], const char *pointer, const char *name)
{
    snprintf(to, 160, "%s", pointer);
    kd_text_pointer(to, 160, name);
}

enum kd_status kd_playground_unknown(const char *pointer, const char *name, struct kd_error *error)
{
    char clipped[60], at[160];
    kd_text_clip(clipped, sizeof clipped, name);
    kd_playground_pointer(at, pointer, name);
    return kd_error_field(error, at, "there is no field %s here", clipped);
}

enum kd_status kd_playground_numbers(double *to, int n, double most, const cJSON *item, const char *pointer,
                                     struct kd_error *error)
{
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != n)
        return kd_error_field(error, pointer, "this is not an array of %d numbers", n);
    int i = 0;
    for (const cJSON *one = item->child; one; one = one->next, i++) {
        const struct kd_value value = kd_tree_value(one);
        char given[KD_VALUE_SIZE], index[12], at[160];
        if (value.kind == KD_VALUE_NUMBER && fabs(value.number) <= most) {
            to[i] = value.number;
            continue;
        }
        snprintf(index, sizeof index, "%d", i);
        kd_playground_pointer(at, pointer, index);
        kd_value_describe(&value, given);
        return kd_error_field(error, at, "this is %s%s; it must be %g to %g", given, kd_value_unwanted(&value), -most,
                              most);
    }
    return KD_OK;
}
