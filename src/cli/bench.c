/* kerrd bench: measures speed and accuracy of this device. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "render/selftest/accuracy_measure.h"
#include "render/device/accuracy_store.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    const char *device, *json, *markdown, *subject;
    struct kd_accuracy_params params;
};

enum { KEY_MARKDOWN = 0x100, KEY_QUICK, KEY_SECONDS };

static const struct argp_option options[] = {
    { "output", 'o', "FILE", 0, "write the table to this file as JSON; - for standard output", 0 },
    { "markdown", KEY_MARKDOWN, "FILE", 0, "write the table to this file as Markdown", 0 },
    { "quick", KEY_QUICK, NULL, 0, "measure with fewer rays for a shorter time: seconds instead of minutes", 0 },
    { "seconds", KEY_SECONDS, "S", 0,
      "seconds of device time for the measurement of each speed (default 0.5; with --quick 0.02)", 0 },
    { 0 },
};

static double seconds_of(const struct argp_state *state, const char *text)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value >= 0.001 && value <= 60))
        argp_error(state, "--seconds is %s; it must be a number from 0.001 to 60", text);
    return value;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &arguments->device; return 0;
    case 'o':
        arguments->json = text;
        kd_cli_ending(state, "--output", text, KD_ENDINGS("json"));
        return 0;
    case KEY_MARKDOWN:
        arguments->markdown = text;
        kd_cli_ending(state, "--markdown", text, KD_ENDINGS("md"));
        return 0;
    case KEY_QUICK: arguments->params.quick = true; return 0;
    case KEY_SECONDS: arguments->params.seconds = seconds_of(state, text); return 0;
    case ARGP_KEY_ARG:
        if (arguments->subject || strcmp(text, "accuracy") != 0)
            argp_error(state, "there is no benchmark %s; the only one is accuracy", text);
        arguments->subject = text;
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "BENCHMARK is missing; it must be accuracy"); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_status put_error(struct kd_buffer *out, double value)
{
    return isfinite(value) ? kd_buffer_printf(out, " %9.1e", value) : kd_buffer_printf(out, " %9s", "-");
}

/* Prints one line for each row: the row's speed, its median errors over the bulk set, and the largest tolerance that
 * the row meets. */
static enum kd_status summarise(const struct kd_accuracy_table *t, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s\n%s\n\n%-10s %-9s %5s %12s %9s %9s %9s %7s %9s\n", t->device,
                            kd_accuracy_set_rays[KD_ACCURACY_BULK], "engine", "precision", "steps",
                            t->cores ? "Mray/s/core" : "Mray/s", "r", "phi", "delay", "differ", "holds"));
    for (uint32_t i = 0; i < t->n; i++) {
        const struct kd_accuracy_row *row = &t->rows[i];
        const struct kd_accuracy_entry *e = &row->sets[KD_ACCURACY_BULK];
        bool closed = row->engine == KD_ENGINE_CLOSED;
        KD_TRY(kd_buffer_printf(out, "%-10s %-9s %5u %12.3g", kd_engine_name(row->engine),
                                kd_precision_name(row->precision), row->steps,
                                e->rays_per_s * 1e-6 / (closed || !t->cores ? 1 : t->cores)));
        for (int q = 0; q < KD_ACCURACY_G; q++)
            KD_TRY(put_error(out, e->of[q].median));
        KD_TRY(closed ? kd_buffer_printf(out, " %7s", "-") : kd_buffer_printf(out, " %7u", e->differ));
        KD_TRY(put_error(out, kd_accuracy_holds(row)));
        KD_TRY(kd_buffer_printf(out, "\n"));
    }
    if (t->skipped[0])
        KD_TRY(kd_buffer_printf(out, "skipped: %s\n", t->skipped));
done:
    return status;
}

static enum kd_status write_as(const struct kd_accuracy_table *table, const char *path, struct kd_error *error,
                               enum kd_status (*format)(const struct kd_accuracy_table *, struct kd_buffer *))
{
    struct kd_buffer text = { 0 };
    enum kd_status status = KD_OK;
    if (path && format(table, &text))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the table");
    else if (path)
        status = kd_file_write(path, &text, error);
    kd_buffer_finish(&text);
    return status;
}

/* Stores the table, except that a quick table does not replace a thorough one of the same version. */
static enum kd_status keep(const struct kd_renderer *renderer, const struct kd_accuracy_table *table,
                           struct kd_buffer *said, struct kd_error *error)
{
    struct kd_accuracy_table *old = malloc(sizeof *old);
    char *path = kd_accuracy_path(renderer);
    enum kd_status status = KD_OK, told;
    if (!path)
        told = kd_buffer_printf(said, "\nThe table is not saved: there is no cache directory.\n");
    else if (old && table->quick && !kd_accuracy_load(path, old, NULL) && !old->quick &&
             !strcmp(old->version, table->version))
        told = kd_buffer_printf(said, "\nThe table is not saved: %s is from a longer measurement.\n", path);
    else if (!(status = kd_accuracy_save(table, path, error)))
        told = kd_buffer_printf(said, "\nstored in %s\n", path);
    else
        told = status;
    free(path);
    free(old);
    return told && !status ? kd_error_set(error, told, "out of memory") : status;
}

static enum kd_status measure(struct arguments *a, struct kd_accuracy_table *t, struct kd_buffer *said,
                              struct kd_error *error)
{
    struct kd_renderer *renderer = NULL;
    struct kd_progress progress;
    enum kd_status status = kd_renderer_create(&(struct kd_renderer_params) { .device = a->device }, &renderer, error);
    if (status)
        return status;
    kd_progress_begin(&progress, 1);
    status = kd_accuracy_measure(renderer, &a->params, kd_progress_update, &progress, t, error);
    kd_progress_end(&progress, status, error);
    if (!status && summarise(t, said))
        status = kd_error_set(error, KD_ENOMEM, "out of memory");
    if (!status)
        status = keep(renderer, t, said, error);
    kd_renderer_destroy(renderer);
    kd_progress_reraise();
    return status;
}

static enum kd_status bench(struct arguments *a, struct kd_buffer *said, struct kd_error *error)
{
    struct kd_accuracy_table *t = malloc(sizeof *t);
    enum kd_status status;
    if (!t)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the table"));
    if (a->json)
        KD_TRY(kd_file_check(a->json, error));
    if (a->markdown)
        KD_TRY(kd_file_check(a->markdown, error));
    KD_TRY(measure(a, t, said, error));
    KD_TRY(write_as(t, a->json, error, kd_accuracy_to_json));
    KD_TRY(write_as(t, a->markdown, error, kd_accuracy_to_markdown));
done:
    free(t);
    return status;
}

/* Returns the command line, whose words are not quoted. */
static char *command_of(int argc, char **argv)
{
    struct kd_buffer text = { 0 };
    for (int i = 0; i < argc; i++)
        if (kd_buffer_printf(&text, "%s%s", i ? " " : "", argv[i])) {
            kd_buffer_finish(&text); /* the text is discarded, because a truncated command line would be misleading */
            break;
        }
    return (char *)text.data;
}

const struct argp *kd_cli_bench_argp(void)
{
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "accuracy",
        .doc = "Measure speed and error of every engine, precision and number of steps on this device, against the "
               "closed form.\vThe table is stored for this device, and GET /v1/accuracy returns it. Errors are those "
               "of the points where rays cross the equatorial plane; speeds are measured in device time. Without "
               "--quick the measurement takes some minutes.",
        .children = kd_cli_device_children,
    };
    return &argp;
}

int kd_cli_bench(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_buffer said = { 0 };
    struct kd_error error = { 0 };

    char *command = command_of(argc, argv);
    argp_parse(kd_cli_bench_argp(), argc, argv, 0, NULL, &arguments);
    arguments.params.command = command;
    enum kd_status status = bench(&arguments, &said, &error);
    free(command);
    bool loud =
        (arguments.json && !strcmp(arguments.json, "-")) || (arguments.markdown && !strcmp(arguments.markdown, "-"));
    int code = status ? kd_cli_fail(&error) : loud ? KD_EXIT_OK : kd_cli_print(said.data, said.size);
    kd_buffer_finish(&said);
    return code;
}
