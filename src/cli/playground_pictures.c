#include "cli/playground_pictures.h"

#include "cli/cli.h"
#include "cli/draw.h"
#include "cli/file.h"
#include "playground/show.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Finds the only %d in a path. The %d may have a width. Returns NULL if there is none, or if the path contains
 * another conversion of printf. */
static const char *number_in(const char *path, int *length)
{
    const char *at = strchr(path, '%'), *end = at;
    if (!at || strchr(at + 1, '%'))
        return NULL;
    end += 1 + strspn(at + 1, "0123456789");
    if (*end != 'd' || end - at > 4)
        return NULL;
    *length = (int)(end - at) + 1;
    return at;
}

enum kd_status kd_pictures_check(const struct kd_pictures_asked *asked, struct kd_error *error)
{
    int length;
    const char *idle = asked->every > 0        ? "--every"
                       : asked->scene.document ? "--scene"
                       : asked->scene.preset   ? "--scene-preset"
                       : asked->scene.n_set    ? "--scene-set and --size"
                       : asked->stats          ? "--stats"
                       : asked->memory         ? "--memory"
                                               : NULL;
    if (!asked->path)
        return idle ? kd_error_set(error, KD_EINVAL, "--picture FILE is missing; it is needed by %s", idle) : KD_OK;
    if (asked->every > 0 && !number_in(asked->path, &length))
        return kd_error_set(error, KD_EINVAL,
                            "--picture is \"%s\"; with --every it must contain one %%d, as in film/%%05d.png",
                            asked->path);
    return KD_OK;
}

/* Loads the scene. If no scene is given, uses one with the playground's hole. */
static enum kd_status load(struct kd_pictures_asked *asked, const char *view, const struct kd_playground *p,
                           struct kd_scene *out, struct kd_error *error)
{
    enum kd_status status;
    if (asked->scene.document || asked->scene.preset)
        return kd_scene_options_load(&asked->scene, out, error);
    kd_scene_defaults(out);
    KD_HOLE_COPY(&out->spacetime, &p->params);
    status = view ? kd_scene_from_json(out, view, strlen(view), error) : kd_playground_widen(p, out, error);
    return status ? status : kd_scene_options_merge(&asked->scene, out, error);
}

/* Makes the name of the next picture. */
static void name_of(const struct kd_pictures *p, char out[4096])
{
    int length;
    const char *at = p->asked->every > 0 ? number_in(p->asked->path, &length) : NULL;
    if (!at) {
        snprintf(out, 4096, "%s", p->asked->path);
        return;
    }
    /* numbers are padded with zeros even if the width has no leading 0 */
    const int width = atoi(at + 1);
    snprintf(out, 4096, "%.*s%0*u%s", (int)(at - p->asked->path), p->asked->path, width, p->made, at + length);
}

enum kd_status kd_pictures_begin(struct kd_pictures_asked *asked, const char *view, const struct kd_playground *p,
                                 struct kd_pictures *out, struct kd_error *error)
{
    char first[4096];
    enum kd_status status;
    *out = (struct kd_pictures) { .asked = asked };
    out->format = asked->format;
    name_of(out, first);
    KD_TRY(kd_file_check(first, error));
    KD_TRY(load(asked, view, p, &out->scene, error));
    KD_TRY(kd_playground_may_show(p, &out->scene, error));
    out->assets = kd_asset_options_assets(&asked->scene.assets);
    KD_TRY(kd_renderer_create(
        &(struct kd_renderer_params) { .device = asked->device, .memory_bytes = asked->memory, .assets = &out->assets },
        &out->renderer, error));
done:
    return status;
}

static enum kd_status render(struct kd_pictures *p, struct kd_scene *scene, struct kd_buffer *file,
                             struct kd_error *error)
{
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    double ms = 0;
    enum kd_status status = kd_cli_draw(p->renderer, p->format, scene, &plan, &frame, &ms, error);
    p->ms += ms;
    KD_TRY(status);
    const struct kd_picture picture = { &frame, scene, &plan, kd_renderer_device_name(p->renderer), p->made };
    KD_TRY(kd_encode(p->format, &picture, KD_EFFORT_KEEP, &p->encoder, file, error));
done:
    kd_frame_finish(&frame);
    return status;
}

enum kd_status kd_pictures_take(struct kd_pictures *pictures, struct kd_playground *p, struct kd_error *error)
{
    struct kd_dynamic_bodies *dynamic = NULL;
    struct kd_buffer file = { 0 };
    struct kd_scene scene = pictures->scene;
    char path[4096];
    enum kd_status status;
    KD_TRY(kd_playground_show_named(p, &dynamic, error));
    kd_scene_show(&scene, dynamic);
    kd_scene_pass(&scene, p->t);
    KD_TRY(kd_scene_validate(&scene, error));
    KD_TRY(render(pictures, &scene, &file, error));
    name_of(pictures, path);
    KD_TRY(kd_file_write(path, &file, error));
    pictures->made++;
done:
    kd_dynamic_bodies_release(dynamic);
    kd_buffer_finish(&file);
    return status;
}

void kd_pictures_finish(struct kd_pictures *pictures)
{
    if (pictures->asked && pictures->asked->stats && pictures->made)
        fprintf(stderr, "{\"pictures\":%u,\"render_s\":%.3f}\n", pictures->made, 1e-3 * pictures->ms);
    kd_encoder_finish(&pictures->encoder);
    kd_renderer_destroy(pictures->renderer);
    *pictures = (struct kd_pictures) { 0 };
}
