/* Named example orbits. Any thread. */
#ifndef KD_ORBIT_CASES_H
#define KD_ORBIT_CASES_H

#include "orbit/asked.h"

/* The spec of a case in numbers, if the hole exists. spin NAN: the case's own spin is used, and the result contains
 * it. */
struct kd_orbit_spec kd_orbit_case_spec(enum kd_orbit_case which, struct kd_hole_given given);
double kd_orbit_case_mass_msun(enum kd_orbit_case which); /* returns NAN if the case has none */

#endif
