#include "render/sky/panorama.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void kd_sky_picture_finish(struct kd_sky_picture *picture)
{
    free(picture->texels);
    *picture = (struct kd_sky_picture) { 0 };
}

enum { BIAS = 15, BITS = 9, LARGEST = (1 << BITS) - 1 };

static float larger(float a, float b) { return a > b ? a : b; }
static float smaller(float a, float b) { return a < b ? a : b; }

static uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* 2^exponent; the result must not be denormal. */
static float power(int exponent)
{
    const uint32_t bits = (uint32_t)(exponent + 127) << 23;
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Rounds x, which is at least 0 and below 2^22, to the nearest whole number. The addition makes the float larger
 * than 2^23, where floats have no fraction bits. */
static uint32_t rounded(float x) { return bits_of(x + 0x1p23f) & 0x7fffff; }

/* Written without frexpf, ldexpf and lrintf, because these are function calls and there are millions of texels. */
uint32_t kd_panorama_pack(const float rgb[3])
{
    float most = smaller(larger(larger(rgb[0], rgb[1]), rgb[2]), 65000);
    if (!(most > 0x1p-25f))
        return 0;
    int exponent = (int)(bits_of(most) >> 23) - 126; /* most < 2^exponent */
    exponent += rounded(most * power(BITS - exponent)) > LARGEST;
    exponent = exponent > -BIAS ? exponent : -BIAS;
    const float scale = power(BITS - exponent);
    uint32_t word = (uint32_t)(exponent + BIAS) << (3 * BITS);
    for (int c = 0; c < 3; c++)
        word |= rounded(scale * smaller(larger(rgb[c], 0), 65000)) << (c * BITS);
    return word;
}

void kd_panorama_unpack(uint32_t word, float rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = ldexpf((float)(word >> (c * BITS) & LARGEST), (int)(word >> (3 * BITS)) - BIAS - BITS);
}

/* Halves both sides; each texel becomes the mean of four. */
static void halve(struct kd_sky_picture *p)
{
    const uint32_t width = p->width / 2, height = p->height / 2;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                const float *a = &p->texels[3 * ((size_t)2 * y * p->width + 2 * x) + (size_t)c],
                            *b = a + 3 * (size_t)p->width;
                p->texels[3 * ((size_t)y * width + x) + (size_t)c] = 0.25f * (a[0] + a[3] + b[0] + b[3]);
            }
    p->width = width;
    p->height = height;
}

/* Replaces each texel of a row by the mean over `over` texels about it, where `over` is less than the row's length.
 * The texels at both ends of the averaged range are weighted by the fraction that lies inside the range. The row is
 * periodic. */
static void spread_row(float *row, uint32_t n, double over, double *sums)
{
    for (int c = 0; c < 3; c++) {
        sums[0] = 0;
        for (uint32_t x = 0; x < 3 * n; x++) /* three periods, so that windows at the ends need no special case */
            sums[x + 1] = sums[x] + row[3 * (x % n) + (uint32_t)c];
        for (uint32_t x = 0; x < n; x++) {
            double ends[2];
            for (int k = 0; k < 2; k++) {
                const double at = n + x + 0.5 + (k - 0.5) * over;
                const uint32_t whole = (uint32_t)at;
                ends[k] = sums[whole] + (at - whole) * (sums[whole + 1] - sums[whole]);
            }
            row[3 * x + (uint32_t)c] = (float)fmax((ends[1] - ends[0]) / over, 0);
        }
    }
}

static void even_out(struct kd_sky_picture *p, double *sums)
{
    for (uint32_t y = 0; y < p->height; y++)
        spread_row(&p->texels[3 * (size_t)y * p->width], p->width, 1 / sin(M_PI * (y + 0.5) / p->height), sums);
}

enum kd_status kd_panorama_fill(struct kd_sky_picture *p, uint32_t *words, struct kd_error *error)
{
    double *sums = p->even ? malloc((3 * (size_t)p->width + 2) * sizeof *sums) : NULL;
    if (p->even && !sums)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a panorama");
    for (; p->height >= 2; halve(p)) {
        if (p->even)
            even_out(p, sums);
        for (size_t i = 0, n = (size_t)p->width * p->height; i < n; i++)
            *words++ = kd_panorama_pack(&p->texels[3 * i]);
    }
    free(sums);
    return KD_OK;
}
