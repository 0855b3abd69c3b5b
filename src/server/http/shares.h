/* Fair-queueing scheduler: picks the client, and the piece of its work, that runs on the device next. Pure: no clock,
 * no thread, no allocation. One thread at a time.
 *
 * The device's time is shared among clients, and each client's part among its classes of work by weight, both by
 * start-time fair queueing (Goyal, Vin & Cheng 1996). Work that ran is charged its time, divided by its weight. The
 * client, and within it the class, that was charged least runs next. One that was away is treated as if it had been
 * charged as much as the one that is running: nobody saves up time, and nobody is punished for having been alone. So a
 * client with little to do waits for the slice that is under way, and then for at most its share of the others,
 * whatever they ask for.
 *
 * Among the works of one class and one client, the one runs next that would end first if all ran side by side
 * (Friedman & Henderson 2003): short work goes first, and the longest still ends no later than with equal parts.
 *
 *     kd_shares_add(&shares, &work->claim);
 *     while ((claim = kd_shares_next(&shares, may, user))) {
 *         do a slice of it, which takes ms;
 *         kd_shares_charge(&shares, claim, ms);
 *         if (it is done) kd_shares_remove(&shares, claim);
 *     } */
#ifndef KD_SERVER_HTTP_SHARES_H
#define KD_SERVER_HTTP_SHARES_H

#include <stdbool.h>

#define KD_CLIENT 48         /* room for the name of a client */
#define KD_SHARE_CLIENTS 64u /* told apart at once; more of them share places */

/* The classes of work with their weights inside a client. A pixel that is told is next as soon as it comes: somebody
 * points at it. A view that is moved by hand leaves a job a fifth; one that goes on by itself (idle) or is refined
 * gives way to the job, which was asked for, and has a twentieth: enough to be seen to go on. */
#define KD_CLASSES(X) X(PIXEL, 64) X(LIVE, 8) X(PICTURE, 4) X(RAYS, 4) X(JOB, 2) X(REFINEMENT, 0.1) X(IDLE, 0.1)
enum kd_class {
#define KD_CLASS_ENUM(name, weight) KD_CLASS_##name,
    KD_CLASSES(KD_CLASS_ENUM)
#undef KD_CLASS_ENUM
        KD_N_CLASSES
};

/* A work that waits, or is being served; embedded in its struct. */
struct kd_claim {
    /* set before kd_shares_add */
    char client[KD_CLIENT];
    enum kd_class class;
    double left_ms; /* estimated, of what is left; kd_shares_charge takes off what has gone by */
    /* the scheduler's own */
    double paid; /* the flow's `now` when it came, and what it has had since */
    struct kd_share_client *owner;
    struct kd_claim *next;
};

struct kd_share_flow { /* the works of one class of one client */
    double paid, now;  /* now: what each of its works would have had, if they had gone on side by side */
    unsigned claims;
    struct kd_claim *first; /* in the order in which they came */
};
struct kd_share_client {
    char name[KD_CLIENT];
    double paid, now; /* now: what its flow that is being served had paid */
    unsigned claims;
    struct kd_share_flow flows[KD_N_CLASSES];
};
struct kd_shares { /* all 0 to begin with */
    double now;
    struct kd_share_client clients[KD_SHARE_CLIENTS];
};

void kd_shares_add(struct kd_shares *shares, struct kd_claim *claim);
void kd_shares_remove(struct kd_shares *shares, struct kd_claim *claim);

/* Finds the next to be served among those that `may`; NULL: there is none. It is only looked up: another call says
 * the same, until something is added, removed or charged. */
struct kd_claim *kd_shares_next(struct kd_shares *shares, bool (*may)(const struct kd_claim *claim, void *user),
                                void *user);

/* Says that a claim has been served for so long. */
void kd_shares_charge(struct kd_shares *shares, struct kd_claim *claim, double ms);

#endif
