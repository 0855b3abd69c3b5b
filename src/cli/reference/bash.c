/* Writes completions for bash: tables of words, which the functions of completion.bash use. */
#include "cli/commands.h"
#include "cli/reference/completions.h"
#include "cli/reference/options.h"

static void write_takes(struct kd_writer *w, enum kd_argument takes, const char *argument)
{
    kd_write(w, "takes='%s", kd_argument_names[takes]);
    if (takes == KD_ARGUMENT_WORDS || takes == KD_ARGUMENT_LIST) {
        kd_write(w, " ");
        kd_argument_words(takes, argument, w);
    }
    kd_write(w, "' ;;\n");
}

static void write_options(struct kd_writer *w, const struct kd_context *context)
{
    kd_write(w, "        '%s') options='", context->name);
    for (size_t i = 0; i < context->options.n; i++) {
        const struct kd_option *o = &context->options.list[i];
        if (o->letter)
            kd_write(w, "-%c ", o->letter);
        for (size_t k = 0; k < o->n_names; k++)
            kd_write(w, o->optional ? "--%s --%s= " : "--%s ", o->names[k], o->names[k]);
    }
    kd_write(w, "' ;;\n");
}

/* Writes the kind of each option's argument. The word "optional" before a kind means that the argument can only be
 * given after "=". */
static void write_arguments(struct kd_writer *w, const struct kd_context *context)
{
    const enum kd_argument positional = kd_argument_positional(context->argp->args_doc);
    if (positional != KD_ARGUMENT_NOTHING) {
        kd_write(w, "        '%s ') ", context->name);
        write_takes(w, positional, context->argp->args_doc);
    }
    for (size_t i = 0; i < context->options.n; i++) {
        const struct kd_option *o = &context->options.list[i];
        const char *gap = "";
        if (o->takes == KD_ARGUMENT_NOTHING)
            continue;
        kd_write(w, "        ");
        for (size_t k = 0; k < o->n_names; k++, gap = " | ")
            kd_write(w, "%s'%s --%s'", gap, context->name, o->names[k]);
        if (o->letter)
            kd_write(w, "%s'%s -%c'", gap, context->name, o->letter);
        kd_write(w, ") %s", o->optional ? "optional=1; " : "");
        write_takes(w, o->takes, o->argument);
    }
}

static void write_words(struct kd_writer *w, const char *variable, enum kd_argument takes)
{
    kd_write(w, "%s='", variable);
    kd_argument_words(takes, NULL, w);
    kd_write(w, "'\n");
}

static void write_named(struct kd_writer *w, const char *name, const char *words, bool list, const char *help)
{
    (void)help;
    kd_write(w, "    '%s=%s%s'\n", name, list ? "," : "", words);
}

void kd_write_tables(struct kd_writer *w)
{
    kd_write(w, "# NAME=, and the words that may follow; after a comma they are a list of these.\n_kerrd_fields=(\n");
    kd_argument_fields(write_named, w);
    kd_write(w, ")\n_kerrd_settings=(\n");
    kd_argument_settings(write_named, w);
    kd_write(w, ")\n");
}

void kd_completions_bash(struct kd_writer *w)
{
    struct kd_context context;
    kd_write(w, "# Completions of kerrd for bash. Generated from its option tables when it is built: "
                "src/cli/reference.\n\n_kerrd_commands='");
    for (size_t i = 0; i < kd_n_commands; i++)
        kd_write(w, "%s ", kd_commands[i].name);
    kd_write(w, "help'\n");
    write_words(w, "_kerrd_presets", KD_ARGUMENT_PRESET);
    write_words(w, "_kerrd_playgrounds", KD_ARGUMENT_PLAYGROUND);
    write_words(w, "_kerrd_quantities", KD_ARGUMENT_QUANTITY);
    kd_write_tables(w);
    kd_write(w, "\n# The options of $1, a command.\n_kerrd_options() {\n    case $1 in\n        '') options='-? --help "
                "--usage -V --version' ;;\n");
    for (size_t i = 0; kd_context_at(i, &context); i++)
        write_options(w, &context);
    kd_write(w, "    esac\n}\n\n# What option $2 of $1 takes, or what stands there without one.\n_kerrd_takes() {\n    "
                "optional= takes=\n    case \"$1 $2\" in\n");
    for (size_t i = 0; kd_context_at(i, &context); i++)
        write_arguments(w, &context);
    kd_write(w, "    esac\n}\n\n");
}
