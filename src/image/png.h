/* Reads and writes PNG files: 8- or 16-bit RGB, sRGB, with text chunks. Any thread. libpng reads files and writes
 * everything except the pixels, which are encoded on as many cores as are idle (png_strips.h).
 *
 * Pixels are rows from the top, three channels, no padding; 16-bit samples are uint16_t in native byte order. */
#ifndef KD_IMAGE_PNG_H
#define KD_IMAGE_PNG_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

struct kd_png_text { const char *key, *value; }; /* UTF-8; written as iTXt if tEXt cannot hold it */

struct kd_png_params {
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
    /* Level of libdeflate, 0 to 8. 0: the data are stored; 1: fastest; from 2 on each row has its best filter. A level
     * makes files as large as zlib's at the same level, in a third of the time */
    int compression;
    const void *pixels;
    const struct kd_png_text *text;
    size_t n_text;
};
enum kd_status kd_png_encode(const struct kd_png_params *params, struct kd_buffer *out, struct kd_error *error);

/* A decoded picture. It is RGB, even if the file held another type. Free with kd_png_finish. Limits: 32768 pixels a
 * side, 1 MiB of text. */
struct kd_png {
    uint32_t width, height;
    int bit_depth; /* 8 or 16 */
    void *pixels;
    struct kd_png_text *text;
    size_t n_text;
};
enum kd_status kd_png_decode(const void *data, size_t size, struct kd_png *out, struct kd_error *error);

/* Reads the header of a PNG file without decoding its pixels. Returns KD_EINVAL in three cases: the chunks are
 * incomplete or do not end with the file, libpng rejects the header, or the file is too small for its number of
 * pixels. Invalid pixels are found only by decoding. */
struct kd_png_about {
    uint32_t width, height;
    int bit_depth, channels; /* bit_depth as in the file: 1, 2, 4, 8 or 16; channels: 1 to 4, and 1 for a palette */
};
enum kd_status kd_png_look(const void *data, size_t size, struct kd_png_about *out, struct kd_error *error);

const char *kd_png_text_find(const struct kd_png *png, const char *key); /* NULL if there is none */
void kd_png_finish(struct kd_png *png);

#endif
