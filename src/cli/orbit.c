/* kerrd orbit: follows timelike geodesics. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/row_options.h"
#include "base/cores.h"
#include "orbit/feed.h"
#include "orbit/fields.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static struct kd_row_options rows;

struct arguments {
    const char *input, *output, *format;
    struct kd_row_texts given;
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (kd_row_options_take(&arguments->given, key, text))
        return 0;
    switch (key) {
    case 'o': arguments->output = text; return 0;
    case 'f':
        if (strcmp(text, "json") && strcmp(text, "ndjson") && strcmp(text, "csv") && strcmp(text, "npy"))
            argp_error(state, "--format is %s; it must be json, ndjson, csv or npy", text);
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
                kd_cli_ending(state, "--output", arguments->output, KD_ENDINGS("json", "ndjson", "csv", "npy"));
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_orbit_format format_of(const struct arguments *arguments)
{
    const char *format = arguments->format;
    return !strcmp(format, "npy")      ? KD_ORBIT_NPY
           : !strcmp(format, "csv")    ? KD_ORBIT_CSV
           : !strcmp(format, "ndjson") ? KD_ORBIT_NDJSON
                                       : KD_ORBIT_JSON;
}

static enum kd_status load_file(const char *path, struct kd_orbit_request *request, struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    enum kd_status status;
    KD_TRY(kd_file_read(path, KD_ORBIT_BODY_MAX, &file, error));
    status = kd_orbit_request_json(request, file.data ? (const char *)file.data : "", file.size, error);
    if (status)
        kd_cli_prefix(error, strcmp(path, "-") ? path : "standard input");
done:
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status set(void *request, const char *name, const char *text, struct kd_error *error)
{
    return kd_orbit_request_set(request, name, text, error);
}

static enum kd_status load(const struct arguments *arguments, struct kd_orbit_request *request, struct kd_error *error)
{
    enum kd_status status;
    if (arguments->input)
        KD_TRY(load_file(arguments->input, request, error));
    KD_TRY(kd_row_options_set(&rows, &arguments->given, set, request, error));
    KD_TRY(kd_orbit_request_check(request, error));
done:
    return status;
}

/* Source of the bytes of the answer. */
struct source {
    struct kd_orbit_feed *feed;
    struct kd_buffer ready;
    size_t taken;
    struct kd_progress progress;
    enum kd_status status;
    struct kd_error *error;
};

static size_t produce(void *user, void *to, size_t size)
{
    struct source *s = user;
    while (s->taken == s->ready.size && !s->status && !kd_orbit_feed_done(s->feed)) {
        s->ready.size = s->taken = 0;
        s->status = kd_orbit_feed_more(s->feed, &s->ready, s->error);
        if (!s->status && !kd_progress_update(&s->progress, kd_orbit_feed_fraction(s->feed)))
            s->status = kd_error_set(s->error, KD_ECANCELLED, "stopped");
    }
    size_t n = s->ready.size - s->taken < size ? s->ready.size - s->taken : size;
    if (s->status)
        return KD_FILE_STOP;
    if (n)
        memcpy(to, s->ready.data + s->taken, n);
    s->taken += n;
    return n;
}

static void *help(void *feed)
{
    while (kd_orbit_feed_help(feed)) {
    }
    return NULL;
}

/* Integrates many orbits on all cores, before the answer is read in order. */
static void share(struct kd_orbit_feed *feed)
{
    pthread_t threads[15];
    int n = 0, cores = (int)kd_cores();
    while (n < 15 && n + 1 < cores && !pthread_create(&threads[n], NULL, help, feed))
        n++;
    help(feed);
    while (n > 0)
        pthread_join(threads[--n], NULL);
}

static enum kd_status write_answer(const struct arguments *arguments, struct kd_orbit_feed *feed,
                                   struct kd_error *error)
{
    const char *path = arguments->output ? arguments->output : "-";
    struct source source = { .feed = feed, .error = error };
    if (strcmp(path, "-") || feed->format == KD_ORBIT_NPY) {
        enum kd_status status = kd_file_check(path, error);
        if (status)
            return status;
    }
    kd_progress_begin(&source.progress, 1);
    /* Computes the first bytes before the file is opened, so that invalid input leaves no file. */
    source.status = kd_orbit_feed_more(feed, &source.ready, error);
    if (!source.status && feed->request->many) {
        share(feed);
        if (!kd_orbit_feed_done(feed))
            source.status = kd_orbit_feed_more(feed, &source.ready, error);
    }
    enum kd_status status = source.status;
    if (!status)
        status = kd_file_stream(path, produce, &source, error);
    kd_progress_finish(&source.progress);
    kd_buffer_finish(&source.ready);
    return source.status ? source.status : status;
}

static enum kd_status run(const struct arguments *arguments, struct kd_error *error)
{
    struct kd_orbit_request request;
    struct kd_orbit_feed *feed = calloc(1, sizeof *feed);
    kd_orbit_request_init(&request);
    enum kd_status status = feed ? load(arguments, &request, error) : kd_error_set(error, KD_ENOMEM, "out of memory");
    if (!status)
        status = kd_orbit_feed_init(feed, &request, format_of(arguments), error);
    if (!status) {
        status = write_answer(arguments, feed, error);
        kd_orbit_feed_finish(feed);
    }
    free(feed);
    kd_orbit_request_finish(&request);
    return status;
}

static void set_options(struct argp_option *options)
{
    /* The forms in which options can define an orbit. The case is first and the state is last, because the meaning
     * of --r depends on the constants. */
    static const struct {
        enum kd_orbit_form form;
        const char *about;
    } forms[] = {
        { KD_ORBIT_CASE, "" },
        { KD_ORBIT_SHAPE, "bound orbit by its shape: " },
        { KD_ORBIT_CONSTANTS, "orbit by its constants: " },
        { KD_ORBIT_STATE, "orbit by position, with --r, and velocity: " },
    };
    struct kd_orbit_request request;
    size_t n = 0;
    kd_orbit_request_init(&request);
    rows.n = 0;
    options[n++] = (struct argp_option) {
        "output", 'o', "FILE", 0, "output file; .npy, .csv and .ndjson choose those formats", 0
    };
    options[n++] =
        (struct argp_option) { "format", 'f', "json|ndjson|csv|npy", 0, "format of the output, independent of its name",
                               0 };
    kd_row_options_add(&rows, options, &n, &kd_orbit_request_document, &request.params, "", false, 0);
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        struct kd_document one = kd_orbit_document;
        one.of = 1u << forms[i].form;
        kd_row_options_add(&rows, options, &n, &one, NULL, forms[i].about, false, 0);
    }
    options[n] = (struct argp_option) { 0 };
}

const struct argp *kd_cli_orbit_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 0 }, { 0 } };
    static struct argp_option options[KD_ROW_OPTIONS + 3];
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "[FILE.json|-]",
        .doc = "Follow a body round a Kerr hole: its path, turning points, constants of motion and their drift, "
               "frequencies, and the advance of its periastron.\vFILE is a request of POST /v1/orbits with one orbit "
               "or a list; options override its members, or replace FILE: kerrd orbit --spin 0.9 --p 6 --e 0.5 "
               "--inclination-deg 30. No device is needed.",
        .children = children,
    };
    set_options(options);
    return &argp;
}

int kd_cli_orbit(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_orbit_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = run(&arguments, &error);
    return kd_progress_exit(status, &error);
}
