/* Cooperative task scheduler: a few workers run slices of long tasks in turn, so that a short task does not wait for a
 * long one. A slice returns after some 10 ms. A function that it calls may also be suspended in the middle
 * (base/pause.h); it then keeps its thread, while as many other threads as there are workers go on. */
#ifndef KD_SERVER_HTTP_TURNS_H
#define KD_SERVER_HTTP_TURNS_H

#include "base/error.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* How a turn of a job ended: what is left to do. */
enum kd_turn_end {
    KD_TURN_MORE, /* there is another piece */
    KD_TURN_PARK, /* there is, but not before kd_turns_wake, kd_turns_cancel or the job's due_ms */
    KD_TURN_AWAY, /* there is, but not before kd_turns_wake: somebody else has it meanwhile */
    KD_TURN_LAST, /* nothing is left to begin */
};

struct kd_turns_job {
    enum kd_turn_end (*turn)(struct kd_turns_job *job); /* on a worker */
    void (*done)(struct kd_turns_job *job); /* on a worker, once, when every turn has returned: may free the job */
    double
        due_ms;  /* on kd_clock_ms, of a park that a turn asks for: it ends then at the latest; 0: it has no such end */
    bool shared; /* several workers at once from the next turn on; a turn may set it */
    char client[KD_CLIENT]; /* whose it is: what kd_turns_admit was asked for */
    /* the queue's own */
    struct kd_turns_job *next, *next_accepted, **accepted_at;
    bool listed, parked, away, woken, over;
    unsigned workers, paused; /* its turns that have begun, and those of them that let others go first */
};

struct kd_turns;

/* limit: unfinished jobs; share: of these, those of one client. */
enum kd_status kd_turns_create(unsigned limit, unsigned share, struct kd_turns **out, struct kd_error *error);
/* No job may be unfinished. Accepts NULL. */
void kd_turns_destroy(struct kd_turns *turns);

/* Whether one more of this client fits: KD_OK, or KD_EBUSY, with *quota where others would still be let in. The
 * submitting thread. */
enum kd_status kd_turns_admit(struct kd_turns *turns, const char *client, bool *quota, struct kd_error *error);
void kd_turns_push(struct kd_turns *turns, struct kd_turns_job *job);
/* End a park, also one that a turn under way is about to ask for. The job must not be done. Any thread. */
void kd_turns_wake(struct kd_turns *turns, struct kd_turns_job *job);
unsigned kd_turns_unfinished(struct kd_turns *turns);

/* Makes kd_turns_cancelled true, which jobs look at in their turns; nothing stays parked then but what is away. Any
 * thread. */
void kd_turns_cancel(struct kd_turns *turns);
bool kd_turns_cancelled(struct kd_turns *turns);

#endif
