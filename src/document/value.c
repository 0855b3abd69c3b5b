#include "document/value.h"

#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void kd_value_describe(const struct kd_value *value, char out[KD_VALUE_SIZE])
{
    char number[KD_NUMBER_SIZE], text[KD_VALUE_SIZE - 2];
    switch (value->kind) {
    case KD_VALUE_NUMBER:
        kd_number_format(number, value->number);
        snprintf(out, KD_VALUE_SIZE, "%s", isfinite(value->number) ? number : "a number beyond 1e308");
        return;
    case KD_VALUE_STRING:
        kd_text_clip(text, sizeof text, value->text);
        snprintf(out, KD_VALUE_SIZE, "\"%s\"", text);
        return;
    case KD_VALUE_BOOL: snprintf(out, KD_VALUE_SIZE, "%s", value->number != 0 ? "true" : "false"); return;
    case KD_VALUE_NULL: snprintf(out, KD_VALUE_SIZE, "null"); return;
    case KD_VALUE_ARRAY: snprintf(out, KD_VALUE_SIZE, "an array"); return;
    case KD_VALUE_OBJECT: snprintf(out, KD_VALUE_SIZE, "an object"); return;
    }
}

struct kd_value kd_value_typed(const char *text)
{
    size_t length = strlen(text);
    if (length && kd_number_span_typed(text, length) == length)
        return (struct kd_value) { KD_VALUE_NUMBER, kd_number_parse(text), NULL };
    if (!strcmp(text, "true") || !strcmp(text, "false"))
        return (struct kd_value) { KD_VALUE_BOOL, text[0] == 't', NULL };
    if (!strcmp(text, "null"))
        return (struct kd_value) { KD_VALUE_NULL, 0, NULL };
    return (struct kd_value) { KD_VALUE_STRING, 0, text };
}

const char *kd_value_unwanted(const struct kd_value *value)
{
    switch (value->kind) {
    case KD_VALUE_NUMBER: return "";
    case KD_VALUE_STRING: return ", a string where a number is needed";
    default: return " where a number is needed";
    }
}
