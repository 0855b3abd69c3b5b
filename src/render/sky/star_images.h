/* Where a map of rays puts stars: for each star the places among rays that end at it. Pure; any thread.
 *
 * Neighbouring rays make triangles, of which the map takes each to one of the sky; a star within that has an image
 * within this, at the same barycentric coordinates. From there Newton's method goes to where the ray itself, if the
 * map can follow one, ends at the star (star_root.h). Where the map folds between four rays, two images of a star
 * meet, and triangles lose both or tell one that is none: there each star that is near is looked for from both
 * sides. A triangle with a side of more than `coarse` has no images. */
#ifndef KD_RENDER_SKY_STAR_IMAGES_H
#define KD_RENDER_SKY_STAR_IMAGES_H

#include "base/error.h"
#include "render/sky/frame.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The map about a place: n + dx * across + dy * down; area: the volume of the three. */
struct kd_sky_tangent {
    struct kd_vec n, across, down;
    double area;
};

/* Rays on a grid, and the places between them: ray 0, 0 is at 0, 0. */
struct kd_sky_map {
    uint32_t width, height;
    double coarse; /* rad */
    const double
        *most; /* of each star: an image where a pixel is more of the sky, sr, need not be told; NULL: all are */
    double (*pixels)(const void *of, double x, double y); /* the pixels that the square of four rays is in; NULL: 1 */
    const void *of;
    void (*row)(const void *of, uint32_t y,
                struct kd_vec *out); /* where rays come from, unit vectors; NAN: one that does not escape */
    bool (*exact)(const void *of, double x, double y,
                  struct kd_vec *out); /* the same of any ray; false: it is not known. NULL: of none */
    /* The map between its rays, but for `area`, to 1e-3 of a ray: what is no image there is not followed exactly.
     * False: not known. NULL: of no place. */
    bool (*between)(const void *of, double x, double y, struct kd_sky_tangent *out);
    bool (*wanted)(const void *of, double x,
                   double y); /* whether an image about there need be told, to 0.01 rays; NULL: all */
};

/* A place and steps from there, by which a solid angle is taken. Steps of 0: it is the derivative at the place. */
struct kd_star_stencil { double x, y, across, down; };

struct kd_star_image {
    size_t star;        /* of the list, */
    double x, y;        /* and its place among the rays, */
    double solid_angle; /* the solid angle of the sky, sr, that the map takes the square of four rays to there, */
    struct kd_star_stencil by; /* as this has it, */
    double x_by_azimuth,
        y_by_azimuth; /* and how the place goes by while the observer goes round the hole, per radian */
    bool mirrored;    /* left and right are exchanged */
};

/* Tells each image of so many stars, unit vectors in the frame of the map, once; row by row. KD_ENOMEM; a status of
 * `found` ends it. */
enum kd_status kd_star_images(const struct kd_sky_map *map, const struct kd_vec *stars, size_t n,
                              enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user);

#endif
