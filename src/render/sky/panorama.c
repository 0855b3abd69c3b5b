#include "render/sky/panorama.h"

#include <math.h>
#include <stdlib.h>

void kd_sky_picture_finish(struct kd_sky_picture *picture)
{
    free(picture->texels);
    *picture = (struct kd_sky_picture) { 0 };
}

enum { BIAS = 15, BITS = 9, LARGEST = (1 << BITS) - 1 };

uint32_t kd_panorama_pack(const float rgb[3])
{
    float most = fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
    int exponent = 0;
    if (!(most > 0x1p-25f))
        return 0;
    frexpf(fminf(most, 65000), &exponent); /* most < 2^exponent */
    if (lrintf(ldexpf(fminf(most, 65000), BITS - exponent)) > LARGEST)
        exponent++;
    exponent = exponent > -BIAS ? exponent : -BIAS;
    uint32_t word = (uint32_t)(exponent + BIAS) << (3 * BITS);
    for (int c = 0; c < 3; c++)
        word |= (uint32_t)lrintf(ldexpf(fminf(fmaxf(rgb[c], 0), 65000), BITS - exponent)) << (c * BITS);
    return word;
}

void kd_panorama_unpack(uint32_t word, float rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = ldexpf((float)(word >> (c * BITS) & LARGEST), (int)(word >> (3 * BITS)) - BIAS - BITS);
}

/* Each texel becomes the mean of four. */
static void halve(struct kd_sky_picture *p)
{
    const uint32_t width = p->width / 2, height = p->height / 2;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                const float *a = &p->texels[3 * ((size_t)2 * y * p->width + 2 * x) + (size_t)c], *b = a + 3 * (size_t)p->width;
                p->texels[3 * ((size_t)y * width + x) + (size_t)c] = 0.25f * (a[0] + a[3] + b[0] + b[3]);
            }
    p->width = width;
    p->height = height;
}

void kd_panorama_fill(struct kd_sky_picture *p, uint32_t *words)
{
    for (; p->height >= 2; halve(p))
        for (size_t i = 0, n = (size_t)p->width * p->height; i < n; i++)
            *words++ = kd_panorama_pack(&p->texels[3 * i]);
}
