/* Reads a subcommand's options from its argp structs, including children, for manual pages and completions. One
 * thread. */
#ifndef KD_CLI_REFERENCE_OPTIONS_H
#define KD_CLI_REFERENCE_OPTIONS_H

#include "cli/reference/values.h"
#include "document/writer.h"

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

enum { KD_OPTIONS_MOST = 100, KD_OPTION_NAMES = 4 };

/* One option, or a heading, which has neither letter nor name. The option tables own the texts. */
struct kd_option {
    char letter;                        /* 0: none */
    const char *names[KD_OPTION_NAMES]; /* including aliases */
    size_t n_names;
    const char *argument; /* NULL: none */
    bool optional;        /* the option's argument may be omitted */
    bool again;           /* the option may be repeated */
    enum kd_argument takes;
    const char *doc; /* the option's help; "": none */
    int group;       /* argp's group; it determines the order of --help */
};
struct kd_options {
    struct kd_option list[KD_OPTIONS_MOST];
    size_t n;
};

/* Reads all visible options in the order of --help: by group; within a group the options of the parent before those
 * of the children, in the order of their tables; argp's own options last. Returns false if there are more than
 * KD_OPTIONS_MOST. */
bool kd_options_read(const struct argp *argp, struct kd_options *out);

/* Entry i of the list of words that may follow "kerrd": each subcommand, then "physics NAME" for each quantity.
 * Returns false beyond the end. The result for a quantity is valid until the next call. */
struct kd_context {
    char name[64];
    const char *help; /* one line */
    const struct argp *argp;
    struct kd_options options;
    bool complete; /* true: `options` has all options; false: there were more than KD_OPTIONS_MOST */
};
bool kd_context_at(size_t i, struct kd_context *out);

/* Calls `one` for the texts of --help. In argp.doc these are the parts before and after \v; `after` selects the
 * parts that follow the options. Texts of the argp's children are included. */
void kd_options_texts(const struct argp *argp, bool after,
                      void (*one)(struct kd_writer *w, const char *text, size_t length), struct kd_writer *w);

#endif
