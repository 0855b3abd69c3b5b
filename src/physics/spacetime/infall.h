/* Reads the clock and the way of what falls freely into Kerr, by quadrature of Sigma/(Sigma r') and the like.
 * Double precision, pure, any thread. G = c = M = 1. */
#ifndef KD_PHYSICS_SPACETIME_INFALL_H
#define KD_PHYSICS_SPACETIME_INFALL_H

#include "physics/spacetime/hole.h"
#include "physics/spacetime/observer.h"

/* Whether its latitude stays, so that the radius alone tells the clock's time: for rain, without spin, in the
 * equatorial plane and on the axis. */
bool kd_infall_is_level(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* Proper time from `at` to the radius r below it, of an infall that exists there and is level. The inner horizon, or
 * r = 0 without spin, is where it may be asked for at last. Relative error some 1e-14, next to fall_from 1e-12. For
 * rain in Schwarzschild (2 at^3/2 - 2 r^3/2)/(3 sqrt 2). */
double kd_infall_proper_time(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r);

/* Where it is then, and what has passed on the way: azimuth, radians, and coordinate time of ingoing Kerr-Schild
 * coordinates, which know no outer horizon: phi + integral of a/Delta dr, t + integral of 2r/Delta dr. far_time:
 * that of Boyer and Lindquist; INFINITY from the horizon on. */
struct kd_infall_way {
    double r, azimuth, time, far_time;
    bool ended; /* it is at kd_infall_last, or was beyond it */
};
struct kd_infall_way kd_infall_way(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r);

/* The same after so much proper time, 0 or more. r is where kd_infall_proper_time says so, to its error. */
struct kd_infall_way kd_infall_after(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                     double proper_time);

/* The last radius of a camera that falls: next to where the model ends, at which pictures have no limit. */
double kd_infall_last(const struct kd_hole *hole);

#endif
