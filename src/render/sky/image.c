#include "render/sky/image.h"

#include "image/png.h"
#include "scene/asset.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* IEC 61966-2-1: linear light of each sample value. */
static void linearise(float *curve, uint32_t samples)
{
    for (uint32_t i = 0; i < samples; i++) {
        double v = i / (double)(samples - 1);
        curve[i] = (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
}

static uint32_t sample(const struct kd_png *png, size_t at)
{
    return png->bit_depth == 16 ? ((const uint16_t *)png->pixels)[at] : ((const uint8_t *)png->pixels)[at];
}

/* A texel of the target covers [from, end) of the source. Returns the length of source pixel k within this range. */
static double part(double from, double end, uint32_t k) { return fmin(end, k + 1.0) - fmax(from, k); }

/* One row of the file, averaged over areas to the width of the target. */
static void narrow_row(const struct kd_png *png, const float *curve, uint32_t y, uint32_t width, double *out)
{
    const double ratio = png->width / (double)width;
    const size_t row = (size_t)3 * y * png->width;
    for (uint32_t x = 0; x < width; x++) {
        const double from = x * ratio, end = fmin(from + ratio, png->width);
        double sum[3] = { 0 };
        for (uint32_t k = (uint32_t)from; k < end; k++) {
            const double share = part(from, end, k);
            for (uint32_t c = 0; c < 3; c++)
                sum[c] += share * curve[sample(png, row + 3 * k + c)];
        }
        for (int c = 0; c < 3; c++)
            out[3 * x + (uint32_t)c] = sum[c] / ratio;
    }
}

/* Averages the file over areas to the target. line, sum: scratch for one row of the target each. */
static void average(const struct kd_png *png, const float *curve, const struct kd_sky_picture *out, double *line,
                    double *sum)
{
    const double ratio = png->height / (double)out->height;
    const size_t n = (size_t)3 * out->width;
    for (uint32_t y = 0; y < out->height; y++) {
        const double from = y * ratio, end = fmin(from + ratio, png->height);
        memset(sum, 0, n * sizeof *sum);
        for (uint32_t k = (uint32_t)from; k < end; k++) {
            const double share = part(from, end, k);
            narrow_row(png, curve, k, out->width, line);
            for (size_t i = 0; i < n; i++)
                sum[i] += share * line[i];
        }
        for (size_t i = 0; i < n; i++)
            out->texels[y * n + i] = (float)(sum[i] / ratio);
    }
}

static uint32_t rows_for(uint32_t height)
{
    uint32_t rows = KD_PANORAMA_LEAST;
    while (rows < KD_SKY_IMAGE_ROWS && 4 * rows < 3 * height)
        rows *= 2;
    return rows;
}

static enum kd_status convert(const struct kd_png *png, struct kd_sky_picture *out, struct kd_error *error)
{
    const uint32_t rows = rows_for(png->height), samples = 1u << png->bit_depth;
    float *curve = malloc(samples * sizeof *curve), *texels = malloc(3 * sizeof *texels * 2 * rows * rows);
    double *lines = malloc(2 * 3 * sizeof *lines * 2 * rows);
    const bool good = curve && texels && lines;
    if (good) {
        *out = (struct kd_sky_picture) { 2 * rows, rows, texels, true };
        linearise(curve, samples);
        average(png, curve, out, lines, lines + 3 * 2 * (size_t)rows);
    }
    free(curve);
    free(lines);
    if (good)
        return KD_OK;
    free(texels);
    return kd_error_set(error, KD_ENOMEM, "out of memory for a panorama of %u rows", rows);
}

/* Copies the author's credit from the file. */
static void take_credit(const struct kd_png *png, char credit[KD_SKY_CREDIT])
{
    const char *text = kd_png_text_find(png, "Copyright");
    text = text ? text : kd_png_text_find(png, "Author");
    credit[0] = 0;
    if (text && *text)
        kd_text_clip(credit, KD_SKY_CREDIT, text);
}

enum kd_status kd_sky_image(const void *data, size_t size, struct kd_sky_picture *out, char credit[KD_SKY_CREDIT],
                            struct kd_error *error)
{
    struct kd_png_about about;
    struct kd_png png = { 0 };
    struct kd_error why = { 0 };
    enum kd_status status;
    *out = (struct kd_sky_picture) { 0 };
    KD_TRY(kd_png_look(data, size, &about, &why)); /* reads only the size, before memory is allocated */
    if (!kd_asset_is_panorama(about.width, about.height))
        KD_TRY(kd_error_set(
            &why, KD_EINVAL,
            "a picture of %u x %u pixels; it must show the whole sky, twice as wide as high, with %d to %d rows",
            about.width, about.height, KD_PANORAMA_LEAST, KD_PANORAMA_MOST));
    KD_TRY(kd_png_decode(data, size, &png, &why));
    KD_TRY(convert(&png, out, &why));
    take_credit(&png, credit);
done:
    kd_png_finish(&png);
    if (status == KD_EINVAL)
        return kd_error_field(error, "/sky/image", "sky.image cannot be used: %s", why.message);
    return status ? kd_error_set(error, status, "%s", why.message) : KD_OK;
}
