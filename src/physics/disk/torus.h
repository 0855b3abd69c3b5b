/* This is the torus of L. G. Fishbone & V. Moncrief 1976 (ApJ 207, 962): gas in equilibrium whose l = u^t u_phi is
 * the same everywhere; h is its enthalpy per rest mass. In double precision, pure, any thread. */
#ifndef KD_PHYSICS_DISK_TORUS_H
#define KD_PHYSICS_DISK_TORUS_H

#include "physics/spacetime/hole.h"

struct kd_torus {
    double l;        /* u^t u_phi, that of the circular orbit where the pressure is largest */
    double edge;     /* what ln h has too much, so that it is 0 at the inner edge */
    double log_most; /* ln h at the largest pressure */
    double outer;    /* M in the plane; INFINITY: it has none */
    double height;   /* the largest |cos(theta)| in it */
};

/* inner: its inner edge in the plane, between the horizon and most: where the pressure is largest, a circular orbit
 * outside the ISCO. 0.5 ms. */
struct kd_torus kd_torus_of(const struct kd_hole *hole, double inner, double most);

/* Gives ln h at a place, below 0 outside the torus. */
double kd_torus_log_enthalpy(const struct kd_torus *torus, const struct kd_hole *hole, double r, double u);

#endif
