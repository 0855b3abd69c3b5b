/* This lays out the rim of the shadow: rays next to the critical curve stand on a grid of their own, round the curve and by the logarithm of the distance to it. There
 * every image order of the sky is as wide as the last, and each image of a star can be found (docs/physics/sky.md). Double precision; pure, any
 * thread. The scene must be valid.
 *
 * The rim lies on a plane: of an observer at infinity (alpha, beta) about the curve's middle; of others the tangent plane of the sky of
 * directions at the middle of the curve, tangents of angles. Column k of `angles` begins at the point (x[k], y[k]) of the curve, row i is further out from the
 * middle by the factor 1 + far e^(-i fall). The last row is KD_RIM_LEAST from the curve: of rays that are nearer 32 bits tell too little. */
#ifndef KD_RENDER_VIEW_RIM_H
#define KD_RENDER_VIEW_RIM_H

#include "render/view/layout.h"
#include "scene/scene.h"

#include <stdbool.h>

#define KD_RIM_ROWS 256    /* at most, of KD_RIM_ANGLES rays (interface.h) */
#define KD_RIM_LEAST 3e-5
#define KD_RIM_PIXELS 14.0 /* as wide is the rim, or KD_RIM_MOST of its radius */
#define KD_RIM_MOST 0.35

struct kd_rim {
    uint32_t rows;                             /* 0: there is none */
    double far, fall;
    double steps;                              /* of the rays' raster to a unit of the plane: a power of two */
    double none, full;                         /* distances from the curve, over its own from the middle: from the first on images of stars are the grid's alone, up to
                                                  the second the rim's, between them they are shared */
    double ahead[3], right[3], up[3];          /* legs of the plane in the observer's frame; at infinity `ahead` is alpha and beta of the middle */
    double x[KD_RIM_ANGLES], y[KD_RIM_ANGLES];
    float edge[KD_RIM_EDGES];                  /* the curve's distance from the middle by the angle from `right`, to 1e-4 */
};

/* Whether there may be one, at no cost. */
bool kd_rim_may_be(const struct kd_scene *scene);
/* There is one where the observer is beyond the orbits of light, and sees all of the curve less than 80 degrees from its middle. Some 0.3 ms. */
bool kd_rim_of(const struct kd_scene *scene, struct kd_rim *out);

/* The camera of its rays, which looks at the middle, and the place there of the one in column k and row i. */
struct kd_camera_block kd_rim_camera(const struct kd_scene *scene, const struct kd_rim *rim);
struct kd_rim_pixel { uint32_t x, y; };
struct kd_rim_pixel kd_rim_ray(const struct kd_rim *rim, uint32_t k, double off); /* off: of the row, */
double kd_rim_off(const struct kd_rim *rim, uint32_t i);                          /* far e^(-i fall) */

/* A lens map of it has one order, w and where rays go; with the list of rays and the tables behind it, at most so many bytes. */
#define KD_RIM_QUANTITIES (KD_LENS_W | KD_LENS_SKY)
static inline uint32_t kd_rim_rays(const struct kd_rim *rim) { return rim->rows * KD_RIM_ANGLES; }
static inline uint64_t kd_rim_bytes(uint32_t rays)
{
    return 4ull * rays * (kd_lens_planes(KD_RIM_QUANTITIES, 1) + 2) + 4ull * (2 * KD_RIM_ANGLES + KD_RIM_EDGES);
}

#endif
