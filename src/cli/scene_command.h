/* The part that all commands that render a scene share: their arguments, and the steps from parsing these to the
 * exit code. Main thread only.
 *
 *     struct arguments { struct kd_scene_command base; ... };    base comes first, and is initialised to 0
 *
 *     static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
 *     {
 *         enum kd_status status;
 *         KD_TRY(kd_scene_command_load(base, error));
 *         KD_TRY(kd_file_check(base->output, error));
 *         KD_TRY(kd_scene_command_open(base, error));
 *         KD_TRY(kd_scene_command_draw(base, &kd_format_png, error));
 *         ...
 *     done:
 *         return status;
 *     }
 *
 *     return kd_scene_command_run(&arguments.base, kd_cli_NAME_argp(), argc, argv, run); */
#ifndef KD_CLI_SCENE_COMMAND_H
#define KD_CLI_SCENE_COMMAND_H

#include "base/buffer.h"
#include "cli/scene_options.h"
#include "render/output/format.h"
#include "render/render.h"

struct kd_scene_command {
    struct kd_scene_options options;
    const char *device, *output; /* output: path of the option -o; NULL if it was not given */
    uint64_t memory;             /* 0: no --memory */
    bool stats;
    /* The following members are results of the steps. kd_scene_command_run frees them. */
    struct kd_scene scene;
    struct kd_assets assets;
    struct kd_renderer *renderer;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_buffer file;
    bool printed; /* true if a successful run ends by writing `file` to standard output */
    double ms;    /* render time */
};

/* Parser of the arguments above, for commands that use kd_scene_device_children. It handles -o, -t and --memory if
 * the command's table has these options. A command with more options has its own parser, which calls this one for
 * all keys that it does not handle itself. */
error_t kd_scene_command_parse(int key, char *text, struct argp_state *state);

enum kd_status kd_scene_command_load(struct kd_scene_command *command, struct kd_error *error);
/* Opens the device. Call this only after the command's assets were read. */
enum kd_status kd_scene_command_open(struct kd_scene_command *command, struct kd_error *error);
/* Plans and renders the command's scene, as kd_cli_draw does. */
enum kd_status kd_scene_command_draw(struct kd_scene_command *command, const struct kd_format *format,
                                     struct kd_error *error);
/* The rendered picture of the command's scene. */
struct kd_picture kd_scene_command_picture(const struct kd_scene_command *command);

/* Parses the arguments, runs the command and reports its error. Returns the exit code. */
int kd_scene_command_run(struct kd_scene_command *command, const struct argp *argp, int argc, char **argv,
                         enum kd_status (*run)(struct kd_scene_command *command, struct kd_error *error));

#endif
