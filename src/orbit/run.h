/* A run: follows one orbit from its start to the end of the request, in pieces. One thread at a time. */
#ifndef KD_ORBIT_RUN_H
#define KD_ORBIT_RUN_H

#include "orbit/request.h"
#include "orbit/run_state.h"

struct kd_orbit_sample {
    struct kd_orbit_place place; /* t and phi NAN at the horizon */
    double x, y, z;              /* sqrt(r^2 + a^2) sin theta (cos phi, sin phi), r cos theta */
    double energy_error;         /* relative; NAN for the closed form */
    struct kd_place_image image; /* image of the body for the observer; NAN if there is none */
};

/* params must outlive the run. Fails with KD_EINVAL like kd_orbit_request_solve. */
enum kd_status kd_orbit_run_init(struct kd_orbit_run *run, const struct kd_orbit_request *request, size_t index,
                                 struct kd_error *error);

enum kd_orbit_method kd_orbit_run_method(const struct kd_orbit_run *run);

/* Finds the end, and a step that meets the tolerance. Takes up to a second for one run. Several runs are tried
 * together in SIMD lanes. Returns KD_EINVAL with the pointer "/duration" or "/method" if there is no such end or
 * step. */
enum kd_status kd_orbit_run_prepare(struct kd_orbit_run *const *runs, size_t n, struct kd_error *error);

/* Advances by up to `steps` steps and `room` samples; returns the number of samples written. */
size_t kd_orbit_run_advance(struct kd_orbit_run *run, uint64_t steps, struct kd_orbit_sample *samples, size_t room);
/* Advances up to KD_ORBIT_LANES runs in SIMD lanes. All must satisfy kd_orbit_run_abreast: prepared, and without
 * samples. */
bool kd_orbit_run_abreast(const struct kd_orbit_run *run);
void kd_orbit_run_advance_abreast(struct kd_orbit_run *const *runs, int n, uint64_t steps);
bool kd_orbit_run_done(const struct kd_orbit_run *run);
double kd_orbit_run_fraction(const struct kd_orbit_run *run);

/* Azimuth between successive periastra beyond a full turn, averaged over the periastra passed; NAN before the second
 * one. */
double kd_orbit_run_advance_measured(const struct kd_orbit_run *run);

#endif
