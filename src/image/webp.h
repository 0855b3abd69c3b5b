/* Writes WebP: lossy pictures for web pages, 8-bit RGB, by libwebp. Any thread. At the same visible quality, a file
 * is about a third smaller than a JPEG. Colours always have half the width and height (4:2:0). */
#ifndef KD_IMAGE_WEBP_H
#define KD_IMAGE_WEBP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdint.h>

#define KD_WEBP_SIDE_MAX 16383 /* pixels; the format has 14 bits for a side */

/* Appends one file. quality: 1 to 100. pixels: rows from the top, three bytes a pixel, no padding. Memory during
 * the call: kd_webp_bytes. Returns KD_EINVAL if quality is outside 1 to 100 or a side is outside 1 to
 * KD_WEBP_SIDE_MAX, KD_ETOOBIG if the picture has more detail than the format can hold at this quality, KD_ENOMEM. On
 * error out->size is unchanged. */
enum kd_status kd_webp_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error);

/* Upper bound of the memory of kd_webp_encode, including the file. The worst case is noise at quality 100. Up to 16
 * Mi pixels libwebp keeps tokens, which take 28 bytes a pixel for noise. A larger picture is encoded without tokens
 * and takes 3.3 bytes a pixel. */
uint64_t kd_webp_bytes(uint32_t width, uint32_t height);

/* Appends a WebP of kd_webp_encode with an XMP packet. KD_ENOMEM; on error out->size is unchanged. */
enum kd_status kd_webp_add_xmp(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                               struct kd_error *error);

/* Appends the XMP packet of a file. KD_EINVAL if the file is not a WebP file or has no packet; KD_ENOMEM. */
enum kd_status kd_webp_xmp(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error);

#endif
