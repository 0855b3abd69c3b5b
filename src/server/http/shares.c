#include "server/http/shares.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A client that cannot be served for a while, for example because memory is short, falls behind in virtual time.
 * Afterwards it catches up by at most this amount of device time. The same limit applies to each flow. */
#define CREDIT_MS 200.0

static const double weights[] = {
#define WEIGHT(name, weight) [KD_CLASS_##name] = weight,
    KD_CLASSES(WEIGHT)
#undef WEIGHT
};

static unsigned hash(const char *name)
{
    unsigned h = 2166136261u; /* FNV-1a */
    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 16777619u;
    return h;
}

/* Finds the client's own entry. If it has none, returns the idle entry with the least virtual time. If no entry is
 * idle, the client shares an entry with others, which is chosen by a hash. */
static struct kd_share_client *place_of(struct kd_shares *shares, const char *name)
{
    struct kd_share_client *free = NULL;
    for (unsigned i = 0; i < KD_SHARE_CLIENTS; i++) {
        struct kd_share_client *c = &shares->clients[i];
        if (!strcmp(c->name, name) && (c->claims || c->paid > 0))
            return c;
        if (!c->claims && (!free || c->paid < free->paid))
            free = c;
    }
    if (!free)
        return &shares->clients[hash(name) % KD_SHARE_CLIENTS];
    *free = (struct kd_share_client) { 0 };
    snprintf(free->name, sizeof free->name, "%s", name);
    return free;
}

void kd_shares_add(struct kd_shares *shares, struct kd_claim *claim)
{
    struct kd_share_client *c = place_of(shares, claim->client);
    struct kd_share_flow *flow = &c->flows[claim->class];
    if (!c->claims++)
        c->paid = fmax(c->paid, shares->now);
    if (!flow->claims++)
        flow->paid = fmax(flow->paid, c->now);
    claim->paid = flow->now;
    claim->owner = c;
    claim->next = NULL;
    struct kd_claim **link = &flow->first;
    while (*link)
        link = &(*link)->next;
    *link = claim;
}

void kd_shares_remove(struct kd_shares *shares, struct kd_claim *claim)
{
    (void)shares;
    struct kd_share_flow *flow = &claim->owner->flows[claim->class];
    struct kd_claim **link = &flow->first;
    while (*link != claim)
        link = &(*link)->next;
    *link = claim->next;
    flow->claims--;
    claim->owner->claims--;
}

/* Virtual time of a client or flow. If it is more than CREDIT_MS behind that of the client or flow that was served
 * last, it is raised to this limit. */
static double standing(double paid, double now, double weight) { return fmax(paid, now - CREDIT_MS / weight); }

static struct kd_claim *next_of_flow(const struct kd_share_flow *flow, bool (*may)(const struct kd_claim *, void *),
                                     void *user)
{
    struct kd_claim *best = NULL;
    for (struct kd_claim *c = flow->first; c; c = c->next)
        if ((!best || c->paid + c->left_ms < best->paid + best->left_ms) && may(c, user))
            best = c;
    return best;
}

static struct kd_claim *next_of_client(const struct kd_share_client *client,
                                       bool (*may)(const struct kd_claim *, void *), void *user)
{
    struct kd_claim *best = NULL, *found;
    double least = INFINITY;
    for (unsigned i = 0; i < KD_N_CLASSES; i++) {
        const struct kd_share_flow *flow = &client->flows[i];
        const double paid = standing(flow->paid, client->now, weights[i]);
        if (!flow->claims || paid >= least || !(found = next_of_flow(flow, may, user)))
            continue;
        least = paid;
        best = found;
    }
    return best;
}

struct kd_claim *kd_shares_next(struct kd_shares *shares, bool (*may)(const struct kd_claim *claim, void *user),
                                void *user)
{
    struct kd_claim *best = NULL, *found;
    double least = INFINITY;
    for (unsigned i = 0; i < KD_SHARE_CLIENTS; i++) {
        const struct kd_share_client *c = &shares->clients[i];
        const double paid = standing(c->paid, shares->now, 1);
        if (!c->claims || paid >= least || !(found = next_of_client(c, may, user)))
            continue;
        least = paid;
        best = found;
    }
    return best;
}

/* Charges a client or flow. Sets *now, the virtual time at which new clients or flows start, to the virtual time of
 * the one that was charged. */
static void pay(double *paid, double *now, double ms, double weight)
{
    *paid = standing(*paid, *now, weight);
    *now = fmax(*now, *paid);
    *paid += ms / weight;
}

void kd_shares_charge(struct kd_shares *shares, struct kd_claim *claim, double ms)
{
    struct kd_share_client *c = claim->owner;
    struct kd_share_flow *flow = &c->flows[claim->class];
    pay(&c->paid, &shares->now, ms, 1);
    pay(&flow->paid, &c->now, ms, weights[claim->class]);
    flow->now += ms / flow->claims;
    claim->paid += ms;
    claim->left_ms = fmax(claim->left_ms - ms, 0);
}
