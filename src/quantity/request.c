/* Parses requests for quantities: a parameter's value or range from text. */
#include "quantity/quantity.h"

#include "base/decimal.h"
#include "base/spelling.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double kd_axis_at(const struct kd_axis *axis, size_t i)
{
    if (!i || i + 1 >= axis->count)
        return i ? axis->last : axis->first;
    return axis->first + (axis->last - axis->first) * (double)i / (double)(axis->count - 1);
}

const char *kd_parameter_word(const char *words, char out[KD_WORD_TEXT])
{
    size_t n = strcspn(words, "|"), kept = n < KD_WORD_TEXT ? n : KD_WORD_TEXT - 1;
    memcpy(out, words, kept);
    out[kept] = 0;
    return words + n + (words[n] == '|');
}

static int word_index(const char *words, const char *text)
{
    char word[KD_WORD_TEXT];
    for (int i = 0; *words; i++) {
        words = kd_parameter_word(words, word);
        if (!strcmp(word, text))
            return i;
    }
    return -1;
}

void kd_parameter_allowed(const struct kd_parameter *p, char out[KD_ALLOWED_TEXT])
{
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    bool pure = p->words || !strcmp(p->unit, "1");
    size_t used;
    if (p->words) {
        char word[KD_WORD_TEXT];
        used = 0;
        for (const char *rest = p->words; *rest && used < KD_ALLOWED_TEXT;) {
            rest = kd_parameter_word(rest, word);
            used += (size_t)snprintf(out + used, KD_ALLOWED_TEXT - used, "%s\"%s\"",
                                     !used   ? ""
                                     : *rest ? ", "
                                             : " or ",
                                     word);
        }
        return;
    }
    kd_number_format(low, p->minimum);
    kd_number_format(high, p->maximum);
    used = (size_t)snprintf(out, KD_ALLOWED_TEXT, p->open ? "above %s and below %s%s%s" : "%s to %s%s%s", low, high,
                            pure ? "" : " ", pure ? "" : p->unit);
    if (p->whole)
        used += (size_t)snprintf(out + used, KD_ALLOWED_TEXT - used, ", a whole number");
    if (p->word)
        snprintf(out + used, KD_ALLOWED_TEXT - used, ", or \"%s\"", p->word);
}

static bool holds(const struct kd_parameter *p, double value)
{
    bool inside = p->open ? value > p->minimum && value < p->maximum : value >= p->minimum && value <= p->maximum;
    return inside && (!p->whole || value == floor(value));
}

/* Parses a number; returns what follows it, NULL if text does not start with one. */
static const char *number(const char *text, double *value)
{
    size_t n = kd_number_span_typed(text, strlen(text));
    if (!n)
        return NULL;
    *value = kd_number_parse(text);
    return text + n;
}

/* Parses a number or a range of numbers; false for anything else. */
static bool parse_range(const char *text, struct kd_axis *axis)
{
    double count = 1;
    const char *rest = number(text, &axis->first);
    axis->last = axis->first;
    if (rest && *rest == ':') {
        rest = number(rest + 1, &axis->last);
        rest = rest && *rest == ':' ? number(rest + 1, &count) : NULL;
        if (!(count >= 2 && count <= KD_QUANTITY_POINTS && count == floor(count)))
            return false;
    }
    axis->count = (size_t)count;
    return rest && !*rest;
}

static bool parse(const struct kd_parameter *p, const char *text, struct kd_axis *axis)
{
    if (p->words || (p->word && !strcmp(text, p->word))) {
        int index = p->words ? word_index(p->words, text) : 0;
        axis->first = axis->last = p->words ? index : INFINITY;
        axis->count = 1;
        return index >= 0;
    }
    bool good = parse_range(text, axis) && holds(p, axis->first) && holds(p, axis->last);
    for (size_t i = 1; good && p->whole && i + 1 < axis->count; i++)
        good = holds(p, kd_axis_at(axis, i));
    return good;
}

static enum kd_status refuse(const struct kd_parameter *p, const char *pointer, const char *text,
                             struct kd_error *error)
{
    char given[64], allowed[KD_ALLOWED_TEXT];
    kd_text_clip(given, sizeof given, text);
    kd_parameter_allowed(p, allowed);
    return kd_error_field(error, pointer, "%s is \"%s\"; it must be %s%s", p->name, given, allowed,
                          p->words ? "" : ", or a range first:last:count of 2 to 100000 such values");
}

static enum kd_status unknown(const struct kd_quantity *quantity, const char *pointer, const char *name,
                              struct kd_error *error)
{
    char given[64], known[300];
    size_t used = 0;
    struct kd_spelling_best meant = { 0 };
    kd_text_clip(given, sizeof given, name);
    for (size_t i = 0; i < quantity->n_parameters; i++)
        kd_spelling_offer(&meant, name, quantity->parameters[i].name);
    for (size_t i = 0; i < quantity->n_parameters && used < sizeof known; i++)
        used +=
            (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", quantity->parameters[i].name);
    if (meant.name)
        return kd_error_field(error, pointer, "%s has no parameter \"%s\"; did you mean %s? Known are %s",
                              quantity->name, given, meant.name, known);
    return kd_error_field(error, pointer, "%s has no parameter \"%s\"; known are %s", quantity->name, given, known);
}

static enum kd_status set_digits(struct kd_quantity_request *request, const char *text, struct kd_error *error)
{
    char given[64];
    double value = 0;
    const char *rest = number(text, &value);
    if (!rest || *rest || value != floor(value) || value < 1 || value > KD_DECIMAL_DIGITS) {
        kd_text_clip(given, sizeof given, text);
        return kd_error_field(error, "/digits", "digits is \"%s\"; it must be a whole number from 1 to %d", given,
                              KD_DECIMAL_DIGITS);
    }
    request->digits = (int)value;
    return KD_OK;
}

enum kd_status kd_quantity_request_set(struct kd_quantity_request *request, const char *name, const char *text,
                                       struct kd_error *error)
{
    const struct kd_quantity *quantity = request->quantity;
    char pointer[120] = "";
    kd_text_pointer(pointer, sizeof pointer, name);
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        const struct kd_parameter *p = &quantity->parameters[i];
        struct kd_axis axis;
        if (strcmp(p->name, name))
            continue;
        if (!parse(p, text, &axis))
            return refuse(p, pointer, text, error);
        request->axes[i] = axis;
        return KD_OK;
    }
    return strcmp(name, "digits") ? unknown(quantity, pointer, name, error) : set_digits(request, text, error);
}

void kd_quantity_request_init(struct kd_quantity_request *request, const struct kd_quantity *quantity)
{
    *request = (struct kd_quantity_request) { .quantity = quantity, .digits = KD_DECIMAL_DIGITS };
    for (size_t i = 0; i < quantity->n_parameters; i++)
        kd_quantity_request_set(request, quantity->parameters[i].name, quantity->parameters[i].initial, NULL);
}

/* Counts the combinations of the parameters that are not `along`, or of all. */
static size_t combinations(const struct kd_quantity_request *request, bool all)
{
    size_t n = 1;
    for (size_t i = 0; i < request->quantity->n_parameters; i++)
        if (all || !request->quantity->parameters[i].along)
            n = n * request->axes[i].count > KD_QUANTITY_POINTS ? KD_QUANTITY_POINTS + 1 : n * request->axes[i].count;
    return n;
}

size_t kd_quantity_points(const struct kd_quantity_request *request) { return combinations(request, true); }

double kd_quantity_cost_ms(const struct kd_quantity_request *request)
{
    return 1e-3 * ((double)combinations(request, true) * request->quantity->point_us +
                   (double)combinations(request, false) * request->quantity->fresh_us);
}
