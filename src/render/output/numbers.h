/* The layers of a frame as numbers, in the order of image.layers, for files of numbers. Any thread. */
#ifndef KD_RENDER_OUTPUT_NUMBERS_H
#define KD_RENDER_OUTPUT_NUMBERS_H

#include "render/output/format.h"
#include "render/plan/layer_kinds.h"

struct kd_numbers {
    struct kd_number_layer {
        char name[KD_LAYER_NAME]; /* the word in image.layers: "rgb", "g", "r_1" */
        const char *unit;         /* "M"; "": dimensionless */
        /* the layer "rgb" has three channels: linear sRGB in units of the disk's largest surface brightness at g = 1 */
        const struct kd_layer *layer;
    } at[KD_WORDS_MOST];
    size_t n;
};

/* Collects the layers. Returns KD_EINVAL if the frame was rendered without them. */
enum kd_status kd_numbers_of(const struct kd_picture *picture, struct kd_numbers *out, struct kd_error *error);

#endif
