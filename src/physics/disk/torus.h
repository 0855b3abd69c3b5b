/* The torus of L. G. Fishbone & V. Moncrief 1976 (ApJ 207, 962): gas in equilibrium with constant l = u^t u_phi. h is
 * the gas's enthalpy per rest mass. Double precision, pure, any thread. */
#ifndef KD_PHYSICS_DISK_TORUS_H
#define KD_PHYSICS_DISK_TORUS_H

#include "physics/spacetime/hole.h"

struct kd_torus {
    double l;        /* the torus's l: u^t u_phi of the circular orbit at the largest pressure */
    double edge;     /* constant that is subtracted from ln h so that ln h is 0 at the inner edge */
    double log_most; /* ln h at the largest pressure */
    double outer;    /* radius of the outer edge in the plane, M; INFINITY if there is no outer edge */
    double height;   /* largest |cos(theta)| of a place inside the torus */
};

/* Makes a torus, in 0.5 ms. inner: inner edge in the plane, between the horizon and `most`. most: radius of the largest
 * pressure, which must be outside the ISCO. */
struct kd_torus kd_torus_of(const struct kd_hole *hole, double inner, double most);

/* ln h at a place, which is negative outside the torus. */
double kd_torus_log_enthalpy(const struct kd_torus *torus, const struct kd_hole *hole, double r, double u);

#endif
