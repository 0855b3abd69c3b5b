/* Finds the images of stars under a map of rays to the sky. For each star these are the places of the rays that end at
 * it. Pure; any thread.
 *
 * Neighbouring rays form triangles, which the map takes to triangles of the sky. A star within a triangle of the sky
 * has an image in the corresponding triangle of rays, at the same barycentric coordinates. From there Newton's method
 * finds the ray that ends at the star, if the map can follow single rays (star_root.h). Where the map folds between
 * four rays, two images of a star merge, and triangles miss both or report a false one. There each nearby star is
 * searched from both sides of the fold. A triangle with a side longer than `coarse` has no images. */
#ifndef KD_RENDER_SKY_STAR_IMAGES_H
#define KD_RENDER_SKY_STAR_IMAGES_H

#include "base/error.h"
#include "render/sky/frame.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The linearised map about a place: n + dx * across + dy * down. area: the volume that n, across and down span. */
struct kd_sky_tangent {
    struct kd_vec n, across, down;
    double area;
};

/* A map given on a grid of rays, and the places between them. Ray (0, 0) is at place (0, 0). */
struct kd_sky_map {
    uint32_t width, height;
    double coarse; /* rad */
    /* for each star, the largest solid angle of a pixel, in sr, at which an image must be reported; NULL: all are
     * reported */
    const double *most;
    /* number of pixels that the square of four rays about a place covers; NULL: 1 */
    double (*pixels)(const void *of, double x, double y);
    const void *of;
    /* gets the directions from which the rays of a row come, as unit vectors; NAN where a ray does not escape */
    void (*row)(const void *of, uint32_t y, struct kd_vec *out);
    bool (*exact)(const void *of, double x, double y,
                  /* gets the direction from which a single ray comes; false: unknown. NULL: no ray can be followed */
                  struct kd_vec *out);
    /* The linearised map at a place between rays, except `area`, accurate to 1e-3 of a ray. With this map, exact rays
     * need not be traced where there is no image. Returns false if the map is unknown at the place. A NULL pointer
     * means that it is unknown everywhere. */
    bool (*between)(const void *of, double x, double y, struct kd_sky_tangent *out);
    bool (*wanted)(const void *of, double x,
                   double y); /* true if an image near this place must be reported, to 0.01 rays; NULL: always */
};

/* A place, and steps from that place. A solid angle is measured over these steps. Steps of 0: the derivative at the
 * place. */
struct kd_star_stencil { double x, y, across, down; };

struct kd_star_image {
    size_t star; /* index in the list */
    double x, y; /* the image's place among the rays */
    /* solid angle in sr of the part of the sky to which the map takes the square of four rays about the place */
    double solid_angle;
    struct kd_star_stencil by;         /* how solid_angle was measured */
    double x_by_azimuth, y_by_azimuth; /* change of the place per radian of the observer's azimuth */
    bool mirrored;                     /* true if left and right are exchanged in the image */
};

/* Reports each image of n stars (unit vectors in the frame of the map) once, row by row. Returns KD_ENOMEM, or the
 * status by which `found` ended the search. */
enum kd_status kd_star_images(const struct kd_sky_map *map, const struct kd_vec *stars, size_t n,
                              enum kd_status (*found)(void *user, const struct kd_star_image *image), void *user);

#endif
