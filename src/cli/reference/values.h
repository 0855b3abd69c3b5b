/* The kind of an option's argument, derived from the argument's name in --help: FILE is a file, DIR a folder,
 * "json|csv" one of two words. Constant data and pure functions, any thread. */
#ifndef KD_CLI_REFERENCE_VALUES_H
#define KD_CLI_REFERENCE_VALUES_H

#include "document/writer.h"

#include <stdbool.h>

enum kd_argument {
    KD_ARGUMENT_NOTHING,
    KD_ARGUMENT_ANYTHING,   /* a number, an address or other text that cannot be completed */
    KD_ARGUMENT_FILE,       /* FILE, FILE.csv, SCENE.json */
    KD_ARGUMENT_FOLDER,     /* DIR */
    KD_ARGUMENT_NAMED_FILE, /* NAME=FILE */
    KD_ARGUMENT_WORDS,      /* one of the words a|b|c; a word in capitals, as in X|infinity, stands for any text */
    KD_ARGUMENT_LIST,       /* "COLUMN,...": words separated by commas */
    KD_ARGUMENT_DEVICE,
    KD_ARGUMENT_PRESET,     /* preset of scenes */
    KD_ARGUMENT_FIELD,      /* PATH=VALUE: a field of a scene */
    KD_ARGUMENT_AXIS,       /* FIELD=VALUES: an axis of a sweep */
    KD_ARGUMENT_PLAYGROUND, /* preset of playgrounds */
    KD_ARGUMENT_SETTING,    /* SETTING=VALUE: a setting of a playground */
    KD_ARGUMENT_QUANTITY,   /* name of a quantity of kerrd physics */
    KD_ARGUMENT_KINDS,
};
/* Names of the kinds in completion scripts: "file", "named-file", ... */
extern const char *const kd_argument_names[KD_ARGUMENT_KINDS];

enum kd_argument kd_argument_of(const char *argument); /* argument NULL: KD_ARGUMENT_NOTHING */
/* Like kd_argument_of, for a positional argument. args_doc is that of argp, such as "[SCENE.json|-]". */
enum kd_argument kd_argument_positional(const char *args_doc);

/* Writes the possible words of an argument as "a b c": enumerated words, columns, presets, playgrounds or
 * quantities. Writes nothing for other kinds of arguments. */
void kd_argument_words(enum kd_argument takes, const char *argument, struct kd_writer *w);

/* Calls `one` for each field of a scene, or for each setting of a playground. words: the possible words as "a|b"; ""
 * for a number. list: true if the value is several words, separated by commas. Fields of list elements have the
 * index 0. */
typedef void (*kd_named_value_fn)(struct kd_writer *w, const char *name, const char *words, bool list,
                                  const char *help);
void kd_argument_fields(kd_named_value_fn one, struct kd_writer *w);
void kd_argument_settings(kd_named_value_fn one, struct kd_writer *w);

#endif
