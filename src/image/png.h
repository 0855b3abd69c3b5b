/* Reads and writes PNG files: 8- or 16-bit RGB, sRGB, with text chunks. Any thread. libpng reads files and writes
 * everything except the pixels, which are encoded on as many cores as are idle (png_strips.h).
 *
 * Pixels are stored in rows from the top, with three channels and no padding; 16-bit samples are uint16_t in native
 * byte order. */
#ifndef KD_IMAGE_PNG_H
#define KD_IMAGE_PNG_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

struct kd_png_text { const char *key, *value; }; /* value in UTF-8; the chunk is iTXt if tEXt cannot hold the value */

struct kd_png_params {
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
    /* Level of libdeflate, 0 to 8. 0: the data are stored; 1: fastest; from 2 on, the best filter is chosen for each
     * row. A file is as large as with zlib at the same level, but takes a third of the time. */
    int compression;
    const void *pixels;
    const struct kd_png_text *text;
    size_t n_text;
};
enum kd_status kd_png_encode(const struct kd_png_params *params, struct kd_buffer *out, struct kd_error *error);

/* A decoded picture. It is RGB, whatever the type in the file is. Free with kd_png_finish. Limits: 32768 pixels for
 * width and height, 1 MiB of text. */
struct kd_png {
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
    void *pixels;
    struct kd_png_text *text;
    size_t n_text;
};
enum kd_status kd_png_decode(const void *data, size_t size, struct kd_png *out, struct kd_error *error);

/* Reads the header of a PNG file without decoding the pixels. Returns KD_EINVAL in three cases: the chunks are
 * incomplete or do not end with the file; libpng rejects the header; the file is too small for its number of pixels.
 * Invalid pixels are found only by decoding. */
struct kd_png_about {
    uint32_t width, height;
    int bit_depth, channels; /* bit_depth: as in the file, 1, 2, 4, 8 or 16; channels: 1 to 4; a palette has 1 */
};
enum kd_status kd_png_look(const void *data, size_t size, struct kd_png_about *out, struct kd_error *error);

/* returns NULL if there is no text with this key */
const char *kd_png_text_find(const struct kd_png *png, const char *key);
void kd_png_finish(struct kd_png *png);

#endif
