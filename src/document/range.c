/* Ranges of evenly spaced numbers, typed as first:last:count. */
#include "document/document_internal.h"

#include "base/schema.h"
#include "document/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double kd_range_at(const struct kd_range *range, size_t i)
{
    if (!i || i + 1 >= range->count)
        return i ? range->last : range->first;
    return range->first + (range->last - range->first) * (double)i / (double)(range->count - 1);
}

/* Reads a number and returns the position after it; NULL if text does not start with a number. */
static const char *number(const char *text, double *value)
{
    const size_t n = kd_number_span_typed(text, strlen(text));
    if (!n)
        return NULL;
    *value = kd_number_parse(text);
    return text + n;
}

/* Reads a number, or a range with any count. Returns false if the text has another form. */
static bool parse(const char *text, struct kd_range *range, double *count)
{
    const char *rest = number(text, &range->first);
    range->last = range->first;
    *count = 1;
    if (rest && *rest == ':') {
        rest = number(rest + 1, &range->last);
        rest = rest && *rest == ':' ? number(rest + 1, count) : NULL;
    }
    return rest && !*rest;
}

static bool holds(const struct kd_row *row, double value) { return isfinite(value) && kd_row_holds(row, value); }

/* True if the row accepts all values of the range. Otherwise *wrong is a value that it does not accept, preferably
 * an end of the range. */
static bool all_hold(const struct kd_row *row, const struct kd_range *range, double *wrong)
{
    const size_t inner = row->kind == KD_KIND_INT ? range->count : 0;
    *wrong = !holds(row, range->first) ? range->first : range->last;
    if (!holds(row, *wrong))
        return false;
    for (size_t i = 0; i < inner; i++)
        if (!holds(row, *wrong = kd_range_at(range, i)))
            return false;
    return true;
}

/* Checks a number or range that was typed. On failure `fault` describes the error; it is empty if the text has the
 * wrong form. */
static bool check(const struct kd_row *row, const char *text, struct kd_range *range, char fault[KD_VALUE_SIZE])
{
    char told[KD_NUMBER_SIZE];
    double count, wrong;
    *fault = 0;
    if (!parse(text, range, &count))
        return false;
    const bool ranged = strchr(text, ':');
    if (ranged && !(count >= 2 && count <= KD_RANGE_MOST && count == floor(count))) {
        kd_number_format(told, count);
        snprintf(fault, KD_VALUE_SIZE, ", a range whose count is %s", isfinite(count) ? told : "beyond 1e308");
        return false;
    }
    range->count = (size_t)count;
    if (all_hold(row, range, &wrong))
        return true;
    kd_number_format(told, wrong);
    if (ranged)
        snprintf(fault, KD_VALUE_SIZE, ", a range with the value %s", isfinite(wrong) ? told : "beyond 1e308");
    return false;
}

enum kd_status kd_row_range(const struct kd_row *row, const char *text, const char *pointer, struct kd_range *range,
                            struct kd_error *error)
{
    const struct kd_value value = kd_value_typed(text);
    struct kd_range read = { row->stands, row->stands, 1 };
    char fault[KD_VALUE_SIZE];
    if (row->kind == KD_KIND_WORD) {
        read.first = read.last = kd_word_index(row->words, text);
        if (read.first < 0)
            return kd_row_refuse(row, &value, row->name, pointer, error);
    } else if (!(row->words && !strcmp(text, row->words)) && !check(row, text, &read, fault)) {
        char allowed[KD_ALLOWED_SIZE], given[KD_VALUE_SIZE];
        struct kd_row told = *row;
        kd_row_allowed(row, allowed);
        snprintf(allowed + strlen(allowed), sizeof allowed - strlen(allowed),
                 ", or a range first:last:count of 2 to %d such values", KD_RANGE_MOST);
        if (strchr(text, ':')) { /* for a range, the message does not say "a string where a number is needed" */
            kd_value_describe(&value, given);
            return kd_error_field(error, pointer, "%s is %s%s; it must be %s", row->name, given, fault, allowed);
        }
        told.allowed = allowed;
        return kd_row_refuse(&told, &value, row->name, pointer, error);
    }
    *range = read;
    return KD_OK;
}

/* Pattern of a typed range with a count of at most KD_RANGE_MOST. */
#define PATTERN "^" KD_SCHEMA_DECIMAL ":" KD_SCHEMA_DECIMAL ":([2-9]|[1-9][0-9]{1,4}|100000)$"
_Static_assert(KD_RANGE_MOST == 100000, "the pattern says so");

void kd_row_range_schema(struct kd_json *json, const char *name, const struct kd_row *row)
{
    const struct kd_value initial = kd_value_typed(row->typed);
    kd_json_object(json, name);
    if (row->kind == KD_KIND_WORD) {
        kd_row_type_members(json, row);
    } else {
        kd_json_array(json, "anyOf");
        /* The type of the word comes first. Generators of clients take the first type that fits the default, and
         * "infinity" also parses as a number. */
        if (row->words)
            kd_schema_word(json, NULL, row->words);
        kd_json_object(json, NULL);
        kd_row_number_members(json, row);
        kd_json_end(json);
        kd_json_object(json, NULL);
        kd_json_string(json, "type", "string");
        kd_json_string(json, "pattern", PATTERN);
        kd_json_end(json);
        kd_json_end(json);
    }
    if (initial.kind == KD_VALUE_NUMBER)
        kd_json_number(json, "default", initial.number);
    else
        kd_json_string(json, "default", row->typed);
    kd_json_end(json);
}
