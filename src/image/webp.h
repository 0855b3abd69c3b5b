/* Writes WebP: lossy 8-bit RGB pictures for web pages, by libwebp. Any thread. At the same visible quality, a file
 * is about a third smaller than a JPEG. The resolution of colours is always halved in width and height (4:2:0). */
#ifndef KD_IMAGE_WEBP_H
#define KD_IMAGE_WEBP_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdint.h>

#define KD_WEBP_SIDE_MAX 16383 /* limit of width and height in pixels: the format has 14 bits for each */

/* Appends one file. quality: 1 to 100. pixels: rows from the top, three bytes per pixel, no padding. For the memory
 * of the call see kd_webp_bytes. Returns KD_EINVAL if quality is outside 1 to 100, or if width or height is outside
 * 1 to KD_WEBP_SIDE_MAX; KD_ETOOBIG if the picture has more detail than the format can hold at this quality;
 * KD_ENOMEM. On error out->size is unchanged. */
enum kd_status kd_webp_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error);

/* Upper bound of the memory that kd_webp_encode uses, including the file. The worst case is noise at quality 100. Up
 * to 16 Mi pixels libwebp stores tokens, which take 28 bytes per pixel for noise. A larger picture is encoded
 * without tokens and takes 3.3 bytes per pixel. */
uint64_t kd_webp_bytes(uint32_t width, uint32_t height);

/* Appends a copy of a file from kd_webp_encode, with an XMP packet. KD_ENOMEM; on error out->size is unchanged. */
enum kd_status kd_webp_add_xmp(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                               struct kd_error *error);

/* Appends the XMP packet of a file. KD_EINVAL if the file is not a WebP file or has no packet; KD_ENOMEM. */
enum kd_status kd_webp_xmp(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error);

#endif
