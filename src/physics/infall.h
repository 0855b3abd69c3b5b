/* This reads the clock of what falls freely into Kerr: proper time by quadrature of Sigma/(Sigma r'). Double precision, pure, any thread.
 * G = c = M = 1. */
#ifndef KD_PHYSICS_INFALL_H
#define KD_PHYSICS_INFALL_H

#include "physics/observer.h"

/* Whether its latitude stays, so that the radius alone tells the clock's time: for rain, without spin, in the equatorial plane and on the axis. */
bool kd_infall_is_level(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* Proper time from `at` to the radius r below it, of an infall that exists there and is level. The inner horizon, or r = 0 without spin, is where
 * it may be asked for at last. Relative error some 1e-14, next to fall_from 1e-12. For rain in Schwarzschild (2 at^3/2 - 2 r^3/2)/(3 sqrt 2). */
double kd_infall_proper_time(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r);

#endif
