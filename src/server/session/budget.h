/* The budget says which part of the device's time each session that moves may count on, so that its governor can fit
 * frames into it. Pure: no clock, no device, no allocation. One owner at a time. Times are milliseconds of any
 * steady clock.
 *
 * The unit is milliseconds of the device a millisecond of the clock, 0 to 1. A session's demand is what it would use
 * if it were alone: what its frames take, divided by that and by the time from the end of one to the request for the
 * next. Time spent waiting for others is in neither, so that who is made to wait seems neither dearer nor less
 * eager. What counts is the mean of the last eight frames and the least of the last eight pauses: a single slow
 * frame or late request says little, and who has begun to drag again is believed at its second frame. A session that
 * has asked for nothing for its hold time demands nothing: that is 400 ms, and grows to twice a pause that was
 * longer than that, to 2 s at most, so that the part of a hand that pauses in a drag is not lent out and taken back
 * at each stroke. Sessions that are only watched, or refined, ask for nothing here.
 *
 * The time is divided as shares.h divides it, by client and then by session, max-min fair (Bertsekas & Gallager,
 * Data Networks, 1992, 6.5.2): each gets the same part, but those who want less get that, and the others have what
 * they leave. The part of a session is told as if it wanted everything: one that is alone has 1.
 *
 *     kd_budget_enter(&budget, &entry);
 *     kd_budget_ask(&entry, now);              a frame of what moves goes into the queue
 *     kd_budget_end(&entry, now, ms);          it has had the device for so long
 *     kd_budget_share(&budget, &entry, now);   before the next
 *     kd_budget_leave(&budget, &entry); */
#ifndef KD_SERVER_SESSION_BUDGET_H
#define KD_SERVER_SESSION_BUDGET_H

#include "server/http/shares.h"

#include <stdbool.h>

enum { KD_BUDGET_FRAMES = 8 };

/* An entry is one session's part of the budget, embedded in it. All of it but the client is 0 to begin with. */
struct kd_budget_entry {
    char client[KD_CLIENT]; /* as in the claims of its frames */
    /* the budget's own */
    double costs[KD_BUDGET_FRAMES], pauses[KD_BUDGET_FRAMES];
    unsigned n_costs, n_pauses;
    double ended_ms, hold_ms; /* when the latest frame had the device last */
    bool asks;                /* a frame is in the queue, or has the device */
    double demand, of_client; /* as of the call that is under way; of_client: 0 but in the first entry of each client */
    struct kd_budget_entry *next;
};
struct kd_budget { /* all 0 to begin with */
    struct kd_budget_entry *first;
};

void kd_budget_enter(struct kd_budget *budget, struct kd_budget_entry *entry);
void kd_budget_leave(struct kd_budget *budget, struct kd_budget_entry *entry);

void kd_budget_ask(struct kd_budget_entry *entry, double now);
/* The frame no longer has the device. ms: how long it had it, 0 or more; 0 says that it was given up, and is no
 * measure. */
void kd_budget_end(struct kd_budget_entry *entry, double now, double ms);

/* Estimates what the session would use alone, 0 to 1. It is 0 until it asks for its second frame. */
double kd_budget_demand(const struct kd_budget_entry *entry, double now);
/* The session may count on this share of the device: over 0, at most 1. */
double kd_budget_share(struct kd_budget *budget, const struct kd_budget_entry *entry, double now);

#endif
