/* kerrd playground: moves bodies around the hole for some time, and writes their final state and the events. */
#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/playground_pictures.h"
#include "cli/progress.h"
#include "playground/json.h"
#include "playground/preset.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    KEY_SET = 256,
    KEY_TIME,
    KEY_SERIES,
    KEY_FALLBACK,
    KEY_EVENTS,
    KEY_LIST,
    KEY_PICTURE,
    KEY_EVERY,
    KEY_SCENE,
    KEY_SCENE_PRESET,
    KEY_SCENE_SET,
    KEY_SIZE,
    SETS_MAX = 64
};

struct arguments {
    const char *document, *preset, *output, *series, *fallback, *events;
    const char *series_format;
    const char *sets[SETS_MAX];
    size_t n_sets;
    double time;
    /* bounded: true if --set budget was given. Otherwise there is no budget, because this setting is meant for
     * servers. */
    bool list, bounded;
    struct kd_pictures_asked pictures;
};

static const struct argp_option table[] = {
    { "preset", 'p', "PLAYGROUND", 0, "preset of a playground to start from (--list prints them)", 0 },
    { "set", KEY_SET, "SETTING=VALUE", 0, "a setting, such as waves=true", 0 },
    { "time", KEY_TIME, "M", 0, "time to simulate (default: 0, which only writes the initial state)", 0 },
    { "output", 'o', "FILE.json", 0,
      "file for the final snapshot, from which a run can continue (default: standard output, unless there are "
      "pictures)",
      0 },
    { "series", KEY_SERIES, "FILE", 0, "energy, angular momentum, separation and strain over time, as .csv or .npy",
      0 },
    { "fallback", KEY_FALLBACK, "FILE.csv", 0,
      "rate at which debris has returned, with the law t^(-5/3) for comparison", 0 },
    { "events", KEY_EVENTS, "FILE.ndjson", 0, "events, one per line", 0 },
    { "list", KEY_LIST, 0, 0, "print the presets", 0 },
    { "picture", KEY_PICTURE, "FILE", 0,
      "lensed picture of the final state; the ending chooses PNG, FITS, EXR, NPZ or NPY; with --every the name must "
      "contain %d, as in film/%05d.png",
      1 },
    { "every", KEY_EVERY, "M", 0, "time between two pictures; the first shows the initial state", 1 },
    { "scene", KEY_SCENE, "SCENE.json", 0,
      "scene of the pictures: camera, disk, sky and so on (default: a view of the preset, or of all bodies)", 1 },
    { "scene-preset", KEY_SCENE_PRESET, "PRESET", 0,
      "preset for the scene of the pictures (`kerrd presets` lists them)", 1 },
    { "scene-set", KEY_SCENE_SET, "PATH=VALUE", 0,
      "set one field of that scene, as in camera.inclination_deg=60; may be repeated", 1 },
    { "size", KEY_SIZE, "WIDTHxHEIGHT", 0, "size of the pictures, as in 1920x1080", 1 },
    { "stats", 't', NULL, 0, "print the number of pictures and their time as one line of JSON on standard error", 1 },
    KD_CLI_MEMORY,
    { 0 },
};

/* Checks that the extensions of the output files agree with their formats. */
static void check_names(struct arguments *a, const struct argp_state *state)
{
    if (a->output)
        kd_cli_ending(state, "--output", a->output, KD_ENDINGS("json"));
    if (a->series)
        a->series_format = kd_cli_ending(state, "--series", a->series, KD_ENDINGS("csv", "npy"));
    if (a->fallback)
        kd_cli_ending(state, "--fallback", a->fallback, KD_ENDINGS("csv"));
    if (a->events)
        kd_cli_ending(state, "--events", a->events, KD_ENDINGS("ndjson"));
    if (a->pictures.path)
        a->pictures.format = kd_cli_picture_format(state, "--picture", a->pictures.path, true);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *a = state->input;
    char *end;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &a->pictures.device; return 0;
    case KEY_PICTURE: a->pictures.path = text; return 0;
    case KEY_EVERY:
        a->pictures.every = strtod(text, &end);
        if (*end || end == text || !(a->pictures.every > 0) || !isfinite(a->pictures.every))
            argp_error(state, "--every is %s; it must be a number above 0", text);
        return 0;
    case KEY_SCENE: a->pictures.scene.document = text; return 0;
    case KEY_SCENE_PRESET: a->pictures.scene.preset = text; return 0;
    case KEY_SCENE_SET:
        if (!strchr(text, '='))
            argp_error(state, "--scene-set is %s; it must be PATH=VALUE, as in camera.inclination_deg=60", text);
        if (!kd_scene_options_add_set(&a->pictures.scene, text))
            argp_failure(state, KD_EXIT_FAILURE, 0, "out of memory");
        return 0;
    case KEY_SIZE:
        if (!kd_scene_options_add_size(&a->pictures.scene, text))
            argp_error(state, "--size is %s; it must be WIDTHxHEIGHT in pixels, as in 1920x1080", text);
        return 0;
    case 't': a->pictures.stats = true; return 0;
    case 'M': a->pictures.memory = kd_cli_bytes(state, "--memory", text); return 0;
    case 'p': a->preset = text; return 0;
    case 'o': a->output = text; return 0;
    case KEY_SERIES: a->series = text; return 0;
    case KEY_FALLBACK: a->fallback = text; return 0;
    case KEY_EVENTS: a->events = text; return 0;
    case KEY_LIST: a->list = true; return 0;
    case KEY_SET:
        if (a->n_sets == SETS_MAX || !strchr(text, '='))
            argp_error(state, "--set must be SETTING=VALUE, and may be given at most %d times", SETS_MAX);
        a->sets[a->n_sets++] = text;
        a->bounded = a->bounded || !strncmp(text, "budget=", 7);
        return 0;
    case KEY_TIME:
        a->time = strtod(text, &end);
        if (*end || end == text || !(a->time >= 0) || !isfinite(a->time))
            argp_error(state, "--time is %s; it must be at least 0", text);
        return 0;
    case ARGP_KEY_ARG:
        if (a->document)
            argp_error(state, "there are two documents; there must be at most one");
        a->document = text;
        return 0;
    case ARGP_KEY_END:
        if (a->document && a->preset)
            argp_error(state, "--preset cannot be used with a document, because the document names its preset");
        check_names(a, state);
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_status set(struct kd_playground *p, const struct arguments *a, struct kd_error *error)
{
    struct kd_playground_params params = p->params;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < a->n_sets; i++) {
        char name[40];
        const char *value = strchr(a->sets[i], '=') + 1;
        snprintf(name, sizeof name, "%.*s", (int)(value - 1 - a->sets[i]), a->sets[i]);
        KD_TRY(kd_playground_params_set(&params, name, value, error));
    }
    if (a->n_sets)
        KD_TRY(kd_playground_set(p, &params, error));
done:
    return status;
}

static enum kd_status load(const struct arguments *a, struct kd_playground **p, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status;
    if (a->document)
        KD_TRY(kd_file_read(a->document, KD_PLAYGROUND_JSON_MAX, &text, error));
    else if (a->preset)
        KD_TRY(kd_buffer_printf(&text, "{\"preset\":\"%.60s\"}", a->preset));
    else
        KD_TRY(kd_buffer_printf(&text, "{}"));
    KD_TRY(kd_playground_read((const char *)text.data, text.size, p, error));
    KD_TRY(set(*p, a, error));
done:
    kd_buffer_finish(&text);
    return status;
}

/* The text of all events since the beginning, one per line. If a sub-step has more than KD_PLAYGROUND_EVENTS events,
 * the oldest are lost; a line then states how many. */
struct story {
    struct kd_buffer text;
    uint64_t told, lost;      /* told: number of the last event that was written; lost: number of lost events */
    struct kd_error short_of; /* the reason why the simulation ended early; status KD_OK if it did not */
};

static enum kd_status add_lost(struct story *story, uint64_t to)
{
    struct kd_json json = kd_json_begin(&story->text);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "kind", "lost");
    kd_json_number(&json, "from", (double)story->told + 1);
    kd_json_number(&json, "to", (double)to);
    kd_json_end(&json);
    story->lost += to - story->told;
    return kd_json_finish_line(&json);
}

static enum kd_status go_on_telling(struct story *story, const struct kd_playground *p)
{
    const uint64_t last = p->events.last, first = last > KD_PLAYGROUND_EVENTS
                                                      ? last - KD_PLAYGROUND_EVENTS
                                                      : 0; /* number of the event before the oldest stored one */
    enum kd_status status = KD_OK;
    if (story->told < first) {
        KD_TRY(add_lost(story, first));
        story->told = first;
    }
    for (; story->told < last; story->told++) {
        struct kd_json json = kd_json_begin(&story->text);
        kd_playground_event_json(kd_playground_event_at(&p->events, story->told + 1), &json, NULL);
        KD_TRY(kd_json_finish_line(&json));
    }
done:
    return status;
}

enum what { SERIES_CSV, SERIES_NPY, FALLBACK, SNAPSHOT };

static enum kd_status write_one(struct kd_playground *p, enum what what, const char *path, struct kd_error *error)
{
    struct kd_buffer out = { 0 };
    double now[KD_SERIES_N];
    enum kd_status status = KD_OK;
    if (!path)
        return KD_OK;
    switch (what) {
    case SERIES_CSV:
    case SERIES_NPY:
        kd_playground_series_row(p, now);
        status = (what == SERIES_NPY ? kd_series_npy : kd_series_csv)(&p->series, now, &out);
        break;
    case FALLBACK: status = kd_debris_csv(&p->debris, &out); break;
    case SNAPSHOT: status = kd_playground_write(p, true, &out);
    }
    if (status)
        status = kd_error_set(error, status, "out of memory for %s", path);
    else
        status = kd_file_write(path, &out, error);
    kd_buffer_finish(&out);
    return status;
}

/* Records why the simulation stops before the time t. Only the first reason is reported, after everything is
 * written. */
static void tell_short(const struct kd_playground *p, double t, bool bounded, struct kd_error *short_of)
{
    if (short_of->status)
        return;
    if (!(p->t < KD_PLAYGROUND_TIME))
        kd_error_set(short_of, KD_EIO,
                     "a playground ends at %g M; the simulation reached %.9g M of the requested %.9g M",
                     KD_PLAYGROUND_TIME, p->t, t);
    else if (!bounded)
        kd_error_set(short_of, KD_EIO,
                     "the simulation reached %.9g M of the requested %.9g M; the next sub-step is too short for the "
                     "resolution of a double",
                     p->t, t);
    else
        kd_error_set(short_of, KD_EIO,
                     "the simulation reached %.9g M of the requested %.9g M, because its budget of %u sub-steps is "
                     "spent (--set budget=N raises it; without --set there is no limit)",
                     p->t, t, p->params.budget);
}

/* Advances the playground to the time t. The budget of sub-steps is meant for servers, so it applies only with the
 * option --set budget. */
static enum kd_status go_on(const struct arguments *a, struct kd_playground *p, double t, struct story *story,
                            struct kd_error *error)
{
    const uint32_t budget = p->params.budget;
    struct kd_playground_run run;
    enum kd_status status = KD_OK;
    bool more = p->t < t;
    if (!a->bounded)
        p->params.budget = UINT32_MAX;
    while (more) {
        const double begin = p->t;
        kd_playground_begin(p, t - p->t, &run);
        do {
            more = kd_playground_go_on(p, &run, 1);
            if (p->events.last > story->told && go_on_telling(story, p))
                KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the events"));
        } while (more);
        more = !a->bounded && p->t < t && p->t > begin && p->t < KD_PLAYGROUND_TIME;
    }
done:
    p->params.budget = budget;
    if (p->t < t)
        tell_short(p, t, a->bounded, &story->short_of);
    return status;
}

static enum kd_status film(struct arguments *a, struct kd_playground *p, struct story *story, struct kd_error *error)
{
    const struct kd_playground_preset *preset = a->preset ? kd_playground_preset_of(a->preset) : NULL;
    const double begin = p->t, end = p->t + a->time, every = a->pictures.every;
    struct kd_pictures pictures;
    enum kd_status status = KD_OK;
    KD_TRY(kd_pictures_begin(&a->pictures, preset ? preset->scene : NULL, p, &pictures, error));
    for (unsigned k = 0; every > 0 && k <= a->time / every * (1 + 1e-12); k++) {
        KD_TRY(go_on(a, p, begin + k * every, story, error));
        KD_TRY(kd_pictures_take(&pictures, p, error));
    }
    KD_TRY(go_on(a, p, end, story, error));
    if (!(every > 0))
        KD_TRY(kd_pictures_take(&pictures, p, error));
done:
    kd_pictures_finish(&pictures);
    return status;
}

/* Checks in advance that all files can be written, because the simulation may take minutes. */
static enum kd_status check_files(const struct arguments *a, struct kd_error *error)
{
    const char *const files[] = { a->output, a->series, a->fallback, a->events };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sizeof files / sizeof *files && !status; i++)
        if (files[i] && strcmp(files[i], "-"))
            status = kd_file_check(files[i], error);
    return status;
}

static enum kd_status work(struct arguments *a, struct kd_error *error)
{
    struct kd_playground *p = NULL;
    struct story story = { 0 };
    enum kd_status status;
    KD_TRY(kd_pictures_check(&a->pictures, error));
    KD_TRY(check_files(a, error));
    KD_TRY(load(a, &p, error));
    story.told = p->events.last; /* skips the events that the snapshot already contains */
    kd_playground_series_begin(p, a->time);
    if (a->pictures.path)
        KD_TRY(film(a, p, &story, error));
    else
        KD_TRY(go_on(a, p, p->t + a->time, &story, error));
    if (story.lost)
        fprintf(stderr, "kerrd: %llu events are lost, because at most %d events of one sub-step are stored\n",
                (unsigned long long)story.lost, KD_PLAYGROUND_EVENTS);
    if (kd_playground_lost_momentum(p))
        fprintf(stderr, "kerrd: bodies smaller than 2 (m1 + m2) accelerated one another beyond c; their speeds were "
                        "limited to c, which removed momentum (state.spent.capped_momentum)\n");
    KD_TRY(write_one(p, a->series && !strcmp(a->series_format, "npy") ? SERIES_NPY : SERIES_CSV, a->series, error));
    KD_TRY(write_one(p, FALLBACK, a->fallback, error));
    if (a->events)
        KD_TRY(kd_file_write(a->events, &story.text, error));
    KD_TRY(write_one(p, SNAPSHOT, a->output ? a->output : a->pictures.path ? NULL : "-", error));
    if (story.short_of.status) {
        status = story.short_of.status;
        *error = story.short_of;
    }
done:
    kd_buffer_finish(&story.text);
    kd_playground_destroy(p);
    return status;
}

const struct argp *kd_cli_playground_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = "[FILE.json|-]",
        .doc = "Simulate bodies round the hole: they attract one another, merge, are torn apart and spiral in. "
               "docs/playground.md has the equations.\vThe document is a request or a snapshot. Without one, and "
               "without --preset, there are no bodies.",
        .children = kd_cli_device_children,
    };
    return &argp;
}

int kd_cli_playground(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_error error = { 0 };
    argp_parse(kd_cli_playground_argp(), argc, argv, 0, NULL, &arguments);
    for (size_t i = 0; arguments.list && i < kd_playground_n_presets; i++)
        printf("%-14s %s\n", kd_playground_presets[i].name, kd_playground_presets[i].title);
    if (arguments.list)
        return KD_EXIT_OK;
    const enum kd_status status = work(&arguments, &error);
    kd_scene_options_finish(&arguments.pictures.scene);
    return kd_progress_exit(status, &error);
}
