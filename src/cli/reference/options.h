/* Reads a subcommand's options from its argp structs, including children, for manual pages and completions. One
 * thread. */
#ifndef KD_CLI_REFERENCE_OPTIONS_H
#define KD_CLI_REFERENCE_OPTIONS_H

#include "cli/reference/values.h"
#include "scene/writer.h"

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

enum { KD_OPTIONS_MOST = 100, KD_OPTION_NAMES = 4 };

/* One option, or a heading, which has neither letter nor name. Texts belong to the tables. */
struct kd_option {
    char letter;                        /* 0: none */
    const char *names[KD_OPTION_NAMES]; /* including aliases */
    size_t n_names;
    const char *argument; /* NULL: none */
    bool optional;        /* its argument is optional */
    bool again;           /* may be repeated */
    enum kd_argument takes;
    const char *doc; /* "": none */
    int group;       /* argp's group, the order of --help */
};
struct kd_options {
    struct kd_option list[KD_OPTIONS_MOST];
    size_t n;
};

/* Reads all visible options, by group, within a group in the order of the tables, parents before children, argp's own
 * last. Returns false if there are more than KD_OPTIONS_MOST. */
bool kd_options_read(const struct argp *argp, struct kd_options *out);

/* Entry i of the words that may follow "kerrd": each subcommand, then "physics NAME" for each quantity. Returns false
 * beyond the end. A result for a quantity is valid until the next call. */
struct kd_context {
    char name[64];
    const char *help; /* one line */
    const struct argp *argp;
    struct kd_options options;
    bool complete; /* `options` has all of its options */
};
bool kd_context_at(size_t i, struct kd_context *out);

/* Calls `one` for the texts of --help before the options, or `after` them: the parts of argp.doc before or after \v, of
 * the argp and its children. */
void kd_options_texts(const struct argp *argp, bool after,
                      void (*one)(struct kd_writer *w, const char *text, size_t length), struct kd_writer *w);

#endif
