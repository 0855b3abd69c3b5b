#include "render/output/format.h"

#include <stdio.h>
#include <string.h>

const struct kd_format *kd_format_named(const char *name)
{
    for (size_t i = 0; i < kd_n_formats; i++)
        if (!strcmp(kd_formats[i]->name, name))
            return kd_formats[i];
    return NULL;
}

const struct kd_format *kd_format_of_bytes(const void *data, size_t size)
{
    for (size_t i = 0; i < kd_n_formats; i++) {
        size_t n = strlen(kd_formats[i]->magic);
        if (n && size >= n && !memcmp(data, kd_formats[i]->magic, n))
            return kd_formats[i];
    }
    return NULL;
}

const struct kd_format *kd_format_live(void)
{
    size_t i = 0;
    while (i + 1 < kd_n_formats && !kd_formats[i]->live)
        i++;
    return kd_formats[i];
}

/* The file of a picture holds a single layer: the picture itself, or one map. */
static enum kd_status check_layers(const struct kd_format *format, const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->image.layers.count <= 1 || format->carries & KD_CARRIES_LAYERS)
        return KD_OK;
    return kd_error_field(
        error, "/image/layers",
        "image.layers has %d layers; for a file of the format %s it must have one; fits, exr, npz and npy take several",
        scene->image.layers.count, format->name);
}

/* Adapts the scene to the format, and checks that the format can hold the scene's layers. */
static enum kd_status adapt(const struct kd_format *format, struct kd_scene *scene, struct kd_error *error)
{
    const unsigned shows = KD_CARRIES_PICTURE | KD_CARRIES_LAYERS;
    /* true if the file records the setting of the exposure, as a part of the requested scene */
    const bool told = format->carries & shows && format->scene;
    if (!(format->carries & KD_CARRIES_PICTURE) && !told && isinf(scene->style.exposure))
        scene->style.exposure = 0;
    if (!(format->carries & shows))
        scene->image.layers = (struct kd_words) { 1, { { KD_LAYER_rgb, -1 } } };
    enum kd_status status = format->draws ? format->draws(scene, error) : KD_OK;
    return status ? status : check_layers(format, scene, error);
}

enum kd_status kd_format_holds(const struct kd_format *format, const struct kd_scene *scene, struct kd_error *error)
{
    struct kd_scene adapted = *scene;
    return adapt(format, &adapted, error);
}

enum kd_status kd_format_plan(const struct kd_format *format, struct kd_scene *scene,
                              const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    enum kd_status status = adapt(format, scene, error);
    if (status)
        return status;
    struct kd_needs needs = kd_needs_of(scene);
    needs.light |= (format->carries & KD_CARRIES_LIGHT) != 0;
    needs.no_image = format->carries == KD_CARRIES_LIGHT;
    needs.radiance = (format->carries & KD_CARRIES_LAYERS) != 0;
    KD_TRY(kd_plan_make_for(scene, &needs, capacity, out, error));
    if (format->bytes) {
        const uint64_t encoder = format->bytes(out->picture.width, kd_plan_shown_height(&out->picture));
        KD_TRY(kd_plan_has_room(out, encoder, capacity, error));
        out->cost.host_bytes += encoder;
    }
done:
    return status;
}

/* Names the formats that hold a scene. */
static enum kd_status refuse_file(struct kd_error *error)
{
    char names[64] = "";
    size_t end = 0, left = 0;
    for (size_t i = 0; i < kd_n_formats; i++)
        left += kd_formats[i]->scene != NULL;
    for (size_t i = 0; i < kd_n_formats && end < sizeof names; i++)
        if (kd_formats[i]->scene)
            end += (size_t)snprintf(names + end, sizeof names - end, "%s%s", kd_formats[i]->name,
                                    --left > 1 ? ", "
                                    : left     ? " or "
                                               : "");
    return kd_error_set(error, KD_EINVAL, "the file must be one that kerrd wrote as %s; only these contain their scene",
                        names);
}

enum kd_status kd_format_scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    const struct kd_format *format = kd_format_of_bytes(data, size);
    if (!format)
        return refuse_file(error);
    if (!format->scene)
        return kd_error_set(error, KD_EINVAL, "files of the format %s contain no scene", format->name);
    return format->scene(data, size, out, error);
}

enum kd_status kd_encode(const struct kd_format *format, const struct kd_picture *picture, enum kd_effort effort,
                         struct kd_encoder *encoder, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_encoder once = { 0 }, *e = encoder ? encoder : &once;
    if (e->of != format)
        kd_encoder_finish(e);
    e->of = format;
    enum kd_status status = format->encode(picture, effort, &e->memory, out, error);
    kd_encoder_finish(&once);
    return status;
}

void kd_encoder_finish(struct kd_encoder *encoder)
{
    if (encoder->memory && encoder->of->forget)
        encoder->of->forget(encoder->memory);
    *encoder = (struct kd_encoder) { 0 };
}
