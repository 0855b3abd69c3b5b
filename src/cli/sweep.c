/* kerrd sweep: renders a scene for all values of some fields into one file. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/frames.h"
#include "cli/progress.h"
#include "cli/scene_command.h"
#include "cli/stats.h"
#include "render/output/curve.h"
#include "render/output/flux.h"
#include "render/output/gather.h"
#include "render/plan/sweep_order.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    struct kd_scene_command base;
    const char **axes;
    const struct kind *kind; /* the kind of output, chosen by the file's extension */
    size_t n_axes;
};

static const struct argp_option table[] = {
    { "axis", 'x', "FIELD=VALUES", 0,
      "an axis: VALUE,VALUE,... or START:STOP:STEP or START:STOP/COUNT; may be repeated, the last axis varies fastest",
      0 },
    { "output", 'o', "FILE", 0,
      "file to write: .fits or .npz for one array per layer; .zip for pictures; .csv or .json for fluxes (required)",
      0 },
    KD_CLI_MEMORY,
    { "stats", 't', NULL, 0,
      "print the numbers of scenes and lens maps, the fluxes in Jy and the time as one line of JSON on standard error",
      0 },
    { 0 },
};

/* A kind of output: the format of each scene, and the format of the file that contains all scenes. */
struct kind {
    const char *name; /* extension of the file */
    const struct kd_format *frame;
    const struct kd_gather_format *whole; /* format of the whole file; NULL: the output is a table */
};

static const struct kind *kind_of(const char *path, const struct argp_state *state)
{
    static struct kind kinds[] = { { "fits", &kd_format_cubed, &kd_gather_fits },
                                   { "npz", &kd_format_cubed, &kd_gather_npz },
                                   { "zip", &kd_format_png, &kd_gather_zip },
                                   { "csv", NULL, NULL },
                                   { "json", NULL, NULL } };
    const char *name = kd_cli_ending_required(state, "--output", path, KD_ENDINGS("fits", "npz", "zip", "csv", "json"));
    size_t i = 0;
    while (strcmp(kinds[i].name, name))
        i++;
    kinds[i].frame = kinds[i].whole ? kinds[i].frame : kd_light_curve.frame;
    return &kinds[i];
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case 'x': kd_cli_add_axis(&arguments->axes, &arguments->n_axes, text, state); return 0;
    case ARGP_KEY_END:
        if (!arguments->n_axes)
            argp_error(state,
                       "--axis is missing; it must be a field and its values, as in --axis spacetime.spin=0,0.5,0.9");
        else if (!arguments->base.output)
            argp_error(state, "-o FILE is missing; it names the output");
        else
            arguments->kind = kind_of(arguments->base.output, state);
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

struct work {
    const struct kd_sweep *sweep;
    const struct kind *kind;
    struct kd_renderer *renderer;
    struct kd_sweep_order order;
    struct kd_encoder encoder;
    struct kd_progress progress;
    struct kd_frames frames;
    double *fluxes; /* flux of each scene in Jy; NAN if the scene has no flux */
    unsigned traced;
};

/* Plans a scene. The message of an error contains the number of the scene. */
static enum kd_status plan_of(struct work *w, unsigned number, struct kd_scene *scene, struct kd_plan *plan,
                              struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_error inner = { 0 };
    kd_renderer_capacity(w->renderer, &capacity);
    enum kd_status status = kd_sweep_scene(w->sweep, number, scene, error);
    if (!status && (status = kd_format_plan(w->kind->frame, scene, &capacity, plan, &inner))) {
        kd_error_field(error, inner.pointer, "scene %u: %.440s", number, inner.message);
        error->status = status;
    }
    return status;
}

/* Plans all scenes, before any is rendered. */
static enum kd_status check(struct work *w, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_cube_shape shape;
    double shared_ms;
    for (unsigned i = 0; i < w->sweep->scenes && !status; i++) {
        struct kd_scene scene;
        struct kd_plan plan;
        uint64_t group;
        status = plan_of(w, i, &scene, &plan, error);
        if (!status && w->kind->frame == &kd_format_cubed)
            status = kd_cube_compare(&shape, i, &scene, &plan.picture, error);
        if (!status && (kd_plan_lens_group(&scene, &group) || kd_sweep_order_add(&w->order, group, 0)))
            status =
                kd_error_set(error, KD_ENOMEM, "out of memory for sorting %u scenes by lens map", w->sweep->scenes);
    }
    if (!status && kd_sweep_order_end(&w->order, &shared_ms))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for sorting %u scenes by lens map", w->sweep->scenes);
    return status;
}

static enum kd_status render(struct work *w, unsigned number, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_buffer file = { 0 };
    enum kd_status status;
    KD_TRY(plan_of(w, number, &scene, &plan, error));
    KD_TRY(kd_render(w->renderer, &scene, &plan, kd_progress_update, &w->progress, &frame, error));
    w->traced += !frame.lens_reused && plan.lens.planes;
    w->fluxes[number] = kd_flux_jy(&scene, &frame);
    const struct kd_picture picture = { &frame, &scene, &plan, kd_renderer_device_name(w->renderer), number };
    KD_TRY(kd_encode(w->kind->frame, &picture, KD_EFFORT_KEEP, &w->encoder, &file, error));
    KD_TRY(kd_frames_put(&w->frames, number, &file, error));
done:
    kd_buffer_finish(&file);
    kd_frame_finish(&frame);
    return status;
}

static enum kd_status render_all(struct work *w, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    kd_progress_begin(&w->progress, w->sweep->scenes);
    for (; w->progress.done < w->sweep->scenes && !status; w->progress.done++)
        status = render(w, w->order.frames[w->progress.done], error);
    return kd_progress_end(&w->progress, status, error);
}

static enum kd_status save_whole(struct work *w, const char *path, struct kd_error *error)
{
    return kd_frames_save(&w->frames, &(struct kd_frames_whole) { .format = w->kind->whole, .sweep = w->sweep }, path,
                          error);
}

static enum kd_status save_table(struct work *w, const char *path, struct kd_error *error)
{
    const struct kd_table_format *format = kd_series_table(&kd_light_curve, w->kind->name);
    const size_t row = kd_light_curve.row_bytes;
    char *rows = malloc(w->sweep->scenes * row);
    struct kd_buffer text = { 0 };
    bool read = rows;
    for (unsigned i = 0; i < w->sweep->scenes && read; i++)
        read = kd_frames_read(&w->frames, i, 0, rows + i * row, row);
    enum kd_status status = !rows ? KD_ENOMEM : read ? format->write(rows, w->sweep->scenes, w->sweep, &text) : KD_EIO;
    status = status
                 ? kd_error_set(error, status,
                                status == KD_EIO ? "cannot read the scenes from TMPDIR" : "out of memory for %u rows",
                                w->sweep->scenes)
                 : kd_file_write(path, &text, error);
    kd_buffer_finish(&text);
    free(rows);
    return status;
}

/* If any scene has a flux, writes the fluxes in the order of the scenes. A scene without a flux gets null. */
static void write_fluxes(const struct work *w, struct kd_json *json)
{
    bool any = false;
    for (unsigned i = 0; i < w->sweep->scenes; i++)
        any = any || !isnan(w->fluxes[i]);
    if (!any)
        return;
    kd_json_array(json, "flux_jy");
    for (unsigned i = 0; i < w->sweep->scenes; i++)
        kd_json_number(json, NULL, w->fluxes[i]);
    kd_json_end(json);
}

static enum kd_status print_stats(const struct work *w, double render_s, double write_s, struct kd_error *error)
{
    struct kd_buffer line = { 0 };
    struct kd_json json = kd_json_begin(&line);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "scenes", w->sweep->scenes);
    kd_json_number(&json, "lens_maps_traced", w->traced);
    write_fluxes(w, &json);
    kd_json_number(&json, "render_s", render_s);
    kd_json_number(&json, "write_s", write_s);
    kd_json_end(&json);
    return kd_stats_print(&json, &line, error);
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    struct kd_sweep *sweep = NULL;
    struct work work = { .kind = arguments->kind, .frames = KD_FRAMES_NONE };
    enum kd_status status;
    base->options.assets.later = true;
    KD_TRY(kd_scene_command_load(base, error));
    const struct kd_assets assets = kd_asset_options_assets(&base->options.assets);
    KD_TRY(kd_sweep_typed(arguments->axes, arguments->n_axes, &base->scene, &assets, &sweep, error));
    KD_TRY(kd_asset_options_check(&base->options.assets, error));
    work.sweep = sweep;
    if (work.kind->frame == &kd_format_cubed)
        KD_TRY(kd_cube_check(sweep, error));
    KD_TRY(kd_file_check(base->output, error));
    KD_TRY(kd_scene_command_open(base, error));
    work.renderer = base->renderer;
    KD_TRY(check(&work, error));
    work.frames.n = sweep->scenes;
    work.frames.noun = "scene";
    work.frames.format = work.kind->frame;
    KD_TRY(kd_frames_open(&work.frames, error));
    work.fluxes = calloc(sweep->scenes, sizeof *work.fluxes);
    if (!work.fluxes)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the fluxes of %u scenes", sweep->scenes));
    const double began = kd_progress_clock();
    KD_TRY(render_all(&work, error));
    const double rendered = kd_progress_clock();
    KD_TRY((work.kind->whole ? save_whole : save_table)(&work, base->output, error));
    if (base->stats)
        KD_TRY(print_stats(&work, rendered - began, kd_progress_clock() - rendered, error));
done:
    kd_frames_finish(&work.frames);
    kd_encoder_finish(&work.encoder);
    kd_sweep_order_finish(&work.order);
    kd_sweep_free(sweep);
    free(work.fluxes);
    return status;
}

const struct argp *kd_cli_sweep_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Render a scene for all combinations of values of some fields: its axes.\vA range START:STOP:STEP "
               "includes STOP if STOP is a whole number of steps from START. Scenes that share a lens map are rendered "
               "one after the other, independent of the order of the axes. A job of a server makes the same file.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_sweep(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    const int code = kd_scene_command_run(&arguments.base, kd_cli_sweep_argp(), argc, argv, run);
    free(arguments.axes);
    return code;
}
