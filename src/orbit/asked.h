/* A request for orbits as plain values: one orbit, and the parameters that all orbits share. Any thread. */
#ifndef KD_ORBIT_ASKED_H
#define KD_ORBIT_ASKED_H

#include "physics/spacetime/observer.h"
#include "physics/spacetime/parameters.h"

#include <stdbool.h>
#include <stdint.h>

/* limit of the number of samples of one orbit, and of all orbits of a request together */
#define KD_ORBIT_SAMPLES_MAX 200000u

enum kd_orbit_form { KD_ORBIT_SHAPE, KD_ORBIT_CONSTANTS, KD_ORBIT_STATE, KD_ORBIT_CASE, KD_ORBIT_FORMS };

#define KD_ORBIT_CASE_WORDS "mercury|zoom-whirl|plunge|isco|spherical" /* words, in the order of enum kd_orbit_case */
#define KD_ORBIT_WAY_WORDS "yoshida6|rkn6|closed"
enum kd_orbit_case { KD_CASE_MERCURY, KD_CASE_ZOOM_WHIRL, KD_CASE_PLUNGE, KD_CASE_ISCO, KD_CASE_SPHERICAL, KD_CASES };

enum kd_orbit_way { KD_WAY_YOSHIDA6, KD_WAY_RKN6, KD_WAY_CLOSED, KD_WAYS };
const char *kd_orbit_way_name(enum kd_orbit_way way); /* The word for a method: "yoshida6", "rkn6" or "closed". */

struct kd_orbit_spec {
    enum kd_orbit_form form;
    /* parameters of the hole. NAN means the request's parameter. If that is NAN too, the spin is that of the named
     * case, and other parameters are 0 */
    KD_HOLE_MEMBERS
    double p, e, inclination_deg;
    /* E, L and Q, and the radius r of a point of the orbit; r is NAN if not given */
    double energy, momentum, carter, r;
    bool outward;
    double place_r, theta_deg, phi_deg, v[3];
    enum kd_observer frame;
    enum kd_orbit_case named;
    uint64_t seen; /* bit mask of the fields that were given */
};

struct kd_orbit_params {
    /* parameters of the hole; NAN if not given. A parameter that is not given is 0, except that the spin is that of the
     * named case, if there is one */
    KD_HOLE_MEMBERS
    double periods,
        /* Duration: number of radial periods (turns, if r is constant), or time t in M. At most one of the two is
         * given, and the other is NAN. */
        time;
    /* true if a plunging or escaping orbit is followed to its end; otherwise such an orbit is an error, because it has
     * no periods */
    bool or_end;
    double r_max; /* radius at which an escaping orbit ends; 100 by default */
    /* Relative error allowed in a radial period, 1e-12 by default. It determines the step if `steps` is 0. */
    double tolerance;
    double mass_msun; /* mass of the hole, by which times are converted to seconds; NAN if not given */
    uint32_t steps;   /* number of steps per radial period */
    uint32_t samples; /* number of samples of the series; 0 for no series */
    uint32_t digits;  /* number of significant digits of the series' numbers in text */
    enum kd_orbit_way way;
    bool series; /* for many orbits: true if the answer includes their series */
    struct kd_orbit_observer {
        /* place of the observer; inclination_deg is NAN if there is no observer */
        double r, inclination_deg, azimuth_deg;
        enum kd_observer motion;
    } seen; /* the observer */
};
static inline bool kd_orbit_is_seen(const struct kd_orbit_params *params)
{
    return params->seen.inclination_deg == params->seen.inclination_deg;
}

#endif
