/* Layers of a frame, each with one value or a few for every pixel. The first layer is "rgb", the displayed picture; if
 * a single map is requested, "rgb" shows that map in false colour. Further layers may be "radiance" and maps by their
 * names (plan/layer_kinds.h). "radiance" is linear sRGB in units of the disk's largest surface brightness at g = 1; for
 * light of one frequency, emit/radio.h has the unit. In maps NaN means no value. */
#ifndef KD_RENDER_FRAME_LAYER_H
#define KD_RENDER_FRAME_LAYER_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

#define KD_FRAME_MAX_LAYERS 18 /* the picture, its linear light, and as many maps as image.layers may have */

struct kd_layer {
    char name[40];
    uint32_t channels;
    enum kd_layer_type { KD_LAYER_U8, KD_LAYER_U16, KD_LAYER_F32 } type;
    void *data; /* rows from the top, channels of a pixel adjacent, no padding, native byte order; malloc'd */
};

static inline size_t kd_layer_pixel_bytes(const struct kd_layer *layer)
{
    static const size_t sizes[] = { [KD_LAYER_U8] = 1, [KD_LAYER_U16] = 2, [KD_LAYER_F32] = 4 };
    return layer->channels * sizes[layer->type];
}

struct kd_frame;
/* Adds a layer of the frame's size; its data is not set. The only error is KD_ENOMEM. */
enum kd_status kd_frame_add_layer(struct kd_frame *frame, const char *name, uint32_t channels, enum kd_layer_type type,
                                  struct kd_error *error);
const struct kd_layer *kd_frame_layer(const struct kd_frame *frame,
                                      const char *name); /* returns NULL if there is no layer of that name */
void kd_frame_drop_layers(struct kd_frame *frame);       /* frees the layers and nothing else */

#endif
