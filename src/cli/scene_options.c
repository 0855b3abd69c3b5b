#include "cli/scene_options.h"

#include "cli/cli.h"
#include "cli/file.h"
#include "render/output/format.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PICTURE_MAX ((size_t)1 << 30)

enum { KEY_PRESET = 'p', KEY_SET = 's', KEY_FROM = 'f', KEY_SIZE = 0x2000, KEY_ASSET, KEY_TILE };

static const struct argp_option options_table[] = {
    { "preset", KEY_PRESET, "PRESET", 0, "start from a preset (`kerrd presets` lists them)", 0 },
    { "set", KEY_SET, "PATH=VALUE", 0, "set one field, as in camera.inclination_deg=60; may be repeated", 0 },
    { "size", KEY_SIZE, "WIDTHxHEIGHT", 0, "size of the picture, as in 1920x1080; sets image.width and image.height",
      0 },
    { "tile", KEY_TILE, "WIDTHxHEIGHT+LEFT+TOP", 0,
      "part of the picture to render, as in 512x512+1024+0; sets the four fields of image.tile", 0 },
    { "asset", KEY_ASSET, "NAME=FILE", 0,
      "a file that fields of the scene refer to by NAME, as in sky.image=NAME (a PNG picture) or volume.grid=NAME (a "
      "grid of matter as NPZ); may be repeated",
      0 },
    { "from", KEY_FROM, "PICTURE.png", 0, "use the scene inside a picture that kerrd made", 0 },
    { 0 },
};

bool kd_scene_options_add_set(struct kd_scene_options *options, const char *text)
{
    const char **set = realloc(options->set, (options->n_set + 1) * sizeof *set);
    if (!set)
        return false;
    options->set = set;
    options->set[options->n_set++] = text;
    return true;
}

static void add_set(struct kd_scene_options *options, const char *text, struct argp_state *state)
{
    if (!kd_scene_options_add_set(options, text))
        argp_failure(state, KD_EXIT_FAILURE, ENOMEM, "--set");
}

/* Adds "1920x1080" as two fields. `options` owns their texts. */
bool kd_scene_options_add_size(struct kd_scene_options *options, const char *text)
{
    size_t width = strspn(text, "0123456789"), height = text[width] ? strspn(text + width + 1, "0123456789") : 0;
    if (!width || !height || !strchr("xX", text[width]) || text[width + 1 + height] || width > 9 || height > 9)
        return false;
    snprintf(options->width, sizeof options->width, "image.width=%.*s", (int)width, text);
    snprintf(options->height, sizeof options->height, "image.height=%s", text + width + 1);
    return kd_scene_options_add_set(options, options->width) && kd_scene_options_add_set(options, options->height);
}

static void add_size(struct kd_scene_options *options, const char *text, struct argp_state *state)
{
    if (!kd_scene_options_add_size(options, text))
        argp_error(state, "--size is %s; it must be WIDTHxHEIGHT in pixels, as in 1920x1080", text);
}

/* Adds "512x512+1024+0" as four fields. `options` owns their texts. */
bool kd_scene_options_add_tile(struct kd_scene_options *options, const char *text)
{
    static const char *const names[] = { "width", "height", "left", "top" };
    static const char *const before[] = { "", "xX", "+", "+" };
    for (int i = 0; i < 4; i++) {
        if (i && (!*text || !strchr(before[i], *text++)))
            return false;
        const size_t digits = strspn(text, "0123456789");
        if (!digits || digits > 9)
            return false;
        snprintf(options->tile[i], sizeof options->tile[i], "image.tile.%s=%.*s", names[i], (int)digits, text);
        text += digits;
    }
    bool added = !*text;
    for (int i = 0; i < 4 && added; i++)
        added = kd_scene_options_add_set(options, options->tile[i]);
    return added;
}

static void add_tile(struct kd_scene_options *options, const char *text, struct argp_state *state)
{
    if (!kd_scene_options_add_tile(options, text))
        argp_error(state, "--tile is %s; it must be WIDTHxHEIGHT+LEFT+TOP in pixels, as in 512x512+1024+0", text);
}

static void add_asset(struct kd_scene_options *options, const char *text, struct argp_state *state)
{
    struct kd_error error;
    if (kd_asset_options_add(&options->assets, text, &error))
        argp_error(state, "%s", error.message);
}

static void check_sources(const struct kd_scene_options *options, struct argp_state *state)
{
    const bool document = options->document && !options->document_is_over;
    if (options->from && (document || options->preset))
        argp_error(state, "--from cannot be used with %s, because a picture has every field of its scene",
                   document ? "SCENE" : "--preset");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct kd_scene_options *options = state->input;
    switch (key) {
    case KEY_PRESET: options->preset = text; return 0;
    case KEY_FROM: options->from = text; return 0;
    case KEY_SIZE: add_size(options, text, state); return 0;
    case KEY_TILE: add_tile(options, text, state); return 0;
    case KEY_ASSET: add_asset(options, text, state); return 0;
    case KEY_SET:
        if (!strchr(text, '=') || text[0] == '=')
            argp_error(state, "--set is %s; it must be PATH=VALUE, as in camera.inclination_deg=60", text);
        add_set(options, text, state);
        return 0;
    case ARGP_KEY_ARG:
        if (options->document)
            argp_error(state, "%s cannot be used with %s, because the command takes one scene", text,
                       options->document);
        options->document = text;
        return 0;
    case ARGP_KEY_END: check_sources(options, state); return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

const struct argp kd_scene_options_argp = { .options = options_table, .parser = parse };
const struct argp_child kd_scene_device_children[] = {
    { &kd_scene_options_argp, 0, NULL, 0 },
    { &kd_cli_device_argp, 0, NULL, 0 },
    { &kd_cli_log_argp, 0, NULL, 0 },
    { 0 },
};

static const char *shown(const char *path) { return strcmp(path, "-") ? path : "standard input"; }

static enum kd_status merge_document(const char *path, struct kd_scene *scene, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_file_read(path, KD_SCENE_JSON_MAX, &text, error);
    if (!status) {
        const char *start = text.data ? (const char *)text.data : "";
        if (kd_format_of_bytes(start, text.size))
            status = kd_error_set(error, KD_EINVAL, "the file is a picture, not a scene: give it with --from");
        else
            status = kd_scene_from_json(scene, start, text.size, error);
        if (status)
            kd_cli_prefix(error, shown(path));
    }
    kd_buffer_finish(&text);
    return status;
}

static enum kd_status take_picture(const char *path, struct kd_scene *scene, struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    enum kd_status status = kd_file_read(path, PICTURE_MAX, &file, error);
    if (!status && (status = kd_format_scene(file.data, file.size, scene, error)))
        kd_cli_prefix(error, shown(path));
    kd_buffer_finish(&file);
    return status;
}

static enum kd_status apply_set(const char *text, struct kd_scene *scene, struct kd_error *error)
{
    const char *equals = strchr(text, '=');
    char *path = strndup(text, (size_t)(equals - text));
    if (!path)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    enum kd_status status = kd_scene_set(scene, path, equals + 1, error);
    free(path);
    return status;
}

enum kd_status kd_scene_options_set(const struct kd_scene_options *options, struct kd_scene *scene,
                                    struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < options->n_set && !status; i++)
        status = apply_set(options->set[i], scene, error);
    return status;
}

enum kd_status kd_scene_options_merge(struct kd_scene_options *options, struct kd_scene *scene, struct kd_error *error)
{
    enum kd_status status;
    if (options->document)
        KD_TRY(merge_document(options->document, scene, error));
    if (options->from)
        KD_TRY(take_picture(options->from, scene, error));
    KD_TRY(kd_scene_options_set(options, scene, error));
    KD_TRY(kd_asset_options_resolve(&options->assets, scene, error));
    KD_TRY(kd_scene_validate(scene, error));
done:
    return status;
}

enum kd_status kd_scene_options_load(struct kd_scene_options *options, struct kd_scene *out, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    kd_scene_defaults(out);
    if (options->preset)
        status = kd_scene_preset(out, options->preset, error);
    return status ? status : kd_scene_options_merge(options, out, error);
}

void kd_scene_options_finish(struct kd_scene_options *options)
{
    free(options->set);
    kd_asset_options_finish(&options->assets);
    *options = (struct kd_scene_options) { 0 };
}
