/* Ringdown of a quasi-normal mode (physics/waves/qnm.h): quality factor, damped oscillation, and two published fits
 * that are used in place of the mode itself. Double precision, pure functions, any thread. Times in M, omega as M
 * omega. */
#ifndef KD_PHYSICS_WAVES_RINGDOWN_H
#define KD_PHYSICS_WAVES_RINGDOWN_H

#include "physics/spacetime/hole.h"

#include <complex.h>

/* Quality factor Q = Re(omega) / (-2 Im(omega)): half the phase, in radians, over which the amplitude decreases by the
 * factor e. */
double kd_ringdown_quality(double complex omega);

/* e^(Im(omega) t) cos(Re(omega) t) for t >= 0. t counts from the start, where the wave is 1. */
double kd_ringdown_wave(double complex omega, double t);

/* 2.1 + 11.3 a^3, a commonly used fit of Q for the fundamental mode l = m = 2, whose source could not be found. Its
 * error is below 4.1 % only for a < 0.33; its errors are +30 % at 0.5, +104 % at 0.8 and -71 % at 0.999. It is given
 * for comparison. */
double kd_ringdown_quality_cubic(const struct kd_hole *hole);

/* Fits of Berti, Cardoso & Will 2006, Phys. Rev. D 73, 064030, table VIII, for l = m = 2, n = 0, 1, 2 and 0 <= a < 1
 * (otherwise NaN):
 *   Re(omega) = f1 + f2 (1 - a)^f3,   Q = q1 + q2 (1 - a)^q3.
 * Error for a <= 0.99, measured against the modes: Re(omega) 1.9, 1.6, 1.9 %, Q 0.9, 1.7, 2.5 % for n = 0, 1, 2. */
struct kd_ringdown_fit { double omega_re, quality; };
struct kd_ringdown_fit kd_ringdown_fit(int n, const struct kd_hole *hole);

#endif
