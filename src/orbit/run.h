/* A run follows one orbit from its start to the end of what was asked for, in pieces. A run belongs to one thread at
 * a time. */
#ifndef KD_ORBIT_RUN_H
#define KD_ORBIT_RUN_H

#include "orbit/request.h"
#include "physics/orbit_lanes.h"
#include "physics/place_image.h"

struct kd_orbit_sample {
    struct kd_orbit_place place; /* t and phi NAN at the horizon */
    double x, y, z;              /* sqrt(r^2 + a^2) sin theta (cos phi, sin phi), r cos theta */
    double energy_error;         /* relative; NAN in closed form */
    struct kd_place_image image; /* as it is seen; NAN where there is none, or nobody looks */
};

enum kd_orbit_end { KD_END_DURATION, KD_END_HORIZON, KD_END_FAR };
const char *kd_orbit_end_name(enum kd_orbit_end end); /* "duration", "horizon", "r_max" */

struct kd_orbit_run {
    /* from the beginning */
    const struct kd_orbit_params *params;
    struct kd_orbit orbit;
    struct kd_orbit_state start;
    double phi;       /* at the start */
    double mass_msun; /* NAN: none */
    double rounding;  /* as kd_orbit_request_solve */
    bool closed;      /* has a closed form: fate BOUND. Else `bound`, `frequencies` and period are not set */
    struct kd_orbit_bound bound;
    struct kd_orbit_frequencies frequencies;
    double period; /* Mino time of a radial period; of a turn in phi where r is constant */
    /* after kd_orbit_run_prepare */
    enum kd_orbit_end end;
    double mino_end, h;
    double aim; /* of a path that is not bound, 1/r or t of its last place; NAN if it ends when its time is over */
    uint64_t steps, done;
    uint32_t samples, sampled;
    double error_estimate; /* relative, of the place after a period (or the whole path): from half as many steps, or
                            * `rounding` if that is larger. NAN if neither is known: `steps` was given, or the closed
                            * form, and no whirl ahead */
    /* while it goes on */
    struct kd_orbit_path path;
    struct kd_orbit_drift worst; /* absolute values */
    uint64_t periastra;
    double first_phi, last_phi;  /* azimuth at periastra */
    struct kd_place_view view;   /* of who looks */
    struct kd_place_image image; /* the latest that was found */
    unsigned missed;             /* samples since then */
};

/* params must outlive the run. KD_EINVAL as kd_orbit_request_solve. */
enum kd_status kd_orbit_run_init(struct kd_orbit_run *run, const struct kd_orbit_request *request, size_t index,
                                 struct kd_error *error);

enum kd_orbit_method kd_orbit_run_method(const struct kd_orbit_run *run);

/* Finds the end, and a step that holds the tolerance; takes up to a second for one, and tries some of many abreast.
 * KD_EINVAL, pointer "/duration" or "/method", if it cannot be done. */
enum kd_status kd_orbit_run_prepare(struct kd_orbit_run *const *runs, size_t n, struct kd_error *error);

/* Up to `steps` steps and `room` samples on; returns how many samples were written. */
size_t kd_orbit_run_advance(struct kd_orbit_run *run, uint64_t steps, struct kd_orbit_sample *samples, size_t room);
/* The same for up to KD_ORBIT_LANES runs side by side, all of which kd_orbit_run_abreast admits: prepared, and
 * without samples. */
bool kd_orbit_run_abreast(const struct kd_orbit_run *run);
void kd_orbit_run_advance_abreast(struct kd_orbit_run *const *runs, int n, uint64_t steps);
bool kd_orbit_run_done(const struct kd_orbit_run *run);
double kd_orbit_run_fraction(const struct kd_orbit_run *run);

/* Azimuth between periastra beyond a full turn, averaged over those passed; NAN before the second. */
double kd_orbit_run_advance_measured(const struct kd_orbit_run *run);

#endif
