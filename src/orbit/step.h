/* Chooses step sizes for orbits. Private to src/orbit. */
#ifndef KD_ORBIT_STEP_H
#define KD_ORBIT_STEP_H

#include "orbit/run_state.h"

/* Rough estimate of the largest phase velocity of the motion per Mino time, from which the first step is chosen. */
double kd_orbit_pace(const struct kd_orbit *orbit);

/* Sets run->h and run->error_estimate such that the run meets run->params->tolerance. n is 1, or up to KD_ORBIT_LANES
 * for runs that kd_orbit_lanes_take. */
void kd_orbit_choose_steps(struct kd_orbit_run *const *runs, int n);

#endif
