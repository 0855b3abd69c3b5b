/* These orbits are known by name. Any thread. */
#ifndef KD_ORBIT_CASES_H
#define KD_ORBIT_CASES_H

#include "orbit/asked.h"

const char *kd_orbit_case_name(enum kd_orbit_case which);

/* A spec that says in numbers what the case is. spin: NAN for the case's own, which is then in the result. */
struct kd_orbit_spec kd_orbit_case_spec(enum kd_orbit_case which, double spin);
double kd_orbit_case_mass_msun(enum kd_orbit_case which); /* NAN: none */

#endif
