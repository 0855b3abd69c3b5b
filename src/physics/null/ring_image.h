/* Lensed image of a ring for an observer at infinity: the (alpha, beta) at which the point (r, phi) of the equatorial
 * plane is seen. For an observer at a finite radius see ring_view.h. Double precision; pure functions, any thread. G =
 * c = M = 1; conventions of physics/null/null_geodesic.h.
 *
 * The closed form gives (r, phi) of a ray's n-th crossing. This file inverts it by Newton's method, starting from a
 * table of the ring's whole image. Along each direction of the image plane r_n grows with the distance from the centre,
 * from the horizon to infinity. Rays closer to the centre are captured first, and rays farther out escape first. */
#ifndef KD_PHYSICS_NULL_RING_IMAGE_H
#define KD_PHYSICS_NULL_RING_IMAGE_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_RING_NODES = 320 };

struct kd_ring_image {
    struct kd_hole hole;
    double cos_theta, sin_theta, radius, flatten;
    int order, nodes;
    /* phi is continuous; it grows by one turn in all */
    double chi[KD_RING_NODES], log_rho[KD_RING_NODES], phi[KD_RING_NODES];
};

/* r outside the horizon; inclination in radians, up to 89.9 degrees; order: 0 or 1; r is at most 1e4. Returns false if
 * the image turns too quickly for the table, which has not been observed for r >= 1.02 r+. Takes some 500 rays. */
bool kd_ring_image_init(struct kd_ring_image *ring, const struct kd_hole *hole, double inclination, double r,
                        int order);

/* Like kd_ring_image_init, but makes no table; the result is valid only for kd_ring_image_seen. */
struct kd_ring_image kd_ring_image_plain(const struct kd_hole *hole, double inclination, double r, int order);

/* phi, sense: as in struct kd_null_crossing. residual: the length of Newton's last step; the error is some 1e-6 of it,
 * plus rounding. */
struct kd_ring_image_point {
    /* Number of images of this order. Usually 1; 3 or more beyond a caustic (high inclination, a != 0; order 0 next
     * to edge-on). */
    int images;
    double alpha, beta, phi, delay, residual;
    int sense;
};

/* Finds the image at the azimuth phi, source minus observer. Of several images it gives the first from +alpha towards
 * +beta. Returns false if none is found. Takes some 30 rays. */
bool kd_ring_image_find(const struct kd_ring_image *ring, double phi, struct kd_ring_image_point *point);

/* Finds the image in the direction (cos(chi), cos(i) sin(chi)) of the image plane from alpha = beta = 0; each
 * direction meets it once. images is 0; residual: ln of the crossing's radius over the ring's. Some 20 rays. */
bool kd_ring_image_seen(const struct kd_ring_image *ring, double chi, struct kd_ring_image_point *point);

#endif
