/* Writes JPEG: 8-bit RGB pictures that move, where bytes count more than the last bit of a pixel. What is kept
 * is PNG. Any thread.
 *
 * Sampling of colour, by measurement (docs/decisions/0004-live-png.md): below KD_JPEG_FULL_COLOUR at half width and
 * height (4:2:0), from there on at every pixel (4:4:4). Below KD_JPEG_THRIFTY Huffman's tables are made for the
 * picture: 5 to 12 % fewer bytes for twice the time.
 *
 * Strips of 256 Ki pixels and more are encoded apart, on as many cores as are idle, as restart intervals of one scan:
 * the pixels that a decoder makes are those of a scan without. Below KD_JPEG_THRIFTY, and where the picture is smaller
 * than that, there is one strip and no interval. */
#ifndef KD_IMAGE_JPEG_H
#define KD_IMAGE_JPEG_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdint.h>

enum { KD_JPEG_FULL_COLOUR = 88, KD_JPEG_THRIFTY = 70 };

/* Append one JFIF file. quality: 1 to 100, as libjpeg has it. pixels: rows from the top, three bytes a pixel, no
 * padding. KD_EINVAL for another quality, or for a side outside 1 to 65500 pixels, KD_ENOMEM; on error out->size is
 * as it was. */
enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error);

#endif
