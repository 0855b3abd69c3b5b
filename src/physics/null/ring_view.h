/* Image of a ring in the equatorial plane for an observer at a finite radius, who may be inside the ring, near the
 * hole or beyond the horizon. Double precision; pure functions, any thread. Units G = c = M = 1.
 *
 * Directions are given in the rain frame (observer.c), which is regular everywhere outside the inner horizon. A
 * direction is at the angle rho from `inwards` (-r), towards chi, where
 *
 *   (right, up) ~ (cos chi, |cos i| sin chi)
 *
 * So chi advances evenly round a ring seen unlensed from afar. Along each chi the radius at which rays meet the plane
 * grows with rho. It starts at the edge of the dark disk, near rho = 0, and reaches infinity at rho = pi or before.
 * Therefore each chi meets the image of each order exactly once, for every ring outside the horizon. Observers who move
 * relative to the rain frame see these directions aberrated. */
#ifndef KD_PHYSICS_NULL_RING_VIEW_H
#define KD_PHYSICS_NULL_RING_VIEW_H

#include "physics/spacetime/observer.h"

struct kd_ring_view {
    struct kd_tetrad rain, frame; /* rain: the rain frame. frame: the observer's own frame */
    double radius;
    int order;
};

/* Makes a view. at: place of the observer, with |cos theta| > 0.0017 (0.1 degrees); the motion must be possible there.
 * r: radius of the ring, outside the horizon. order: 0 or 1. */
struct kd_ring_view kd_ring_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r,
                                    int order);

/* A point of the image. alpha, beta: labels of the photon's constants (null_geodesic.h), infinite or NaN if its energy
 * at infinity is 0. phi, delay: azimuth and delay of the crossing, as in null_geodesic.h. They are NaN for observers
 * within the horizon, whose azimuth and time are not Boyer-Lindquist's, and for light whose energy at infinity is not
 * positive. residual: ln of the ratio of the crossing's radius to the ring's. */
struct kd_ring_view_point {
    struct kd_look look;
    double alpha, beta, phi, delay, residual;
};

/* Returns false if no direction is found whose crossing is within 1e-6 of r. No such case is known: the largest
 * difference was 1e-8 of r, near the singularity, which amplifies rounding of the direction. Takes some 0.3 ms. */
bool kd_ring_view_seen(const struct kd_ring_view *view, double chi, struct kd_ring_view_point *out);

#endif
