/* Writes JPEG: 8-bit RGB pictures of moving views and of web pages, for which size matters more than the last bit of
 * a pixel. Any thread.
 *
 * Chroma subsampling depends on the quality and was chosen by measurement (docs/decisions/0004-live-png.md). Below
 * KD_JPEG_FULL_COLOUR colours have half the width and height (4:2:0); from there on they have full size (4:4:4).
 * Below KD_JPEG_THRIFTY the Huffman tables are optimised for the picture, which saves 5 to 12 % of the bytes and
 * takes twice the time.
 *
 * Strips of at least 256 Ki pixels are encoded separately, on as many cores as are idle, as restart intervals of one
 * scan. These intervals do not change the decoded pixels. Below KD_JPEG_THRIFTY, and for smaller pictures, there is
 * one strip and no restart interval. */
#ifndef KD_IMAGE_JPEG_H
#define KD_IMAGE_JPEG_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdint.h>

#define KD_JPEG_SIDE_MAX 65500 /* limit of libjpeg for width and height, in pixels */

enum { KD_JPEG_FULL_COLOUR = 88, KD_JPEG_THRIFTY = 70 };

/* Appends one JFIF file. quality: 1 to 100, as in libjpeg. pixels: rows from the top, three bytes per pixel, no
 * padding. Returns KD_EINVAL if quality is outside 1 to 100, or if a side is outside 1 to KD_JPEG_SIDE_MAX;
 * KD_ENOMEM. On error out->size is unchanged. */
enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error);

/* Maximum length of an XMP packet. A segment has at most 65535 bytes, which include its length and the name of the
 * namespace (XMP Specification Part 3, 1.1.3). */
#define KD_JPEG_XMP_MAX 65502

/* Appends a copy of a file from kd_jpeg_encode, with an XMP packet. KD_ETOOBIG if the packet exceeds
 * KD_JPEG_XMP_MAX; KD_ENOMEM. On error out->size is unchanged. */
enum kd_status kd_jpeg_add_xmp(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                               struct kd_error *error);

/* Finds the XMP packet of a JPEG. Returns NULL if there is none, or if the data are not a JPEG. *length: size of the
 * packet in bytes. */
const void *kd_jpeg_xmp(const void *data, size_t size, size_t *length);

#endif
