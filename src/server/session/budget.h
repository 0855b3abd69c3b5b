/* The budget estimates the share of the device's time on which each moving session can rely, so that its governor
 * can choose frames that fit. Pure: no clock, no device, no allocation. One thread at a time. Times are milliseconds
 * of any steady clock.
 *
 * Shares and demands are milliseconds of the device for each millisecond of the clock, 0 to 1. A session's demand is
 * the share that it would use if it were alone: the device time of a frame, divided by the sum of that time and the
 * pause after the frame. The pause lasts until the next frame is requested. Neither of these times includes waiting
 * for others, so waiting does not change the demand. The demand is computed from the mean cost of the last eight
 * frames and the smallest of the last eight pauses. A single slow frame or late request therefore changes the demand
 * little. When a user begins another drag, the demand is known from the second frame on.
 *
 * The demand of a session that has not requested a frame for its hold time is 0. The hold time is 400 ms. After a
 * longer pause the hold time becomes twice that pause, at most 2 s. Without a hold time, a session would lose its
 * share to others whenever the user's hand rests during a drag. The demand of sessions that are only watched or
 * refined is 0.
 *
 * The time is divided as in shares.h, first among clients, then among the sessions of each. The division is max-min
 * fair (Bertsekas & Gallager, Data Networks, 1992, 6.5.2): small demands are met, and all others get equal parts of
 * the rest. For a session's own share, its demand is taken to be 1, so that a session that is alone has the share 1.
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

/* A session's entry in the budget, which is a member of the session. Set client, and initialise all other members to
 * 0. */
struct kd_budget_entry {
    char client[KD_CLIENT]; /* the client that is named in the claims of the session's frames */
    /* The following members are private to the budget. */
    double costs[KD_BUDGET_FRAMES], pauses[KD_BUDGET_FRAMES];
    unsigned n_costs, n_pauses;
    double ended_ms, hold_ms; /* ended_ms: time when the latest frame left the device; hold_ms: hold time */
    bool asks;                /* true while a frame is queued or being rendered */
    /* Computed anew in each call. of_client: in the first entry of a client, the sum of the demands of all its
     * sessions; in its other entries 0. */
    double demand, of_client;
    struct kd_budget_entry *next;
};
struct kd_budget { /* initialise to 0 */
    struct kd_budget_entry *first;
};

void kd_budget_enter(struct kd_budget *budget, struct kd_budget_entry *entry);
void kd_budget_leave(struct kd_budget *budget, struct kd_budget_entry *entry);

void kd_budget_ask(struct kd_budget_entry *entry, double now);
/* Records that the frame has left the device. ms: device time that the frame has used; 0: the frame was abandoned,
 * and its time is not counted. */
void kd_budget_end(struct kd_budget_entry *entry, double now, double ms);

/* Estimates the session's demand, 0 to 1. The demand is 0 until the second frame is requested. */
double kd_budget_demand(const struct kd_budget_entry *entry, double now);
/* Returns the share of the device on which the session can rely: above 0, at most 1. */
double kd_budget_share(struct kd_budget *budget, const struct kd_budget_entry *entry, double now);

#endif
