/* kerrd pixel: explains one pixel of a picture. */
#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/scene_command.h"
#include "render/explain/explain.h"

#include <string.h>

enum { KEY_AT = 256, KEY_TRACE };

struct arguments {
    struct kd_scene_command base;
    const char *at, *format;
    bool trace;
};

static const struct argp_option table[] = {
    { "at", KEY_AT, "X,Y", 0, "position of the pixel, in pixels from the upper left corner of the picture (required)",
      0 },
    { "trace", KEY_TRACE, 0, 0, "include the engine's steps along the ray (JSON only)", 0 },
    { "output", 'o', "FILE", 0, "output file; .json chooses that format (default: - for standard output)", 0 },
    { "format", 'f', "text|json", 0, "format of the output, independent of its name", 0 },
    KD_CLI_MEMORY,
    { 0 },
};

static bool wants_json(const struct arguments *arguments) { return !strcmp(arguments->format, "json"); }

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case KEY_AT: arguments->at = text; return 0;
    case KEY_TRACE: arguments->trace = true; return 0;
    case 'f':
        if (strcmp(text, "text") && strcmp(text, "json"))
            argp_error(state, "--format is %s; it must be text or json", text);
        arguments->format = text;
        return 0;
    case ARGP_KEY_END:
        if (!arguments->at)
            argp_error(state, "--at X,Y is missing; it names the pixel");
        if (!arguments->format)
            arguments->format = kd_cli_ending(state, "--output", arguments->base.output, KD_ENDINGS("text", "json"));
        if (arguments->trace && !wants_json(arguments))
            argp_error(state, "--trace needs JSON: --format json, or an output name that ends in .json");
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

static enum kd_status draw(const struct arguments *arguments, struct kd_scene_command *base, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_plan *plan = &base->plan;
    enum kd_status status;
    kd_renderer_capacity(base->renderer, &capacity);
    KD_TRY(kd_format_plan(&kd_format_pixel, &base->scene, &capacity, plan, error));
    KD_TRY(kd_explain_at(arguments->at, plan, error));
    if (arguments->trace)
        KD_TRY(kd_explain_trace("steps", plan, error));
    KD_TRY(kd_explain_narrow(&capacity, &base->scene, plan, error));
    KD_TRY(kd_cli_draw_planned(base->renderer, &base->scene, plan, &base->frame, &base->ms, error));
done:
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    const char *path = base->output ? base->output : "-";
    enum kd_status status;
    KD_TRY(kd_scene_command_load(base, error));
    if (strcmp(path, "-"))
        KD_TRY(kd_file_check(path, error));
    KD_TRY(kd_scene_command_open(base, error));
    KD_TRY(draw(arguments, base, error));
    const struct kd_picture picture = kd_scene_command_picture(base);
    KD_TRY(wants_json(arguments) ? kd_encode(&kd_format_pixel, &picture, KD_EFFORT_KEEP, NULL, &base->file, error)
                                 : kd_explain_text(&picture, &base->file, error));
    KD_TRY(kd_file_write(path, &base->file, error));
done:
    return status;
}

const struct argp *kd_cli_pixel_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Explain what one pixel of a scene's picture shows: its ray, what the ray crosses and when, the light "
               "of each emitter, where the ray ends and why.\vThe scene is merged as for render.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_pixel(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    return kd_scene_command_run(&arguments.base, kd_cli_pixel_argp(), argc, argv, run);
}
