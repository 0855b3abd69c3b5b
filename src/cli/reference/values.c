#include "cli/reference/values.h"

#include "playground/params.h"
#include "playground/preset.h"
#include "quantity/quantity.h"
#include "render/output/particle_list.h"
#include "scene/table.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

const char *const kd_argument_names[KD_ARGUMENT_KINDS] = {
    "nothing", "anything", "file",  "folder", "named-file", "words",   "list",
    "device",  "preset",   "field", "axis",   "playground", "setting", "quantity",
};

/* Placeholders such as DIR or PRESET, each with the kind of value that it stands for. */
static const struct {
    const char *argument;
    enum kd_argument takes;
} kinds[] = {
    { "DIR", KD_ARGUMENT_FOLDER },
    { "NAME=FILE", KD_ARGUMENT_NAMED_FILE },
    { "COLUMN,...", KD_ARGUMENT_LIST },
    { "DEVICE", KD_ARGUMENT_DEVICE },
    { "PRESET", KD_ARGUMENT_PRESET },
    { "PATH=VALUE", KD_ARGUMENT_FIELD },
    { "FIELD=VALUES", KD_ARGUMENT_AXIS },
    { "PLAYGROUND", KD_ARGUMENT_PLAYGROUND },
    { "SETTING=VALUE", KD_ARGUMENT_SETTING },
    { "QUANTITY", KD_ARGUMENT_QUANTITY },
};

static bool is_placeholder(const char *text, size_t length)
{
    bool capital = false;
    for (size_t i = 0; i < length; i++) {
        if (islower((unsigned char)text[i]))
            return false;
        capital = capital || isupper((unsigned char)text[i]);
    }
    return capital;
}

/* True if the text is like FILE, FILE.csv or SCENE.json: capitals and an extension. Only FILE may lack the
 * extension. */
static bool is_file(const char *text, size_t length)
{
    const char *dot = memchr(text, '.', length);
    const size_t stem = dot ? (size_t)(dot - text) : length;
    return is_placeholder(text, stem) &&
           ((stem == 4 && !memcmp(text, "FILE", 4)) || (dot && islower((unsigned char)dot[1])));
}

enum kd_argument kd_argument_of(const char *argument)
{
    if (!argument)
        return KD_ARGUMENT_NOTHING;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (!strcmp(argument, kinds[i].argument))
            return kinds[i].takes;
    const size_t first = strcspn(argument, "|");
    if (is_file(argument, first))
        return KD_ARGUMENT_FILE;
    return argument[first] || islower((unsigned char)*argument) ? KD_ARGUMENT_WORDS : KD_ARGUMENT_ANYTHING;
}

enum kd_argument kd_argument_positional(const char *args_doc)
{
    char argument[80];
    const char *begin = args_doc ? args_doc + strspn(args_doc, "[") : "";
    snprintf(argument, sizeof argument, "%.*s", (int)strcspn(begin, " ]"), begin);
    return *argument ? kd_argument_of(argument) : KD_ARGUMENT_NOTHING;
}

void kd_argument_words(enum kd_argument takes, const char *argument, struct kd_writer *w)
{
    const char *gap = "";
    switch (takes) {
    case KD_ARGUMENT_WORDS:
        for (const char *at = argument + strspn(argument, "["); *at && *at != ']';) {
            const size_t n = strcspn(at, "|]");
            if (!is_placeholder(at, n)) {
                kd_write(w, "%s%.*s", gap, (int)n, at);
                gap = " ";
            }
            at += n + (at[n] == '|');
        }
        break;
    case KD_ARGUMENT_LIST:
        for (int i = 0; i < KD_PARTICLE_N_COLUMNS; i++)
            kd_write(w, "%s%s", i ? " " : "", kd_particle_column_name((enum kd_particle_column)i));
        break;
    case KD_ARGUMENT_PRESET:
        for (size_t i = 0; i < kd_scene_preset_count(); i++)
            kd_write(w, "%s%s", i ? " " : "", kd_scene_preset_name(i));
        break;
    case KD_ARGUMENT_PLAYGROUND:
        for (size_t i = 0; i < kd_playground_n_presets; i++)
            kd_write(w, "%s%s", i ? " " : "", kd_playground_presets[i].name);
        break;
    case KD_ARGUMENT_QUANTITY:
        for (size_t i = 0; i < kd_quantity_count; i++)
            kd_write(w, "%s%s", i ? " " : "", kd_quantities[i]->name);
        break;
    default: break;
    }
}

/* Writes the words of a field as "a|b|c". A word such as name_N, which may be followed by a number, is written
 * without "_N". */
static void words_of(const struct kd_row *field, char *out, size_t size)
{
    *out = 0;
    if (field->kind == KD_KIND_BOOL)
        snprintf(out, size, "true|false");
    else if (field->kind != KD_KIND_WORD && field->kind != KD_KIND_SERIES)
        snprintf(out, size, "%s", field->words ? field->words : "");
    else
        for (int i = 0; i < kd_word_count(field->words); i++) {
            const size_t used = strlen(out);
            bool numbered = false;
            const struct kd_word word = kd_words_root(field->words, i, &numbered);
            snprintf(out + used, size - used, "%s%.*s", i ? "|" : "", word.length, word.text);
        }
}

void kd_argument_fields(kd_named_value_fn one, struct kd_writer *w)
{
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        char name[KD_PATH_SIZE], words[1000];
        kd_field_path(&kd_fields[i], 0, name);
        words_of(&kd_fields[i], words, sizeof words);
        one(w, name, words, kd_fields[i].kind == KD_KIND_SERIES, kd_fields[i].help);
    }
}

void kd_argument_settings(kd_named_value_fn one, struct kd_writer *w)
{
    for (size_t i = 0; i < kd_playground_settings.n; i++) {
        const struct kd_row *s = &kd_playground_settings.rows[i];
        one(w, s->name,
            s->kind == KD_KIND_WORD   ? s->words
            : s->kind == KD_KIND_BOOL ? "true|false"
                                      : "",
            false, s->help);
    }
}
