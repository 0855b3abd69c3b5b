/* kerrd rays: computes the end points of listed rays. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/row_options.h"
#include "cli/trace.h"
#include "render/rays/answer.h"
#include "render/rays/fields.h"
#include "render/rays/looks.h"
#include "render/rays/request.h"
#include "document/number.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_TRACE = KD_ROW_KEY + KD_ROW_OPTIONS };

static struct kd_row_options rows;

struct arguments {
    const char *input, *output, *device, *format;
    struct kd_row_texts fields;
    /* trace: write the steps of the ray; points: write the points of its path instead of the steps */
    bool trace, points;
    struct kd_rays_request more; /* the rays that the options --ray give */
};

static const struct argp_option own[] = {
    { "output", 'o', "FILE", 0, "output file; .npy and .csv choose those formats (default: - for standard output)", 0 },
    { "format", 'f', "json|npy|csv|text", 0, "format of the output, independent of its name; text needs --trace", 0 },
    { "ray", 'r', "ALPHA,BETA", 0, "another ray, in M; may be repeated", 0 },
    { "trace", KEY_TRACE, "steps|path", OPTION_ARG_OPTIONAL,
      "explain a single ray: its type of motion, why it ends, and the device's steps, or with --trace=path the points "
      "of its path (default engine: mino-rkn6)",
      0 },
};

static void add_ray(struct arguments *arguments, const char *text, struct argp_state *state)
{
    struct kd_error error;
    size_t n = kd_number_span_typed(text, strlen(text));
    size_t m = text[n] == ',' ? kd_number_span_typed(text + n + 1, strlen(text + n + 1)) : 0;
    if (!n || !m || text[n + 1 + m])
        argp_error(state, "--ray is %s; it must be ALPHA,BETA, as in --ray -5.2,0.1", text);
    if (kd_rays_request_add(&arguments->more, kd_number_parse(text), kd_number_parse(text + n + 1), &error))
        argp_failure(state, KD_EXIT_FAILURE, ENOMEM, "--ray");
}

/* If no format was given, derives it from the output's name. Text is available only for steps, and NPY only without
 * steps. */
static void settle_format(struct arguments *arguments, const struct argp_state *state)
{
    const char *const *known = arguments->trace ? KD_ENDINGS("text", "json", "csv") : KD_ENDINGS("json", "npy", "csv");
    if (!arguments->format)
        arguments->format = kd_cli_ending(state, "--output", arguments->output, known);
    if (arguments->trace && !strcmp(arguments->format, "npy"))
        argp_error(state, "--trace writes text, json or csv, not npy");
    if (!arguments->trace && !strcmp(arguments->format, "text"))
        argp_error(state, "--format text needs --trace");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (kd_row_options_take(&arguments->fields, key, text))
        return 0;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &arguments->device; return 0;
    case 'o': arguments->output = text; return 0;
    case 'f':
        if (strcmp(text, "json") && strcmp(text, "npy") && strcmp(text, "csv") && strcmp(text, "text"))
            argp_error(state, "--format is %s; it must be json, npy or csv, or text with --trace", text);
        arguments->format = text;
        return 0;
    case 'r': add_ray(arguments, text, state); return 0;
    case KEY_TRACE:
        if (text && strcmp(text, "steps") && strcmp(text, "path"))
            argp_error(state, "--trace is %s; it must be steps or path", text);
        arguments->trace = true;
        arguments->points = text && !strcmp(text, "path");
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->input)
            argp_error(state, "%s cannot be used with %s, because the command takes one file", text, arguments->input);
        arguments->input = text;
        return 0;
    case ARGP_KEY_END:
        if (!arguments->input && !arguments->more.n)
            argp_error(state, "there are no rays: name a file, or give --ray ALPHA,BETA");
        settle_format(arguments, state);
        if (arguments->trace && !arguments->input) {
            const char **engine = &arguments->fields.of[kd_row_options_find(&rows, "engine")];
            *engine = *engine ? *engine : "mino-rkn6";
        }
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_rays_format format_of(const struct arguments *arguments)
{
    const char *format = arguments->format;
    return !strcmp(format, "npy") ? KD_RAYS_NPY : !strcmp(format, "csv") ? KD_RAYS_CSV : KD_RAYS_JSON;
}

static enum kd_status load_file(const char *path, struct kd_rays_request *request, struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    enum kd_status status = kd_file_read(path, KD_RAYS_BODY_MAX, &file, error);
    const char *start = file.data ? (const char *)file.data : "";
    if (!status) {
        status = kd_rays_request_is_npy(start, file.size) ? kd_rays_request_npy(request, start, file.size, error)
                                                          : kd_rays_request_json(request, start, file.size, error);
        if (status)
            kd_cli_prefix(error, strcmp(path, "-") ? path : "standard input");
    }
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status set(void *request, const char *name, const char *text, struct kd_error *error)
{
    return kd_rays_request_set(request, name, text, error);
}

/* Loads the file, then merges each option over it. */
static enum kd_status load(const struct arguments *arguments, struct kd_rays_request *request, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (arguments->input)
        KD_TRY(load_file(arguments->input, request, error));
    KD_TRY(kd_row_options_set(&rows, &arguments->fields, set, request, error));
    for (size_t i = 0; i < arguments->more.n; i++)
        KD_TRY(kd_rays_request_add(request, arguments->more.alpha_beta[2 * i], arguments->more.alpha_beta[2 * i + 1],
                                   error));
done:
    return status;
}

/* Chooses engine, precision and number of steps for the requested accuracy. Opens a device if one is needed. */
static enum kd_status settle(const struct arguments *arguments, struct kd_rays_request *request,
                             struct kd_renderer **renderer, struct kd_error *error)
{
    struct kd_capacity capacity;
    enum kd_status status;
    bool device = kd_accuracy_request_needs_device(&request->asked_accuracy);
    if (device) {
        KD_TRY(kd_renderer_create(&(struct kd_renderer_params) { .device = arguments->device }, renderer, error));
        kd_renderer_capacity(*renderer, &capacity);
    }
    KD_TRY(kd_rays_request_settle(request, device ? &capacity : NULL, error));
    KD_TRY(kd_rays_request_check(request, error));
done:
    return status;
}

static enum kd_status trace(struct kd_renderer *renderer, struct kd_rays_answer *answer, struct kd_error *error)
{
    struct kd_progress progress;
    kd_progress_begin(&progress, 1);
    enum kd_status status = kd_rays_trace(renderer, &answer->params, answer->alpha_beta, answer->n, answer->crossings,
                                          answer->ends, kd_progress_update, &progress, error);
    kd_progress_finish(&progress);
    /* An error with a pointer means that the device lacks a feature; it does not mean that the device is lost. */
    if (status == KD_EDEVICE && !*error->pointer)
        kd_cli_device_lost(error);
    return status ? status : kd_rays_answer_summarise(answer, error);
}

static size_t produce(void *user, void *to, size_t size) { return kd_rays_stream_read(user, to, size); }

static enum kd_status run(const struct arguments *arguments, struct kd_error *error)
{
    struct kd_rays_request request;
    struct kd_rays_answer answer = { 0 };
    struct kd_rays_stream stream = { 0 };
    enum kd_rays_format format = format_of(arguments);
    struct kd_renderer *renderer = NULL;
    const char *path = arguments->output ? arguments->output : "-";
    kd_rays_request_init(&request);
    enum kd_status status;
    KD_TRY(load(arguments, &request, error));
    KD_TRY(settle(arguments, &request, &renderer, error));
    if (strcmp(path, "-") || format == KD_RAYS_NPY)
        KD_TRY(kd_file_check(path, error));
    double *alpha_beta = request.alpha_beta; /* from here on the answer owns the array */
    request.alpha_beta = NULL;
    KD_TRY(kd_rays_answer_init(&answer, &request.params, alpha_beta, request.n, error));
    KD_TRY(trace(renderer, &answer, error));
    KD_TRY(kd_rays_stream_init(&stream, &answer, format, error));
    KD_TRY(kd_file_stream(path, produce, &stream, error));
done:
    kd_renderer_destroy(renderer);
    kd_rays_stream_finish(&stream);
    kd_rays_answer_finish(&answer);
    kd_rays_request_finish(&request);
    return status;
}

static enum kd_status tell(const struct arguments *arguments, const struct kd_described_steps *trace,
                           struct kd_error *error)
{
    const char *format = arguments->format, *path = arguments->output;
    struct kd_buffer text = { 0 };
    enum kd_status status = !strcmp(format, "json")  ? kd_trace_json(trace, &text)
                            : !strcmp(format, "csv") ? kd_trace_csv(trace, &text)
                                                     : kd_trace_text(trace, &text);
    if (status)
        status = kd_error_set(error, status, "out of memory for the steps");
    else
        status = kd_file_write(path ? path : "-", &text, error);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status run_trace(const struct arguments *arguments, struct kd_error *error)
{
    struct kd_rays_request request;
    struct kd_rays_steps steps = { 0 };
    struct kd_described_steps trace = { 0 };
    struct kd_renderer *renderer = NULL;
    double energy;
    bool outward = false;
    kd_rays_request_init(&request);
    enum kd_status status;
    KD_TRY(load(arguments, &request, error));
    if (request.n != 1)
        KD_TRY(kd_error_field(error, "/rays", "there are %zu rays; with --trace there must be one", request.n));
    if (arguments->output && strcmp(arguments->output, "-"))
        KD_TRY(kd_file_check(arguments->output, error));
    KD_TRY(settle(arguments, &request, &renderer, error));
    if (request.params.observer) {
        kd_rays_looks_label(&request.params, request.alpha_beta, 1, request.alpha_beta, &outward, &energy);
        request.params.observer = 0; /* from here on, the ray does not refer to an observer */
    }
    status = kd_rays_steps(renderer, &request.params, &(struct kd_ray_labels) { request.alpha_beta, &outward, 1 },
                           &steps, error);
    if (status == KD_EDEVICE && !*error->pointer) /* see trace() */
        kd_cli_device_lost(error);
    KD_TRY(status);
    KD_TRY(kd_trace_explain(&steps, arguments->points, &trace, error));
    KD_TRY(tell(arguments, &trace, error));
done:
    kd_trace_finish(&trace);
    kd_rays_steps_finish(&steps);
    kd_renderer_destroy(renderer);
    kd_rays_request_finish(&request);
    return status;
}

const struct argp *kd_cli_rays_argp(void)
{
    static struct argp_option options[sizeof own / sizeof *own + KD_ROW_OPTIONS + 1];
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE.json|FILE.npy|-]",
        .doc = "Trace listed rays back from the observer: equatorial crossings with azimuth, delay and redshift, the "
               "direction of escape, and an error for each.\vFILE is a request of POST /v1/rays: a JSON document, or "
               "an NPY array of pairs (alpha, beta). Options override its members, and --ray adds a ray. The closed "
               "engine needs no device.",
        .children = kd_cli_device_children,
    };
    struct kd_rays_request request;
    size_t n = sizeof own / sizeof *own;
    kd_rays_request_init(&request);
    memcpy(options, own, sizeof own);
    rows.n = 0;
    kd_row_options_add(&rows, options, &n, &kd_rays_document, &request, "", false, 0);
    options[n] = (struct argp_option) { 0 };
    return &argp;
}

int kd_cli_rays(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_rays_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = (arguments.trace ? run_trace : run)(&arguments, &error);
    kd_rays_request_finish(&arguments.more);
    return kd_progress_exit(status, &error);
}
