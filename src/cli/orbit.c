/* kerrd orbit: follows timelike geodesics. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "base/cores.h"
#include "orbit/feed.h"
#include "physics/spacetime/observer.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_FIRST = 256 };

/* Fields in the order of their keys. Their names are those of kd_orbit_request_set and of --help. */
static const struct {
    const char *name, *argument, *help;
} fields[] = {
    { "case", "mercury|zoom-whirl|plunge|isco|spherical", "an orbit by name" },
    { "spin", "A", "spin of the hole, above -1 and below 1" },
    { "charge", "Q", "charge of the hole in M; the body is neutral (0)" },
    { "p", "P", "bound orbit by its shape: semi-latus rectum; the radii are between P/(1+E) and P/(1-E)" },
    { "e", "E", "bound orbit by its shape: eccentricity, below 1" },
    { "inclination_deg", "I", "bound orbit by its shape: inclination; above 90 is retrograde" },
    { "energy", "E", "orbit by its constants: energy per mass" },
    { "angular_momentum", "L", "orbit by its constants: angular momentum about the axis, per mass" },
    { "carter", "Q", "orbit by its constants: Carter's constant; 0 (the default): equatorial" },
    { "theta_deg", "T", "orbit by position and velocity: polar angle" },
    { "phi_deg", "F", "azimuth" },
    { "frame", KD_OBSERVER_FRAME_WORDS, "observer whose frame the velocity refers to (zamo)" },
    { "v_r", "V", "components of the velocity, in units of c" },
    { "v_theta", "V", NULL },
    { "v_phi", "V", NULL },
    /* These two come after the fields on which their meaning depends. */
    { "r", "R", "radius of the position; for an orbit by its constants, the radius where it starts" },
    { "outward", "true|false", "for an orbit by its constants: whether it starts outwards" },
    { "periods", "N", "duration in radial periods (10), or in revolutions if r is constant" },
    { "or_end", "true|false", "follow an orbit that plunges or escapes to its end, because it has no periods (false)" },
    { "time", "T", "duration in coordinate time, M" },
    { "samples", "N", "number of samples of the path, both ends included (1000); 0 for none" },
    { "digits", "N", "significant digits of the series as text (17: all)" },
    { "method", "yoshida6|rkn6|closed", "method of integration (yoshida6)" },
    { "steps", "N", "steps per radial period, instead of a tolerance" },
    { "tolerance", "X", "largest relative error after a period; it determines the step (1e-12)" },
    { "r_max", "R", "radius at which an escaping orbit ends (100)" },
    { "observer_inclination_deg", "I", "observer who sees each sample: inclination" },
    { "observer_r", "R|infinity", "observer's radius (infinity)" },
    { "observer_azimuth_deg", "F", "observer's azimuth (0)" },
    { "observer", KD_OBSERVER_FRAME_WORDS, "observer's motion (static)" },
    { "mass_msun", "M", "mass of the hole; adds frequencies in Hz and the advance per century" },
};
#define N_FIELDS (sizeof fields / sizeof *fields)

struct arguments {
    const char *input, *output, *format;
    const char *given[N_FIELDS];
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (key >= KEY_FIRST && key < KEY_FIRST + (int)N_FIELDS) {
        arguments->given[key - KEY_FIRST] = text;
        return 0;
    }
    switch (key) {
    case 'o': arguments->output = text; return 0;
    case 'f':
        if (strcmp(text, "json") && strcmp(text, "ndjson") && strcmp(text, "csv") && strcmp(text, "npy"))
            argp_error(state, "--format is %s; it must be json, ndjson, csv or npy", text);
        arguments->format = text;
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->input)
            argp_error(state, "%s: one file at a time, and %s was given already", text, arguments->input);
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

static enum kd_status load(const struct arguments *arguments, struct kd_orbit_request *request, struct kd_error *error)
{
    enum kd_status status;
    if (arguments->input)
        KD_TRY(load_file(arguments->input, request, error));
    for (size_t i = 0; i < N_FIELDS; i++)
        if (arguments->given[i])
            KD_TRY(kd_orbit_request_set(request, fields[i].name, arguments->given[i], error));
    KD_TRY(kd_orbit_request_check(request, error));
done:
    return status;
}

/* Source of the answer's bytes. */
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

/* Integrates many orbits on all cores, before the answer is read. */
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
    kd_progress_init(&source.progress);
    kd_progress_catch_signals();
    /* The first bytes are computed before the file is opened, so that bad input leaves no file. */
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

/* Makes an option for each field: --inclination-deg for inclination_deg. */
static void set_options(struct argp_option *options, char names[N_FIELDS][32])
{
    options[0] = (struct argp_option) {
        "output", 'o', "FILE", 0, "output file; .npy, .csv and .ndjson choose those formats", 0
    };
    options[1] =
        (struct argp_option) { "format", 'f', "json|ndjson|csv|npy", 0, "format of the output, independent of its name",
                               0 };
    for (size_t i = 0; i < N_FIELDS; i++) {
        strncpy(names[i], fields[i].name, 31);
        for (char *c = names[i]; (c = strchr(c, '_'));)
            *c = '-';
        options[2 + i] =
            (struct argp_option) { names[i], KEY_FIRST + (int)i, fields[i].argument, 0, fields[i].help, 0 };
    }
}

const struct argp *kd_cli_orbit_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 0 }, { 0 } };
    static char names[N_FIELDS][32];
    static struct argp_option options[N_FIELDS + 3];
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
    set_options(options, names);
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
