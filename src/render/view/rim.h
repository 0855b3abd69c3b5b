/* Lays out the rim of the shadow: next to the critical curve rays of a picture lead too far apart to find
 * images of stars between them, and others are followed there, round the curve and by the logarithm of the distance
 * to it, in which every image order of the sky is as wide as the last (docs/physics/sky.md). Which ones: rim_grid.h.
 * Double precision; pure, any thread. The scene must be valid.
 *
 * The rim lies on a plane: of an observer at infinity (alpha, beta) about the curve's middle; of others the tangent
 * plane of the sky of directions at the middle of the curve, tangents of angles. A place of it is a turn u round the
 * curve, KD_RIM_ANGLES to the whole, and l, the logarithm of `off`: it is further out from the middle than the
 * curve's point by the factor 1 + off. The last rays are KD_RIM_LEAST from the curve, or so near that the brightest
 * star would be seen no more, if that is nearer, but not nearer than KD_RIM_NEAREST: an image at `off` of a star of
 * flux F has the radiance F off (radius/pixel)^2 at least, and not much more unless the star is next to a caustic. */
#ifndef KD_RENDER_VIEW_RIM_H
#define KD_RENDER_VIEW_RIM_H

#include "physics/null/critical.h"
#include "render/view/layout.h"
#include "scene/scene.h"

#include <stdbool.h>

#define KD_RIM_LEAST 3e-5
#define KD_RIM_NEAREST 1e-7     /* nearer even double precision loses 1e-6 rad and more */
#define KD_RIM_BRIGHTEST 0.0235 /* sr: of V = -1.5, Sirius's and some more (sky/star.h) */
#define KD_RIM_SEEN 0.1         /* of KD_STAR_LEAST: what moves makes stars brighter */
#define KD_RIM_PIXELS 14.0      /* as wide is the rim, where neighbouring pixels lead far apart; */
#define KD_RIM_NOISE \
    1.3e-3 /* or, over its radius, so many radii in pixels: beyond, what 32 bits lose, 7e-6 over the distance, is less \
              than half a percent of where the next pixel leads; */
#define KD_RIM_MOST 1.0 /* of its radius at most */

struct kd_rim {
    bool there;
    double none, full; /* distances from the curve, over its own from the middle: from the first on images of stars are
                          the grid's alone, up to the second the rim's, between them they are shared */
    double last;       /* the least distance of its rays */
    double winds; /* how far, at most, the sky goes by from one point of the curve to the next on the way down there,
                     rad; roughly */
    double pixel; /* a step of the picture on the plane */
    bool flat;
    double ahead[3], right[3],
        up[3]; /* legs of the plane in the observer's frame; at infinity `ahead` is alpha and beta of the middle */
    float edge[KD_RIM_EDGES]; /* the curve's distance from the middle by the angle from `right`, to 1e-4 */
    struct kd_critical curve;
};

/* Whether there may be one, at no cost. */
bool kd_rim_may_be(const struct kd_scene *scene);
/* There is one where the observer is beyond the orbits of light, and sees all of the curve less than 80 degrees from
 * its middle. Some 0.3 ms. */
bool kd_rim_of(const struct kd_scene *scene, struct kd_rim *out);

/* The place on its plane at a turn u, any real, `off` from the curve. */
void kd_rim_place(const struct kd_rim *rim, double u, double off, double place[2]);
/* Which way an observer looks at a place of its plane: along e_r, e_theta, e_phi, of any length; at infinity alpha
 * and beta. */
void kd_rim_look(const struct kd_rim *rim, const double place[2], double look[3]);
/* How far from the curve an observer looks, over its distance from the middle there; far off where the plane is not. */
double kd_rim_off(const struct kd_rim *rim, const double look[3]);

#endif
