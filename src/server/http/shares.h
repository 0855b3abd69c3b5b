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
#define KD_SHARE_CLIENTS 64u /* clients tracked at once; beyond that, clients share an entry */

/* Classes of work and their weights within a client. PIXEL is next as soon as it arrives, because somebody points at
 * the picture. LIVE, a view moved by hand, leaves a job (JOB) a fifth. IDLE (a view that animates by itself) and
 * REFINEMENT give way to a job, which somebody requested: they get a twentieth, so that they still visibly advance. */
#define KD_CLASSES(X) X(PIXEL, 64) X(LIVE, 8) X(PICTURE, 4) X(RAYS, 4) X(JOB, 2) X(REFINEMENT, 0.1) X(IDLE, 0.1)
enum kd_class {
#define KD_CLASS_ENUM(name, weight) KD_CLASS_##name,
    KD_CLASSES(KD_CLASS_ENUM)
#undef KD_CLASS_ENUM
        KD_N_CLASSES
};

/* A piece of work that waits or runs; embedded in its owner's struct. */
struct kd_claim {
    /* set before kd_shares_add */
    char client[KD_CLIENT];
    enum kd_class class;
    double left_ms; /* estimated time left; kd_shares_charge subtracts what has run */
    /* private to the scheduler */
    double paid; /* virtual time: the flow's `now` when the work was added, plus what it was charged */
    struct kd_share_client *owner;
    struct kd_claim *next;
};

struct kd_share_flow { /* work of one class of one client */
    double paid, now;  /* now: virtual time that each of its works would have received if they ran side by side */
    unsigned claims;
    struct kd_claim *first; /* in order of arrival */
};
struct kd_share_client {
    char name[KD_CLIENT];
    double paid, now; /* now: virtual time of the flow that runs */
    unsigned claims;
    struct kd_share_flow flows[KD_N_CLASSES];
};
struct kd_shares { /* initialise to 0 */
    double now;
    struct kd_share_client clients[KD_SHARE_CLIENTS];
};

void kd_shares_add(struct kd_shares *shares, struct kd_claim *claim);
void kd_shares_remove(struct kd_shares *shares, struct kd_claim *claim);

/* Returns the work to run next among those for which `may` is true, or NULL. Changes nothing: repeated calls return the
 * same until something is added, removed or charged. */
struct kd_claim *kd_shares_next(struct kd_shares *shares, bool (*may)(const struct kd_claim *claim, void *user),
                                void *user);

/* Charges a claim for `ms` of device time. */
void kd_shares_charge(struct kd_shares *shares, struct kd_claim *claim, double ms);

#endif
