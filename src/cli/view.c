/* kerrd view: shows a scene or an existing picture in the terminal. */
#include "cli/cli.h"
#include "cli/file.h"
#include "cli/scene_command.h"
#include "cli/show.h"
#include "cli/terminal.h"
#include "image/png.h"
#include "scene/difference.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define PICTURE_MAX ((size_t)1 << 30)

enum { KEY_PROTOCOL = 256, KEY_ENLARGE };
enum protocol { ASKED, KITTY, SIXEL };

struct arguments {
    struct kd_scene_command base;
    enum protocol protocol;
    bool enlarge;
};

static const struct argp_option table[] = {
    { "protocol", KEY_PROTOCOL, "kitty|sixel", 0,
      "protocol of the picture, even if standard output is not a terminal (default: kerrd queries the terminal)", 0 },
    { "enlarge", KEY_ENLARGE, NULL, 0, "enlarge a smaller picture to the size of the terminal", 0 },
    KD_CLI_MEMORY,
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    switch (key) {
    case KEY_PROTOCOL:
        if (strcmp(text, "kitty") && strcmp(text, "sixel"))
            argp_error(state, "--protocol is %s; it must be kitty or sixel", text);
        arguments->protocol = *text == 'k' ? KITTY : SIXEL;
        return 0;
    case KEY_ENLARGE: arguments->enlarge = true; return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

static enum kd_status choose(const struct arguments *arguments, const struct kd_terminal *terminal, enum protocol *out,
                             struct kd_error *error)
{
    static const char remedy[] = "`kerrd render -o FILE.png` writes the picture to a file; --protocol kitty or "
                                 "--protocol sixel sends it nevertheless";
    *out = arguments->protocol ? arguments->protocol : terminal->kitty ? KITTY : SIXEL;
    if (arguments->protocol || terminal->kitty || terminal->sixel)
        return KD_OK;
    if (!terminal->is)
        return kd_error_set(error, KD_EIO, "standard output is not a terminal: %s", remedy);
    return kd_error_set(error, KD_EIO, "this terminal%s supports neither kitty's graphics nor sixel: %s",
                        getenv("TMUX") ? ", or the tmux in front of it," : "", remedy);
}

/* Reads the document if it is a picture that kerrd has made. Otherwise *picture stays empty, and the document is
 * read later, together with the options of the scene. */
static enum kd_status look(const struct arguments *arguments, struct kd_buffer *picture, struct kd_scene *scene,
                           struct kd_error *error)
{
    const struct kd_scene_options *options = &arguments->base.options;
    struct stat about;
    enum kd_status status;
    if (!options->document || !strcmp(options->document, "-") || stat(options->document, &about) ||
        !S_ISREG(about.st_mode)) /* a pipe can be read only once, so it is left for later */
        return KD_OK;
    KD_TRY(kd_file_read(options->document, PICTURE_MAX, picture, error));
    if (!picture->size || kd_format_of_bytes(picture->data, picture->size) != &kd_format_png) {
        kd_buffer_finish(picture);
        return KD_OK;
    }
    if (options->preset || options->n_set || options->assets.n)
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            "%s is a picture and is shown unchanged; to change its scene, give it with --from",
                            options->document));
    status = kd_format_scene(picture->data, picture->size, scene, error);
    if (status)
        kd_cli_prefix(error, options->document);
done:
    return status;
}

static enum kd_status show(const struct kd_buffer *png, enum protocol protocol, const struct kd_terminal *terminal,
                           uint32_t lines, bool enlarge, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_png_about about;
    enum kd_status status;
    KD_TRY(kd_png_look(png->data, png->size, &about, error));
    uint32_t width = about.width, height = about.height, columns = 0;
    kd_terminal_fit(terminal, lines, enlarge, &width, &height);
    if (width != about.width && terminal->columns)
        columns = (uint32_t)((uint64_t)width * terminal->columns / terminal->width);
    KD_TRY(protocol == KITTY ? kd_show_kitty(png, columns, out, error) : kd_show_sixel(png, width, height, out, error));
    if (kd_buffer_printf(out, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the picture"));
done:
    return status;
}

/* Shows the picture unchanged, followed by a line about its scene. */
static enum kd_status show_picture(const struct arguments *arguments, const struct kd_buffer *png,
                                   const struct kd_scene *scene, struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_terminal terminal = kd_terminal_ask();
    enum protocol protocol;
    enum kd_status status;
    KD_TRY(choose(arguments, &terminal, &protocol, error));
    KD_TRY(show(png, protocol, &terminal, 2, arguments->enlarge, out, error));
    if (kd_buffer_printf(out, "%s, %d x %d: ", arguments->base.options.document, scene->image.width,
                         scene->image.height) ||
        kd_scene_line(scene, out) || kd_buffer_printf(out, "\n"))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the scene"));
done:
    return status;
}

/* Renders the scene at the size that fits in the terminal. */
static enum kd_status show_scene(struct kd_scene_command *base, struct kd_buffer *png, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    const struct kd_terminal terminal = kd_terminal_ask();
    struct kd_scene *scene = &base->scene;
    enum protocol protocol;
    enum kd_status status;
    KD_TRY(choose(arguments, &terminal, &protocol, error));
    uint32_t width = (uint32_t)scene->image.width, height = (uint32_t)scene->image.height;
    kd_terminal_fit(&terminal, 1, arguments->enlarge, &width, &height);
    scene->image.width = (int32_t)width;
    scene->image.height = (int32_t)height;
    if (kd_scene_has_tile(scene))
        KD_TRY(kd_error_field(error, "/image/tile/width",
                              "image.tile.width is %d; it must be 0, because kerrd view shows whole pictures",
                              scene->tile.width));
    KD_TRY(kd_scene_validate(scene, error));
    KD_TRY(kd_scene_command_open(base, error));
    KD_TRY(kd_scene_command_draw(base, &kd_format_png, error));
    const struct kd_picture picture = kd_scene_command_picture(base);
    KD_TRY(kd_encode(&kd_format_png, &picture, KD_EFFORT_KEEP, NULL, png, error));
    KD_TRY(show(png, protocol, &terminal, 1, false, &base->file, error));
done:
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    const struct arguments *arguments = (struct arguments *)base;
    struct kd_buffer png = { 0 };
    enum kd_status status;
    kd_scene_defaults(&base->scene);
    KD_TRY(look(arguments, &png, &base->scene, error));
    if (!png.size)
        KD_TRY(kd_scene_command_load(base, error));
    KD_TRY(png.size ? show_picture(arguments, &png, &base->scene, &base->file, error) : show_scene(base, &png, error));
done:
    kd_buffer_finish(&png);
    return status;
}

const struct argp *kd_cli_view_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = "[SCENE.json|PICTURE.png|-]",
        .doc = "Show a scene in the terminal, rendered at a size that fits; or a picture that kerrd has made, and its "
               "scene in one line.\vkerrd queries the terminal for kitty's graphics and sixel. A terminal without both "
               "cannot show a picture: `kerrd render -o FILE.png` writes a file instead. tmux and screen pass no kitty "
               "graphics, and sixel only if they support it. A picture is never larger than image.width and "
               "image.height, unless --enlarge is given. The scene is merged as for `kerrd render`.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_view(int argc, char **argv)
{
    struct arguments arguments = { .base.printed = true };
    return kd_scene_command_run(&arguments.base, kd_cli_view_argp(), argc, argv, run);
}
