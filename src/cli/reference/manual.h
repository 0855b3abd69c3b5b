/* Writes manual pages in the language of man(7). One thread. */
#ifndef KD_CLI_REFERENCE_MANUAL_H
#define KD_CLI_REFERENCE_MANUAL_H

#include "document/writer.h"

#include <stdbool.h>

#include <stdbool.h>

/* Writes the manual page of a subcommand, or of kerrd itself if command is NULL. The date on the page is
 * SOURCE_DATE_EPOCH, or today if that is not set. Returns false if there is no such command. */
bool kd_manual_page(struct kd_writer *w, const char *command);

/* Examples and environment variables, which are in the pages besides the option tables. tests/cli/manual.py runs the
 * examples in this order, in a folder that is empty at first. */
struct kd_example {
    const char *command; /* the command whose page shows the example */
    const char *line;    /* command lines; the test skips lines that begin with # */
    const char *says;
};
extern const struct kd_example kd_examples[];
extern const size_t kd_n_examples;

struct kd_variable {
    const char *name;
    /* commands that read the variable, separated by blanks, as in "sweep serve"; NULL: all commands with the option
     * --device */
    const char *commands;
    const char *says;
};
extern const struct kd_variable kd_variables[];
extern const size_t kd_n_variables;

#endif
