/* Finds where a place near the hole is seen: the ray that leads from an observer back to it. Double precision;
 * pure functions, any thread. Units G = c = M = 1, angles in radians.
 *
 * The ray is searched for by Newton's method in two angles: what is to vanish is the part of (nearest place of the
 * ray - the place) across the ray. Rays are those of null_course.h, between whose places a cubic in Mino time goes.
 * The first guesses are on the side of the hole on which the place is, or the image of a neighbour. It is the direct
 * image, of order 0, that is found from nothing; of those that a caustic adds behind a hole that spins, one, and
 * from a neighbour whichever image that one was of: next to such a hole, seen nearly edge on, it may have gone round
 * it. */
#ifndef KD_PHYSICS_NULL_PLACE_IMAGE_H
#define KD_PHYSICS_NULL_PLACE_IMAGE_H

#include "physics/spacetime/observer.h"

/* Observers outside the horizon, at a finite radius or at INFINITY. */
struct kd_place_view { struct kd_tetrad frame; /* at infinity its vantage alone */ };
struct kd_place_view kd_place_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* alpha, beta: labels of null_geodesic.h. look: NAN at infinity. delay: likewise as there. off: by how much the ray
 * misses the place, M; what is left of it on the sky is off over the distance. chart: where the search of a
 * neighbour begins. */
struct kd_place_image {
    double alpha, beta;
    bool outward;
    struct kd_look look;
    double delay, off, chart[2];
};

/* The place: radius, cos(theta), azimuth less the observer's. near: the image of a place next to it, or NULL;
 * searches: whether to begin anew where that leads nowhere. False: it is not found to 1e-5 of its radius, and
 * everything is NAN; it is not looked for within KD_PLACE_LEAST horizons, where light lingers. Some 20 ms, 2 ms from
 * a neighbour, up to 0.3 s where nothing is found. */
#define KD_PLACE_LEAST 1.2
bool kd_place_image_seen(const struct kd_place_view *view, double r, double u, double phi,
                         const struct kd_place_image *near, bool searches, struct kd_place_image *out);

#endif
