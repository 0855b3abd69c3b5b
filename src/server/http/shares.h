/* Fair-queueing scheduler: picks the client that uses the device next, and which of its work runs. Pure: no clock,
 * no thread, no allocation. One thread at a time.
 *
 * The device's time is shared equally among clients. Each client's time is shared among its classes of work by
 * weight. Both divisions use start-time fair queueing (Goyal, Vin & Cheng 1996). When work has run, the time is
 * charged to its client, and, divided by the weight, to its class. The client with the smallest charge runs next,
 * and within that client the class with the smallest charge. A client or class that was idle is treated as if it had
 * been charged as much as the one that is running, so that idle time gives neither an advantage nor a disadvantage.
 * A client with little work therefore waits for the slice in progress, and then at most for one share of each other
 * client, however much work these have.
 *
 * Among the works of one class of one client, the next is the one that would end first if all ran concurrently at
 * equal speed (Friedman & Henderson 2003). Short work thus runs first, and even the longest work ends no later than
 * it would at equal speed.
 *
 *     kd_shares_add(&shares, &work->claim);
 *     while ((claim = kd_shares_next(&shares, may, user))) {
 *         do a slice of the work, which takes ms;
 *         kd_shares_charge(&shares, claim, ms);
 *         if (it is done) kd_shares_remove(&shares, claim);
 *     } */
#ifndef KD_SERVER_HTTP_SHARES_H
#define KD_SERVER_HTTP_SHARES_H

#include <stdbool.h>

#define KD_CLIENT 48 /* maximum size of a client's name */
/* maximum number of clients that are tracked at the same time; further clients share entries */
#define KD_SHARE_CLIENTS 64u

/* Classes of work, with their weights within a client. PIXEL runs as soon as it arrives, because a user points at
 * the picture and waits. While a user moves a view (LIVE), a job (JOB) gets a fifth of the time. While a job runs,
 * an animated view (IDLE) and REFINEMENT get a twentieth, so that they still advance visibly. */
#define KD_CLASSES(X) X(PIXEL, 64) X(LIVE, 8) X(PICTURE, 4) X(RAYS, 4) X(JOB, 2) X(REFINEMENT, 0.1) X(IDLE, 0.1)
enum kd_class {
#define KD_CLASS_ENUM(name, weight) KD_CLASS_##name,
    KD_CLASSES(KD_CLASS_ENUM)
#undef KD_CLASS_ENUM
        KD_N_CLASSES
};

/* Work that waits or runs. This struct is a member of the struct of the work's owner. */
struct kd_claim {
    /* set before kd_shares_add */
    char client[KD_CLIENT];
    enum kd_class class;
    double left_ms; /* estimated time left, in ms; kd_shares_charge subtracts the time that was used */
    /* The following members are private to the scheduler. */
    /* virtual time of the work: the flow's `now` when the work was added, plus all charges for the work */
    double paid;
    struct kd_share_client *owner;
    struct kd_claim *next;
};

struct kd_share_flow { /* all work of one class of one client */
    /* paid: virtual time that was charged to the flow. now: virtual time that each work of the flow would have reached
     * if all of the flow's work ran concurrently. */
    double paid, now;
    unsigned claims;
    struct kd_claim *first; /* the flow's work, in order of arrival */
};
struct kd_share_client {
    char name[KD_CLIENT];
    /* paid: virtual time that was charged to the client; now: virtual time of its flow that is running */
    double paid, now;
    unsigned claims;
    struct kd_share_flow flows[KD_N_CLASSES];
};
struct kd_shares { /* initialise to 0 */
    double now;
    struct kd_share_client clients[KD_SHARE_CLIENTS];
};

void kd_shares_add(struct kd_shares *shares, struct kd_claim *claim);
void kd_shares_remove(struct kd_shares *shares, struct kd_claim *claim);

/* Returns the work to run next, of all work for which `may` returns true, or NULL. Changes nothing: repeated calls
 * return the same work until some work is added, removed or charged. */
struct kd_claim *kd_shares_next(struct kd_shares *shares, bool (*may)(const struct kd_claim *claim, void *user),
                                void *user);

/* Charges a claim with `ms` of device time. */
void kd_shares_charge(struct kd_shares *shares, struct kd_claim *claim, double ms);

#endif
