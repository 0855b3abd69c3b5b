#include "scene/value.h"

#include "scene/asset.h"
#include "document/number.h"
#include "document/text.h"
#include "scene/words.h"

#include <stdio.h>
#include <string.h>

static void list_words(const struct kd_field *field, char out[KD_ALLOWED_SIZE])
{
    int count = kd_field_word_count(field);
    size_t used = 0;
    for (int i = 0; i < count && used < KD_ALLOWED_SIZE; i++) {
        struct kd_word word = kd_field_word(field, i);
        used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%.*s\"", kd_text_or((size_t)i, (size_t)count),
                                 word.length, word.text);
    }
}

/* Writes what a WORDS field allows, such as "1 to 3 of a, b_N and c, each once". */
static void list_many(const struct kd_field *field, char out[KD_ALLOWED_SIZE])
{
    int count = kd_field_word_count(field),
        used = snprintf(out, KD_ALLOWED_SIZE, "1 to %d of ", count < KD_WORDS_MOST ? count : KD_WORDS_MOST);
    bool any = false, numbered = false;
    for (int i = 0; i < count && used < KD_ALLOWED_SIZE; i++) {
        int length = kd_words_length(field, i, &numbered);
        any |= numbered;
        used += snprintf(out + used, (size_t)(KD_ALLOWED_SIZE - used), "%s%.*s%s",
                         i == 0          ? ""
                         : i + 1 < count ? ", "
                                         : " and ",
                         length, kd_field_word(field, i).text, numbered ? "[_N]" : "");
    }
    if (used < KD_ALLOWED_SIZE)
        snprintf(out + used, (size_t)(KD_ALLOWED_SIZE - used), ", each once%s", any ? ", N a number" : "");
}

void kd_value_allowed(const struct kd_field *field, char out[KD_ALLOWED_SIZE])
{
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    bool pure = !strcmp(field->unit, "1");
    const char *space = pure ? "" : " ", *unit = pure ? "" : field->unit;
    kd_number_format(low, field->minimum);
    kd_number_format(high, field->maximum);
    switch (field->kind) {
    case KD_FIELD_REAL: snprintf(out, KD_ALLOWED_SIZE, "%s to %s%s%s", low, high, space, unit); return;
    case KD_FIELD_WORD:
        snprintf(out, KD_ALLOWED_SIZE, "%s to %s%s%s, or \"%s\"", low, high, space, unit, field->words);
        return;
    case KD_FIELD_INT:
        snprintf(out, KD_ALLOWED_SIZE,
                 field->words ? "a whole number from %s to %s%s%s, or \"%s\"" : "a whole number from %s to %s%s%s", low,
                 high, space, unit, field->words);
        return;
    case KD_FIELD_BOOL: snprintf(out, KD_ALLOWED_SIZE, "true or false"); return;
    case KD_FIELD_ENUM: list_words(field, out); return;
    case KD_FIELD_ASSET:
        snprintf(out, KD_ALLOWED_SIZE,
                 "null, the SHA-256 of an asset as 64 hexadecimal digits, or a name: a letter, then letters, digits, "
                 ". _ and -");
        return;
    case KD_FIELD_WORDS: list_many(field, out); return;
    }
}

/* Converts the value to the double of its field; NAN if the value has another type or is not one of the words. */
static double convert(const struct kd_field *field, const struct kd_value *value)
{
    bool string = value->kind == KD_VALUE_STRING, number = value->kind == KD_VALUE_NUMBER;
    switch (field->kind) {
    case KD_FIELD_WORD:
    case KD_FIELD_INT:
        if (string && field->words && !strcmp(value->text, field->words))
            return INFINITY;
        /* fall through */
    case KD_FIELD_REAL: return number && isfinite(value->number) ? value->number : NAN;
    case KD_FIELD_BOOL: return value->kind == KD_VALUE_BOOL ? value->number : NAN;
    case KD_FIELD_ENUM: return string ? kd_field_word_index(field, value->text) : NAN;
    case KD_FIELD_ASSET:
        if (value->kind == KD_VALUE_NULL || (string && !*value->text))
            return 0;
        return string && (kd_asset_is_hash(value->text) || kd_asset_is_name(value->text)) ? 1 : NAN;
    case KD_FIELD_WORDS: return NAN; /* words cannot be represented by one number */
    }
    return NAN;
}

/* Whether the user meant to give a number. If the field also accepts a word, a string counts as a number only if its
 * text is one. */
static bool wants_number(const struct kd_field *field, const struct kd_value *value)
{
    if (field->kind != KD_FIELD_ENUM && field->words)
        return value->kind == KD_VALUE_STRING && kd_value_typed(value->text).kind == KD_VALUE_NUMBER;
    return field->kind == KD_FIELD_REAL || field->kind == KD_FIELD_INT;
}

enum kd_status kd_value_store(struct kd_scene *scene, const struct kd_field *field, size_t index,
                              const struct kd_value *value, struct kd_error *error)
{
    struct kd_words words;
    double number = convert(field, value);
    if (field->kind == KD_FIELD_WORDS && value->kind == KD_VALUE_STRING && kd_words_read(field, value->text, &words)) {
        kd_field_put_words(scene, field, index, &words);
        return KD_OK;
    }
    if (kd_field_holds(field, number)) {
        if (field->kind == KD_FIELD_ASSET && number != 0)
            kd_field_put_asset(scene, field, index, value->text);
        else
            kd_field_put(scene, field, index, number);
        return KD_OK;
    }
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE], given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    kd_value_describe(value, given);
    kd_value_allowed(field, allowed);
    return kd_error_field(error, pointer, "%s is %s%s; it must be %s", path, given,
                          wants_number(field, value) ? kd_value_unwanted(value) : "", allowed);
}

enum kd_status kd_value_version(const struct kd_value *value, struct kd_error *error)
{
    if (value->kind == KD_VALUE_NUMBER && value->number == KD_SCENE_VERSION)
        return KD_OK;
    char given[KD_VALUE_SIZE];
    kd_value_describe(value, given);
    return kd_error_field(error, "/version", "version is %s; it must be %d", given, KD_SCENE_VERSION);
}
