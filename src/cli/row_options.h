/* Options of a command that are made from the rows of its request, for example --inclination-deg for
 * inclination_deg. The row gives the option's name, argument and help, so that each new row automatically becomes an
 * option. Main thread only. */
#ifndef KD_CLI_ROW_OPTIONS_H
#define KD_CLI_ROW_OPTIONS_H

#include "document/document.h"

#include <argp.h>

/* the options have the keys KD_ROW_KEY to KD_ROW_KEY + KD_ROW_OPTIONS - 1 */
enum { KD_ROW_KEY = 256, KD_ROW_OPTIONS = 64 };

struct kd_row_options {
    size_t n;
    char names[KD_ROW_OPTIONS][64]; /* name of each field: "name" or "object.name" */
    char options[KD_ROW_OPTIONS][64], values[KD_ROW_OPTIONS][48], helps[KD_ROW_OPTIONS][320];
};

/* The text of each of these options; NULL if the option was not given. */
struct kd_row_texts { const char *of[KD_ROW_OPTIONS]; };

/* Adds an option for each row of the document, unless an option of the same name exists. The table must have enough
 * room; *n is the index of its next free entry. from: struct with the default values, which the help shows; NULL:
 * they are unknown. about: text before the row's help; may be "". objects: if true, the name of an option begins
 * with the name of the row's object. */
void kd_row_options_add(struct kd_row_options *to, struct argp_option *table, size_t *n,
                        const struct kd_document *document, const void *from, const char *about, bool objects,
                        int group);
/* If the key belongs to one of these options, stores the text and returns true. */
bool kd_row_options_take(struct kd_row_texts *texts, int key, const char *text);
/* Returns the index of a field's option. The field must have an option. */
size_t kd_row_options_find(const struct kd_row_options *options, const char *name);

typedef enum kd_status kd_row_setter(void *request, const char *name, const char *text, struct kd_error *error);
/* Calls `set` with the name and the text of each option that was given, in the order in which the options were
 * added. */
enum kd_status kd_row_options_set(const struct kd_row_options *options, const struct kd_row_texts *texts,
                                  kd_row_setter *set, void *request, struct kd_error *error);

#endif
