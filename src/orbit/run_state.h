/* The state of a run (run.h). */
#ifndef KD_ORBIT_RUN_STATE_H
#define KD_ORBIT_RUN_STATE_H

#include "orbit/asked.h"
#include "physics/null/place_image.h"
#include "physics/orbit/orbit_lanes.h"

enum kd_orbit_end { KD_END_DURATION, KD_END_HORIZON, KD_END_FAR };
const char *kd_orbit_end_name(enum kd_orbit_end end); /* "duration", "horizon", "r_max" */

struct kd_orbit_run {
    /* set by kd_orbit_run_init */
    const struct kd_orbit_params *params;
    struct kd_orbit orbit;
    struct kd_orbit_state start;
    double phi;       /* azimuth at the start */
    double mass_msun; /* NAN: none */
    double rounding;  /* result of kd_orbit_request_solve */
    bool closed; /* true if the fate is BOUND, so that the motion has a closed form; if false, `bound`, `frequencies`
                  * and `period` are not set */
    struct kd_orbit_bound bound;
    struct kd_orbit_frequencies frequencies;
    double period; /* Mino time of a radial period; if r is constant, of a turn in phi */
    /* set by kd_orbit_run_prepare */
    enum kd_orbit_end end;
    double mino_end, h;
    double aim; /* for an unbound path: 1/r or t at its end; NAN if the path ends because its duration is over */
    uint64_t steps, done;
    uint32_t samples, sampled;
    /* Relative error of the place after a period (or at the end of the whole path). The estimate is from a run with
     * half the number of steps. If `rounding` is larger, the estimate is `rounding`. NAN if neither is known:
     * `steps` was given, or the closed form is used, and there is no whirl. */
    double error_estimate;
    /* updated by kd_orbit_run_advance */
    struct kd_orbit_path path;
    struct kd_orbit_drift worst; /* absolute values */
    uint64_t periastra;
    double first_phi, last_phi;  /* azimuth at the first and the last periastron */
    struct kd_place_view view;   /* view of the observer */
    struct kd_place_image image; /* the last image found */
    unsigned missed;             /* number of samples since that image was found */
};

#endif
