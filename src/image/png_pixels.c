#include "image/png_pixels.h"

#include "image/png_filter.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

static size_t step_of(const struct kd_png_params *p) { return 3 * ((size_t)p->bit_depth / 8); }

size_t kd_png_filtered_bytes(const struct kd_png_params *p) { return (p->width * step_of(p) + 1) * p->height; }

/* Samples of 16 bits stand with the larger byte first. */
static void copy_row(const struct kd_png_params *p, uint32_t y, size_t stride, uint8_t *to)
{
    const uint8_t *from = (const uint8_t *)p->pixels + y * stride;
    if (p->bit_depth == 8) {
        memcpy(to, from, stride);
        return;
    }
    for (size_t i = 0; i < stride / 2; i++) {
        uint16_t sample;
        memcpy(&sample, from + 2 * i, 2);
        to[2 * i] = (uint8_t)(sample >> 8);
        to[2 * i + 1] = (uint8_t)sample;
    }
}

/* room: two rows, the first of them zeros, and what the filters need. Filters cost more than they gain at the lowest
 * levels. */
static void filter(const struct kd_png_params *p, uint8_t *to, uint8_t *room)
{
    const size_t stride = p->width * step_of(p);
    uint8_t *above = room, *row = room + stride;
    for (uint32_t y = 0; y < p->height; y++, to += stride + 1) {
        copy_row(p, y, stride, row);
        if (p->compression > 1) {
            kd_png_filter_least(to, row, above, stride, step_of(p), room + 2 * stride);
        } else if (p->compression == 1) {
            kd_png_filter_sub(to, row, stride, step_of(p));
        } else {
            to[0] = 0;
            memcpy(to + 1, row, stride);
        }
        uint8_t *last = above;
        above = row;
        row = last;
    }
}

enum kd_status kd_png_pixels(const struct kd_png_params *p, struct kd_buffer *out)
{
    const size_t stride = p->width * step_of(p), size = kd_png_filtered_bytes(p);
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(p->compression);
    const size_t bound = compressor ? libdeflate_zlib_compress_bound(compressor, size) : 0;
    uint8_t *rows = malloc(size), *room = calloc(7, stride), *packed = malloc(bound ? bound : 1);
    enum kd_status status = compressor && rows && room && packed ? KD_OK : KD_ENOMEM;
    if (!status) {
        filter(p, rows, room);
        status = kd_buffer_append(out, packed, libdeflate_zlib_compress(compressor, rows, size, packed, bound));
    }
    libdeflate_free_compressor(compressor);
    free(packed);
    free(room);
    free(rows);
    return status;
}
