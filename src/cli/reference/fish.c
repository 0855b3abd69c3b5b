/* Writes completions for fish: one line for each option, and tables that the functions of completion.fish use. */
#include "cli/commands.h"
#include "cli/reference/completions.h"
#include "cli/reference/options.h"

#include <string.h>

static void write_text(struct kd_writer *w, const char *text)
{
    for (; *text; text++)
        kd_write(w, *text == '\'' || *text == '\\' ? "\\%c" : "%c", *text);
}

/* Writes how fish completes an argument, for example " -x -a 'json csv'". */
static void write_action(struct kd_writer *w, enum kd_argument takes, const char *argument, bool optional)
{
    static const char *const actions[KD_ARGUMENT_KINDS] = {
        [KD_ARGUMENT_FOLDER] = "(__fish_complete_directories)",
        [KD_ARGUMENT_DEVICE] = "(__kerrd_devices)",
        [KD_ARGUMENT_FIELD] = "(__kerrd_named $__kerrd_fields)",
        [KD_ARGUMENT_AXIS] = "(__kerrd_named $__kerrd_fields)",
        [KD_ARGUMENT_SETTING] = "(__kerrd_named $__kerrd_settings)",
    };
    if (takes == KD_ARGUMENT_NOTHING)
        return;
    if (takes == KD_ARGUMENT_FILE || takes == KD_ARGUMENT_NAMED_FILE) {
        kd_write(w, optional ? " -F" : " -r -F");
        return;
    }
    kd_write(w, optional ? " -f" : " -x");
    if (takes == KD_ARGUMENT_ANYTHING)
        return;
    kd_write(w, " -a '");
    if (actions[takes])
        kd_write(w, "%s", actions[takes]);
    else {
        kd_write(w, takes == KD_ARGUMENT_LIST ? "(__fish_append , " : "");
        kd_argument_words(takes, argument, w);
        kd_write(w, takes == KD_ARGUMENT_LIST ? ")" : "");
    }
    kd_write(w, "'");
}

static void write_option(struct kd_writer *w, const char *name, const struct kd_option *o)
{
    if (!o->letter && !o->n_names)
        return;
    kd_write(w, "complete -c kerrd -n '__kerrd_is %s'", name);
    if (o->letter)
        kd_write(w, " -s '%c'", o->letter);
    for (size_t k = 0; k < o->n_names; k++)
        kd_write(w, " -l %s", o->names[k]);
    write_action(w, o->takes, o->argument, o->optional);
    kd_write(w, " -d '");
    write_text(w, o->doc);
    kd_write(w, "'\n");
}

static void write_context(struct kd_writer *w, const struct kd_context *context)
{
    const enum kd_argument positional = kd_argument_positional(context->argp->args_doc);
    kd_write(w, "\n");
    for (size_t i = 0; i < context->options.n; i++)
        write_option(w, context->name, &context->options.list[i]);
    if (positional == KD_ARGUMENT_FILE)
        kd_write(w, "complete -c kerrd -n '__kerrd_is %s' -F\n", context->name);
    else if (positional != KD_ARGUMENT_NOTHING && positional != KD_ARGUMENT_QUANTITY) {
        kd_write(w, "complete -c kerrd -n '__kerrd_is %s' -f -a '", context->name);
        kd_argument_words(positional, context->argp->args_doc, w);
        kd_write(w, "'\n");
    }
}

static void write_named(struct kd_writer *w, const char *name, const char *words, bool list, const char *help)
{
    (void)help;
    kd_write(w, " \\\n    '%s=%s%s'", name, list ? "," : "", words);
}

void kd_completions_fish(struct kd_writer *w)
{
    struct kd_context context;
    kd_write(
        w, "# Completions of kerrd for fish. Generated from its option tables when it is built: src/cli/reference.\n\n"
           "# NAME=, and the words that may follow; after a comma they are a list of these.\nset -g __kerrd_fields");
    kd_argument_fields(write_named, w);
    kd_write(w, "\nset -g __kerrd_settings");
    kd_argument_settings(write_named, w);
    kd_write(w, "\nset -g __kerrd_quantities ");
    kd_argument_words(KD_ARGUMENT_QUANTITY, NULL, w);
    kd_write(w, "\n\ncomplete -c kerrd -f\n");
    for (size_t i = 0; kd_context_at(i, &context); i++) {
        const bool command = i < kd_n_commands;
        kd_write(w, "complete -c kerrd -n '%s' -a %s -d '", command ? "__kerrd_is" : "__kerrd_is physics",
                 command ? context.name : strchr(context.name, ' ') + 1);
        write_text(w, context.help);
        kd_write(w, "'\n");
        if (command)
            kd_write(w, "complete -c kerrd -n '__kerrd_is help' -a %s\n", context.name);
    }
    kd_write(
        w, "complete -c kerrd -n '__kerrd_is' -a help -d 'print the options of a command'\ncomplete -c kerrd -n "
           "'__kerrd_is' -s '?' -l help -d 'Give this help list'\ncomplete -c kerrd -n '__kerrd_is' -l usage -d 'Give "
           "a short usage message'\ncomplete -c kerrd -n '__kerrd_is' -s V -l version -d 'Print program version'\n");
    for (size_t i = 0; kd_context_at(i, &context); i++)
        write_context(w, &context);
    kd_write(w, "\n");
}
