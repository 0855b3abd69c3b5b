#include "cli/reference/manual.h"

#include "cli/commands.h"
#include "cli/serve_settings.h"
#include "cli/reference/options.h"
#include "quantity/quantity.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Writes text as roff: escapes special characters, and sets text between backquotes in bold. */
static void write_escaped(struct kd_writer *w, const char *text, size_t length)
{
    bool bold = false;
    for (size_t i = 0; i < length; i++) {
        const bool first = !i || text[i - 1] == '\n';
        switch (text[i]) {
        case '\\': kd_write(w, "\\e"); break;
        case '-': kd_write(w, "\\-"); break;
        case '^': kd_write(w, "\\(ha"); break;
        case '~': kd_write(w, "\\(ti"); break;
        case '\'': kd_write(w, "\\(aq"); break;
        case '"': kd_write(w, "\\(dq"); break;
        case '`': kd_write(w, "%s", (bold = !bold) ? "\\fB" : "\\fR"); break;
        default: kd_write(w, text[i] == '.' && first ? "\\&%c" : "%c", text[i]);
        }
    }
}

static void write_text(struct kd_writer *w, const char *text) { write_escaped(w, text, strlen(text)); }

static void write_paragraph(struct kd_writer *w, const char *text, size_t length)
{
    kd_write(w, ".PP\n");
    write_escaped(w, text, length);
    kd_write(w, "\n");
}

static void write_first(struct kd_writer *w, const char *text, size_t length)
{
    write_escaped(w, text, length);
    kd_write(w, "\n");
}

static void write_head(struct kd_writer *w, const char *command)
{
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    const time_t now = epoch ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
    struct tm parts;
    char date[20] = "";
    strftime(date, sizeof date, "%Y-%m-%d", gmtime_r(&now, &parts));
    kd_write(w, ".\\\" Generated from the option tables when kerrd is built: src/cli/reference.\n.TH KERRD");
    for (const char *c = command ? command : ""; *c; c++)
        kd_write(w, c == command ? "\\-%s%c" : "%s%c", *c == '-' ? "\\" : "", toupper((unsigned char)*c));
    kd_write(w, " 1 %s \"kerrd " KD_VERSION "\" \"kerrd\"\n", date);
}

static void write_name(struct kd_writer *w, const char *prefix, const char *name)
{
    write_text(w, prefix);
    write_text(w, name);
}

/* Writes .TP and then the option in the usual fonts, as in "-o, --output=FILE". */
static void write_option(struct kd_writer *w, const struct kd_option *o)
{
    const char *gap = "";
    if (!o->letter && !o->n_names) {
        kd_write(w, ".SS ");
        write_text(w, o->doc);
        kd_write(w, "\n");
        return;
    }
    kd_write(w, ".TP\n");
    if (o->letter) {
        kd_write(w, "\\fB\\-%c\\fR", o->letter);
        if (o->argument && !o->n_names) {
            kd_write(w, " \\fI");
            write_text(w, o->argument);
            kd_write(w, "\\fR");
        }
        gap = ", ";
    }
    for (size_t i = 0; i < o->n_names; i++, gap = ", ") {
        kd_write(w, "%s\\fB\\-\\-", gap);
        write_text(w, o->names[i]);
        kd_write(w, "\\fR");
        if (o->argument) {
            kd_write(w, o->optional ? "[=\\fI" : "=\\fI");
            write_text(w, o->argument);
            kd_write(w, o->optional ? "\\fR]" : "\\fR");
        }
    }
    kd_write(w, "\n");
    write_text(w, *o->doc ? o->doc : "the same for it");
    kd_write(w, "\n");
}

static bool takes_device(const struct kd_options *options)
{
    for (size_t i = 0; i < options->n; i++)
        if (options->list[i].takes == KD_ARGUMENT_DEVICE)
            return true;
    return false;
}

static bool has_word(const char *words, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = words; (at = strstr(at, word)); at += n)
        if ((at == words || at[-1] == ' ') && (!at[n] || at[n] == ' '))
            return true;
    return false;
}

/* Writes one entry for all environment variables that correspond to options. The text of each option explains its
 * variable. */
static void write_settings(struct kd_writer *w)
{
    const char *gap = "";
    kd_write(w, ".TP\n");
    for (size_t i = 0; i < KD_SERVE_COUNT; i++) {
        char variable[KD_SETTING_VARIABLE];
        if (kd_serve_settings[i].where == KD_SETTING_FLAG)
            continue;
        kd_setting_variable(&kd_serve_settings[i], variable);
        kd_write(w, "%s\\fB%s\\fR", gap, variable);
        gap = ", ";
    }
    kd_write(w, "\n");
    write_text(w, "the options with these names, if no flag gives them; a switch is yes or no, several values of "
                  "--host are separated by commas");
    kd_write(w, "\n");
}

static void write_environment(struct kd_writer *w, const char *command, bool device)
{
    bool any = false;
    for (size_t i = 0; i < kd_n_variables; i++) {
        const struct kd_variable *v = &kd_variables[i];
        if (command && !(v->commands ? has_word(v->commands, command) : device))
            continue;
        kd_write(w, any ? "" : ".SH ENVIRONMENT\n");
        kd_write(w, ".TP\n.B %s\n", v->name);
        write_text(w, v->says);
        kd_write(w, "\n");
        any = true;
    }
    if (command && !strcmp(command, "serve"))
        write_settings(w);
}

static void write_examples(struct kd_writer *w, const char *command)
{
    bool any = false;
    for (size_t i = 0; i < kd_n_examples; i++) {
        if (command && strcmp(kd_examples[i].command, command))
            continue;
        if (!command && i && !strcmp(kd_examples[i].command, kd_examples[i - 1].command))
            /* only the first example of a command gets the heading that follows */
            continue;
        kd_write(w, any ? ".PP\n" : ".SH EXAMPLES\n");
        write_text(w, kd_examples[i].says);
        kd_write(w, "\n.PP\n.RS 4\n.EX\n");
        write_text(w, kd_examples[i].line);
        kd_write(w, "\n.EE\n.RE\n");
        any = true;
    }
}

static void write_exit_status(struct kd_writer *w)
{
    kd_write(w, ".SH EXIT STATUS\n.TP\n.B 0\nSuccess.\n.TP\n.B 1\nFailure, for example of a device or a disk, or "
                "because a queue is full.\n.TP\n.B 2\nThe input or the usage is bad.\n.TP\n.B 3\nThe device was lost "
                "or hangs. The same command may succeed if it is repeated.\n.PP\nIf the reader of a pipe is gone, "
                "SIGPIPE ends kerrd without a message.\nAn error is one line on standard error. It names the fault, "
                "and its JSON pointer if there is one.\n");
}

/* True if one of the page's texts mentions `kerrd NAME`. */
static bool names(const struct kd_context *context, const char *name)
{
    char text[80];
    const char *const docs = context->argp->doc ? context->argp->doc : "";
    snprintf(text, sizeof text, "`kerrd %s`", name);
    if (strstr(docs, text))
        return true;
    for (size_t i = 0; i < context->options.n; i++)
        if (strstr(context->options.list[i].doc, text))
            return true;
    return false;
}

/* Writes SEE ALSO. kerrd's own page lists all commands. The page of a command lists the commands that it mentions. */
static void write_see_also(struct kd_writer *w, const struct kd_context *context)
{
    const char *gap = context ? ",\n" : "";
    kd_write(w, ".SH SEE ALSO\n%s", context ? ".BR kerrd (1)" : "");
    for (size_t i = 0; i < kd_n_commands; i++) {
        if (context && (!strcmp(context->name, kd_commands[i].name) || !names(context, kd_commands[i].name)))
            continue;
        kd_write(w, "%s", gap);
        kd_write(w, ".BR ");
        write_name(w, "kerrd-", kd_commands[i].name);
        kd_write(w, " (1)");
        gap = ",\n";
    }
    kd_write(w, "\n");
}

static bool has(const struct kd_options *options, const struct kd_option *option)
{
    for (size_t i = 0; options && i < options->n; i++)
        if (options->list[i].n_names && option->n_names && !strcmp(options->list[i].names[0], option->names[0]))
            return true;
    return false;
}

/* Writes all options except those in `told`. */
static void write_options(struct kd_writer *w, const struct kd_options *options, const struct kd_options *told)
{
    for (size_t i = 0; i < options->n; i++)
        if (!has(told, &options->list[i]))
            write_option(w, &options->list[i]);
}

static void write_quantities(struct kd_writer *w, const struct kd_options *told)
{
    struct kd_context context;
    kd_write(w, ".SH QUANTITIES\n");
    for (size_t i = kd_n_commands; kd_context_at(i, &context); i++) {
        kd_write(w, ".SS \"");
        write_name(w, "kerrd ", context.name);
        kd_write(w, "\"\n");
        kd_options_texts(context.argp, false, write_first, w);
        write_options(w, &context.options, told);
    }
}

static bool find(const char *command, struct kd_context *out)
{
    for (size_t i = 0; i < kd_n_commands; i++)
        if (!strcmp(kd_commands[i].name, command))
            return kd_context_at(i, out);
    return false;
}

static bool write_command_page(struct kd_writer *w, const char *command)
{
    struct kd_context context;
    if (!find(command, &context) || !context.complete)
        return false;
    write_head(w, command);
    kd_write(w, ".SH NAME\n");
    write_name(w, "kerrd-", command);
    kd_write(w, " \\- ");
    write_text(w, context.help);
    kd_write(w, "\n.SH SYNOPSIS\n\\fBkerrd ");
    write_text(w, command);
    kd_write(w, "\\fR [\\fIOPTION\\fR...] ");
    write_text(w, context.argp->args_doc ? context.argp->args_doc : "");
    kd_write(w, "\n.SH DESCRIPTION\n");
    kd_options_texts(context.argp, false, write_first, w);
    kd_options_texts(context.argp, true, write_paragraph, w);
    kd_write(w, ".SH OPTIONS\n");
    write_options(w, &context.options, NULL);
    if (kd_argument_positional(context.argp->args_doc) == KD_ARGUMENT_QUANTITY)
        write_quantities(w, &context.options);
    write_exit_status(w);
    write_environment(w, command, takes_device(&context.options));
    write_examples(w, command);
    write_see_also(w, &context);
    return true;
}

static void write_program_page(struct kd_writer *w)
{
    struct kd_options options;
    const struct argp none = { 0 };
    write_head(w, NULL);
    kd_write(w, ".SH NAME\nkerrd \\- pictures of black holes\n.SH SYNOPSIS\n\\fBkerrd\\fR \\fICOMMAND\\fR "
                "[\\fIOPTION\\fR...]\n.SH DESCRIPTION\n");
    write_text(w, KD_CLI_ABOUT);
    kd_write(w, "\n.SH COMMANDS\n");
    for (size_t i = 0; i < kd_n_commands; i++) {
        kd_write(w, ".TP\n.BR ");
        write_name(w, "kerrd-", kd_commands[i].name);
        kd_write(w, " (1)\n");
        write_text(w, kd_commands[i].help);
        kd_write(w, "\n");
    }
    kd_write(w, ".TP\n\\fBhelp\\fR \\fICOMMAND\\fR\nthe options of a command\n.SH OPTIONS\n");
    kd_options_read(&none, &options);
    write_options(w, &options, NULL);
    write_exit_status(w);
    write_environment(w, NULL, true);
    write_examples(w, NULL);
    write_see_also(w, NULL);
}

bool kd_manual_page(struct kd_writer *w, const char *command)
{
    if (command)
        return write_command_page(w, command);
    write_program_page(w);
    return true;
}
