/* The files orbit*.c share this. Private to src/physics. */
#ifndef KD_PHYSICS_ORBIT_INTERNAL_H
#define KD_PHYSICS_ORBIT_INTERNAL_H

#include "physics/orbit_path.h"

/* K, L^2 + Q and the coefficients of W from a, E, b, L and Q. */
void kd_orbit_set_constants(struct kd_orbit *orbit);
enum kd_status kd_orbit_check_spin(double a, struct kd_error *error);

/* W = (w - w_low)(w_high - w)(g[0] + g[1] w + g[2] w^2) where both ends are turning points. */
void kd_orbit_factor(const struct kd_orbit *orbit, double g[3]);

/* Yoshida's weights w3, w2, w1, w0, and the turns of a spring in the drifts of a step of h. */
extern const double kd_orbit_kicks[4];
void kd_orbit_set_turns(struct kd_spring *spring, double h);

#endif
