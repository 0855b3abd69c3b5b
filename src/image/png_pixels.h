/* The pixels of a PNG file as they stand in its IDAT chunks: filtered, and one zlib stream. Any thread. For png.c. */
#ifndef KD_IMAGE_PNG_PIXELS_H
#define KD_IMAGE_PNG_PIXELS_H

#include "image/png.h"

#define KD_PNG_WHOLE \
    ((size_t)16 << 20) /* bytes of filtered rows, of which there are two copies: what is larger goes through zlib row \
                          by row, without any */

size_t kd_png_filtered_bytes(const struct kd_png_params *params);

/* Appends the stream. Levels are libdeflate's: the same size as zlib's of that number in a third of the time.
 * KD_ENOMEM. */
enum kd_status kd_png_pixels(const struct kd_png_params *params, struct kd_buffer *out);

#endif
