/* Finds where a listed ray starts in Cartesian ingoing Kerr-Schild coordinates of the mirrored spacetime (t,
 * phi) -> (-t, -phi), in which a ray that is traced back is a photon that flies away from the observer. Double
 * precision, pure, any thread. */
#ifndef KD_RENDER_RAYS_START_H
#define KD_RENDER_RAYS_START_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

struct kd_rays_origin {
    double x[3], p[3]; /* position and momentum, E = 1 */
    double w, phi;     /* the crossing of the equatorial plane on the way here from infinity: 1/r, 0 where there is none
                        * (there is at most one), and its azimuth as in render/rays/rays.h */
};

/* a; r and cosine and sine of the observer's polar angle, 0 allowed; labels as in render/rays/rays.h. r = INFINITY:
 * the start is at `far`, or at eight times the impact parameter where that is more. outward: a finite observer's ray
 * that starts away from the hole. */
void kd_rays_start(const struct kd_hole *hole, double r, double u, double s, double alpha, double beta, bool outward,
                   double far, struct kd_rays_origin *out);

#endif
