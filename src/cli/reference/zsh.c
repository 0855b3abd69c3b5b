/* Writes completions for zsh: for each command the arguments of _arguments, and tables that the functions of
 * completion.zsh use. */
#include "cli/commands.h"
#include "cli/reference/completions.h"
#include "cli/reference/options.h"

#include <string.h>

/* Writes text for use within single quotes. Puts a backslash before each of the `special` characters. */
static void write_text(struct kd_writer *w, const char *text, const char *special)
{
    for (; *text; text++)
        kd_write(w, *text == '\'' ? "'\\''" : strchr(special, *text) ? "\\%c" : "%c", *text);
}

/* Writes ":ARGUMENT:ACTION" for _arguments. An action that begins with a space is called by zsh as it stands,
 * without the options of compadd. */
static void write_action(struct kd_writer *w, enum kd_argument takes, const char *argument, const char *colons)
{
    static const char *const actions[KD_ARGUMENT_KINDS] = {
        [KD_ARGUMENT_ANYTHING] = " ",
        [KD_ARGUMENT_FILE] = "_files",
        [KD_ARGUMENT_FOLDER] = "_files -/",
        [KD_ARGUMENT_NAMED_FILE] = "_kerrd_named_file",
        [KD_ARGUMENT_DEVICE] = "_kerrd_devices",
        [KD_ARGUMENT_FIELD] = " _kerrd_named _kerrd_fields",
        [KD_ARGUMENT_AXIS] = " _kerrd_named _kerrd_fields ,",
        [KD_ARGUMENT_SETTING] = " _kerrd_named _kerrd_settings",
    };
    if (takes == KD_ARGUMENT_NOTHING)
        return;
    kd_write(w, "%s", colons);
    write_text(w, argument, ":\\");
    kd_write(w, ":");
    if (actions[takes])
        kd_write(w, "%s", actions[takes]);
    else {
        kd_write(w, takes == KD_ARGUMENT_LIST ? "_values -s , column " : "(");
        kd_argument_words(takes, argument, w);
        kd_write(w, takes == KD_ARGUMENT_LIST ? "" : ")");
    }
}

/* Writes '(-o --output)'{-o+,--output=}'[text]:FILE:_files'. */
static void write_option(struct kd_writer *w, const struct kd_option *o)
{
    const char *long_end = o->takes == KD_ARGUMENT_NOTHING ? "" : o->optional ? "=-" : "=";
    const size_t ways = o->n_names + (o->letter ? 1 : 0);
    const char *gap = "";
    if (!ways)
        return;
    kd_write(w, " \\\n        ");
    if (o->again)
        kd_write(w, "'*'");
    else if (ways > 1) {
        kd_write(w, "'(");
        if (o->letter)
            kd_write(w, "-%c ", o->letter);
        for (size_t k = 0; k < o->n_names; k++)
            kd_write(w, "%s--%s", k ? " " : "", o->names[k]);
        kd_write(w, ")'");
    }
    kd_write(w, ways > 1 ? "{" : "");
    if (o->letter) {
        kd_write(w, "'-%c%s'", o->letter, o->takes == KD_ARGUMENT_NOTHING ? "" : o->optional ? "-" : "+");
        gap = ",";
    }
    for (size_t k = 0; k < o->n_names; k++, gap = ",")
        kd_write(w, "%s'--%s%s'", gap, o->names[k], long_end);
    kd_write(w, "%s'[", ways > 1 ? "}" : "");
    write_text(w, o->doc, "[]\\");
    kd_write(w, "]");
    write_action(w, o->takes, o->argument, o->optional ? "::" : ":");
    kd_write(w, "'");
}

static void write_context(struct kd_writer *w, const struct kd_context *context)
{
    const char *args = context->argp->args_doc;
    const enum kd_argument positional = kd_argument_positional(args);
    kd_write(w, "    '%s') _arguments -s -S", context->name);
    for (size_t i = 0; i < context->options.n; i++)
        write_option(w, &context->options.list[i]);
    if (positional == KD_ARGUMENT_QUANTITY)
        kd_write(w, " \\\n        '1:quantity:_kerrd_quantities' '*:: :_kerrd_quantity'");
    else if (positional != KD_ARGUMENT_NOTHING) {
        kd_write(w, " \\\n        '");
        write_action(w, positional, args, *args == '[' ? "::" : ":");
        kd_write(w, "'");
    }
    kd_write(w, " ;;\n");
}

void kd_completions_zsh(struct kd_writer *w)
{
    struct kd_context context;
    kd_write(w, "#compdef kerrd\n# Completions of kerrd for zsh. Generated from its option tables when it is built: "
                "src/cli/reference.\n\n");
    kd_write_tables(w);
    kd_write(w, "_kerrd_commands=(\n");
    for (size_t i = 0; kd_context_at(i, &context); i++) {
        if (i == kd_n_commands)
            kd_write(w, "    'help:print the options of a command'\n)\n_kerrd_physics=(\n");
        kd_write(w, "    '");
        write_text(w, i < kd_n_commands ? context.name : strchr(context.name, ' ') + 1, ":\\");
        kd_write(w, ":");
        write_text(w, context.help, ":\\");
        kd_write(w, "'\n");
    }
    kd_write(
        w,
        ")\n\n# The options of $1, a command, or \"physics\" and a quantity.\n_kerrd_arguments() {\n    case $1 in\n");
    for (size_t i = 0; kd_context_at(i, &context); i++)
        write_context(w, &context);
    kd_write(w, "    esac\n}\n\n");
}
