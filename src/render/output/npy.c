/* Writes a frame's layers as numbers: kd_format_npy. The file is one NumPy array of the shape (height, width). Each
 * element is a record with a float32 field for each word of image.layers, in the order of these words. A field is one
 * number, NaN if undefined. The field "rgb" is three numbers, linear sRGB in units of the disk's largest surface
 * brightness at g = 1. */
#include "render/output/format.h"

#include "image/npy.h"
#include "render/output/numbers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct kd_npy array_of(const struct kd_frame *frame, const struct kd_numbers *numbers)
{
    struct kd_npy array = { .n_fields = numbers->n, .shape = { frame->height, frame->width }, .n_dimensions = 2 };
    for (size_t i = 0; i < numbers->n; i++) {
        const uint32_t channels = numbers->at[i].layer->channels;
        array.fields[i] = (struct kd_npy_field) { .type = KD_NPY_F4, .count = channels > 1 ? channels : 0 };
        snprintf(array.fields[i].name, KD_NPY_NAME, "%.*s", KD_NPY_NAME - 1, numbers->at[i].name);
    }
    return array;
}

/* Writes a row of pixels, each with the numbers of all layers. */
static void interleave(const struct kd_numbers *numbers, size_t first, size_t width, float *to)
{
    for (size_t x = first; x < first + width; x++)
        for (size_t i = 0; i < numbers->n; i++) {
            const struct kd_layer *layer = numbers->at[i].layer;
            for (uint32_t c = 0; c < layer->channels; c++)
                *to++ = ((const float *)layer->data)[x * layer->channels + c];
        }
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    struct kd_numbers numbers;
    (void)effort, (void)memory;
    if (kd_numbers_of(picture, &numbers, error))
        return KD_EINVAL;
    const struct kd_npy array = array_of(frame, &numbers);
    size_t row = frame->width * kd_npy_item_size(&array);
    float *values = malloc(row);
    enum kd_status status = values ? kd_npy_write_header(&array, out) : KD_ENOMEM;
    for (size_t y = 0; y < frame->height && !status; y++) {
        interleave(&numbers, y * frame->width, frame->width, values);
        status = kd_buffer_append(out, values, row);
    }
    free(values);
    return status ? kd_error_set(error, status, "out of memory for %zu bytes of numbers", row * frame->height) : KD_OK;
}

const struct kd_format kd_format_npy = {
    .name = "npy",
    .media_type = KD_NPY_TYPE,
    .magic = "\x93NUMPY",
    .carries = KD_CARRIES_LAYERS,
    .encode = encode,
};
