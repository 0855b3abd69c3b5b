#include "cli/row_options.h"

#include "document/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Writes the placeholder of an option's argument for --help. */
static void name_value(const struct kd_row *row, char *out, size_t size)
{
    const bool word = row->kind == KD_KIND_REAL && row->words;
    const char *plain = row->kind == KD_KIND_WORD                                  ? row->words
                        : row->kind == KD_KIND_BOOL                                ? "true|false"
                        : row->kind == KD_KIND_WORDS                               ? "WORD,..."
                        : row->kind == KD_KIND_LIST || row->kind == KD_KIND_VECTOR ? "X,Y,..."
                        : row->kind == KD_KIND_INT                                 ? "N"
                        : row->kind == KD_KIND_TEXT                                ? "TEXT"
                                                                                   : "X";
    snprintf(out, size, "%s%s%s", plain, word ? "|" : "", word ? row->words : "");
}

/* Describes the default value of a row. Writes nothing for a row without default, and for a list. */
static void name_default(const struct kd_row *row, const void *from, char *out, size_t size)
{
    const void *at = from ? (const char *)from + row->offset : NULL;
    char text[KD_WORD_ROOM] = ""; /* large enough for a word; a number is shorter */
    int word = 0;
    double number = NAN;
    *out = 0;
    /* skipped if there is no default, or if the help text already states the default */
    if (!at || row->needed || strstr(row->help, "default"))
        return;
    switch (row->kind) {
    case KD_KIND_WORD:
        memcpy(&word, at, sizeof word);
        if (word >= row->first)
            kd_word_at(row->words, word - row->first, text);
        break;
    case KD_KIND_BOOL: snprintf(text, sizeof text, *(const bool *)at ? "true" : "false"); break;
    case KD_KIND_INT: number = *(const uint32_t *)at; break;
    case KD_KIND_REAL: number = *(const double *)at; break;
    default: break;
    }
    if (isfinite(number))
        kd_number_format(text, number);
    else if (row->kind == KD_KIND_REAL && row->words && (isnan(number) ? isnan(row->stands) : isinf(row->stands)))
        snprintf(text, sizeof text, "%.40s", row->words);
    if (*text)
        snprintf(out, size, " (default: %s)", text);
}

static bool has(const struct kd_row_options *options, const char *option)
{
    for (size_t i = 0; i < options->n; i++)
        if (!strcmp(options->options[i], option))
            return true;
    return false;
}

void kd_row_options_add(struct kd_row_options *to, struct argp_option *table, size_t *n,
                        const struct kd_document *document, const void *from, const char *about, bool objects,
                        int group)
{
    for (size_t i = 0; i < document->n; i++) {
        const struct kd_row *row = &document->rows[i];
        const char *object = objects && row->object ? row->object : "", *unit = row->unit ? row->unit : "";
        char option[sizeof *to->options], initial[80];
        const bool pure = !*unit || !strcmp(unit, "1"), word = row->kind == KD_KIND_REAL && row->words;
        snprintf(option, sizeof option, "%.30s%s%.30s", object, *object ? "-" : "", row->name);
        for (char *c = option; (c = strchr(c, '_'));)
            *c = '-';
        if ((document->of && row->of && !(row->of & document->of)) || has(to, option))
            continue;
        /* If a table outgrows this array, the command fails at every start, so that this mistake is noticed at once. */
        if (to->n == KD_ROW_OPTIONS)
            abort();
        const size_t k = to->n++;
        name_default(row, from, initial, sizeof initial);
        memcpy(to->options[k], option, sizeof option);
        snprintf(to->names[k], sizeof to->names[k], "%.30s%s%.30s", object, *object ? "." : "", row->name);
        name_value(row, to->values[k], sizeof to->values[k]);
        snprintf(to->helps[k], sizeof to->helps[k], "%s%s%s%s%s%s%.30s%s", about, row->help, pure ? "" : " [",
                 pure ? "" : unit, pure ? "" : "]", word ? "; a number or " : "", word ? row->words : "", initial);
        table[(*n)++] = (struct argp_option) { to->options[k],
                                               KD_ROW_KEY + (int)k,
                                               row->kind == KD_KIND_WORD ? row->words : to->values[k],
                                               0,
                                               to->helps[k],
                                               group };
    }
}

bool kd_row_options_take(struct kd_row_texts *texts, int key, const char *text)
{
    const bool mine = key >= KD_ROW_KEY && key < KD_ROW_KEY + KD_ROW_OPTIONS;
    if (mine)
        texts->of[key - KD_ROW_KEY] = text;
    return mine;
}

size_t kd_row_options_find(const struct kd_row_options *options, const char *name)
{
    size_t i = 0;
    while (strcmp(options->names[i], name))
        i++;
    return i;
}

enum kd_status kd_row_options_set(const struct kd_row_options *options, const struct kd_row_texts *texts,
                                  kd_row_setter *set, void *request, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < options->n && !status; i++)
        if (texts->of[i])
            status = set(request, options->names[i], texts->of[i], error);
    return status;
}
