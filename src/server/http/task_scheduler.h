/* Cooperative task scheduler: a few workers run slices of long tasks in turn, so that a short task need not wait for
 * a long one. A slice returns after some 10 ms. A function that a slice calls may also be suspended in the middle
 * (base/pause.h). It then occupies its thread while it is suspended. Another thread replaces that thread as a
 * worker, so the number of running workers stays the same. */
#ifndef KD_SERVER_HTTP_TASK_SCHEDULER_H
#define KD_SERVER_HTTP_TASK_SCHEDULER_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* Result of a slice of a job. */
enum kd_slice_result {
    KD_SLICE_MORE, /* the job has more to do */
    KD_SLICE_PARK, /* wait for kd_scheduler_wake, kd_scheduler_cancel or the job's due_ms, then continue */
    KD_SLICE_AWAY, /* wait for kd_scheduler_wake only, because another thread uses the job meanwhile */
    KD_SLICE_LAST, /* the job is finished and has no further slice */
};

struct kd_scheduler_job {
    enum kd_slice_result (*turn)(struct kd_scheduler_job *job); /* runs one slice; on a worker */
    void (*done)(
        struct kd_scheduler_job *job); /* called once on a worker when every slice has returned; may free the job */
    /* true if nobody waits for the job's result any more; kd_pause then returns true until the slice ends. The
     * slice's thread calls it without a lock; NULL: never true */
    bool (*unwanted)(struct kd_scheduler_job *job);
    /* time on kd_clock_ms at which a parked job is resumed; 0: none */
    double due_ms;
    /* several workers may run slices of the job at once, from the next slice on; a slice may set this */
    bool shared;
    char client[KD_CLIENT]; /* the client that was passed to kd_scheduler_admit */
    /* private to the scheduler */
    struct kd_scheduler_job *next, *next_accepted, **accepted_at;
    bool listed, parked, away, woken, over;
    unsigned workers, paused; /* number of slices under way, and the number of these that are suspended */
};

struct kd_scheduler;

/* limit: largest number of unfinished jobs; share: largest number of one client's unfinished jobs */
enum kd_status kd_scheduler_create(unsigned limit, unsigned share, struct kd_scheduler **out, struct kd_error *error);
/* All jobs must be finished. Accepts NULL. */
void kd_scheduler_destroy(struct kd_scheduler *scheduler);

/* Tests whether the client may add a job: KD_OK or KD_EBUSY. *quota: true if the limit is the client's share. Called by
 * the thread that adds the job. */
enum kd_status kd_scheduler_admit(struct kd_scheduler *scheduler, const char *client, bool *quota,
                                  struct kd_error *error);
void kd_scheduler_push(struct kd_scheduler *scheduler, struct kd_scheduler_job *job);
/* Wakes a parked job. If the job's current slice is about to park it, the job is not parked. The job must not have
 * finished. Any thread. */
void kd_scheduler_wake(struct kd_scheduler *scheduler, struct kd_scheduler_job *job);
unsigned kd_scheduler_unfinished(struct kd_scheduler *scheduler);

/* Makes kd_scheduler_cancelled return true. Jobs call kd_scheduler_cancelled in their slices. Resumes all parked
 * jobs except those that returned KD_SLICE_AWAY. Any thread. */
void kd_scheduler_cancel(struct kd_scheduler *scheduler);
bool kd_scheduler_cancelled(struct kd_scheduler *scheduler);

#endif
