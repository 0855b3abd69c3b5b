/* Cooperative task scheduler: a few workers run slices of long tasks in turn, so that a short task does not wait for a
 * long one. A slice returns after some 10 ms. A function that it calls may also be suspended in the middle
 * (base/pause.h); it then keeps its thread, while as many other threads as there are workers go on. */
#ifndef KD_SERVER_HTTP_TASK_SCHEDULER_H
#define KD_SERVER_HTTP_TASK_SCHEDULER_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* How a turn of a job ended. */
enum kd_slice_result {
    KD_SLICE_MORE, /* there is more to do */
    KD_SLICE_PARK, /* wait for kd_scheduler_wake, kd_scheduler_cancel or the job's due_ms, then continue */
    KD_SLICE_AWAY, /* wait for kd_scheduler_wake alone: another thread uses the job meanwhile */
    KD_SLICE_LAST, /* nothing is left to begin */
};

struct kd_scheduler_job {
    enum kd_slice_result (*turn)(struct kd_scheduler_job *job); /* runs one slice; on a worker */
    void (*done)(
        struct kd_scheduler_job *job); /* called once on a worker when every turn has returned; may free the job */
    double due_ms;                     /* end of the next park on kd_clock_ms; 0: parked without a time limit */
    bool shared;            /* several workers may run turns at once, from the next turn on; a turn may set it */
    char client[KD_CLIENT]; /* the client that kd_scheduler_admit was asked about */
    /* private to the scheduler */
    struct kd_scheduler_job *next, *next_accepted, **accepted_at;
    bool listed, parked, away, woken, over;
    unsigned workers, paused; /* turns under way, and those of them that are suspended */
};

struct kd_scheduler;

/* limit: unfinished jobs; share: those of one client. */
enum kd_status kd_scheduler_create(unsigned limit, unsigned share, struct kd_scheduler **out, struct kd_error *error);
/* All jobs must be finished. Accepts NULL. */
void kd_scheduler_destroy(struct kd_scheduler *turns);

/* Tests whether the client may add a job: KD_OK or KD_EBUSY. *quota: it is the client's share that is used up.
 * Submitting thread. */
enum kd_status kd_scheduler_admit(struct kd_scheduler *turns, const char *client, bool *quota, struct kd_error *error);
void kd_scheduler_push(struct kd_scheduler *turns, struct kd_scheduler_job *job);
/* Ends a park, also one that a turn under way is about to request. The job must not be done. Any thread. */
void kd_scheduler_wake(struct kd_scheduler *turns, struct kd_scheduler_job *job);
unsigned kd_scheduler_unfinished(struct kd_scheduler *turns);

/* Makes kd_scheduler_cancelled true, which jobs poll in their turns, and ends all parks but KD_SLICE_AWAY. Any thread.
 */
void kd_scheduler_cancel(struct kd_scheduler *turns);
bool kd_scheduler_cancelled(struct kd_scheduler *turns);

#endif
