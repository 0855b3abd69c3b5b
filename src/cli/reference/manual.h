/* Writes manual pages in the language of man(7). One thread. */
#ifndef KD_CLI_REFERENCE_MANUAL_H
#define KD_CLI_REFERENCE_MANUAL_H

#include "scene/writer.h"

#include <stdbool.h>

/* The page of a subcommand, or with NULL that of kerrd. Its date is that of SOURCE_DATE_EPOCH, else today. False:
 * there is no such command. */
bool kd_manual_page(struct kd_writer *w, const char *command);

/* What a page says besides what the option tables do: examples, which tests/cli/manual.py runs, in an empty folder
 * and in this order; and what of the environment is read. */
struct kd_example {
    const char *command; /* on whose page it stands */
    const char *line;    /* as it is typed; one that begins with # is not run by the test */
    const char *says;
};
extern const struct kd_example kd_examples[];
extern const size_t kd_n_examples;

struct kd_variable {
    const char *name;
    const char *commands; /* "sweep serve": those that read it; NULL: all that take a --device */
    const char *says;
};
extern const struct kd_variable kd_variables[];
extern const size_t kd_n_variables;

#endif
