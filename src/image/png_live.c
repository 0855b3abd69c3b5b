#include "image/png_live.h"

#include "image/png_filter.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

/* Chunks and filters: PNG specification, third edition (W3C 2025), sections 5, 9 and 11. */

enum { MAX_SIDE = 32768, CHUNK_HEAD = 8 };

struct kd_png_live {
    struct kd_deflate *deflate;
    uint8_t *rows; /* filtered */
    size_t room;
};

enum kd_status kd_png_live_create(enum kd_deflate_engine engine, struct kd_png_live **out, struct kd_error *error)
{
    *out = NULL;
    struct kd_png_live *live = calloc(1, sizeof *live);
    if (!live)
        return kd_error_set(error, KD_ENOMEM, "out of memory for an encoder of live frames");
    enum kd_status status = kd_deflate_create(engine, &live->deflate, error);
    if (status)
        kd_png_live_destroy(live);
    else
        *out = live;
    return status;
}

void kd_png_live_destroy(struct kd_png_live *live)
{
    if (!live)
        return;
    kd_deflate_destroy(live->deflate);
    free(live->rows);
    free(live);
}

/* This filter makes kerrd's pictures smallest, among those whose cost is nothing beside deflate's
 * (docs/decisions/0004-live-png.md). */
static void filter_rows(uint8_t *restrict to, const uint8_t *restrict pixels, size_t stride, uint32_t height)
{
    for (uint32_t y = 0; y < height; y++, to += stride + 1, pixels += stride)
        kd_png_filter_sub(to, pixels, stride, 3);
}

static void big_endian(uint8_t to[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
}

static enum kd_status chunk_open(struct kd_buffer *out, const char type[5])
{
    uint8_t head[CHUNK_HEAD] = { 0 };
    memcpy(head + 4, type, 4);
    return kd_buffer_append(out, head, sizeof head);
}

/* The chunk that was opened at `start` ends here: its length goes in front, its checksum behind. */
static enum kd_status chunk_close(struct kd_buffer *out, size_t start)
{
    uint8_t sum[4];
    size_t length = out->size - start - CHUNK_HEAD;
    big_endian(out->data + start, (uint32_t)length);
    big_endian(sum, libdeflate_crc32(0, out->data + start + 4, length + 4));
    return kd_buffer_append(out, sum, sizeof sum);
}

static enum kd_status put_chunk(struct kd_buffer *out, const char type[5], const void *data, size_t size)
{
    size_t start = out->size;
    enum kd_status status;
    KD_TRY(chunk_open(out, type));
    KD_TRY(kd_buffer_append(out, data, size));
    KD_TRY(chunk_close(out, start));
done:
    return status;
}

static enum kd_status put_pixels(struct kd_png_live *live, size_t filtered, struct kd_buffer *out)
{
    size_t start = out->size;
    enum kd_status status;
    KD_TRY(chunk_open(out, "IDAT"));
    KD_TRY(kd_deflate_append(live->deflate, live->rows, filtered, out));
    KD_TRY(chunk_close(out, start));
done:
    return status;
}

static enum kd_status put_file(struct kd_png_live *live, uint32_t width, uint32_t height, size_t filtered,
                               struct kd_buffer *out)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    uint8_t header[13] = { [8] = 8, [9] = 2 }; /* bits a channel; RGB */
    big_endian(header, width);
    big_endian(header + 4, height);
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, signature, sizeof signature));
    KD_TRY(put_chunk(out, "IHDR", header, sizeof header));
    KD_TRY(put_chunk(out, "sRGB", "", 1)); /* perceptual, as image/png.c */
    KD_TRY(put_pixels(live, filtered, out));
    KD_TRY(put_chunk(out, "IEND", NULL, 0));
done:
    return status;
}

static enum kd_status make_room(struct kd_png_live *live, size_t size)
{
    if (size <= live->room)
        return KD_OK;
    free(live->rows); /* what it held is of no use: no copy, as realloc would make */
    live->rows = malloc(size);
    live->room = live->rows ? size : 0;
    return live->rows ? KD_OK : KD_ENOMEM;
}

enum kd_status kd_png_live_encode(struct kd_png_live *live, uint32_t width, uint32_t height, const uint8_t *pixels,
                                  struct kd_buffer *out, struct kd_error *error)
{
    if (width < 1 || width > MAX_SIDE || height < 1 || height > MAX_SIDE)
        return kd_error_set(error, KD_EINVAL, "a live PNG of %u x %u pixels: each side is 1 to %d", width, height,
                            MAX_SIDE);
    uint64_t filtered = (3 * (uint64_t)width + 1) * height;
    if (filtered > KD_DEFLATE_MAX) /* so that the IDAT chunk stays below its 2 GiB whatever the pixels are */
        return kd_error_set(error, KD_ETOOBIG, "a live PNG of %u x %u pixels takes %.2f GiB uncompressed, at most 1",
                            width, height, (double)filtered / (1 << 30));
    size_t start = out->size;
    enum kd_status status = make_room(live, (size_t)filtered);
    if (!status) {
        filter_rows(live->rows, pixels, (size_t)width * 3, height);
        status = put_file(live, width, height, (size_t)filtered, out);
    }
    if (status) {
        out->size = start;
        kd_error_set(error, status, "out of memory for a live PNG of %u x %u pixels", width, height);
    }
    return status;
}
