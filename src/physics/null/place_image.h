/* The image of a place near the hole: the ray that leads from an observer back to it. Double precision; pure functions,
 * any thread. Units G = c = M = 1, angles in radians.
 *
 * Newton's method in two angles finds the ray whose closest point to the place has no transverse offset. Rays are those
 * of null_course.h, interpolated by a cubic in Mino time. The search starts on the place's side of the hole, or at the
 * image of a neighbouring place. Without a neighbouring image the search finds the direct image, which has order 0.
 * Behind a caustic of a spinning hole there are several direct images, and one of them is found. With a neighbouring
 * image the result continues it. The ray of such an image may go round the hole if the view is nearly edge-on. */
#ifndef KD_PHYSICS_NULL_PLACE_IMAGE_H
#define KD_PHYSICS_NULL_PLACE_IMAGE_H

#include "physics/spacetime/observer.h"

/* The observer, who is outside the horizon at a finite radius or at INFINITY. */
struct kd_place_view { struct kd_tetrad frame; /* only the member `at` is set if the observer is at infinity */ };
struct kd_place_view kd_place_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* alpha, beta: labels of null_geodesic.h. look: direction, NAN for an observer at infinity. delay: as in
 * null_geodesic.h. off: distance by which the ray misses the place, M; divided by the observer's distance it is an
 * angle on the sky. chart: coordinates at which the search for a neighbouring place's image starts. */
struct kd_place_image {
    double alpha, beta;
    bool outward;
    struct kd_look look;
    double delay, off, chart[2];
};

/* Finds the image of a place. r, cos_theta: place. phi: azimuth of the place minus the observer's. near: the image of a
 * neighbouring place, or NULL. searches: true if a new search is made when the continuation from `near` fails. Returns
 * false, with all members NAN, if the image is not found to 1e-5 of the radius. Within KD_PLACE_LEAST times the
 * horizon's radius, where rays linger, no search is made. Takes some 20 ms, or 2 ms from a neighbour, and up to 0.3 s
 * if no image is found. */
#define KD_PLACE_LEAST 1.2
bool kd_place_image_seen(const struct kd_place_view *view, double r, double u, double phi,
                         const struct kd_place_image *near, bool searches, struct kd_place_image *out);

#endif
