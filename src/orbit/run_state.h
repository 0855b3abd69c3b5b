/* The state of a run (run.h). */
#ifndef KD_ORBIT_RUN_STATE_H
#define KD_ORBIT_RUN_STATE_H

#include "orbit/asked.h"
#include "physics/null/place_image.h"
#include "physics/orbit/orbit_lanes.h"

enum kd_orbit_end { KD_END_DURATION, KD_END_HORIZON, KD_END_FAR };
const char *kd_orbit_end_name(enum kd_orbit_end end); /* Name of an end: "duration", "horizon" or "r_max". */

struct kd_orbit_run {
    /* The next members are set by kd_orbit_run_init. */
    const struct kd_orbit_params *params;
    struct kd_orbit orbit;
    struct kd_orbit_state start;
    double phi;       /* azimuth at the start */
    double mass_msun; /* mass of the hole; NAN if there is none */
    double rounding;  /* result of kd_orbit_request_solve */
    /* true if the fate is BOUND, so that the motion has a closed form; otherwise `bound`, `frequencies` and
     * `period` are not set */
    bool closed;
    struct kd_orbit_bound bound;
    struct kd_orbit_frequencies frequencies;
    double period; /* Mino time of a radial period or, if r is constant, of a turn in phi */
    /* The next members are set by kd_orbit_run_prepare. */
    enum kd_orbit_end end;
    double mino_end, h;
    double aim; /* 1/r, or t, at the end of an unbound path; NAN if the path ends because its duration is over */
    uint64_t steps, done;
    uint32_t samples, sampled;
    /* Relative error of the place after a radial period, or at the end of an unbound path. It is estimated from a run
     * with half the number of steps, and is at least `rounding`. NAN if neither is known: without a whirl, if `steps`
     * was given or the closed form is used. */
    double error_estimate;
    /* The next members change in kd_orbit_run_advance. */
    struct kd_orbit_path path;
    struct kd_orbit_drift worst; /* largest absolute drifts so far */
    uint64_t periastra;
    double first_phi, last_phi;  /* azimuths at the first and at the last periastron */
    struct kd_place_view view;   /* the observer's view, in which images are found */
    struct kd_place_image image; /* the image that was found last */
    unsigned missed;             /* number of samples since an image was last found */
};

#endif
