/* Kind of an option's argument, from its name in --help: FILE is a file, DIR a folder, "json|csv" one of these words.
 * Constant data and pure functions, any thread. */
#ifndef KD_CLI_REFERENCE_VALUES_H
#define KD_CLI_REFERENCE_VALUES_H

#include "document/writer.h"

#include <stdbool.h>

enum kd_argument {
    KD_ARGUMENT_NOTHING,
    KD_ARGUMENT_ANYTHING,   /* a number or an address; it cannot be completed */
    KD_ARGUMENT_FILE,       /* FILE, FILE.csv, SCENE.json */
    KD_ARGUMENT_FOLDER,     /* DIR */
    KD_ARGUMENT_NAMED_FILE, /* NAME=FILE */
    KD_ARGUMENT_WORDS,      /* one of a|b|c. A word in capitals, as in X|infinity, stands for any text */
    KD_ARGUMENT_LIST,       /* COLUMN,...: words separated by commas */
    KD_ARGUMENT_DEVICE,
    KD_ARGUMENT_PRESET,     /* preset of scenes */
    KD_ARGUMENT_FIELD,      /* PATH=VALUE of a scene */
    KD_ARGUMENT_AXIS,       /* FIELD=VALUES of a sweep */
    KD_ARGUMENT_PLAYGROUND, /* preset of playgrounds */
    KD_ARGUMENT_SETTING,    /* SETTING=VALUE of a playground */
    KD_ARGUMENT_QUANTITY,   /* quantity of kerrd physics */
    KD_ARGUMENT_KINDS,
};
/* Names of the kinds in completion scripts: "file", "named-file", ... */
extern const char *const kd_argument_names[KD_ARGUMENT_KINDS];

enum kd_argument kd_argument_of(const char *argument); /* argument NULL: KD_ARGUMENT_NOTHING */
/* Like kd_argument_of, for a positional argument. Its name is argp's args_doc, such as "[SCENE.json|-]". */
enum kd_argument kd_argument_positional(const char *args_doc);

/* Writes the possible words as "a b c": enumerated words, columns, presets, playgrounds, quantities. Writes nothing for
 * other kinds. */
void kd_argument_words(enum kd_argument takes, const char *argument, struct kd_writer *w);

/* Calls `one` for each field of a scene or each setting of a playground. It passes the name and the possible words as
 * "a|b"; words is "" for a number. list: the value is several words, separated by commas. Fields of list elements have
 * the index 0. */
typedef void (*kd_named_value_fn)(struct kd_writer *w, const char *name, const char *words, bool list,
                                  const char *help);
void kd_argument_fields(kd_named_value_fn one, struct kd_writer *w);
void kd_argument_settings(kd_named_value_fn one, struct kd_writer *w);

#endif
