/* kerrd physics: computes physical quantities, each selected by its name. */
#include "base/spelling.h"
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "quantity/sound.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_PARAMETER = 256, KEY_DIGITS = KEY_PARAMETER + KD_QUANTITY_PARAMETERS, NAME_SIZE = 40, HELP_SIZE = 800 };

struct arguments {
    const struct kd_quantity *quantity;
    const char *output, *format, *digits;
    const char *given[KD_QUANTITY_PARAMETERS]; /* NULL: not given */
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (key >= KEY_PARAMETER && key < KEY_PARAMETER + KD_QUANTITY_PARAMETERS) {
        arguments->given[key - KEY_PARAMETER] = text;
        return 0;
    }
    switch (key) {
    case 'o': arguments->output = text; return 0;
    case KEY_DIGITS: arguments->digits = text; return 0;
    case 'f':
        if (strcmp(text, "json") && strcmp(text, "csv") && strcmp(text, "wav"))
            argp_error(state, "--format is %s; it must be json, csv or wav", text);
        arguments->format = text;
        return 0;
    case ARGP_KEY_ARG: argp_error(state, "%s must be an option, as in --%s VALUE", text, "spin"); return 0;
    case ARGP_KEY_END:
        if (!arguments->format)
            arguments->format = kd_cli_ending(state, "--output", arguments->output, KD_ENDINGS("json", "csv", "wav"));
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

/* Options of one quantity, and the texts that they refer to. */
struct options {
    struct argp_option table[KD_QUANTITY_PARAMETERS + 4];
    char names[KD_QUANTITY_PARAMETERS][NAME_SIZE], values[KD_QUANTITY_PARAMETERS][NAME_SIZE],
        helps[KD_QUANTITY_PARAMETERS][HELP_SIZE], doc[HELP_SIZE];
    struct argp argp;
};

static void make_options(const struct kd_quantity *quantity, struct options *options)
{
    size_t n = 0;
    for (; n < quantity->n_parameters; n++) {
        const struct kd_row *p = &quantity->parameters[n];
        char *name = options->names[n], *help = options->helps[n], *value = options->values[n],
             allowed[KD_ALLOWED_SIZE];
        snprintf(name, NAME_SIZE, "%s", p->name);
        for (char *c = name; *c; c++)
            *c = *c == '_' ? '-' : *c;
        kd_row_allowed(p, allowed);
        const bool word = p->kind == KD_KIND_WORD;
        snprintf(value, NAME_SIZE, "VALUE%s%s", p->words ? "|" : "", p->words ? p->words : "");
        snprintf(help, HELP_SIZE, "%s; %s (default: %s)", p->help, allowed, p->typed);
        options->table[n] = (struct argp_option) { name, KEY_PARAMETER + (int)n, word ? p->words : value, 0, help, 1 };
    }
    options->table[n++] = (struct argp_option) {
        "output", 'o', "FILE", 0, "output file; .csv and .wav choose those formats (default: - for standard output)", 2
    };
    options->table[n++] =
        (struct argp_option) { "format", 'f', "json|csv|wav", 0, "format of the output, independent of its name", 2 };
    options->table[n++] =
        (struct argp_option) { "digits",
                               KEY_DIGITS,
                               "N",
                               0,
                               "significant digits of numbers in lists, and of all numbers in CSV (default: 17, all)",
                               2 };
    options->table[n] = (struct argp_option) { 0 };
}

static enum kd_status answer_text(const struct arguments *arguments, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_quantity_request request;
    struct kd_quantity_answer answer;
    const char *format = arguments->format;
    enum kd_status status;
    kd_quantity_request_init(&request, arguments->quantity);
    for (size_t i = 0; i < arguments->quantity->n_parameters; i++)
        if (arguments->given[i])
            KD_TRY(
                kd_quantity_request_set(&request, arguments->quantity->parameters[i].name, arguments->given[i], error));
    if (arguments->digits)
        KD_TRY(kd_quantity_request_set(&request, "digits", arguments->digits, error));
    if (!strcmp(format, "wav"))
        KD_TRY(kd_quantity_sound_check(&request, error));
    KD_TRY(kd_quantity_evaluate(&request, &answer, error));
    if (!strcmp(format, "wav"))
        status = kd_quantity_sound(&answer, out, error);
    else if ((status = strcmp(format, "csv") ? kd_quantity_json(&answer, out) : kd_quantity_csv(&answer, out)))
        kd_error_set(error, status, "out of memory for %zu points", answer.points);
    kd_quantity_answer_finish(&answer);
done:
    return status;
}

const struct argp *kd_cli_quantity_argp(const struct kd_quantity *quantity)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 3 }, { 0 } };
    static struct options options;
    make_options(quantity, &options);
    snprintf(options.doc, sizeof options.doc,
             "%c%s.\vA VALUE is a number or a range, first:last:count. docs/physics-quantities.md and GET /v1/physics "
             "explain each number of the answer.",
             quantity->summary[0] - 'a' + 'A', quantity->summary + 1);
    options.argp =
        (struct argp) { .options = options.table, .parser = parse, .doc = options.doc, .children = children };
    return &options.argp;
}

static int run_quantity(const struct kd_quantity *quantity, int argc, char **argv)
{
    struct arguments arguments = { .quantity = quantity };
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_quantity_argp(quantity), argc, argv, 0, NULL, &arguments);
    enum kd_status status = answer_text(&arguments, &out, &error);
    bool print = !arguments.output || !strcmp(arguments.output, "-");
    if (!status && !print)
        status = kd_file_write(arguments.output, &out, &error);
    int code = status ? kd_cli_fail(&error) : print ? kd_cli_print(out.data, out.size) : KD_EXIT_OK;
    kd_buffer_finish(&out);
    return code;
}

static error_t parse_name(int key, char *text, struct argp_state *state)
{
    int *index = state->input;
    char names[300];
    if (key == ARGP_KEY_ARG) {
        kd_quantity_names(names, sizeof names);
        struct kd_spelling_best meant = { 0 };
        for (size_t i = 0; i < kd_quantity_count; i++)
            kd_spelling_offer(&meant, text, kd_quantities[i]->name);
        if (!kd_quantity_find(text) && meant.name)
            argp_error(state, "there is no quantity \"%s\"; did you mean %s? The quantities are %s", text, meant.name,
                       names);
        if (!kd_quantity_find(text))
            argp_error(state, "there is no quantity \"%s\"; the quantities are %s", text, names);
        *index = state->next - 1;
        state->next = state->argc; /* parsing stops here, because the remaining arguments belong to the quantity */
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

const struct argp *kd_cli_physics_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 0 }, { 0 } };
    static const struct argp argp = {
        .parser = parse_name,
        .args_doc = "[QUANTITY [OPTION...]]",
        .doc =
            "Compute quantities of a hole, an orbit or a disk as JSON or CSV, at a point or along a range of a "
            "parameter.\vWithout a QUANTITY, list them; `kerrd physics QUANTITY --help` lists the parameters of one.",
        .children = children,
    };
    return &argp;
}

int kd_cli_physics(int argc, char **argv)
{
    int index = 0;
    char name[64];
    argp_parse(kd_cli_physics_argp(), argc, argv, ARGP_IN_ORDER, NULL, &index);
    if (!index) {
        for (size_t i = 0; i < kd_quantity_count; i++)
            printf("%-16s %s\n", kd_quantities[i]->name, kd_quantities[i]->summary);
        return kd_cli_print("", 0);
    }
    const struct kd_quantity *quantity = kd_quantity_find(argv[index]);
    snprintf(name, sizeof name, "kerrd physics %s", quantity->name);
    argv[index] = name;
    return run_quantity(quantity, argc - index, argv + index);
}
