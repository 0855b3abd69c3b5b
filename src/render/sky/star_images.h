/* Where a lens map puts stars: for each star the places in a picture whose rays end at it. Pure; any thread.
 *
 * Neighbouring rays make triangles, of which the map takes each to one of the sky; a star within that has an image within this, at the same
 * barycentric coordinates. A triangle with a side of more than KD_IMAGES_COARSE of sky, next to the critical curve, has no images: there, as
 * in pictures (comp/star_search.comp), pixels are too coarse to tell. */
#ifndef KD_RENDER_SKY_STAR_IMAGES_H
#define KD_RENDER_SKY_STAR_IMAGES_H

#include "base/error.h"
#include "render/sky/frame.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_IMAGES_COARSE 0.15 /* rad */

/* Where the rays of a picture end, one a pixel, rows from the top, radians; a NaN is a ray that does not escape. */
struct kd_sky_places {
    uint32_t width, height;
    const float *theta, *phi;
    double azimuth; /* is taken from phi */
};

struct kd_star_image {
    size_t star;        /* of the list, */
    double x, y;        /* and its place in pixels: 0, 0 is the upper left corner of the picture, 0.5, 0.5 the middle of its first pixel */
    double solid_angle; /* of the sky that the map takes one pixel to there, sr */
    bool mirrored;      /* left and right are exchanged */
};

/* Tells each image of so many stars, unit vectors in the frame of the places; row by row. KD_ENOMEM; a status of `found` ends it. */
enum kd_status kd_star_images(const struct kd_sky_places *map, const struct kd_vec *stars, size_t n,
                              enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user);

#endif
