/* kerrd render: renders a scene to a picture file. */
#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/scene_options.h"
#include "cli/stats.h"
#include "render/output/format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    struct kd_scene_options scene;
    const char *device, *output;
    const struct kd_format *format; /* format of the output */
    uint64_t memory;
    unsigned quality; /* 0: the default */
    bool stats;
};

static const struct argp_option table[] = {
    { "output", 'o', "FILE", 0,
      "file to write; its ending chooses PNG, JPEG, WebP, FITS, EXR, NPZ or NPY; - for standard output, a PNG "
      "(required)",
      0 },
    { "quality", 'q', "1..100", 0, "quality of a JPEG or WebP (90)", 0 },
    KD_CLI_MEMORY,
    { "stats", 't', NULL, 0, "print times and accuracy as one line of JSON on standard error", 0 },
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
    case 'o': arguments->output = text; return 0;
    case 't': arguments->stats = true; return 0;
    case 'q': arguments->quality = kd_cli_number(state, "--quality", text, 1, KD_QUALITY_MAX); return 0;
    case 'M': arguments->memory = kd_cli_bytes(state, "--memory", text); return 0;
    case ARGP_KEY_END:
        if (!arguments->output)
            argp_error(state, "-o FILE is missing; it names the picture");
        else
            arguments->format = kd_cli_picture_format(state, "--output", arguments->output, false);
        if (arguments->output && !arguments->format)
            arguments->format = kd_formats[0];
        if (arguments->quality && !arguments->format->lossy)
            argp_error(state, "--quality is for .jpg and .webp; \"%s\" is an exact %s", arguments->output,
                       arguments->format->name);
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

struct work {
    struct kd_renderer *renderer;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_buffer file;
    double render_ms, encode_ms;
};

static enum kd_status save(struct work *work, const struct kd_scene *scene, const struct arguments *arguments,
                           struct kd_error *error)
{
    double started = kd_progress_clock();
    const struct kd_picture picture = {
        &work->frame, scene, &work->plan, kd_renderer_device_name(work->renderer), 0, arguments->quality
    };
    enum kd_status status = kd_encode(arguments->format, &picture, KD_EFFORT_KEEP, NULL, &work->file, error);
    work->encode_ms = 1e3 * (kd_progress_clock() - started);
    return status ? status : kd_file_write(arguments->output, &work->file, error);
}

static enum kd_status print_stats(const struct work *work, const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_stats stats = {
        .device = kd_renderer_device_name(work->renderer),
        .scene = scene,
        .plan = &work->plan,
        .frame = &work->frame,
        .render_ms = work->render_ms,
        .encode_ms = work->encode_ms,
        .bytes = work->file.size,
    };
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_stats_json(&stats, &text);
    if (status)
        kd_error_set(error, status, "out of memory for --stats");
    else
        fputs((const char *)text.data, stderr);
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status run(struct arguments *arguments, struct kd_error *error)
{
    struct kd_scene scene;
    struct work work = { 0 };
    enum kd_status status;
    KD_TRY(kd_scene_options_load(&arguments->scene, &scene, error));
    KD_TRY(kd_file_check(arguments->output, error));
    const struct kd_assets assets = kd_asset_options_assets(&arguments->scene.assets);
    KD_TRY(kd_renderer_create(&(struct kd_renderer_params) { .device = arguments->device,
                                                             .memory_bytes = arguments->memory,
                                                             .assets = &assets },
                              &work.renderer, error));
    KD_TRY(kd_cli_draw(work.renderer, arguments->format, &scene, &work.plan, &work.frame, &work.render_ms, error));
    KD_TRY(save(&work, &scene, arguments, error));
    if (arguments->stats)
        KD_TRY(print_stats(&work, &scene, error));
done:
    kd_frame_finish(&work.frame);
    kd_buffer_finish(&work.file);
    kd_renderer_destroy(work.renderer);
    return status;
}

const struct argp *kd_cli_render_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Render a scene to a picture, or to a file of numbers. Without a scene, the default scene is "
               "rendered.\vThe scene is merged in this order: defaults or --preset; SCENE.json, or the scene of "
               "--from; every --set. The picture contains its scene: --from renders it again.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_render(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_render_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = run(&arguments, &error);
    kd_scene_options_finish(&arguments.scene);
    return kd_progress_exit(status, &error);
}
