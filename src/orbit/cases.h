/* Named example orbits. Any thread. */
#ifndef KD_ORBIT_CASES_H
#define KD_ORBIT_CASES_H

#include "orbit/asked.h"

/* The orbit of a named case in numbers, if the hole exists. If the given spin is NAN, the result contains the spin of
 * the case. */
struct kd_orbit_spec kd_orbit_case_spec(enum kd_orbit_case which, struct kd_hole_given given);
double kd_orbit_case_mass_msun(enum kd_orbit_case which); /* Mass of the case's hole; NAN if the case has none. */

#endif
