/* Rotation of a torus in equilibrium with u^t u_phi = l everywhere (L. G. Fishbone & V. Moncrief 1976, ApJ 207,
 * 962). */
#ifndef KD_TESTS_TORUS_TURNS_H
#define KD_TESTS_TORUS_TURNS_H

#include <math.h>

/* Finds by bisection the angular velocity with u^t u_phi = l, from g_tt, g_tphi and g_phiphi. Gives u, and ln h = ln
 * u^t - l Omega up to a constant. */
static inline double torus_turns(double tt, double tp, double pp, double l, double out[4])
{
    const double omega = -tp / pp, reach = sqrt(tp * tp - tt * pp) / pp;
    double low = omega - reach, high = omega + reach, w = omega, t2 = 1;
    for (int i = 0; i < 100; i++) {
        w = 0.5 * (low + high);
        t2 = -1 / (tt + 2 * w * tp + w * w * pp);
        *(t2 > 0 && t2 * (tp + w * pp) < l ? &low : &high) = w;
    }
    out[0] = sqrt(t2);
    out[1] = out[2] = 0;
    out[3] = w * out[0];
    return log(out[0]) - l * w;
}

#endif
