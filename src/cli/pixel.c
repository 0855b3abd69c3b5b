/* kerrd pixel: explains one pixel of a picture. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "cli/scene_options.h"
#include "render/explain/explain.h"

#include <string.h>

enum { KEY_AT = 256, KEY_TRACE };

struct arguments {
    struct kd_scene_options scene;
    const char *device, *at, *output, *format;
    uint64_t memory;
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
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &arguments->scene;
        state->child_inputs[1] = &arguments->device;
        return 0;
    case KEY_AT: arguments->at = text; return 0;
    case KEY_TRACE: arguments->trace = true; return 0;
    case 'o': arguments->output = text; return 0;
    case 'f':
        if (strcmp(text, "text") && strcmp(text, "json"))
            argp_error(state, "--format is %s; it must be text or json", text);
        arguments->format = text;
        return 0;
    case 'M': arguments->memory = kd_cli_bytes(state, "--memory", text); return 0;
    case ARGP_KEY_END:
        if (!arguments->at)
            argp_error(state, "--at X,Y is missing; it names the pixel");
        if (!arguments->format)
            arguments->format = kd_cli_ending(state, "--output", arguments->output, KD_ENDINGS("text", "json"));
        if (arguments->trace && !wants_json(arguments))
            argp_error(state, "--trace needs JSON: --format json, or an output name that ends in .json");
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_status draw(const struct arguments *arguments, struct kd_renderer *renderer, struct kd_scene *scene,
                           struct kd_plan *plan, struct kd_frame *frame, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_progress progress;
    enum kd_status status;
    kd_renderer_capacity(renderer, &capacity);
    KD_TRY(kd_format_plan(&kd_format_pixel, scene, &capacity, plan, error));
    KD_TRY(kd_explain_at(arguments->at, plan, error));
    if (arguments->trace)
        KD_TRY(kd_explain_trace("steps", plan, error));
    KD_TRY(kd_explain_narrow(&capacity, scene, plan, error));
    kd_progress_init(&progress);
    kd_progress_catch_signals();
    status = kd_render(renderer, scene, plan, kd_progress_update, &progress, frame, error);
    kd_progress_finish(&progress);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
done:
    return status;
}

static enum kd_status run(struct arguments *arguments, struct kd_error *error)
{
    const char *path = arguments->output ? arguments->output : "-";
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_renderer *renderer = NULL;
    struct kd_buffer text = { 0 };
    enum kd_status status;
    KD_TRY(kd_scene_options_load(&arguments->scene, &scene, error));
    if (strcmp(path, "-"))
        KD_TRY(kd_file_check(path, error));
    const struct kd_assets assets = kd_asset_options_assets(&arguments->scene.assets);
    KD_TRY(kd_renderer_create(&(struct kd_renderer_params) { .device = arguments->device,
                                                             .memory_bytes = arguments->memory,
                                                             .assets = &assets },
                              &renderer, error));
    KD_TRY(draw(arguments, renderer, &scene, &plan, &frame, error));
    const struct kd_picture picture = { &frame, &scene, &plan, kd_renderer_device_name(renderer), 0 };
    KD_TRY(wants_json(arguments) ? kd_encode(&kd_format_pixel, &picture, KD_EFFORT_KEEP, NULL, &text, error)
                                 : kd_explain_text(&picture, &text, error));
    KD_TRY(kd_file_write(path, &text, error));
done:
    kd_buffer_finish(&text);
    kd_frame_finish(&frame);
    kd_renderer_destroy(renderer);
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
    struct kd_error error = { 0 };

    argp_parse(kd_cli_pixel_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = run(&arguments, &error);
    kd_scene_options_finish(&arguments.scene);
    return kd_progress_exit(status, &error);
}
