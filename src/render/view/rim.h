/* Layout of the rim of the shadow, where images of stars are searched with extra rays. Next to the critical curve
 * neighbouring rays of a picture end too far apart for a search. The extra rays are evenly spaced in the angle round
 * the curve and in the logarithm of the distance to it. On this logarithmic scale every image order of the sky has the
 * same width (docs/physics/sky.md). rim_grid.h chooses the rays. Double precision; pure, any thread. The scene must be
 * valid.
 *
 * The rim lies on a plane. For an observer at infinity this is the plane of (alpha, beta) about the curve's middle. For
 * other observers it is the tangent plane of the sphere of directions at the curve's middle. Its coordinates are
 * tangents of angles. A place has two coordinates. u is the turn round the curve, KD_RIM_ANGLES for a whole turn. l is
 * log(off), where the place's distance from the middle is 1 + off times that of the curve's point.
 *
 * The innermost rays are KD_RIM_LEAST from the curve. These rays are nearer, down to KD_RIM_NEAREST, if the brightest
 * star could still be seen there. An image at the relative distance `off`, of a star of flux F, has at least the
 * radiance F off (radius/pixel)^2. It is not much brighter unless the star is next to a caustic. */
#ifndef KD_RENDER_VIEW_RIM_H
#define KD_RENDER_VIEW_RIM_H

#include "physics/null/critical.h"
#include "render/view/layout.h"
#include "scene/scene.h"

#include <stdbool.h>

#define KD_RIM_LEAST 3e-5
#define KD_RIM_NEAREST 1e-7     /* distance from the curve below which double precision loses 1e-6 rad and more */
#define KD_RIM_BRIGHTEST 0.0235 /* flux in sr, of a star slightly brighter than Sirius: V = -1.5 (sky/star.h) */
/* An image counts as visible from this fraction of KD_STAR_LEAST on. The fraction is below 1 because motion of the
 * observer can make stars brighter. */
#define KD_RIM_SEEN 0.1
#define KD_RIM_PIXELS 14.0 /* width of the rim in pixels; within it neighbouring pixels end far apart on the sky */
/* The width of the rim is at least this times the rim's radius in pixels. The error by rounding to 32 bits is 7e-6
 * divided by the distance. Beyond this width the error is less than half a percent of the step from pixel to pixel. */
#define KD_RIM_NOISE 1.3e-3
#define KD_RIM_MOST 1.0 /* the width of the rim is at most this fraction of its radius */

struct kd_rim {
    bool there;
    /* relative distances from the curve. Beyond `none`, all images come from the picture's grid. Within `full`, all
     * come from the rim. Between the two, grid and rim share the light */
    double none, full;
    double last; /* the least relative distance from the curve of the rim's rays */
    /* rough estimate, in rad: the shift of the sky between the outermost and the innermost ray changes by at most
     * this much from one point of the curve to the next */
    double winds;
    double pixel; /* size of a pixel on the plane */
    bool flat;
    double ahead[3], right[3],
        up[3]; /* axes of the plane in the observer's frame; at infinity `ahead` is (alpha, beta) of the middle */
    float edge[KD_RIM_EDGES]; /* distance of the curve from the middle, accurate to 1e-4, for each angle from `right` */
    struct kd_critical curve;
};

/* True if the scene may have a rim; a cheap test. */
bool kd_rim_may_be(const struct kd_scene *scene);
/* Makes the rim. Returns false if there is none. There is one if the observer is outside the photon orbits and sees
 * all of the curve within 80 degrees of its middle. Takes about 0.3 ms. */
bool kd_rim_of(const struct kd_scene *scene, struct kd_rim *out);

/* The place on the plane at turn u (any real number) and relative distance `off` from the curve. */
void kd_rim_place(const struct kd_rim *rim, double u, double off, double place[2]);
/* Direction of a place of the plane: along e_r, e_theta, e_phi, of any length; at infinity (alpha, beta). */
void kd_rim_look(const struct kd_rim *rim, const double place[2], double look[3]);
/* Distance of a direction from the curve, relative to the curve's distance from the middle; INFINITY behind the
 * plane. */
double kd_rim_off(const struct kd_rim *rim, const double look[3]);

#endif
