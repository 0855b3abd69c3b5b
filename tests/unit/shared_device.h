/* A simulation of sessions that share a device. Each session has a governor, and a viewer who requests the next frame
 * some time after the last. The budget divides the device's time among the sessions, shares.h chooses the next session,
 * and governor_simulation.h gives the costs of frames. Events are processed in the order of their times. A frame has
 * the device until it is done, a refinement for 40 ms at a time. */
#ifndef KD_TESTS_SHARED_DEVICE_H
#define KD_TESTS_SHARED_DEVICE_H

#include "governor_simulation.h"
#include "server/session/budget.h"

enum { MOST = 64 };

struct sharer {
    struct simulation sim;
    struct kd_budget_entry entry;
    struct kd_claim claim; /* its share of the device */
    double pause;          /* mean time from a frame to the next request; actual times are 0.5 to 1.5 times the mean */
    double from, to;       /* between these times the scene changes at each request */
    double stroke, lift;   /* changes last for `stroke` and pause for `lift`, in turn; 0: no pauses */
    bool still;            /* the changes reuse the lens map, as a change of time does */
    /* state of the simulation */
    double due; /* time of the next request; INFINITY: a frame is in the queue */
    struct kd_frame_decision turn;
    struct kd_frame_cost cost;
    double left;        /* ms of the device that the frame still needs */
    double latest, gap; /* time of the newest frame that was not a refinement; the longest time between two in a drag */
    uint64_t moved, refined; /* number of frames */
    double used;             /* ms of the device, without refinement */
    /* changes of scale; frames of a drag after which the server would start to refine before the next request
     * arrives */
    uint64_t seen, hasty;
};

struct device {
    struct sharer *sharers;
    int n;
    struct kd_shares shares;
    struct kd_budget budget;
    struct sharer *served; /* the sharer that is using the device; NULL: none */
    double now, until, slice;
    bool alone; /* governors have no information about each other */
};

static void open_device(struct device *d, struct sharer *sharers, int n)
{
    *d = (struct device) { .sharers = sharers, .n = n };
    memset(sharers, 0, (size_t)n * sizeof *sharers);
}

/* Adds a sharer that exists from the beginning and is at rest until `from`. */
static struct sharer *join(struct device *d, int i, const char *client, struct truth truth, double pause, double from,
                           double to)
{
    struct sharer *s = &d->sharers[i];
    begin(&s->sim, kd_governor_params(), 640, 360, truth);
    snprintf(s->entry.client, sizeof s->entry.client, "%s", client);
    memcpy(s->claim.client, s->entry.client, sizeof s->claim.client);
    kd_budget_enter(&d->budget, &s->entry);
    s->pause = pause;
    s->from = s->due = from;
    s->to = to;
    s->latest = -INFINITY;
    return s;
}

static bool dragged(const struct sharer *s, double now)
{
    return now >= s->from && now < s->to && (s->stroke == 0 || fmod(now - s->from, s->stroke + s->lift) < s->stroke);
}

static double next_drag(const struct sharer *s, double now)
{
    if (now < s->from)
        return s->from;
    if (now >= s->to || s->stroke == 0)
        return INFINITY;
    return s->from + (floor((now - s->from) / (s->stroke + s->lift)) + 1) * (s->stroke + s->lift);
}

static void tell_share(struct device *d, struct sharer *s)
{
    if (!d->alone)
        kd_governor_share(&s->sim.governor, kd_budget_share(&d->budget, &s->entry, d->now));
}

static void request(struct device *d, struct sharer *s)
{
    struct simulation *sim = &s->sim;
    sim->now = d->now;
    tell_share(d, s);
    const bool first = sim->lens == 0;
    if (first || dragged(s, d->now))
        change(sim, first || !s->still);
    if (first) /* the server takes this estimate from the plan */
        kd_governor_expect(&sim->governor, &(struct kd_frame_cost) { .fixed_ms = sim->truth.fixed,
                                                                     .rays_ms = sim->truth.traced,
                                                                     .pixels_ms = sim->truth.pixels,
                                                                     .total_ms = sim->truth.fixed + sim->truth.traced +
                                                                                 sim->truth.pixels });
    s->turn = kd_governor_decide(&sim->governor, d->now);
    if (s->turn.wait_ms > 0) {
        double next = next_drag(s, d->now);
        s->due = fmin(d->now + s->turn.wait_ms, next) + 1e-6; /* rounded upwards, so that it is not before that time */
        return;
    }
    struct kd_scene scene;
    kd_quality_apply(&s->turn.quality, &sim->asked, &scene);
    bool reused = lens_kept(sim, &scene);
    s->cost = sim->cost(sim, &scene, reused);
    s->cost.lens_reused = reused;
    s->left = s->cost.total_ms;
    s->due = INFINITY;
    s->claim.class = s->turn.refining ? KD_CLASS_REFINEMENT : KD_CLASS_LIVE;
    s->claim.left_ms = s->left;
    kd_shares_add(&d->shares, &s->claim);
    if (!s->turn.refining)
        kd_budget_ask(&s->entry, d->now);
}

static void count(struct device *d, struct sharer *s, const struct kd_quality *before)
{
    if (s->turn.refining) {
        s->refined++;
        return;
    }
    if (s->moved && dragged(s, s->latest) && dragged(s, d->now))
        s->gap = fmax(s->gap, d->now - s->latest);
    s->seen += s->moved && before->scale != s->turn.quality.scale;
    s->latest = d->now;
    s->moved++;
    s->used += s->cost.total_ms;
    s->sim.last = s->turn.quality;
}

static void finish(struct device *d, struct sharer *s)
{
    const struct kd_quality before = s->sim.last;
    kd_shares_remove(&d->shares, &s->claim);
    if (!s->turn.refining)
        kd_budget_end(&s->entry, d->now, s->cost.total_ms);
    tell_share(d, s);
    kd_governor_frame(&s->sim.governor, d->now, &s->turn, &s->cost);
    count(d, s, &before);
    s->hasty += !s->turn.refining && dragged(s, d->now) && !(kd_governor_decide(&s->sim.governor, d->now).wait_ms > 0);
    s->sim.frames++;
    s->due = d->now + s->pause * (0.5 + uniform());
}

static bool any(const struct kd_claim *claim, void *user)
{
    (void)user;
    return claim;
}

static void serve(struct device *d)
{
    const struct kd_claim *next = kd_shares_next(&d->shares, any, NULL);
    d->served = NULL;
    for (int i = 0; i < d->n && next; i++)
        if (&d->sharers[i].claim == next)
            d->served = &d->sharers[i];
    if (!d->served)
        return;
    d->slice = d->served->turn.refining ? fmin(d->served->left, 40) : d->served->left;
    d->until = d->now + d->slice;
}

static void end_of_slice(struct device *d)
{
    struct sharer *s = d->served;
    kd_shares_charge(&d->shares, &s->claim, d->slice);
    s->left -= d->slice;
    if (s->left <= 1e-9)
        finish(d, s);
    serve(d);
}

static void go_on(struct device *d, double ms)
{
    for (double end = d->now + ms;;) {
        struct sharer *first = NULL;
        for (int i = 0; i < d->n; i++)
            if (!first || d->sharers[i].due < first->due)
                first = &d->sharers[i];
        bool slice = d->served && d->until <= first->due;
        double next = slice ? d->until : first->due;
        if (next > end) {
            d->now = end;
            return;
        }
        d->now = next;
        if (slice)
            end_of_slice(d);
        else
            request(d, first);
        if (!d->served)
            serve(d);
    }
}

static void count_anew(struct device *d)
{
    for (int i = 0; i < d->n; i++) {
        struct sharer *s = &d->sharers[i];
        s->moved = s->refined = s->seen = s->hasty = 0;
        s->gap = s->used = 0;
    }
}

#endif
