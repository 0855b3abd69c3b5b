/* Cooperative task scheduler. A few workers run slices of long tasks in turn, so that a short task need not wait for
 * a long one to end. A slice returns after some 10 ms. It may also be suspended in the middle of a function
 * (base/pause.h). While it is suspended it occupies its thread, and another thread takes over as a worker, so that
 * the number of running workers stays the same. */
#ifndef KD_SERVER_HTTP_TASK_SCHEDULER_H
#define KD_SERVER_HTTP_TASK_SCHEDULER_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* How a slice of a job has ended. */
enum kd_slice_result {
    KD_SLICE_MORE, /* the job needs another slice */
    KD_SLICE_PARK, /* the job waits for kd_scheduler_wake, for kd_scheduler_cancel, or until its due_ms */
    KD_SLICE_AWAY, /* the job waits for kd_scheduler_wake only, because another thread uses it in the meantime */
    KD_SLICE_LAST, /* the job is finished */
};

struct kd_scheduler_job {
    enum kd_slice_result (*turn)(struct kd_scheduler_job *job); /* runs one slice, on a worker */
    void (*done)(
        struct kd_scheduler_job *job); /* called once, on a worker, when all slices have returned; may free the job */
    /* Returns true if nobody waits for the job's result any more; kd_pause then returns true until the slice ends.
     * It is called on the slice's thread, without a lock. NULL: the result is always wanted. */
    bool (*unwanted)(struct kd_scheduler_job *job);
    /* time on the clock of kd_clock_ms when a parked job is resumed; 0: only by kd_scheduler_wake or
     * kd_scheduler_cancel */
    double due_ms;
    /* true if several workers may run slices of the job at the same time; a slice may set this, and it applies from
     * the next slice on */
    bool shared;
    char client[KD_CLIENT]; /* name of the client, as passed to kd_scheduler_admit */
    /* The following members are private to the scheduler. */
    struct kd_scheduler_job *next, *next_accepted, **accepted_at;
    bool listed, parked, away, woken, over;
    unsigned workers, paused; /* workers: number of slices in progress; paused: number of these that are suspended */
};

struct kd_scheduler;

/* limit: maximum number of unfinished jobs; share: maximum number of unfinished jobs of one client */
enum kd_status kd_scheduler_create(unsigned limit, unsigned share, struct kd_scheduler **out, struct kd_error *error);
/* All jobs must be finished before this call. Accepts NULL. */
void kd_scheduler_destroy(struct kd_scheduler *scheduler);

/* Tests whether the client may add a job: KD_OK or KD_EBUSY. *quota: true if the limit that was reached is the
 * client's share. Must be called by the thread that adds the job. */
enum kd_status kd_scheduler_admit(struct kd_scheduler *scheduler, const char *client, bool *quota,
                                  struct kd_error *error);
void kd_scheduler_push(struct kd_scheduler *scheduler, struct kd_scheduler_job *job);
/* Wakes a parked job. If its current slice is about to park it, it is not parked. The job must not be finished. Any
 * thread. */
void kd_scheduler_wake(struct kd_scheduler *scheduler, struct kd_scheduler_job *job);
unsigned kd_scheduler_unfinished(struct kd_scheduler *scheduler);

/* From this call on, kd_scheduler_cancelled returns true; jobs call that function in their slices. Resumes all
 * parked jobs, except those that have returned KD_SLICE_AWAY. Any thread. */
void kd_scheduler_cancel(struct kd_scheduler *scheduler);
bool kd_scheduler_cancelled(struct kd_scheduler *scheduler);

#endif
