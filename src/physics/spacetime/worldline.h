/* How an observer goes on by its own clock: those that stay, those that go round, and what falls. Double precision,
 * pure, any thread. G = c = M = 1. */
#ifndef KD_PHYSICS_SPACETIME_WORLDLINE_H
#define KD_PHYSICS_SPACETIME_WORLDLINE_H

#include "physics/spacetime/observer.h"

/* Whether this knows its path: at a finite radius, at a latitude that stays; not of a velocity of its own choice. */
bool kd_worldline_is_known(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* What comes of `proper_time`, 0 or more. azimuth in radians and time are those gained: of what falls in ingoing
 * Kerr-Schild coordinates, of others in those of Boyer and Lindquist, which at one radius go on alike. far_time: in
 * the latter of all; INFINITY of what falls from the horizon on. */
struct kd_worldline_place {
    double r, azimuth, time, far_time;
    bool ended; /* it falls no further */
};
struct kd_worldline_place kd_worldline_after(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                             double proper_time);

/* Whether it goes on: not what has fallen as far as a camera can. */
bool kd_worldline_goes_on(const struct kd_observer_motion *motion, const struct kd_vantage *at);

#endif
