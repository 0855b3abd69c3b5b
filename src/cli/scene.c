/* kerrd scene and kerrd presets: print the scene that would be rendered, without a device. */
#include "cli/cli.h"
#include "cli/scene_options.h"

#include <stdbool.h>
#include <stdio.h>

struct arguments {
    struct kd_scene_options scene;
    bool hash;
};

static const struct argp_option scene_table[] = {
    { "hash", 'H', NULL, 0, "print the SHA-256 of the scene instead of the scene", 0 },
    { 0 },
};

static error_t parse_scene(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    (void)text;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &arguments->scene; return 0;
    case 'H': arguments->hash = true; return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_status print_scene(const struct kd_scene *scene, bool hash, struct kd_buffer *out)
{
    char digits[65];
    if (!hash)
        return kd_scene_to_json(scene, out);
    enum kd_status status = kd_scene_hash(scene, digits);
    return status ? status : kd_buffer_printf(out, "%s", digits);
}

const struct argp *kd_cli_scene_argp(void)
{
    static const struct argp_child children[] = { { &kd_scene_options_argp, 0, NULL, 0 },
                                                  { &kd_cli_log_argp, 0, NULL, 0 },
                                                  { 0 } };
    static const struct argp argp = {
        .options = scene_table,
        .parser = parse_scene,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Print the merged scene in canonical form, with every field.",
        .children = children,
    };
    return &argp;
}

int kd_cli_scene(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    struct kd_scene scene;
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };

    argp_parse(kd_cli_scene_argp(), argc, argv, 0, NULL, &arguments);
    enum kd_status status = kd_scene_options_load(&arguments.scene, &scene, &error);
    kd_scene_options_finish(&arguments.scene);
    if (status)
        return kd_cli_fail(&error);
    status = print_scene(&scene, arguments.hash, &out);
    if (!status)
        status = kd_buffer_printf(&out, "\n");
    if (status)
        kd_error_set(&error, status, "cannot print the scene: %s", kd_status_name(status));
    int code = status ? kd_cli_fail(&error) : kd_cli_print(out.data, out.size);
    kd_buffer_finish(&out);
    return code;
}

static error_t parse_presets(int key, char *text, struct argp_state *state)
{
    if (key != ARGP_KEY_ARG)
        return ARGP_ERR_UNKNOWN;
    argp_error(state, "%s cannot be used, because the command takes no argument", text);
    return 0;
}

const struct argp *kd_cli_presets_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 0 }, { 0 } };
    static const struct argp argp = {
        .parser = parse_presets,
        .doc = "List the presets: scenes that have a name.",
        .children = children,
    };
    return &argp;
}

int kd_cli_presets(int argc, char **argv)
{
    argp_parse(kd_cli_presets_argp(), argc, argv, 0, NULL, NULL);
    /* The text is complete before anything is written, so that a write error is reported as such. */
    struct kd_buffer out = { 0 };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < kd_scene_preset_count() && !status; i++)
        status = kd_buffer_printf(&out, "%-16s %s\n", kd_scene_preset_name(i), kd_scene_preset_title(i));
    struct kd_error error = { .status = status, .message = "out of memory" };
    const int code = status ? kd_cli_fail(&error) : kd_cli_print(out.data, out.size);
    kd_buffer_finish(&out);
    return code;
}
