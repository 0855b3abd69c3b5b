/* A panorama: the diffuse light of a sky as a picture in galactic coordinates. It is equirectangular, with l = 0 in
 * its middle, l growing to the left, and the galactic pole at the top. Linear light; 1 is KD_SKY_UNIT_MAG magnitudes
 * a square arcsecond. Pure; any thread.
 *
 * A panorama is stored as mips. Level k has 1/4^k of the texels of level 0, and each texel is the mean of four texels
 * of the level before. The last level has two rows. Texels are words with a shared exponent (Khronos,
 * EXT_texture_shared_exponent): nine bits a channel. Sides are powers of two, so the levels before level k have
 * together (4 - 4^(1 - k))/3 times the texels of level 0. */
#ifndef KD_RENDER_SKY_PANORAMA_H
#define KD_RENDER_SKY_PANORAMA_H

#include "base/error.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

/* The picture from which a panorama is made: three floats a texel, rows from the top. */
struct kd_sky_picture {
    uint32_t width, height;
    float *texels;
    /* Texels of a row are narrower towards the poles. If `even` is set, each level is averaged along rows over
     * 1/cos(latitude) texels, so that a row is as coarse there as at the equator. Otherwise the poles would look like
     * stars with many rays. */
    bool even;
};
void kd_sky_picture_finish(struct kd_sky_picture *picture);

/* Number of texels of all levels together. */
static inline size_t kd_panorama_words(uint32_t width, uint32_t height)
{
    size_t sum = 0;
    for (; height >= 2; width /= 2, height /= 2)
        sum += (size_t)width * height;
    return sum;
}
/* Makes all levels. The picture's texels are averaged in place. The only error is KD_ENOMEM. */
enum kd_status kd_panorama_fill(struct kd_sky_picture *picture, uint32_t *words, struct kd_error *error);

uint32_t kd_panorama_pack(const float rgb[3]);
void kd_panorama_unpack(uint32_t word, float rgb[3]);

/* The procedural Milky Way (milky_way.c) of sky.seed. The only error is KD_ENOMEM. Takes some tenths of a second. */
enum { KD_MILKY_WAY_WIDTH = 2048, KD_MILKY_WAY_HEIGHT = 1024 };
enum kd_status kd_milky_way(int32_t seed, struct kd_sky_picture *out, struct kd_error *error);
/* Computes only some of the Milky Way's rows, one after the other into texels. They are identical, bit by bit, to the
 * rows of the whole picture. */
enum kd_status kd_milky_way_rows(int32_t seed, const uint32_t *rows, size_t n, float *texels, struct kd_error *error);

/* Largest number of rows of a picture of the sky after it is read (image.h). */
enum { KD_SKY_IMAGE_ROWS = 2048 };

#endif
