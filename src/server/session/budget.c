#include "server/session/budget.h"

#include <math.h>
#include <string.h>

/* hold time in ms: initial value and maximum. The governor uses the same times to distinguish one drag from the
 * next. */
static const double HOLD_MS = 400, HOLD_MAX_MS = 2000;

void kd_budget_enter(struct kd_budget *budget, struct kd_budget_entry *entry)
{
    entry->hold_ms = HOLD_MS;
    entry->next = budget->first;
    budget->first = entry;
}

void kd_budget_leave(struct kd_budget *budget, struct kd_budget_entry *entry)
{
    struct kd_budget_entry **link = &budget->first;
    while (*link != entry)
        link = &(*link)->next;
    *link = entry->next;
}

void kd_budget_ask(struct kd_budget_entry *e, double now)
{
    double pause = now - e->ended_ms;
    e->asks = true;
    if (!e->n_costs)
        return; /* the first frame has no preceding pause */
    e->pauses[e->n_pauses++ % KD_BUDGET_FRAMES] = pause;
    if (pause >= HOLD_MAX_MS)
        e->hold_ms = HOLD_MS;
    else if (pause > e->hold_ms)
        e->hold_ms = fmin(2 * pause, HOLD_MAX_MS);
}

void kd_budget_end(struct kd_budget_entry *e, double now, double ms)
{
    e->asks = false;
    e->ended_ms = now;
    if (ms > 0)
        e->costs[e->n_costs++ % KD_BUDGET_FRAMES] = ms;
}

static unsigned known(unsigned n) { return n < KD_BUDGET_FRAMES ? n : KD_BUDGET_FRAMES; }

double kd_budget_demand(const struct kd_budget_entry *e, double now)
{
    double cost = 0, pause = INFINITY;
    if (!e->n_costs || !e->n_pauses || (!e->asks && now - e->ended_ms > e->hold_ms))
        return 0;
    for (unsigned i = 0; i < known(e->n_costs); i++)
        cost += e->costs[i] / known(e->n_costs);
    for (unsigned i = 0; i < known(e->n_pauses); i++)
        pause = fmin(pause, e->pauses[i]);
    return cost / (cost + pause);
}

static bool same_client(const struct kd_budget_entry *a, const struct kd_budget_entry *b)
{
    return !strcmp(a->client, b->client);
}

static void look(struct kd_budget *budget, double now)
{
    for (struct kd_budget_entry *e = budget->first; e; e = e->next) {
        struct kd_budget_entry *head = budget->first;
        e->demand = kd_budget_demand(e, now);
        e->of_client = 0;
        while (!same_client(head, e))
            head = head->next;
        head->of_client += e->demand;
    }
}

/* A demand that competes with that of the entry. It belongs to another client, or to another session of the same
 * client. */
static double rival(const struct kd_budget_entry *entry, const struct kd_budget_entry *other, bool clients)
{
    if (clients)
        return same_client(entry, other) ? 0 : other->of_client;
    return other != entry && same_client(entry, other) ? other->demand : 0;
}

/* Divides `whole` between a session and its rivals by max-min fairness. Returns the session's part, which is called
 * the level. Each rival gets its demand, but at most the level. The iteration first assumes that all rivals demand
 * everything. In each round the rivals whose demand is below the level drop out, and the level rises. The iteration
 * therefore ends after at most one round per rival. */
static double fill(const struct kd_budget *budget, const struct kd_budget_entry *entry, bool clients, double whole)
{
    for (double level = 0, next;; level = next) {
        double left = whole;
        unsigned n = 1;
        for (const struct kd_budget_entry *e = budget->first; e; e = e->next) {
            double demand = rival(entry, e, clients);
            if (demand > level)
                n++;
            else
                left -= demand;
        }
        next = left / n;
        if (next <= level)
            return level;
    }
}

double kd_budget_share(struct kd_budget *budget, const struct kd_budget_entry *entry, double now)
{
    look(budget, now);
    return fill(budget, entry, false, fill(budget, entry, true, 1));
}
