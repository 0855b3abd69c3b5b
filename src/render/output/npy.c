/* This writes a frame's layers as numbers: kd_format_npy. One NumPy array of the shape (height, width) whose elements are records with a field for
 * each word of image.layers, in its order, float32: a number, NaN where there is none, or of "rgb" three, linear sRGB in units of the
 * brightest surface brightness of the disk at g = 1. */
#include "render/output/format.h"

#include "image/npy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The layer of each word, in their order. */
static size_t layers_of(const struct kd_picture *picture, const struct kd_layer *out[KD_WORDS_MOST])
{
    const struct kd_words *words = &picture->scene->image.layers;
    for (int i = 0; i < words->count; i++) {
        const struct kd_plan_layer layer = { words->at[i].word, words->at[i].number };
        char name[KD_LAYER_NAME];
        kd_layer_name(layer, name);
        out[i] = kd_frame_layer(picture->frame, layer.kind == KD_LAYER_rgb ? "radiance" : name);
    }
    return (size_t)words->count;
}

static struct kd_npy array_of(const struct kd_frame *frame, const struct kd_layer *const *layers, size_t n)
{
    struct kd_npy array = { .n_fields = n, .shape = { frame->height, frame->width }, .n_dimensions = 2 };
    for (size_t i = 0; i < n; i++) {
        array.fields[i] = (struct kd_npy_field) { .type = KD_NPY_F4, .count = layers[i]->channels > 1 ? layers[i]->channels : 0 };
        snprintf(array.fields[i].name, KD_NPY_NAME, "%.*s", KD_NPY_NAME - 1, layers[i]->channels > 1 ? "rgb" : layers[i]->name);
    }
    return array;
}

/* A row of pixels, each the numbers of all layers. */
static void interleave(const struct kd_layer *const *layers, size_t n, size_t first, size_t width, float *to)
{
    for (size_t x = first; x < first + width; x++)
        for (size_t i = 0; i < n; i++)
            for (uint32_t c = 0; c < layers[i]->channels; c++)
                *to++ = ((const float *)layers[i]->data)[x * layers[i]->channels + c];
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory, struct kd_buffer *out,
                             struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    const struct kd_layer *layers[KD_WORDS_MOST] = { NULL };
    size_t n = layers_of(picture, layers);
    (void)effort, (void)memory;
    for (size_t i = 0; i < n; i++)
        if (!layers[i])
            return kd_error_set(error, KD_EINVAL, "the frame has not all layers that image.layers names");
    const struct kd_npy array = array_of(frame, layers, n);
    size_t row = frame->width * kd_npy_item_size(&array);
    float *numbers = malloc(row);
    enum kd_status status = numbers ? kd_npy_write_header(&array, out) : KD_ENOMEM;
    for (size_t y = 0; y < frame->height && !status; y++) {
        interleave(layers, n, y * frame->width, frame->width, numbers);
        status = kd_buffer_append(out, numbers, row);
    }
    free(numbers);
    return status ? kd_error_set(error, status, "out of memory for %zu bytes of numbers", row * frame->height) : KD_OK;
}

const struct kd_format kd_format_npy = {
    .name = "npy", .media_type = "application/x-npy", .magic = "\x93NUMPY", .carries = KD_CARRIES_LAYERS, .encode = encode,
};
