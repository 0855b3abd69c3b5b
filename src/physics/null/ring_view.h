/* Finds the image of a ring in the equatorial plane on the sky of an observer at a finite radius, who may be
 * within it, near the hole or beyond the horizon. Double precision; pure functions, any thread. Units G = c = M = 1.
 *
 * Directions are told in the frame of rain (observer.c), which is regular everywhere outside the inner horizon: off
 * `inwards` (-r) by an angle rho, towards chi, where
 *
 *   (right, up) ~ (cos chi, |cos i| sin chi)
 *
 * so that chi turns evenly round a ring seen unlensed from afar. Along each chi the radius at which rays meet the
 * plane grows from the edge of the dark, rho = 0, to infinity, rho = pi at most: each direction meets the image of
 * each order once, and every ring outside the horizon has it. Observers that move past rain see these directions
 * elsewhere. */
#ifndef KD_PHYSICS_NULL_RING_VIEW_H
#define KD_PHYSICS_NULL_RING_VIEW_H

#include "physics/spacetime/observer.h"

struct kd_ring_view {
    struct kd_tetrad rain, frame; /* the observer's own */
    double radius;
    int order;
};

/* at: |cos theta| > 0.0017 (0.1 degrees), where there is such an observer; r: outside the horizon; order: 0 or 1. */
struct kd_ring_view kd_ring_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r,
                                    int order);

/* alpha, beta: the photon's constants by their labels (null_geodesic.h), infinite or NaN where it has no energy at
 * infinity. phi, delay: of the crossing, as there; NaN for observers within the horizon, whose azimuth and time are
 * not Boyer and Lindquist's, and for light whose energy at infinity is not above 0. residual: ln of the crossing's
 * radius over the ring's. */
struct kd_ring_view_point {
    struct kd_look look;
    double alpha, beta, phi, delay, residual;
};

/* False where it is not found to 1e-6 of r, which has not been seen: near the singularity, where a rounding of the
 * direction is worth so much, to 1e-8. Some 0.3 ms. */
bool kd_ring_view_seen(const struct kd_ring_view *view, double chi, struct kd_ring_view_point *out);

#endif
