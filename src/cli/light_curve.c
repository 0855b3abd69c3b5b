/* kerrd light-curve: flux and centroid of a scene over time. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/scene_command.h"
#include "physics/spacetime/kerr.h"
#include "render/output/curve.h"
#include "scene/hole.h"

#include <stdlib.h>
#include <string.h>

#define FRAMES_MAX 100000

struct arguments {
    struct kd_scene_command base;
    const char *start, *end;
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
    case 'a': arguments->start = text; return 0;
    case 'b': arguments->end = text; return 0;
    case 'n': arguments->frames = kd_cli_number(state, "frames", text, 2, FRAMES_MAX); return 0;
    case 'f':
        arguments->format = kd_series_table(&kd_light_curve, text);
        if (!arguments->format)
            argp_error(state, "--format is %s; it must be json or csv", text);
        return 0;
    case ARGP_KEY_END:
        if (!arguments->format)
            arguments->format = kd_series_table(
                &kd_light_curve, kd_cli_ending(state, "--output", arguments->base.output, KD_ENDINGS("json", "csv")));
        if (!arguments->format)
            arguments->format = &kd_light_curve.tables[0];
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

/* Parses the first and the last time. Valid ranges and messages are those of the scene's field `time`. */
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
        return kd_error_set(
            error, KD_EINVAL,
            "--end is missing; by default the curve covers one orbit of the first spot, but the scene has no spot");
    *to = scene->top.time + 2 * M_PI / kd_kerr_omega(kd_scene_hole(scene), on[0]->r);
    return KD_OK;
}

struct work {
    struct kd_renderer *renderer;
    struct kd_curve_row *rows;
    struct kd_progress progress;
    unsigned frames;
};

static enum kd_status measure(struct work *w, const struct kd_scene *first, double to, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    kd_progress_begin(&w->progress, w->frames);
    for (unsigned i = 0; i < w->frames && !status; i++, w->progress.done++) {
        struct kd_scene scene = *first;
        struct kd_capacity capacity;
        struct kd_plan plan;
        struct kd_frame frame = { 0 };
        scene.top.time += (to - first->top.time) * i / (w->frames - 1);
        kd_renderer_capacity(w->renderer, &capacity);
        status = kd_format_plan(kd_light_curve.frame, &scene, &capacity, &plan, error);
        if (!status)
            status = kd_render(w->renderer, &scene, &plan, kd_progress_update, &w->progress, &frame, error);
        if (!status)
            w->rows[i] = kd_curve_row_of(i, &scene, &frame);
        kd_frame_finish(&frame);
    }
    return kd_progress_end(&w->progress, status, error);
}

static enum kd_status save(const struct work *w, const struct arguments *arguments, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = arguments->format->write(w->rows, w->frames, NULL, &text);
    if (status)
        kd_error_set(error, status, "out of memory for %u rows", w->frames);
    else
        status = kd_file_write(arguments->base.output, &text, error);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    struct work work = { .frames = arguments->frames };
    double to = 0;
    enum kd_status status;
    KD_TRY(kd_scene_command_load(base, error));
    KD_TRY(span(arguments, &base->scene, &to, error));
    if (strcmp(base->output, "-"))
        KD_TRY(kd_file_check(base->output, error));
    KD_TRY(kd_scene_command_open(base, error));
    work.renderer = base->renderer;
    if (!(work.rows = malloc(work.frames * sizeof *work.rows)))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %u rows", work.frames));
    KD_TRY(measure(&work, &base->scene, to, error));
    KD_TRY(save(&work, arguments, error));
done:
    free(work.rows);
    return status;
}

const struct argp *kd_cli_light_curve_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Compute flux and centroid of a scene over time: of the whole picture, and of its hot spots "
               "alone.\vFlux is in M^2 times the unit of brightness; centroids are (alpha, beta) in M. From a finite "
               "radius, flux is in sr times the unit of brightness, and centroids are in degrees to the right of the "
               "hole and above it. Where light is polarised (polarization.model), Stokes Q and U in the unit of the "
               "flux, the polarised fraction and the EVPA in radians are written as well, so that a spot's Q-U loop "
               "can be drawn. What lies outside the picture is not counted.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_light_curve(int argc, char **argv)
{
    struct arguments arguments = { .base.output = "-", .frames = 121 };
    return kd_scene_command_run(&arguments.base, kd_cli_light_curve_argp(), argc, argv, run);
}
