/* What is asked of one orbit, and of all of a request. Plain values, any thread. */
#ifndef KD_ORBIT_ASKED_H
#define KD_ORBIT_ASKED_H

#include "physics/spacetime/observer.h"

#include <stdbool.h>
#include <stdint.h>

#define KD_ORBIT_SAMPLES_MAX 200000u /* of one orbit; of all together where there are many */

enum kd_orbit_form { KD_ORBIT_SHAPE, KD_ORBIT_CONSTANTS, KD_ORBIT_STATE, KD_ORBIT_CASE, KD_ORBIT_FORMS };

enum kd_orbit_case { KD_CASE_MERCURY, KD_CASE_ZOOM_WHIRL, KD_CASE_PLUNGE, KD_CASE_ISCO, KD_CASE_SPHERICAL, KD_CASES };

enum kd_orbit_way { KD_WAY_YOSHIDA6, KD_WAY_RKN6, KD_WAY_CLOSED, KD_WAYS };
const char *kd_orbit_way_name(enum kd_orbit_way way); /* "yoshida6", "rkn6", "closed" */

struct kd_orbit_spec {
    enum kd_orbit_form form;
    double spin; /* NAN: that of the request, or the case's own */
    double p, e, inclination_deg;
    double energy, momentum, carter, r; /* r: NAN if not given */
    bool outward;
    double place_r, theta_deg, phi_deg, v[3];
    enum kd_observer frame;
    enum kd_orbit_case named;
    unsigned seen; /* which fields were given, a bit each */
};

struct kd_orbit_params {
    double spin; /* NAN if not given: 0, or the case's own */
    double periods,
        time;     /* the duration: radial periods (turns, if r is constant), or t in M; NAN but for at most one */
    bool or_end;  /* what has no periods, for it plunges or escapes, is followed to its end instead of being refused */
    double r_max; /* where what escapes is let go, 100 */
    double tolerance; /* relative error of a radial period, 1e-12; chooses the step where `steps` is 0 */
    double mass_msun; /* for times in seconds; NAN: none */
    uint32_t steps;   /* per radial period */
    uint32_t samples; /* 0: no series */
    uint32_t digits;  /* significant, of the series' numbers as text */
    enum kd_orbit_way way;
    bool series; /* of many orbits */
    struct kd_orbit_observer {
        double r, inclination_deg, azimuth_deg; /* inclination_deg: NAN: nobody looks */
        enum kd_observer motion;
    } seen; /* by whom */
};
static inline bool kd_orbit_is_seen(const struct kd_orbit_params *params)
{
    return params->seen.inclination_deg == params->seen.inclination_deg;
}

#endif
