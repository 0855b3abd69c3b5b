/* Gravity of the hole on bodies: the potential of Paczynski and Wiita. Pure functions, any thread; units G = c = M =
 * 1.
 *
 * Phi = -1/(r - 2) (B. Paczynski & P. Wiita 1980, A&A 88, 23). With Newton's kinetic energy v^2/2 it has exactly
 * Schwarzschild's last stable orbit, 6, and marginally bound orbit, 4. The potential does not limit speeds: a body that
 * falls from rest far away reaches c at r = 4. The integrator caps speeds at 1, and counts the energy that the cap
 * removes. */
#ifndef KD_PLAYGROUND_HOLE_H
#define KD_PLAYGROUND_HOLE_H

#include <math.h>

#define KD_PLAYGROUND_HORIZON 2. /* r_s */
/* radius within which bodies are captured; it is large enough that sub-steps never reach the horizon */
#define KD_PLAYGROUND_CAPTURE 2.05

static inline double kd_playground_radius(const double x[3]) { return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

static inline double kd_playground_potential(double r) { return -1 / (r - KD_PLAYGROUND_HORIZON); }

/* The acceleration at the position x is this factor times x. */
static inline double kd_playground_pull(double r)
{
    return -1 / (r * (r - KD_PLAYGROUND_HORIZON) * (r - KD_PLAYGROUND_HORIZON));
}

/* Speed v of a circular orbit, with v^2 = r/(r - 2)^2. */
static inline double kd_playground_circular(double r) { return sqrt(r) / (r - KD_PLAYGROUND_HORIZON); }

/* Energy per mass of a body in the hole's field, without mutual gravity. */
static inline double kd_playground_specific(const double x[3], const double v[3])
{
    return 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + kd_playground_potential(kd_playground_radius(x));
}

#endif
