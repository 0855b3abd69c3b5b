/* This says who has the device next, by fair shares of its time. Pure: no clock, no thread, no allocation. One owner
 * at a time.
 *
 * The device's time is shared among clients, and each client's part among its classes of work by their weights. Both
 * by start-time fair queueing (Goyal, Vin & Cheng 1996): who is served pays with the time it took, divided by its
 * weight; who has paid least is next; and who was away is as if it had paid as much as the one that is being served,
 * so that nobody saves time up and nobody is made to wait for having been the only one. So a client with little to
 * do waits for the slice that is under way, and for no more than its share of the others, however much another one
 * wants.
 *
 * Among the works of one class and one client that one is next which would end first if each had the same part of
 * the time (Friedman & Henderson 2003): short work goes first, and yet the longest ends no later than it would if
 * all went on side by side.
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
