/* kerrd render: renders a scene to a picture file. */
#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/scene_command.h"
#include "cli/stats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    struct kd_scene_command base;
    const struct kd_format *format; /* format of the output */
    unsigned quality;               /* 0: the default */
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
    const char *output = arguments->base.output;
    switch (key) {
    case 'q': arguments->quality = kd_cli_number(state, "--quality", text, 1, KD_QUALITY_MAX); return 0;
    case ARGP_KEY_END:
        if (!output)
            argp_error(state, "-o FILE is missing; it names the picture");
        else
            arguments->format = kd_cli_picture_format(state, "--output", output, false);
        if (output && !arguments->format)
            arguments->format = kd_formats[0];
        if (arguments->quality && !arguments->format->lossy)
            argp_error(state, "--quality is for .jpg and .webp; \"%s\" is an exact %s", output,
                       arguments->format->name);
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

static enum kd_status print_stats(const struct kd_scene_command *base, double encode_ms, struct kd_error *error)
{
    const struct kd_stats stats = {
        .device = kd_renderer_device_name(base->renderer),
        .scene = &base->scene,
        .plan = &base->plan,
        .frame = &base->frame,
        .render_ms = base->ms,
        .encode_ms = encode_ms,
        .bytes = base->file.size,
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

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    enum kd_status status;
    KD_TRY(kd_scene_command_load(base, error));
    KD_TRY(kd_file_check(base->output, error));
    KD_TRY(kd_scene_command_open(base, error));
    KD_TRY(kd_scene_command_draw(base, arguments->format, error));
    const double drawn = kd_progress_clock();
    struct kd_picture picture = kd_scene_command_picture(base);
    picture.lossy = arguments->quality;
    KD_TRY(kd_encode(arguments->format, &picture, KD_EFFORT_KEEP, NULL, &base->file, error));
    const double encode_ms = 1e3 * (kd_progress_clock() - drawn);
    KD_TRY(kd_file_write(base->output, &base->file, error));
    if (base->stats)
        KD_TRY(print_stats(base, encode_ms, error));
done:
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
    return kd_scene_command_run(&arguments.base, kd_cli_render_argp(), argc, argv, run);
}
