/* Reads the options of a subcommand from its argp struct and from that of its children, for manual pages and
 * completions. One thread. */
#ifndef KD_CLI_REFERENCE_OPTIONS_H
#define KD_CLI_REFERENCE_OPTIONS_H

#include "cli/reference/values.h"
#include "document/writer.h"

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

enum { KD_OPTIONS_MOST = 100, KD_OPTION_NAMES = 4 };

/* One option, or a heading (which has neither a letter nor a name). The texts belong to the option tables. */
struct kd_option {
    char letter;                        /* 0: none */
    const char *names[KD_OPTION_NAMES]; /* including aliases */
    size_t n_names;
    const char *argument; /* NULL: none */
    bool optional;        /* true if the option's argument may be omitted */
    bool again;           /* true if the option may be repeated */
    enum kd_argument takes;
    const char *doc; /* help text of the option; "" if there is none */
    int group;       /* argp's group, which determines the order in --help */
};
struct kd_options {
    struct kd_option list[KD_OPTIONS_MOST];
    size_t n;
};

/* Reads all visible options in the order of --help. They are sorted by group. Within a group, the parent's options
 * precede those of the children, and each table keeps its order. argp's own options come last. Returns false if
 * there are more than KD_OPTIONS_MOST. */
bool kd_options_read(const struct argp *argp, struct kd_options *out);

/* The list of words that may follow "kerrd": each subcommand, then "physics NAME" for each quantity. Gets entry i;
 * returns false beyond the end. The entry of a quantity is valid until the next call. */
struct kd_context {
    char name[64];
    const char *help; /* one line */
    const struct argp *argp;
    struct kd_options options;
    bool complete; /* true if `options` has all options; false if there were more than KD_OPTIONS_MOST */
};
bool kd_context_at(size_t i, struct kd_context *out);

/* Calls `one` with each text of --help. argp.doc has two parts, separated by \v: `after` false selects the part
 * before the options, `after` true the part that follows them. The texts of the argp's children are included. */
void kd_options_texts(const struct argp *argp, bool after,
                      void (*one)(struct kd_writer *w, const char *text, size_t length), struct kd_writer *w);

#endif
