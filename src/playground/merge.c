/* Mergers of touching bodies, and captures by the hole. */
#include "base/pause.h"
#include "playground/hole.h"
#include "playground/playground.h"

#include <math.h>
#include <string.h>

static struct kd_playground_event event_of(const struct kd_playground *p, enum kd_playground_event_kind kind,
                                           const struct kd_playground_body *body)
{
    struct kd_playground_event event = { .t = p->t,
                                         .kind = kind,
                                         .body = body->id,
                                         .mass = body->mass,
                                         .r = kd_playground_radius(body->x),
                                         .tidal_radius = NAN,
                                         .spread = NAN };
    memcpy(event.name, body->name, sizeof event.name);
    return event;
}

/* True if two bodies touched within the last h, with their motion approximated as straight. */
static bool touched(const struct kd_playground_body *a, const struct kd_playground_body *b, double h)
{
    double x[3], v[3], xv = 0, vv = 0, d2 = 0;
    for (int k = 0; k < 3; k++) {
        x[k] = a->x[k] - b->x[k];
        v[k] = a->v[k] - b->v[k];
        xv += x[k] * v[k];
        vv += v[k] * v[k];
    }
    const double ago = vv > 0 ? fmin(fmax(xv / vv, 0), h) : 0;
    for (int k = 0; k < 3; k++)
        d2 += (x[k] - ago * v[k]) * (x[k] - ago * v[k]);
    const double reach = a->radius + b->radius;
    return a->radius > 0 && b->radius > 0 && d2 <= reach * reach;
}

/* Merges b into a. Masses, momenta and volumes are added, and the merged body is at the centre of mass. It keeps the
 * name and id of the heavier one. */
static void join(struct kd_playground *p, struct kd_playground_body *a, struct kd_playground_body *b)
{
    const bool other = b->mass > a->mass;
    const double mass = a->mass + b->mass, share = mass > 0 ? b->mass / mass : 0.5;
    struct kd_playground_event event = event_of(p, KD_PLAYGROUND_MERGER, other ? b : a);
    double v2 = 0;
    for (int k = 0; k < 3; k++)
        v2 += (a->v[k] - b->v[k]) * (a->v[k] - b->v[k]);
    event.other = (other ? a : b)->id;
    event.other_mass = (other ? a : b)->mass;
    memcpy(event.other_name, (other ? a : b)->name, sizeof event.other_name);
    event.energy = 0.5 * a->mass * share * v2;
    struct kd_playground_body one = other ? *b : *a;
    for (int k = 0; k < 3; k++) {
        one.x[k] = a->x[k] + share * (b->x[k] - a->x[k]);
        one.v[k] = mass > 0 ? (a->mass * a->v[k] + b->mass * b->v[k]) / mass : 0.5 * (a->v[k] + b->v[k]);
    }
    one.mass = mass;
    one.radius = cbrt(a->radius * a->radius * a->radius + b->radius * b->radius * b->radius);
    one.temperature_k = a->temperature_k + share * (b->temperature_k - a->temperature_k);
    one.radiated = a->radiated + b->radiated;
    one.whole_mass = 0; /* the merged star may begin a new tidal pass */
    *a = one;
    b->id = 0; /* 0 marks the body for removal below */
    kd_playground_event_add(&p->events, event);
}

void kd_playground_merge(struct kd_playground *p, double h)
{
    double before = 0;
    size_t joined = 0;
    /* marks bodies that have merged in this step; the position of such a body before the step has no meaning */
    bool grown[KD_PLAYGROUND_BODIES_MAX] = { false };
    for (size_t i = 0; i < p->n; i++) {
        bool again = p->mutual.near[i] > 0 && p->bodies[i].id;
        while (again) {
            again = false;
            kd_pause_every(i, 64);
            for (size_t j = 0; j < p->n; j++)
                if (j != i && p->bodies[j].id && touched(&p->bodies[i], &p->bodies[j], grown[i] || grown[j] ? 0 : h)) {
                    before = joined++ ? before : kd_playground_totals(p).energy;
                    join(p, &p->bodies[i], &p->bodies[j]);
                    grown[i] = again = true; /* the merged body is larger, so it may touch others */
                }
        }
    }
    if (!joined)
        return;
    size_t kept = 0;
    for (size_t i = 0; i < p->n; i++)
        if (p->bodies[i].id)
            p->bodies[kept++] = p->bodies[i];
    p->n = kept;
    p->forced = false;
    p->rate = 0;
    p->spent.merged += before - kd_playground_totals(p).energy;
}

void kd_playground_capture(struct kd_playground *p)
{
    double before = 0;
    size_t taken = 0;
    for (size_t i = 0; i < p->n;) {
        const struct kd_playground_body *body = &p->bodies[i];
        struct kd_playground_spent *spent = &p->spent;
        if (p->params.waves && body->radiated > 0 && !body->told_inspiral && kd_playground_radius(body->x) < 6) {
            struct kd_playground_event event = event_of(p, KD_PLAYGROUND_INSPIRAL, body);
            event.energy = body->radiated;
            p->bodies[i].told_inspiral = true;
            kd_playground_event_add(&p->events, event);
        }
        if (kd_playground_radius(body->x) > KD_PLAYGROUND_CAPTURE) {
            i++;
            continue;
        }
        before = taken++ ? before : kd_playground_totals(p).energy;
        struct kd_playground_event event = event_of(p, KD_PLAYGROUND_CAPTURED, body);
        event.energy = body->mass * kd_playground_specific(body->x, body->v);
        kd_playground_event_add(&p->events, event);
        spent->captured_mass += body->mass;
        for (int k = 0; k < 3; k++)
            spent->captured_momentum[k] += body->mass * (body->x[(k + 1) % 3] * body->v[(k + 2) % 3] -
                                                         body->x[(k + 2) % 3] * body->v[(k + 1) % 3]);
        kd_playground_drop(p, i);
    }
    if (taken) /* computed once for all captures, because it takes a pass over all pairs */
        p->spent.captured_energy += before - kd_playground_totals(p).energy;
}
