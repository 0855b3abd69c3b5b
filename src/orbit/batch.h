/* A batch: many orbits, followed a few at a time by any number of threads. */
#ifndef KD_ORBIT_BATCH_H
#define KD_ORBIT_BATCH_H

#include "orbit/run.h"

#include <stdatomic.h>

struct kd_orbit_batch {
    /* results, which may be read only when the batch is done */
    const struct kd_orbit_request *request;
    struct kd_orbit_run *runs;
    struct kd_orbit_sample *samples; /* samples of all orbits; NULL if no series is requested */
    size_t n;
    /* function that worker threads call again and again, or NULL; when it returns true, the batch is abandoned */
    bool (*stop)(void *user);
    void *user;
    /* private */
    _Atomic size_t next, finished;
    _Atomic bool failed;
    struct kd_error error; /* error of the first orbit that failed; valid once the batch is done */
};

/* Makes a batch. Solves every orbit, which takes some microseconds each. The request must outlive the batch. */
enum kd_status kd_orbit_batch_init(struct kd_orbit_batch *batch, const struct kd_orbit_request *request,
                                   struct kd_error *error);
void kd_orbit_batch_finish(struct kd_orbit_batch *batch);
size_t kd_orbit_batch_bytes(const struct kd_orbit_request *request);

/* Follows the next few orbits to their ends. Returns false if no orbit is left to begin. Several threads may call this
 * function at once. */
bool kd_orbit_batch_turn(struct kd_orbit_batch *batch);
/* True when no orbit is being followed and none will be begun. */
bool kd_orbit_batch_done(const struct kd_orbit_batch *batch);

#endif
