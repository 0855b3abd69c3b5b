/* kerrd line, transfer-function, impulse, lags, spectrum, visibility, compare and observe: integrals over a thin disk
 * or over pictures of a scene. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/row_options.h"
#include "cli/scene_options.h"
#include "integral/run.h"
#include "observe/embedded.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_OBSERVATION = KD_ROW_KEY + KD_ROW_OPTIONS };

struct arguments {
    enum kd_integral what;
    const char *input, *output, *format;
    const struct kd_row_options *rows;
    struct kd_row_texts given;
    const char *observation;       /* path of the file with the observations that are compared with the scene */
    struct kd_scene_options scene; /* options of the scene, for integrals that use one */
    const char *device;
};

/* True if the integral can be computed from pictures of a scene. */
static bool may_have_scene(enum kd_integral what)
{
    return what == KD_INTEGRAL_SPECTRUM || kd_integral_is_pictured(what);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (kd_row_options_take(&arguments->given, key, text))
        return 0;
    switch (key) {
    case ARGP_KEY_INIT:
        if (may_have_scene(arguments->what))
            state->child_inputs[0] = &arguments->scene, state->child_inputs[1] = &arguments->device;
        return 0;
    case 'o': arguments->output = text; return 0;
    case KEY_OBSERVATION: arguments->observation = text; return 0;
    case 'f':
        if (strcmp(text, "json") && strcmp(text, "csv") && strcmp(text, "npy") && strcmp(text, "npz") &&
            (strcmp(text, "uvfits") || arguments->what != KD_INTEGRAL_OBSERVE))
            argp_error(state, "--format is %s; it must be %s", text,
                       arguments->what == KD_INTEGRAL_OBSERVE ? "json, csv, npy, npz or uvfits"
                                                              : "json, csv, npy or npz");
        arguments->format = text;
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->input)
            argp_error(state, "%s cannot be used with %s, because the command takes one file", text, arguments->input);
        arguments->input = text;
        return 0;
    case ARGP_KEY_END:
        if (!arguments->format)
            arguments->format =
                arguments->what == KD_INTEGRAL_OBSERVE
                    ? kd_cli_ending(state, "--output", arguments->output,
                                    KD_ENDINGS("json", "csv", "npy", "npz", "uvfits"))
                    : kd_cli_ending(state, "--output", arguments->output, KD_ENDINGS("json", "csv", "npy", "npz"));
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_integral_format format_of(const struct arguments *arguments)
{
    const char *format = arguments->format;
    return !strcmp(format, "npy")      ? KD_INTEGRAL_NPY
           : !strcmp(format, "npz")    ? KD_INTEGRAL_NPZ
           : !strcmp(format, "csv")    ? KD_INTEGRAL_CSV
           : !strcmp(format, "uvfits") ? KD_INTEGRAL_UVFITS
                                       : KD_INTEGRAL_JSON;
}

static enum kd_status read_file(const struct arguments *arguments, struct kd_integral_request *request,
                                struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    enum kd_status status = kd_file_read(arguments->input, KD_INTEGRAL_BODY_MAX, &file, error);
    if (!status &&
        (status = kd_integral_request_read(request, file.data ? (const char *)file.data : "", file.size, error)))
        kd_cli_prefix(error, strcmp(arguments->input, "-") ? arguments->input : "standard input");
    kd_buffer_finish(&file);
    return status;
}

/* Loads the scene from the file, --preset or --from, and applies --set. */
static enum kd_status load_scene(struct arguments *arguments, struct kd_integral_request *request,
                                 struct kd_error *error)
{
    struct kd_scene_options *options = &arguments->scene;
    enum kd_status status = KD_OK;
    const bool chosen = options->preset || options->from;
    if (chosen && request->scene)
        return kd_error_set(error, KD_EINVAL, "--%s cannot be used with a file that has a scene",
                            options->preset ? "preset" : "from");
    if (!request->scene && !chosen && !options->n_set && !kd_integral_is_pictured(request->what))
        return KD_OK;
    if (!request->scene)
        KD_TRY(kd_integral_make_scene(request, error));
    if (options->preset)
        KD_TRY(kd_scene_preset(request->scene, options->preset, error));
    KD_TRY(kd_scene_options_merge(options, request->scene, error));
done:
    return status;
}

static enum kd_status read_observation(const char *path, struct kd_integral_request *request, struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    const struct kd_embedded_observation *own = kd_embedded_observation_find(path);
    if (own)
        return kd_integral_set_observation(request, own->data, own->size, error);
    enum kd_status status = kd_file_read(path, KD_OBSERVATION_BYTES, &file, error);
    if (!status &&
        (status = kd_integral_set_observation(request, file.data ? file.data : (const uint8_t *)"", file.size, error)))
        kd_cli_prefix(error, path);
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status set(void *request, const char *name, const char *text, struct kd_error *error)
{
    return kd_integral_request_set(request, name, text, error);
}

static enum kd_status load(struct arguments *arguments, struct kd_integral_request *request, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (arguments->input)
        KD_TRY(read_file(arguments, request, error));
    if (may_have_scene(request->what))
        KD_TRY(load_scene(arguments, request, error));
    KD_TRY(kd_row_options_set(arguments->rows, &arguments->given, set, request, error));
    if (arguments->observation)
        KD_TRY(read_observation(arguments->observation, request, error));
    KD_TRY(kd_integral_request_check(request, error));
done:
    return status;
}

struct work {
    struct kd_integral_run run;
    struct kd_renderer *renderer;
    struct kd_progress progress;
};

static enum kd_status make_picture(struct work *w, const struct kd_integral_request *request, struct kd_error *error)
{
    const struct kd_format *format = kd_integral_picture_format(request->what);
    struct kd_scene scene = kd_integral_scene(request, w->run.picture);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_buffer file = { 0 };
    enum kd_status status;
    kd_renderer_capacity(w->renderer, &capacity);
    KD_TRY(kd_integral_plan(request, &scene, &capacity, &plan, error));
    KD_TRY(kd_render(w->renderer, &scene, &plan, kd_progress_update, &w->progress, &frame, error));
    KD_TRY(kd_encode(format, &(struct kd_picture) { &frame, &scene, &plan, kd_renderer_device_name(w->renderer), 0 },
                     KD_EFFORT_QUICK, NULL, &file, error));
    KD_TRY(kd_integral_run_take(&w->run, &file, &scene, &plan.report, error));
    kd_integral_run_step(&w->run, INFINITY);
done:
    kd_integral_name_set(request, w->run.picture, status, error);
    kd_frame_finish(&frame);
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status make_pictures(struct work *w, struct arguments *arguments,
                                    const struct kd_integral_request *request, struct kd_error *error)
{
    const struct kd_assets assets = kd_asset_options_assets(&arguments->scene.assets);
    enum kd_status status = kd_renderer_create(
        &(struct kd_renderer_params) { .device = arguments->device, .assets = &assets }, &w->renderer, error);
    if (status)
        return status;
    kd_progress_begin(&w->progress, w->run.pictures);
    for (; !status && w->run.picture < w->run.pictures; w->progress.done++)
        status = make_picture(w, request, error);
    kd_progress_end(&w->progress, status, error);
    kd_renderer_destroy(w->renderer);
    return status;
}

static enum kd_status answer_text(struct arguments *arguments, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_integral_request request;
    struct work work = { 0 };
    enum kd_status status;
    kd_integral_request_init(&request, arguments->what);
    KD_TRY(load(arguments, &request, error));
    KD_TRY(kd_integral_check_format(&request, format_of(arguments), error));
    KD_TRY(kd_integral_run_begin(&work.run, &request, error));
    if (work.run.pictures)
        KD_TRY(make_pictures(&work, arguments, &request, error));
    if ((status = kd_integral_write(&work.run.answer, format_of(arguments), out)))
        kd_error_set(error, status, "out of memory for %zu rows", work.run.answer.rows);
done:
    kd_integral_run_finish(&work.run);
    kd_integral_request_finish(&request);
    return status;
}

/* Makes an option for each field, for example --inclination-deg for inclination_deg. */
static void set_options(enum kd_integral what, struct argp_option *options, struct kd_row_options *rows)
{
    const struct kd_document document = {
        .rows = kd_integral_fields,
        .n = kd_n_integral_fields,
        .of = 1u << what | (what == KD_INTEGRAL_SPECTRUM ? 1u << KD_INTEGRAL_VOLUME : 0),
    };
    struct kd_integral_request request;
    size_t n = 0;
    kd_integral_request_init(&request, what);
    rows->n = 0;
    options[n++] = (struct argp_option) { "output", 'o', "FILE", 0, "output file; its ending chooses the format", 2 };
    options[n++] = (struct argp_option) { "format",
                                          'f',
                                          what == KD_INTEGRAL_OBSERVE ? "json|csv|npy|npz|uvfits" : "json|csv|npy|npz",
                                          0,
                                          "format of the output, independent of its name",
                                          2 };
    if (kd_integral_is_observed(what))
        options[n++] =
            (struct argp_option) { "observation",
                                   KEY_OBSERVATION,
                                   "FILE",
                                   0,
                                   what == KD_INTEGRAL_COMPARE
                                       ? "observation to compare with: uvfits, the EHT's CSV, or the "
                                         "name of one in kerrd: " KD_EMBEDDED_OBSERVATIONS
                                       : "observation whose times, baselines and errors are used: uvfits, the EHT's "
                                         "CSV, or the name of one in kerrd: " KD_EMBEDDED_OBSERVATIONS,
                                   1 };
    kd_row_options_add(rows, options, &n, &document, &request, "", true, 1);
    kd_integral_request_finish(&request);
    options[n] = (struct argp_option) { 0 };
}

/* Options of one integral, and the texts that they refer to. */
struct table {
    struct argp argp;
    struct argp_option options[KD_ROW_OPTIONS + 4];
    struct kd_row_options rows;
    char doc[400];
};

static struct table tables[KD_INTEGRALS];

static const struct argp *make_argp(enum kd_integral what)
{
    struct table *table = &tables[what];
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 3 }, { 0 } };
    const char *title = kd_integral_kind_of(what)->title;
    set_options(what, table->options, &table->rows);
    snprintf(table->doc, sizeof table->doc,
             "%c%s.\vFILE is a request of POST /v1/%s; options override its members, or replace FILE. "
             "docs/physics/integrals.md has the formulas. %s",
             title[0] - 'a' + 'A', title + 1, kd_integral_name(what),
             what == KD_INTEGRAL_SPECTRUM
                 ? "With a scene, it computes the spectrum of the scene's volume; without one, no device is needed."
             : may_have_scene(what) ? "The scene is the default scene, changed by FILE, --preset, --from and --set."
                                    : "No device is needed.");
    table->argp = (struct argp) { .options = table->options,
                                  .parser = parse,
                                  .args_doc = "[FILE.json|-]",
                                  .doc = table->doc,
                                  .children = may_have_scene(what) ? kd_scene_device_children : children };
    return &table->argp;
}

static int run(enum kd_integral what, int argc, char **argv)
{
    struct arguments arguments = { .what = what, .rows = &tables[what].rows };
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };

    argp_parse(make_argp(what), argc, argv, 0, NULL, &arguments);
    bool print = !arguments.output || !strcmp(arguments.output, "-");
    enum kd_status status = !print || format_of(&arguments) >= KD_INTEGRAL_NPY
                                ? kd_file_check(print ? "-" : arguments.output, &error)
                                : KD_OK;
    if (!status)
        status = answer_text(&arguments, &out, &error);
    if (!status && !print)
        status = kd_file_write(arguments.output, &out, &error);
    int code = status ? kd_progress_exit(status, &error) : print ? kd_cli_print(out.data, out.size) : KD_EXIT_OK;
    kd_buffer_finish(&out);
    kd_scene_options_finish(&arguments.scene);
    return code;
}

const struct argp *kd_cli_line_argp(void) { return make_argp(KD_INTEGRAL_LINE); }
int kd_cli_line(int argc, char **argv) { return run(KD_INTEGRAL_LINE, argc, argv); }

const struct argp *kd_cli_transfer_function_argp(void) { return make_argp(KD_INTEGRAL_TRANSFER); }
int kd_cli_transfer_function(int argc, char **argv) { return run(KD_INTEGRAL_TRANSFER, argc, argv); }

const struct argp *kd_cli_impulse_argp(void) { return make_argp(KD_INTEGRAL_IMPULSE); }
int kd_cli_impulse(int argc, char **argv) { return run(KD_INTEGRAL_IMPULSE, argc, argv); }

const struct argp *kd_cli_lags_argp(void) { return make_argp(KD_INTEGRAL_LAGS); }
int kd_cli_lags(int argc, char **argv) { return run(KD_INTEGRAL_LAGS, argc, argv); }

const struct argp *kd_cli_visibility_argp(void) { return make_argp(KD_INTEGRAL_VISIBILITY); }
int kd_cli_visibility(int argc, char **argv) { return run(KD_INTEGRAL_VISIBILITY, argc, argv); }

const struct argp *kd_cli_compare_argp(void) { return make_argp(KD_INTEGRAL_COMPARE); }
int kd_cli_compare(int argc, char **argv) { return run(KD_INTEGRAL_COMPARE, argc, argv); }

const struct argp *kd_cli_observe_argp(void) { return make_argp(KD_INTEGRAL_OBSERVE); }
int kd_cli_observe(int argc, char **argv) { return run(KD_INTEGRAL_OBSERVE, argc, argv); }

const struct argp *kd_cli_spectrum_argp(void) { return make_argp(KD_INTEGRAL_SPECTRUM); }
int kd_cli_spectrum(int argc, char **argv) { return run(KD_INTEGRAL_SPECTRUM, argc, argv); }
