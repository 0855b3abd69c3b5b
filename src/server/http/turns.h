/* Cooperative task scheduler: a few workers run slices of long tasks in turn, so that a short task does not wait for a
 * long one. A slice returns after some 10 ms. A function that it calls may also be suspended in the middle
 * (base/pause.h); it then keeps its thread, while as many other threads as there are workers go on. */
#ifndef KD_SERVER_HTTP_TURNS_H
#define KD_SERVER_HTTP_TURNS_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* How a turn of a job ended. */
enum kd_turn_end {
    KD_TURN_MORE, /* there is more to do */
    KD_TURN_PARK, /* wait for kd_turns_wake, kd_turns_cancel or the job's due_ms, then continue */
    KD_TURN_AWAY, /* wait for kd_turns_wake alone: another thread uses the job meanwhile */
    KD_TURN_LAST, /* nothing is left to begin */
};

struct kd_turns_job {
    enum kd_turn_end (*turn)(struct kd_turns_job *job); /* runs one slice; on a worker */
    void (*done)(struct kd_turns_job *job); /* called once on a worker when every turn has returned; may free the job */
    double due_ms;                          /* end of the next park on kd_clock_ms; 0: parked without a time limit */
    bool shared;            /* several workers may run turns at once, from the next turn on; a turn may set it */
    char client[KD_CLIENT]; /* the client that kd_turns_admit was asked about */
    /* private to the scheduler */
    struct kd_turns_job *next, *next_accepted, **accepted_at;
    bool listed, parked, away, woken, over;
    unsigned workers, paused; /* turns under way, and those of them that are suspended */
};

struct kd_turns;

/* limit: unfinished jobs; share: those of one client. */
enum kd_status kd_turns_create(unsigned limit, unsigned share, struct kd_turns **out, struct kd_error *error);
/* All jobs must be finished. Accepts NULL. */
void kd_turns_destroy(struct kd_turns *turns);

/* Tests whether the client may add a job: KD_OK or KD_EBUSY. *quota: it is the client's share that is used up.
 * Submitting thread. */
enum kd_status kd_turns_admit(struct kd_turns *turns, const char *client, bool *quota, struct kd_error *error);
void kd_turns_push(struct kd_turns *turns, struct kd_turns_job *job);
/* Ends a park, also one that a turn under way is about to request. The job must not be done. Any thread. */
void kd_turns_wake(struct kd_turns *turns, struct kd_turns_job *job);
unsigned kd_turns_unfinished(struct kd_turns *turns);

/* Makes kd_turns_cancelled true, which jobs poll in their turns, and ends all parks but KD_TURN_AWAY. Any thread. */
void kd_turns_cancel(struct kd_turns *turns);
bool kd_turns_cancelled(struct kd_turns *turns);

#endif
