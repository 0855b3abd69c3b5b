/* kerrd light-curve: flux and centroid of a scene over time. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/scene_options.h"
#include "physics/spacetime/kerr.h"
#include "render/output/curve.h"
#include "scene/hole.h"

#include <stdlib.h>
#include <string.h>

#define FRAMES_MAX 100000

struct arguments {
    struct kd_scene_options scene;
    const char *device, *output, *start, *end;
    const struct kd_table_format *format;
    unsigned frames;
};

static const struct argp_option table[] = {
    { "start", 'a', "T", 0, "time of the first frame, M (default: the scene's)", 0 },
    { "end", 'b', "T", 0, "time of the last frame, M (default: one orbit of the first spot later)", 0 },
    { "frames", 'n', "N", 0, "number of frames, evenly spaced (default: 121)", 0 },
    { "output", 'o', "FILE", 0, "output file; .csv chooses that format (default: - for standard output)", 0 },
    { "format", 'f', "json|csv", 0, "format of the output, independent of its name", 0 },
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &arguments->scene;
        state->child_inputs[1] = &arguments->device;
        return 0;
    case 'a': arguments->start = text; return 0;
    case 'b': arguments->end = text; return 0;
    case 'n': arguments->frames = kd_cli_number(state, "frames", text, 2, FRAMES_MAX); return 0;
    case 'o': arguments->output = text; return 0;
    case 'f':
        arguments->format = kd_series_table(&kd_light_curve, text);
        if (!arguments->format)
            argp_error(state, "--format is %s; it must be json or csv", text);
        return 0;
    case ARGP_KEY_END:
        if (!arguments->format)
            arguments->format = kd_series_table(
                &kd_light_curve, kd_cli_ending(state, "--output", arguments->output, KD_ENDINGS("json", "csv")));
        if (!arguments->format)
            arguments->format = &kd_light_curve.tables[0];
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

/* Parses the first and the last time. Their range and messages are those of the scene's own time. */
static enum kd_status span(const struct arguments *arguments, struct kd_scene *scene, double *to,
                           struct kd_error *error)
{
    const struct kd_spot *on[KD_SPOTS];
    struct kd_scene last = *scene;
    enum kd_status status = arguments->start ? kd_scene_set(scene, "time", arguments->start, error) : KD_OK;
    if (status)
        return kd_cli_prefix(error, "--start");
    if (arguments->end && kd_scene_set(&last, "time", arguments->end, error))
        return kd_cli_prefix(error, "--end");
    *to = last.top.time;
    if (arguments->end)
        return KD_OK;
    if (!kd_scene_spots(scene, on))
        return kd_error_set(error, KD_EINVAL, "--end is missing; its default needs a spot, whose orbit it follows");
    *to = scene->top.time + 2 * M_PI / kd_kerr_omega(kd_scene_hole(scene), on[0]->r);
    return KD_OK;
}

struct work {
    struct kd_renderer *renderer;
    struct kd_curve_row *rows;
    struct kd_progress progress;
    unsigned frames, done;
};

static bool progress(void *user, double fraction)
{
    struct work *w = user;
    return kd_progress_update(&w->progress, (w->done + fraction) / w->frames);
}

static enum kd_status measure(struct work *w, const struct kd_scene *first, double to, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    kd_progress_init(&w->progress);
    kd_progress_catch_signals();
    for (; w->done < w->frames && !status; w->done++) {
        struct kd_scene scene = *first;
        struct kd_capacity capacity;
        struct kd_plan plan;
        struct kd_frame frame = { 0 };
        scene.top.time += (to - first->top.time) * w->done / (w->frames - 1);
        kd_renderer_capacity(w->renderer, &capacity);
        status = kd_format_plan(kd_light_curve.frame, &scene, &capacity, &plan, error);
        if (!status)
            status = kd_render(w->renderer, &scene, &plan, progress, w, &frame, error);
        if (!status)
            w->rows[w->done] = kd_curve_row_of(w->done, &scene, &frame);
        kd_frame_finish(&frame);
    }
    kd_progress_finish(&w->progress);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    return status;
}

static enum kd_status save(const struct work *w, const struct arguments *arguments, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = arguments->format->write(w->rows, w->frames, NULL, &text);
    if (status)
        kd_error_set(error, status, "out of memory for %u rows", w->frames);
    else
        status = kd_file_write(arguments->output, &text, error);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status run(struct arguments *arguments, struct kd_error *error)
{
    struct kd_scene scene;
    struct work work = { .frames = arguments->frames };
    double to = 0;
    enum kd_status status;
    KD_TRY(kd_scene_options_load(&arguments->scene, &scene, error));
    KD_TRY(span(arguments, &scene, &to, error));
    if (strcmp(arguments->output, "-"))
        KD_TRY(kd_file_check(arguments->output, error));
    const struct kd_assets assets = kd_asset_options_assets(&arguments->scene.assets);
    KD_TRY(kd_renderer_create(&(struct kd_renderer_params) { .device = arguments->device, .assets = &assets },
                              &work.renderer, error));
    if (!(work.rows = malloc(work.frames * sizeof *work.rows)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %u rows", work.frames));
    KD_TRY(measure(&work, &scene, to, error));
    KD_TRY(save(&work, arguments, error));
done:
    free(work.rows);
    kd_renderer_destroy(work.renderer);
    return status;
}

const struct argp *kd_cli_light_curve_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc =
            "Compute flux and centroid of a scene over time: of the whole picture, and of its hot spots alone.\vFlux "
            "is in M^2 (from a finite radius: sr) times the unit of brightness, centroids are (alpha, beta) in M "
            "(degrees to the right of the hole and above it). Where light is polarised (polarization.model), Stokes Q "
            "and U in the unit of the flux, the polarised fraction and the EVPA in radians are written as well, so "
            "that a spot's Q-U loop can be drawn. What lies outside the picture is not counted.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_light_curve(int argc, char **argv)
{
    struct arguments arguments = { .frames = 121, .output = "-" };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_light_curve_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = run(&arguments, &error);
    kd_scene_options_finish(&arguments.scene);
    return kd_progress_exit(status, &error);
}
