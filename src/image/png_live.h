/* Writes PNG for a live view: 8-bit RGB frames, one after another, fast rather than small. image/png.h writes files
 * with text and with 16 bits.
 *
 *     struct kd_png_live *live;
 *     if (kd_png_live_create(kd_deflate_fastest(), &live, &error)) ...
 *     for each frame:
 *         struct kd_buffer png = { 0 };
 *         if (kd_png_live_encode(live, width, height, pixels, &png, &error)) ...
 *         pass png on; its last user calls kd_buffer_finish
 *     kd_png_live_destroy(live);
 *
 * Only one thread at a time may use a struct kd_png_live, so each encoder thread needs its own. Frames may differ in
 * size. Working memory is kept between frames (png_strips.h). For the cost of a frame see bench/results,
 * *-encode.md. The file consists of IHDR, sRGB, an IDAT for each strip, and IEND. It has no text, because the
 * metadata of a live frame are sent separately. When a user saves a frame, it is rendered again as a file that
 * contains its scene (render/output/png.h). */
#ifndef KD_IMAGE_PNG_LIVE_H
#define KD_IMAGE_PNG_LIVE_H

#include "base/buffer.h"
#include "base/error.h"
#include "image/deflate.h"

#include <stdint.h>

#define KD_PNG_LIVE_MAX ((size_t)1 << 30) /* limit of the size of all filtered rows, in bytes */

struct kd_png_live;
enum kd_status kd_png_live_create(enum kd_deflate_engine engine, struct kd_png_live **out, struct kd_error *error);
void kd_png_live_destroy(struct kd_png_live *live); /* accepts NULL */

/* Appends one file. pixels: rows from the top, three bytes per pixel, no padding, as in a kd_frame of 8 bits.
 * Returns KD_EINVAL if width or height is outside 1 to 32768 pixels, KD_ETOOBIG if the filtered rows exceed
 * KD_PNG_LIVE_MAX, or KD_ENOMEM. On error out->size is unchanged, and the next frame may be encoded. */
enum kd_status kd_png_live_encode(struct kd_png_live *live, uint32_t width, uint32_t height, const uint8_t *pixels,
                                  struct kd_buffer *out, struct kd_error *error);

#endif
