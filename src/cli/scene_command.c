#include "cli/scene_command.h"

#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/progress.h"

error_t kd_scene_command_parse(int key, char *text, struct argp_state *state)
{
    struct kd_scene_command *command = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &command->options;
        state->child_inputs[1] = &command->device;
        return 0;
    case 'o': command->output = text; return 0;
    case 't': command->stats = true; return 0;
    case 'M': command->memory = kd_cli_bytes(state, "--memory", text); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

enum kd_status kd_scene_command_load(struct kd_scene_command *command, struct kd_error *error)
{
    return kd_scene_options_load(&command->options, &command->scene, error);
}

enum kd_status kd_scene_command_open(struct kd_scene_command *command, struct kd_error *error)
{
    command->assets = kd_asset_options_assets(&command->options.assets);
    return kd_renderer_create(&(struct kd_renderer_params) { .device = command->device,
                                                             .memory_bytes = command->memory,
                                                             .assets = &command->assets },
                              &command->renderer, error);
}

enum kd_status kd_scene_command_draw(struct kd_scene_command *command, const struct kd_format *format,
                                     struct kd_error *error)
{
    return kd_cli_draw(command->renderer, format, &command->scene, &command->plan, &command->frame, &command->ms,
                       error);
}

struct kd_picture kd_scene_command_picture(const struct kd_scene_command *command)
{
    return (struct kd_picture) { &command->frame, &command->scene, &command->plan,
                                 kd_renderer_device_name(command->renderer), 0 };
}

int kd_scene_command_run(struct kd_scene_command *command, const struct argp *argp, int argc, char **argv,
                         enum kd_status (*run)(struct kd_scene_command *command, struct kd_error *error))
{
    struct kd_error error = { 0 };
    argp_parse(argp, argc, argv, 0, NULL, command);
    const enum kd_status status = run(command, &error);
    kd_frame_finish(&command->frame);
    kd_renderer_destroy(command->renderer);
    kd_scene_options_finish(&command->options);
    const int code = command->printed && !status ? kd_cli_print(command->file.data, command->file.size)
                                                 : kd_progress_exit(status, &error);
    kd_buffer_finish(&command->file);
    return code;
}
