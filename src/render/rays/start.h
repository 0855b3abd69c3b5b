/* The start of a listed ray in Cartesian ingoing Kerr-Schild coordinates of the mirrored spacetime (t, phi) -> (-t,
 * -phi). In the mirrored spacetime, a ray traced backwards is a photon that moves away from the observer. Double
 * precision, pure, any thread. */
#ifndef KD_RENDER_RAYS_START_H
#define KD_RENDER_RAYS_START_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

struct kd_rays_origin {
    double x[3], p[3]; /* position and momentum, for E = 1 */
    /* 1/r and azimuth (as in render/rays/rays.h) at which the ray crosses the equatorial plane between infinity and
     * the start. There is at most one such crossing. w = 0: none */
    double w, phi;
};

/* u, s: cosine and sine of the observer's polar angle, which may be 0; labels as in render/rays/rays.h. If r =
 * INFINITY, the ray starts at `far`, or at eight times the impact parameter if that is more. outward: true if the ray
 * of an observer at a finite radius starts away from the hole. */
void kd_rays_start(const struct kd_hole *hole, double r, double u, double s, double alpha, double beta, bool outward,
                   double far, struct kd_rays_origin *out);

#endif
