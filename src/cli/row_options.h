/* Options of a command, one for each row of its request: --inclination-deg for inclination_deg. Name, argument and
 * help of the option are made from the row, so that a new row becomes an option automatically. Main thread only. */
#ifndef KD_CLI_ROW_OPTIONS_H
#define KD_CLI_ROW_OPTIONS_H

#include "document/document.h"

#include <argp.h>

enum { KD_ROW_KEY = 256, KD_ROW_OPTIONS = 64 }; /* keys are KD_ROW_KEY to KD_ROW_KEY + KD_ROW_OPTIONS - 1 */

struct kd_row_options {
    size_t n;
    char names[KD_ROW_OPTIONS][64]; /* names of the fields: "name", or "object.name" */
    char options[KD_ROW_OPTIONS][64], values[KD_ROW_OPTIONS][48], helps[KD_ROW_OPTIONS][320];
};

/* Text of each of these options; NULL: the option was not given. */
struct kd_row_texts { const char *of[KD_ROW_OPTIONS]; };

/* Adds an option for each row of the document, unless an option already has the row's name. The table must have
 * room; *n is the index of its next free place. from: the rows' default values, which the help shows; NULL: unknown.
 * about: begins the help; may be "". objects: an option begins with the name of the row's object. */
void kd_row_options_add(struct kd_row_options *to, struct argp_option *table, size_t *n,
                        const struct kd_document *document, const void *from, const char *about, bool objects,
                        int group);
/* True if the key belongs to one of these options. If so, the text is stored. */
bool kd_row_options_take(struct kd_row_texts *texts, int key, const char *text);
/* Index of a field's option. The field must have one. */
size_t kd_row_options_find(const struct kd_row_options *options, const char *name);

typedef enum kd_status kd_row_setter(void *request, const char *name, const char *text, struct kd_error *error);
/* Calls `set` with the name and the text of each option that was given, in the order in which they were added. */
enum kd_status kd_row_options_set(const struct kd_row_options *options, const struct kd_row_texts *texts,
                                  kd_row_setter *set, void *request, struct kd_error *error);

#endif
