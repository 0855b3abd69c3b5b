#include "document/number.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct kd_number_locale kd_number_locale_enter(void)
{
    /* The C library has this locale built in, so nothing is allocated. */
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return (struct kd_number_locale) { c, uselocale(c) };
}

void kd_number_locale_leave(struct kd_number_locale state)
{
    uselocale(state.previous);
    if (state.c)
        freelocale(state.c);
}

static size_t digits(const char *text, size_t i, size_t length)
{
    while (i < length && text[i] >= '0' && text[i] <= '9')
        i++;
    return i;
}

/* Returns the position after the exponent; i if there is no exponent; 0 if the exponent has no digits. */
static size_t exponent(const char *text, size_t i, size_t length)
{
    if (i >= length || (text[i] != 'e' && text[i] != 'E'))
        return i;
    i++;
    if (i < length && (text[i] == '+' || text[i] == '-'))
        i++;
    size_t end = digits(text, i, length);
    return end > i ? end : 0;
}

/* Length of the number at the start of the text. open: if true, the digits before or after the decimal point may be
 * missing. */
static size_t span(const char *text, size_t length, bool open)
{
    size_t start = length && text[0] == '-', point = digits(text, start, length), end = point, whole = point - start,
           fraction = 0;
    if (whole > 1 && text[start] == '0')
        return 0;
    if (point < length && text[point] == '.') {
        end = digits(text, point + 1, length);
        fraction = end - point - 1;
        if (!open && !fraction)
            return 0;
    }
    return whole || (open && fraction) ? exponent(text, end, length) : 0;
}

size_t kd_number_span(const char *text, size_t length) { return span(text, length, false); }

size_t kd_number_span_typed(const char *text, size_t length) { return span(text, length, true); }

double kd_number_parse(const char *text)
{
    struct kd_number_locale locale = kd_number_locale_enter();
    double value = strtod(text, NULL);
    kd_number_locale_leave(locale);
    return value;
}

/* Turns 1e-07 into 1e-7, and 1e+20 into 1e20. */
static void shorten_exponent(char *text)
{
    char *e = strchr(text, 'e');
    if (!e)
        return;
    char *to = e + 1 + (e[1] == '-'), *from = e + 2;
    while (*from == '0')
        from++;
    memmove(to, from, strlen(from) + 1);
}

void kd_number_format(char out[KD_NUMBER_SIZE], double value)
{
    struct kd_number_locale locale = kd_number_locale_enter();
    for (int digits_kept = 15; digits_kept <= 17; digits_kept++) {
        snprintf(out, KD_NUMBER_SIZE, "%.*g", digits_kept, value);
        if (strtod(out, NULL) == value)
            break;
    }
    kd_number_locale_leave(locale);
    shorten_exponent(out);
}
