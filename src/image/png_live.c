#include "image/png_live.h"

#include "image/png_strips.h"

#include <stdlib.h>

enum { MAX_SIDE = 32768, LEVEL = 1 }; /* docs/decisions/0004-live-png.md */

struct kd_png_live { struct kd_png_strips *strips; };

enum kd_status kd_png_live_create(enum kd_deflate_engine engine, struct kd_png_live **out, struct kd_error *error)
{
    *out = NULL;
    struct kd_png_live *live = calloc(1, sizeof *live);
    if (!live)
        return kd_error_set(error, KD_ENOMEM, "out of memory for an encoder of live frames");
    enum kd_status status = kd_png_strips_create(engine, &live->strips, error);
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
    kd_png_strips_destroy(live->strips);
    free(live);
}

static void big_endian(uint8_t to[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
}

static enum kd_status put_file(struct kd_png_live *live, const struct kd_png_params *params, struct kd_buffer *out,
                               struct kd_error *error)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    uint8_t header[13] = { [8] = 8, [9] = 2 }; /* 8 bits per channel; colour type 2, RGB */
    big_endian(header, params->width);
    big_endian(header + 4, params->height);
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, signature, sizeof signature));
    KD_TRY(kd_png_chunk(out, "IHDR", header, sizeof header));
    KD_TRY(kd_png_chunk(out, "sRGB", "", 1)); /* perceptual rendering intent, as in image/png.c */
    if ((status = kd_png_strips_append(live->strips, params, out, error)))
        return status;
    KD_TRY(kd_png_chunk(out, "IEND", NULL, 0));
    return KD_OK;
done:
    return kd_error_set(error, status, "out of memory for a live PNG of %u x %u pixels", params->width, params->height);
}

enum kd_status kd_png_live_encode(struct kd_png_live *live, uint32_t width, uint32_t height, const uint8_t *pixels,
                                  struct kd_buffer *out, struct kd_error *error)
{
    if (width < 1 || width > MAX_SIDE || height < 1 || height > MAX_SIDE)
        return kd_error_set(error, KD_EINVAL, "a live PNG has %u x %u pixels; each side must be 1 to %d", width, height,
                            MAX_SIDE);
    uint64_t filtered = (3 * (uint64_t)width + 1) * height;
    if (filtered > KD_PNG_LIVE_MAX)
        return kd_error_set(error, KD_ETOOBIG,
                            "a live PNG of %u x %u pixels takes %.2f GiB uncompressed; it must be at most 1 GiB", width,
                            height, (double)filtered / (1 << 30));
    const size_t start = out->size;
    const struct kd_png_params params = {
        .width = width, .height = height, .bit_depth = 8, .compression = LEVEL, .pixels = pixels
    };
    const enum kd_status status = put_file(live, &params, out, error);
    if (status)
        out->size = start;
    return status;
}
