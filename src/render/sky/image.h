/* Reads sky.image, a picture of the whole sky in a PNG file. Pure; any thread.
 *
 * The file has 8 or 16 bits a channel and the axes of panorama.h. It is taken as sRGB, whatever it declares. The
 * picture is resampled by area averages. The number of rows becomes the nearest power of two, at most
 * KD_SKY_IMAGE_ROWS, because a device cannot bind more at once. A texel then covers 5.3 minutes of arc. White becomes
 * 1. */
#ifndef KD_RENDER_SKY_IMAGE_H
#define KD_RENDER_SKY_IMAGE_H

#include "render/sky/panorama.h"

/* credit: the file's text "Copyright"; if the file has none, its text "Author"; "" if the file has neither. Errors
 * name the field sky.image. Returns KD_ENOMEM, or KD_EINVAL unless the bytes are a valid PNG file, twice as wide as
 * high, of KD_PANORAMA_LEAST to KD_PANORAMA_MOST rows. Needs memory for all pixels of the file, and 12 bytes a texel;
 * 6500 x 3250 pixels take a second. */
#define KD_SKY_CREDIT 400
enum kd_status kd_sky_image(const void *data, size_t size, struct kd_sky_picture *out, char credit[KD_SKY_CREDIT],
                            struct kd_error *error);

#endif
