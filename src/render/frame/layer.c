#include "render/frame/frame.h"
#include "render/frame/probe.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum kd_status kd_frame_add_layer(struct kd_frame *frame, const char *name, uint32_t channels, enum kd_layer_type type,
                                  struct kd_error *error)
{
    struct kd_layer layer = { .channels = channels, .type = type };
    size_t bytes = (size_t)frame->width * frame->height * kd_layer_pixel_bytes(&layer);
    if (frame->n_layers == KD_FRAME_MAX_LAYERS)
        return kd_error_set(error, KD_ETOOBIG, "a frame has at most %d layers; there is no room for \"%s\"",
                            KD_FRAME_MAX_LAYERS, name);
    snprintf(layer.name, sizeof layer.name, "%s", name);
    layer.data = malloc(bytes);
    if (!layer.data)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu bytes of pixels", bytes);
    frame->layers[frame->n_layers++] = layer;
    return KD_OK;
}

const struct kd_layer *kd_frame_layer(const struct kd_frame *frame, const char *name)
{
    for (size_t i = 0; i < frame->n_layers; i++)
        if (!strcmp(frame->layers[i].name, name))
            return &frame->layers[i];
    return NULL;
}

void kd_frame_drop_layers(struct kd_frame *frame)
{
    for (size_t i = 0; i < frame->n_layers; i++)
        free(frame->layers[i].data);
    memset(frame->layers, 0, sizeof frame->layers);
    frame->n_layers = 0;
}

void kd_probed_destroy(struct kd_probed_pixel *told)
{
    if (told && told->steps)
        kd_rays_steps_finish(told->steps);
    if (told)
        free(told->steps), free(told->each);
    free(told);
}

void kd_frame_finish(struct kd_frame *frame)
{
    kd_frame_drop_layers(frame);
    kd_probed_destroy(frame->told);
    *frame = (struct kd_frame) { 0 };
}
