#include "quantity/text.h"

#include "base/decimal.h"

#include <math.h>
#include <string.h>

void kd_quantity_write_number(struct kd_writer *w, double value, const char *missing)
{
    char text[KD_DECIMAL_SIZE];
    size_t n = strlen(missing);
    if (isfinite(value)) {
        n = kd_decimal_print(text, value == 0 ? 0 : value);
        missing = text;
    }
    if (!w->status) /* formats numbers without printf, which would be too slow for many numbers */
        w->status = kd_buffer_append(w->out, missing, n);
}

void kd_quantity_write_value(struct kd_writer *w, const struct kd_row *parameter, double value, const char *quote)
{
    char word[KD_WORD_ROOM];
    const bool words = parameter->kind == KD_KIND_WORD;
    if ((words || isinf(value)) && kd_word_at(parameter->words, words ? (int)value : 0, word))
        kd_write(w, "%s%s%s", quote, word, quote);
    else
        kd_quantity_write_number(w, value, "");
}

void kd_quantity_write_sentences(struct kd_writer *w, const char *const *sentences)
{
    kd_write(w, "[");
    for (size_t i = 0; sentences[i]; i++) {
        kd_write(w, "%s", i ? "," : "");
        kd_write_string(w, sentences[i]);
    }
    kd_write(w, "]");
}
