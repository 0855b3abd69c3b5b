/* The image of a place near the hole: the ray that leads from an observer back to it. Double precision; pure functions,
 * any thread. Units G = c = M = 1, angles in radians.
 *
 * Newton's method in two angles makes the transverse offset between the place and the ray's closest point vanish. Rays
 * are those of null_course.h, interpolated by a cubic in Mino time. The first guesses are on the place's side of the
 * hole, or the image of a neighbour. Without a neighbour the direct image, of order 0, is found. Behind a caustic of a
 * spinning hole there are several, and one of them is found. With a neighbour the result continues that image, which
 * may have gone round the hole when seen nearly edge-on. */
#ifndef KD_PHYSICS_NULL_PLACE_IMAGE_H
#define KD_PHYSICS_NULL_PLACE_IMAGE_H

#include "physics/spacetime/observer.h"

/* The observer, who is outside the horizon at a finite radius or at INFINITY. */
struct kd_place_view { struct kd_tetrad frame; /* at infinity only the vantage is set */ };
struct kd_place_view kd_place_view_of(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* alpha, beta: labels of null_geodesic.h. look: NAN at infinity. delay: as in null_geodesic.h. off: distance by
 * which the ray misses the place, M; on the sky that is off over the distance. chart: start for the search of a
 * neighbour. */
struct kd_place_image {
    double alpha, beta;
    bool outward;
    struct kd_look look;
    double delay, off, chart[2];
};

/* Arguments: radius and cos(theta) of the place, its azimuth less the observer's; near: the image of a neighbouring
 * place, or NULL; searches: whether to search anew if the continuation from `near` fails. Returns false, with all
 * members NAN, if the image is not found to 1e-5 of the radius. Within KD_PLACE_LEAST times the horizon's radius, where
 * rays linger, no search is made. Takes some 20 ms, or 2 ms from a neighbour, and up to 0.3 s if no image is found. */
#define KD_PLACE_LEAST 1.2
bool kd_place_image_seen(const struct kd_place_view *view, double r, double u, double phi,
                         const struct kd_place_image *near, bool searches, struct kd_place_image *out);

#endif
