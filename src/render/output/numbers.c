#include "render/output/numbers.h"

enum kd_status kd_numbers_of(const struct kd_picture *picture, struct kd_numbers *out, struct kd_error *error)
{
    const struct kd_words *words = &picture->scene->image.layers;
    *out = (struct kd_numbers) { .n = (size_t)words->count };
    for (size_t i = 0; i < out->n; i++) {
        struct kd_number_layer *to = &out->at[i];
        const struct kd_plan_layer layer = { words->at[i].word, words->at[i].number };
        kd_layer_name(layer, to->name);
        to->unit = kd_layer_kinds[layer.kind].unit;
        to->layer = kd_frame_layer(picture->frame, layer.kind == KD_LAYER_rgb ? "radiance" : to->name);
        if (!to->layer)
            return kd_error_set(error, KD_EINVAL, "the frame lacks a layer that image.layers names");
    }
    return KD_OK;
}
