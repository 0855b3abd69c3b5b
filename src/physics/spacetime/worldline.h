/* Paths of observers as functions of their own time: at rest, on circular orbits, and in free fall. Double precision,
 * pure, any thread. G = c = M = 1. */
#ifndef KD_PHYSICS_SPACETIME_WORLDLINE_H
#define KD_PHYSICS_SPACETIME_WORLDLINE_H

#include "physics/spacetime/observer.h"

/* True if the observer's path is implemented. The observer must be at a finite radius, and stay at its latitude. Paths
 * of observers with a chosen velocity are not implemented. */
bool kd_worldline_is_known(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* The observer's place after a proper time, which must be >= 0. azimuth (radians), time: increases since the start.
 * They are in ingoing Kerr-Schild coordinates for free fall, and in Boyer-Lindquist coordinates for other observers; at
 * constant radius both coordinates give the same increases. far_time: increase of Boyer-Lindquist time for all
 * observers; INFINITY for free fall from the horizon on. */
struct kd_worldline_place {
    double r, azimuth, time, far_time;
    bool ended; /* true if the observer has reached the end of its fall */
};
struct kd_worldline_place kd_worldline_after(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                             double proper_time);

/* Computes the place. Returns false if the observer has fallen as far as a camera can. */
bool kd_worldline_goes_on(const struct kd_observer_motion *motion, const struct kd_vantage *at);

#endif
