/* Budget: estimates the share of the device's time that each moving session can rely on, so that its governor can
 * choose frames that fit. Pure: no clock, no device, no allocation. One thread at a time. Times are milliseconds of any
 * steady clock.
 *
 * Shares and demands are milliseconds of the device for each millisecond of the clock, 0 to 1. A session's demand is
 * the share that it would use if it were alone: the device time of a frame, divided by the sum of that time and the
 * pause after the frame. The pause lasts until the next frame is requested. Neither term includes the time spent
 * waiting for others, so waiting does not change the demand. The demand is computed from the mean cost of the last
 * eight frames and the smallest of the last eight pauses. So a single slow frame or late request changes the demand
 * little. When a user begins another drag, the demand is known from the second frame on.
 *
 * The demand of a session that has not requested a frame for its hold time is 0. The hold time is 400 ms. After a
 * longer pause the hold time becomes twice that pause, at most 2 s. Without a hold time, a session would lose its share
 * to others whenever the user's hand rests during a drag. The demand of sessions that are only watched or refined is 0.
 *
 * The time is divided as in shares.h, first among clients, then among the sessions of each. The division is max-min
 * fair (Bertsekas & Gallager, Data Networks, 1992, 6.5.2): whoever has a small demand gets that demand, and the others
 * get equal parts of the rest. To compute a session's own share, its demand is taken to be 1. So a session that is
 * alone has the share 1.
 *
 *     kd_budget_enter(&budget, &entry);
 *     kd_budget_ask(&entry, now);             a frame of a moving session is queued
 *     kd_budget_end(&entry, now, ms);         it has used the device for ms
 *     kd_budget_share(&budget, &entry, now);  before the next frame
 *     kd_budget_leave(&budget, &entry); */
#ifndef KD_SERVER_SESSION_BUDGET_H
#define KD_SERVER_SESSION_BUDGET_H

#include "server/http/shares.h"

#include <stdbool.h>

enum { KD_BUDGET_FRAMES = 8 };

/* One session's entry in the budget, embedded in the session. Set client, and initialise the other members to 0. */
struct kd_budget_entry {
    char client[KD_CLIENT]; /* the client that the claims of the session's frames name */
    /* private to the budget */
    double costs[KD_BUDGET_FRAMES], pauses[KD_BUDGET_FRAMES];
    unsigned n_costs, n_pauses;
    double ended_ms, hold_ms; /* ended_ms: time at which the latest frame left the device; hold_ms: hold time */
    bool asks;                /* a frame is queued or being rendered */
    /* Computed in each call. of_client: sum of demands over all sessions of a client, in the client's first entry; 0 in
     * its other entries. */
    double demand, of_client;
    struct kd_budget_entry *next;
};
struct kd_budget { /* initialise to 0 */
    struct kd_budget_entry *first;
};

void kd_budget_enter(struct kd_budget *budget, struct kd_budget_entry *entry);
void kd_budget_leave(struct kd_budget *budget, struct kd_budget_entry *entry);

void kd_budget_ask(struct kd_budget_entry *entry, double now);
/* Records that the frame has left the device. ms: device time that it used; 0: the frame was abandoned, so its time
 * is not counted. */
void kd_budget_end(struct kd_budget_entry *entry, double now, double ms);

/* Estimates the session's demand, 0 to 1. It is 0 until the second frame is requested. */
double kd_budget_demand(const struct kd_budget_entry *entry, double now);
/* Returns the share of the device that the session can rely on: above 0, at most 1. */
double kd_budget_share(struct kd_budget *budget, const struct kd_budget_entry *entry, double now);

#endif
