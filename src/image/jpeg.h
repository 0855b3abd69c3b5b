/* Writes JPEG: 8-bit RGB pictures of moving views, for which size matters more than the last bit of a pixel. Files that
 * are kept are PNG. Any thread.
 *
 * Chroma subsampling depends on the quality and was chosen by measurement (docs/decisions/0004-live-png.md): below
 * KD_JPEG_FULL_COLOUR half width and height (4:2:0), from there on none (4:4:4). Below KD_JPEG_THRIFTY Huffman tables
 * are optimised for the picture, for 5 to 12 % fewer bytes in twice the time.
 *
 * Strips of at least 256 Ki pixels are encoded separately, on as many cores as are idle, as restart intervals of one
 * scan: the decoded pixels are those of a scan without intervals. Below KD_JPEG_THRIFTY, and for smaller pictures,
 * there is one strip and no interval. */
#ifndef KD_IMAGE_JPEG_H
#define KD_IMAGE_JPEG_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdint.h>

enum { KD_JPEG_FULL_COLOUR = 88, KD_JPEG_THRIFTY = 70 };

/* Appends one JFIF file. quality: 1 to 100, as in libjpeg. pixels: rows from the top, three bytes a pixel, no
 * padding. KD_EINVAL for another quality, or a side outside 1 to 65500 pixels; KD_ENOMEM; on error out->size is
 * unchanged. */
enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error);

#endif
