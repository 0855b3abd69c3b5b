/* Chooses how long a step may be. Private to src/orbit. */
#ifndef KD_ORBIT_STEP_H
#define KD_ORBIT_STEP_H

#include "orbit/run_state.h"

/* The fastest phase of the motion per Mino time, roughly: to choose a first step by. */
double kd_orbit_pace(const struct kd_orbit *orbit);

/* Sets run->h by run->params->tolerance, and run->error_estimate, of one run or of up to KD_ORBIT_LANES that
 * kd_orbit_lanes_take. */
void kd_orbit_choose_steps(struct kd_orbit_run *const *runs, int n);

#endif
