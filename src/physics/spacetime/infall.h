/* Free fall into a Kerr hole: proper time, azimuth and coordinate time, by quadrature of Sigma/(Sigma r') and similar
 * integrands. Double precision, pure, any thread. G = c = M = 1. */
#ifndef KD_PHYSICS_SPACETIME_INFALL_H
#define KD_PHYSICS_SPACETIME_INFALL_H

#include "physics/spacetime/hole.h"
#include "physics/spacetime/observer.h"

/* True if the fall stays at its latitude, so that proper time is a function of the radius alone. This holds for rain,
 * for holes without spin, in the equatorial plane, and on the axis. */
bool kd_infall_is_level(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* Proper time from `at` down to the radius r. The infall must exist at `at`, and must be level. The smallest allowed r
 * is the inner horizon, or 0 without spin. The relative error is some 1e-14, and 1e-12 next to fall_from. For rain in
 * Schwarzschild the time is (2 at^3/2 - 2 r^3/2)/(3 sqrt 2). */
double kd_infall_proper_time(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r);

/* A fall down to the radius r. azimuth (radians), time: increases of phi + integral of a/Delta dr and of t + integral
 * of 2r/Delta dr, which are ingoing Kerr-Schild coordinates and are regular at the outer horizon. far_time: increase of
 * the Boyer-Lindquist time; INFINITY from the horizon on. */
struct kd_infall_way {
    double r, azimuth, time, far_time;
    bool ended; /* true if the body has reached kd_infall_last, or was beyond it */
};
struct kd_infall_way kd_infall_way(const struct kd_observer_motion *motion, const struct kd_vantage *at, double r);

/* The fall after a proper time, which must be >= 0. r is the inverse of kd_infall_proper_time, and has the same error.
 */
struct kd_infall_way kd_infall_after(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                     double proper_time);

/* Smallest radius of a falling camera. It is just outside the radius at which the model ends, because pictures have no
 * defined limit at that radius. */
double kd_infall_last(const struct kd_hole *hole);

#endif
