/* A batch is many orbits, followed a few at a time by any thread that has time. */
#ifndef KD_ORBIT_BATCH_H
#define KD_ORBIT_BATCH_H

#include "orbit/run.h"

#include <stdatomic.h>

struct kd_orbit_batch {
    /* read only; to be read when it is done */
    const struct kd_orbit_request *request;
    struct kd_orbit_run *runs;
    struct kd_orbit_sample *samples; /* NULL without series */
    size_t n;
    bool (*stop)(void *user); /* asked now and then by whoever is at work, unless NULL: true gives the batch up */
    void *user;
    /* its own */
    _Atomic size_t next, finished;
    _Atomic bool failed;
    struct kd_error error; /* of the first that failed, once it is done */
};

/* Every orbit is checked here: some microseconds each. The request must outlive the batch. */
enum kd_status kd_orbit_batch_init(struct kd_orbit_batch *batch, const struct kd_orbit_request *request,
                                   struct kd_error *error);
void kd_orbit_batch_finish(struct kd_orbit_batch *batch);
size_t kd_orbit_batch_bytes(const struct kd_orbit_request *request);

/* Follow the next few orbits to their ends; false if there are none left to begin. Any thread, several at once. */
bool kd_orbit_batch_turn(struct kd_orbit_batch *batch);
bool kd_orbit_batch_done(const struct kd_orbit_batch *batch); /* all that was begun, and no more will be */

#endif
