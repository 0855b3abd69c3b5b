/* This lays out the rim of the shadow: rays next to the critical curve stand on a grid of their own, round the curve and by the logarithm of the distance to it. There
 * every image order of the sky is as wide as the last, and each image of a star can be found (docs/physics/sky.md). Double precision; pure, any
 * thread. The scene must be valid.
 *
 * The rim lies on a plane: of an observer at infinity (alpha, beta) about the curve's middle; of others the tangent plane of the sky of
 * directions at the middle of the curve, tangents of angles. Column k of `angles` begins at the point (x[k], y[k]) of the curve, row i is further out from the
 * middle by the factor 1 + far e^(-i fall). The last row is KD_RIM_LEAST from the curve, or so near that the brightest star would be seen no more, if that is nearer, but not nearer than KD_RIM_NEAREST: an
 * image at `off` of a star of flux F has the radiance F off (radius/pixel)^2 at least, and not much more unless the star is next to a caustic. */
#ifndef KD_RENDER_VIEW_RIM_H
#define KD_RENDER_VIEW_RIM_H

#include "render/view/layout.h"
#include "scene/scene.h"

#include <stdbool.h>

#define KD_RIM_ROWS 256    /* at most, of KD_RIM_ANGLES rays (interface.h) */
#define KD_RIM_LEAST 3e-5
#define KD_RIM_NEAREST 1e-7      /* nearer even double precision loses 1e-6 rad and more */
#define KD_RIM_STEP 0.1          /* rad */
#define KD_RIM_BRIGHTEST 0.0235  /* sr: of V = -1.5, Sirius's and some more (sky/star.h) */
#define KD_RIM_SEEN 0.1          /* of KD_STAR_LEAST: what moves makes stars brighter */
#define KD_RIM_PIXELS 14.0 /* as wide is the rim, where neighbouring pixels lead far apart; */
#define KD_RIM_NOISE 1.3e-3 /* or, over its radius, so many radii in pixels: beyond, what 32 bits lose, 7e-6 over the distance, is less than half a percent of where the next pixel leads; */
#define KD_RIM_MOST 1.0     /* of its radius at most */

struct kd_rim {
    uint32_t rows;                             /* 0: there is none */
    double far, fall;
    double apart;                              /* where neighbouring rays lead, at most, rad; roughly */
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

/* Which way an observer looks at a place of its plane: along e_r, e_theta, e_phi, of any length; at infinity alpha and beta. */
void kd_rim_look(const struct kd_rim *rim, double x, double y, double look[3]);
/* How far from the curve an observer looks, over its distance from the middle there; far off where the plane is not. */
double kd_rim_off(const struct kd_rim *rim, const double look[3], bool flat);
/* The place of its plane, between columns and rows as on them; by the quartic through five points of the curve. */
void kd_rim_between(const struct kd_rim *rim, double column, double row, double place[2]);

/* Its buffer holds where its rays come from (rim_sky.h), three planes of numbers, and the tables that say where it is: x and y of the curve's points, and `edge`. */
static inline uint32_t kd_rim_rays(const struct kd_rim *rim) { return rim->rows * KD_RIM_ANGLES; }
static inline uint64_t kd_rim_tables(uint32_t rays) { return 3ull * rays; } /* the number that they begin at */
static inline uint64_t kd_rim_bytes(uint32_t rays) { return 4ull * (kd_rim_tables(rays) + 2 * KD_RIM_ANGLES + KD_RIM_EDGES); }

#endif
