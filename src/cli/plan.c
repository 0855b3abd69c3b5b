/* kerrd plan: cost of a scene on this device. */
#include "cli/cli.h"
#include "cli/scene_options.h"
#include "render/output/cost.h"
#include "render/render.h"

#include <math.h>
#include <stdlib.h>

struct arguments {
    struct kd_scene_options scene;
    const char *device, **axes;
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
    if (key != ARGP_KEY_INIT)
        return ARGP_ERR_UNKNOWN;
    state->child_inputs[0] = &arguments->scene;
    state->child_inputs[1] = &arguments->device;
    return 0;
}

static enum kd_status plan_sweep(struct arguments *arguments, const struct kd_scene *scene,
                                 const struct kd_capacity *capacity, struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_assets assets = kd_asset_options_assets(&arguments->scene.assets);
    struct kd_sweep *sweep = NULL;
    struct kd_cost cost = { 0 };
    enum kd_status status;
    KD_TRY(kd_sweep_typed(arguments->axes, arguments->n_axes, scene, &assets, &sweep, error));
    KD_TRY(kd_asset_options_check(&arguments->scene.assets, error));
    KD_TRY(kd_cost_sweep(&cost, NULL, sweep, capacity, INFINITY, error));
    if (kd_cost_json(&cost, sweep, out) || kd_buffer_printf(out, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the plan"));
done:
    kd_cost_finish(&cost);
    kd_sweep_free(sweep);
    return status;
}

static enum kd_status plan_scene(struct arguments *arguments, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_renderer *renderer = NULL;
    enum kd_status status;
    arguments->scene.assets.later = arguments->n_axes > 0;
    KD_TRY(kd_scene_options_load(&arguments->scene, &scene, error));
    KD_TRY(kd_renderer_create(&(struct kd_renderer_params) { .device = arguments->device }, &renderer, error));
    kd_renderer_capacity(renderer, &capacity);
    if (arguments->n_axes) {
        status = plan_sweep(arguments, &scene, &capacity, out, error);
        goto done;
    }
    KD_TRY(kd_plan_make(&scene, &capacity, &plan, error));
    if (kd_plan_to_json(&plan, out) || kd_buffer_printf(out, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the plan"));
done:
    kd_renderer_destroy(renderer); /* the renderer owns the accuracy table in the capacity */
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
    struct arguments arguments = { 0 };
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_plan_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = plan_scene(&arguments, &out, &error);
    kd_scene_options_finish(&arguments.scene);
    free(arguments.axes);
    int code = status ? kd_cli_fail(&error) : kd_cli_print(out.data, out.size);
    kd_buffer_finish(&out);
    return code;
}
