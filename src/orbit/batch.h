/* A batch: many orbits, followed a few at a time by any number of threads. */
#ifndef KD_ORBIT_BATCH_H
#define KD_ORBIT_BATCH_H

#include "orbit/run.h"

#include <stdatomic.h>

struct kd_orbit_batch {
    /* results; read them only when the batch is done */
    const struct kd_orbit_request *request;
    struct kd_orbit_run *runs;
    struct kd_orbit_sample *samples; /* NULL without series */
    size_t n;
    /* polled by the worker threads, unless it is NULL; if it returns true, the batch is abandoned */
    bool (*stop)(void *user);
    void *user;
    /* private */
    _Atomic size_t next, finished;
    _Atomic bool failed;
    struct kd_error error; /* error of the first orbit that failed; valid once the batch is done */
};

/* Solves every orbit, some microseconds each. The request must outlive the batch. */
enum kd_status kd_orbit_batch_init(struct kd_orbit_batch *batch, const struct kd_orbit_request *request,
                                   struct kd_error *error);
void kd_orbit_batch_finish(struct kd_orbit_batch *batch);
size_t kd_orbit_batch_bytes(const struct kd_orbit_request *request);

/* Follows the next few orbits to their ends; false if none are left to begin. Any thread, several at once. */
bool kd_orbit_batch_turn(struct kd_orbit_batch *batch);
/* true when nothing is running and nothing more will be started */
bool kd_orbit_batch_done(const struct kd_orbit_batch *batch);

#endif
