/* The options of a subcommand are read here from its argp structs, children and all, for manual pages and
 * completions. One thread. */
#ifndef KD_CLI_REFERENCE_OPTIONS_H
#define KD_CLI_REFERENCE_OPTIONS_H

#include "cli/reference/values.h"
#include "scene/writer.h"

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

enum { KD_OPTIONS_MOST = 100, KD_OPTION_NAMES = 4 };

/* One option, as whoever types it sees it; or a heading of those after it, which has neither letter nor name. Texts
 * are the tables'. */
struct kd_option {
    char letter;                        /* 0: none */
    const char *names[KD_OPTION_NAMES]; /* aliases too */
    size_t n_names;
    const char *argument; /* NULL: it takes none */
    bool optional;        /* the argument */
    bool again;           /* may be given several times */
    enum kd_argument takes;
    const char *doc; /* "" for none */
    int group;       /* as argp sorts by */
};
struct kd_options {
    struct kd_option list[KD_OPTIONS_MOST];
    size_t n;
};

/* All that are not hidden, by their groups, within one in the order of the tables, a parent's before its children's;
 * those that argp itself has are last. False: there are more than KD_OPTIONS_MOST. */
bool kd_options_read(const struct argp *argp, struct kd_options *out);

/* What may be typed behind "kerrd": each subcommand, and then "physics NAME" for each quantity. False: there are no
 * more. What the last call gave for a quantity is then gone. */
struct kd_context {
    char name[64];
    const char *help; /* one line */
    const struct argp *argp;
    struct kd_options options;
    bool complete; /* all its options are there */
};
bool kd_context_at(size_t i, struct kd_context *out);

/* The text of --help before the options, or after them: that before, or after, a \v in argp.doc, of the argp and of
 * its children, each followed by a call of `one`. */
void kd_options_texts(const struct argp *argp, bool after,
                      void (*one)(struct kd_writer *w, const char *text, size_t length), struct kd_writer *w);

#endif
