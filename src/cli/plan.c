/* kerrd plan: estimates what a scene costs on this device. */
#include "cli/cli.h"
#include "cli/scene_command.h"
#include "render/output/cost.h"

#include <math.h>
#include <stdlib.h>

struct arguments {
    struct kd_scene_command base;
    const char **axes;
    size_t n_axes;
};

static const struct argp_option table[] = {
    { "axis", 'x', "FIELD=VALUES", 0,
      "an axis of a sweep, as for kerrd sweep; the answer is the total of all its scenes", 0 },
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (key == 'x') {
        kd_cli_add_axis(&arguments->axes, &arguments->n_axes, text, state);
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

static enum kd_status plan_sweep(struct kd_scene_command *base, const struct kd_capacity *capacity,
                                 struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    struct kd_sweep *sweep = NULL;
    struct kd_cost cost = { 0 };
    enum kd_status status;
    KD_TRY(kd_sweep_typed(arguments->axes, arguments->n_axes, &base->scene, &base->assets, &sweep, error));
    KD_TRY(kd_asset_options_check(&base->options.assets, error));
    KD_TRY(kd_cost_sweep(&cost, NULL, sweep, capacity, INFINITY, error));
    if (kd_cost_json(&cost, sweep, &base->file) || kd_buffer_printf(&base->file, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the plan"));
done:
    kd_cost_finish(&cost);
    kd_sweep_free(sweep);
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    struct kd_capacity capacity;
    enum kd_status status;
    const bool sweeps = ((struct arguments *)base)->n_axes > 0;
    base->options.assets.later = sweeps;
    KD_TRY(kd_scene_command_load(base, error));
    KD_TRY(kd_scene_command_open(base, error));
    kd_renderer_capacity(base->renderer, &capacity);
    if (sweeps)
        return plan_sweep(base, &capacity, error);
    KD_TRY(kd_plan_make(&base->scene, &capacity, &base->plan, error));
    if (kd_plan_to_json(&base->plan, &base->file) || kd_buffer_printf(&base->file, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the plan"));
done:
    return status;
}

const struct argp *kd_cli_plan_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Print the cost of rendering a scene: passes, rays, bytes, estimated time, approximations.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_plan(int argc, char **argv)
{
    struct arguments arguments = { .base.printed = true };
    const int code = kd_scene_command_run(&arguments.base, kd_cli_plan_argp(), argc, argv, run);
    free(arguments.axes);
    return code;
}
