/* A run follows one orbit from its start to the end that the request gives, in pieces. It may be used by one thread at
 * a time.
 */
#ifndef KD_ORBIT_RUN_H
#define KD_ORBIT_RUN_H

#include "orbit/request.h"
#include "orbit/run_state.h"

struct kd_orbit_sample {
    struct kd_orbit_place place; /* place of the body; t and phi are NAN at the horizon */
    double x, y, z;      /* Cartesian place: x, y = sqrt(r^2 + a^2) sin theta (cos phi, sin phi), z = r cos theta */
    double energy_error; /* relative error of the energy; NAN for the closed form */
    struct kd_place_image image; /* image of the body for the observer; NAN if there is none */
};

/* Makes a run. The parameters must outlive the run. Returns KD_EINVAL where kd_orbit_request_solve does. */
enum kd_status kd_orbit_run_init(struct kd_orbit_run *run, const struct kd_orbit_request *request, size_t index,
                                 struct kd_error *error);

enum kd_orbit_method kd_orbit_run_method(const struct kd_orbit_run *run);

/* Finds the end of each run, and a step that meets the tolerance. For one run this takes up to a second. Several runs
 * are tried together in SIMD lanes. Returns KD_EINVAL with the pointer "/duration" or "/method" if there is no such end
 * or step. */
enum kd_status kd_orbit_run_prepare(struct kd_orbit_run *const *runs, size_t n, struct kd_error *error);

/* Advances by up to `steps` steps and up to `room` samples. Returns the number of samples written. */
size_t kd_orbit_run_advance(struct kd_orbit_run *run, uint64_t steps, struct kd_orbit_sample *samples, size_t room);
/* kd_orbit_run_abreast: true if a run can be advanced in SIMD lanes: it is prepared and has no samples.
 * kd_orbit_run_advance_abreast: advances up to KD_ORBIT_LANES such runs. */
bool kd_orbit_run_abreast(const struct kd_orbit_run *run);
void kd_orbit_run_advance_abreast(struct kd_orbit_run *const *runs, int n, uint64_t steps);
bool kd_orbit_run_done(const struct kd_orbit_run *run);
double kd_orbit_run_fraction(const struct kd_orbit_run *run);

/* Measured advance of the periastron: the azimuth gained beyond a full turn between successive periastra, as a mean
 * over all periastra so far. NAN before the second periastron. */
double kd_orbit_run_advance_measured(const struct kd_orbit_run *run);

#endif
