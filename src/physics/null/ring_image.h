/* Lensed image of a ring for an observer at infinity: the place (alpha, beta) at which the point (r, phi) of the
 * equatorial plane is seen. ring_view.h is for an observer at a finite radius. Double precision; pure functions, any
 * thread. G = c = M = 1; conventions of physics/null/null_geodesic.h.
 *
 * The closed form gives (r, phi) of a ray's n-th crossing. This file inverts it by Newton's method, starting from a
 * table of the ring's whole image. Along each direction of the image plane, the radius r_n of the n-th crossing grows
 * with the distance from the centre, from the horizon to infinity. Rays closer to the centre are captured first, and
 * rays farther out escape first. */
#ifndef KD_PHYSICS_NULL_RING_IMAGE_H
#define KD_PHYSICS_NULL_RING_IMAGE_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum { KD_RING_NODES = 320 };

struct kd_ring_image {
    struct kd_hole hole;
    double cos_theta, sin_theta, radius, flatten;
    int order, nodes;
    /* table of the image; phi is continuous, and grows by one turn in total */
    double chi[KD_RING_NODES], log_rho[KD_RING_NODES], phi[KD_RING_NODES];
};

/* Makes the table of a ring's image. r: outside the horizon, at most 1e4. inclination: radians, up to 89.9 degrees.
 * order: 0 or 1. Returns false if the image turns too quickly for the table, which has not been observed for r >= 1.02
 * r+. Takes some 500 rays. */
bool kd_ring_image_init(struct kd_ring_image *ring, const struct kd_hole *hole, double inclination, double r,
                        int order);

/* Makes a ring image without a table, which only kd_ring_image_seen accepts. */
struct kd_ring_image kd_ring_image_plain(const struct kd_hole *hole, double inclination, double r, int order);

/* phi, sense: as in struct kd_null_crossing. residual: the length of the last Newton step. The error is some 1e-6 of
 * this length, plus rounding. */
struct kd_ring_image_point {
    /* Number of images of this order. It is usually 1. Beyond a caustic it is 3 or more (high inclination and a != 0;
     * order 0 next to edge-on). */
    int images;
    double alpha, beta, phi, delay, residual;
    int sense;
};

/* Finds the image at the azimuth phi, source minus observer. Of several images it gives the first from +alpha towards
 * +beta. Returns false if none is found. Takes some 30 rays. */
bool kd_ring_image_find(const struct kd_ring_image *ring, double phi, struct kd_ring_image_point *point);

/* Finds the image of the ring in the direction (cos(chi), cos(i) sin(chi)) from alpha = beta = 0; each direction meets
 * the image once. In *out, images is 0, and residual is the ln of the ratio of the crossing's radius to the ring's.
 * Takes some 20 rays. */
bool kd_ring_image_seen(const struct kd_ring_image *ring, double chi, struct kd_ring_image_point *point);

#endif
