/* sky.image is a picture of the whole sky from a PNG file. Pure; any thread.
 *
 * The file is of 8 or 16 bits a channel, sRGB whatever it says of itself, and has the axes of panorama.h. It is
 * averaged over areas to the power of two of rows that is nearest to its own, KD_SKY_IMAGE_ROWS at most: what a
 * device binds at once, and 5.3 minutes of arc a texel. White becomes 1. */
#ifndef KD_RENDER_SKY_IMAGE_H
#define KD_RENDER_SKY_IMAGE_H

#include "render/sky/panorama.h"

/* credit: what the file says in its text "Copyright", or else in "Author"; "" if neither is there. Of the bytes of
 * sky.image the error names the field: KD_EINVAL for what is no sound PNG file, twice as wide as high, of
 * KD_PANORAMA_LEAST to KD_PANORAMA_MOST rows; KD_ENOMEM. Memory for all pixels of the file, and 12 bytes a texel; of
 * 6500 x 3250 pixels it takes a second. */
#define KD_SKY_CREDIT 400
enum kd_status kd_sky_image(const void *data, size_t size, struct kd_sky_picture *out, char credit[KD_SKY_CREDIT],
                            struct kd_error *error);

#endif
