/* Converts a picture to sixel by libsixel. */
#include "cli/show.h"

#include "image/png.h"

#include <sixel.h>
#include <stdlib.h>
#include <string.h>

enum { COLOURS = 256 };

/* Converts pixels to 8 bits for each channel. */
static unsigned char *bytes_of(const struct kd_png *png)
{
    const size_t n = (size_t)png->width * png->height * 3;
    const uint16_t *wide = png->pixels;
    unsigned char *bytes = malloc(n);
    for (size_t i = 0; bytes && png->bit_depth == 16 && i < n; i++)
        bytes[i] = (unsigned char)((wide[i] * 255u + 32767) / 65535);
    if (bytes && png->bit_depth != 16)
        memcpy(bytes, png->pixels, n);
    return bytes;
}

/* Scales the pixels and frees `from`. Returns NULL when out of memory. */
static unsigned char *scaled(unsigned char *from, const struct kd_png *png, uint32_t width, uint32_t height)
{
    if (!from || (width == png->width && height == png->height))
        return from;
    unsigned char *to = malloc((size_t)width * height * 3);
    if (to &&
        SIXEL_FAILED(sixel_helper_scale_image(to, from, (int)png->width, (int)png->height, SIXEL_PIXELFORMAT_RGB888,
                                              (int)width, (int)height, SIXEL_RES_BILINEAR, NULL))) {
        free(to);
        to = NULL;
    }
    free(from);
    return to;
}

static int take(char *data, int size, void *user) { return kd_buffer_append(user, data, (size_t)size) ? -1 : size; }

enum kd_status kd_show_sixel(const struct kd_buffer *file, uint32_t width, uint32_t height, struct kd_buffer *out,
                             struct kd_error *error)
{
    struct kd_png png;
    sixel_dither_t *dither = NULL;
    sixel_output_t *output = NULL;
    enum kd_status status = kd_png_decode(file->data, file->size, &png, error);
    if (status)
        return status;
    unsigned char *pixels = scaled(bytes_of(&png), &png, width, height);
    SIXELSTATUS failed = pixels ? sixel_dither_new(&dither, COLOURS, NULL) : SIXEL_BAD_ALLOCATION;
    if (!SIXEL_FAILED(failed))
        failed = sixel_dither_initialize(dither, pixels, (int)width, (int)height, SIXEL_PIXELFORMAT_RGB888,
                                         SIXEL_LARGE_AUTO, SIXEL_REP_AUTO, SIXEL_QUALITY_HIGH);
    if (!SIXEL_FAILED(failed))
        failed = sixel_output_new(&output, take, out, NULL);
    if (!SIXEL_FAILED(failed))
        failed = sixel_encode(pixels, (int)width, (int)height, 3, dither, output);
    if (SIXEL_FAILED(failed))
        status = failed == SIXEL_BAD_ALLOCATION
                     ? kd_error_set(error, KD_ENOMEM, "out of memory for a picture of %u x %u pixels", width, height)
                     : kd_error_set(error, KD_EIO, "libsixel cannot encode the picture: %s",
                                    sixel_helper_format_error(failed));
    if (output)
        sixel_output_unref(output);
    if (dither)
        sixel_dither_unref(dither);
    free(pixels);
    kd_png_finish(&png);
    return status;
}
