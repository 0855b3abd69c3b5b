/* Reads requests for the orbit integrator: a JSON document, or fields by name. Any thread.
 *
 *     {"spin": 0.9, "orbit": {"p": 6, "e": 0.5, "inclination_deg": 30}, "duration": {"periods": 10}, "samples":
 *       1000,
 *     "method": "yoshida6", "tolerance": 1e-12, "seen": {"observer_r": 30, "observer_inclination_deg": 60}}
 *
 * An orbit has one of the forms
 *
 *     {"p", "e", "inclination_deg"}                                   bound, between p/(1+e) and p/(1-e)
 *     {"energy", "angular_momentum", "carter", "r", "outward"}        the last three may be left out
 *     {"position": {"r", "theta_deg", "phi_deg"}, "velocity": {"frame", "v_r", "v_theta", "v_phi"}}
 *     {"case"}                                                        "mercury", "zoom-whirl", "plunge", "isco",
 *       "spherical"
 *
 * An orbit may have its own "spin" and "charge". Instead of "orbit" a request may have "orbits", an array of up to
 * KD_ORBITS_MAX orbits. The answer then has a summary of each orbit, and the series if "series" is true. */
#ifndef KD_ORBIT_REQUEST_H
#define KD_ORBIT_REQUEST_H

#include "base/error.h"
#include "orbit/asked.h"
#include "physics/orbit/orbit_path.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_ORBITS_MAX 10000u
#define KD_ORBIT_BODY_MAX ((size_t)4 << 20) /* largest size of a document, bytes */
/* Largest number of samples if there is an observer. Each sample takes some 2 ms. A stream ends when its client
 * disconnects. */
#define KD_ORBIT_SEEN_MAX 20000u
#define KD_ORBIT_ROUNDING_MAX 1e-3
#define KD_ORBIT_STEPS_MAX 1000000000. /* largest number of steps of one orbit, which take five minutes */

struct kd_orbit_request {
    struct kd_orbit_params params;
    struct kd_orbit_spec *specs; /* malloc'd */
    size_t n;
    bool many; /* true if the orbits were given as "orbits" */
};

void kd_orbit_request_init(struct kd_orbit_request *request);
void kd_orbit_request_finish(struct kd_orbit_request *request);

/* Merges a document into a request that has no orbits yet. The function checks types and ranges, but not whether each
 * orbit exists. If the text is not a JSON document, it returns KD_EINVAL and leaves the error's pointer empty. */
enum kd_status kd_orbit_request_json(struct kd_orbit_request *request, const char *text, size_t length,
                                     struct kd_error *error);

/* Sets one parameter of the request, or one field of the orbit, by the last part of its name. The orbit is
 * request->specs[0]; setting its first field creates it. */
enum kd_status kd_orbit_request_set(struct kd_orbit_request *request, const char *name, const char *text,
                                    struct kd_error *error);
/* Checks that there is a complete orbit. Call it after the last kd_orbit_request_set. */
enum kd_status kd_orbit_request_check(const struct kd_orbit_request *request, struct kd_error *error);

/* Solves for the motion that a spec describes. If it returns KD_EINVAL, the error has the pointer within the request,
 * such as "/orbits/17/p". The result does not include the initial azimuth. *rounding matters for a whirl, which is
 * close to an unstable circular orbit: it is the error of the path that rounding of the constants of motion causes,
 * relative to the whole path. If this exceeds KD_ORBIT_ROUNDING_MAX, the orbit is refused. */
enum kd_status kd_orbit_request_solve(const struct kd_orbit_request *request, size_t index, struct kd_orbit *orbit,
                                      struct kd_orbit_state *start, double *rounding, struct kd_error *error);

#endif
