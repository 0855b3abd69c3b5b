/* Writes manual pages in the language of man(7). One thread. */
#ifndef KD_CLI_REFERENCE_MANUAL_H
#define KD_CLI_REFERENCE_MANUAL_H

#include "scene/writer.h"

#include <stdbool.h>

/* Writes the page of a subcommand, or of kerrd if command is NULL. Its date is SOURCE_DATE_EPOCH, else today. Returns
 * false if there is no such command. */
bool kd_manual_page(struct kd_writer *w, const char *command);

/* Contents of pages besides the option tables: examples and environment variables. tests/cli/manual.py runs the
 * examples in this order, in an empty folder. */
struct kd_example {
    const char *command; /* command on whose page it appears */
    const char *line;    /* command line; the test skips lines that begin with # */
    const char *says;
};
extern const struct kd_example kd_examples[];
extern const size_t kd_n_examples;

struct kd_variable {
    const char *name;
    const char *commands; /* commands that read it, "sweep serve"; NULL: all with --device */
    const char *says;
};
extern const struct kd_variable kd_variables[];
extern const size_t kd_n_variables;

#endif
