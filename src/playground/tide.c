#include "playground/tide.h"

#include "playground/hole.h"
#include "playground/playground.h"

#include <math.h>
#include <string.h>

#define TOLD 0.1 /* fraction of its mass that a star must lose between two events */

double kd_tide_radius(double mass, double radius) { return radius * cbrt(1 / mass); }

double kd_tide_spread(double mass, double radius)
{
    const double r = kd_tide_radius(mass, radius);
    return radius / (r * r);
}

double kd_tide_share(double b)
{
    if (!(b > KD_TIDE_BEGINS))
        return 0;
    if (b >= KD_TIDE_WHOLE)
        return 1;
    return exp((3.1647 - 6.3777 * b + 3.1797 * b * b) / (1 - 3.4137 * b + 2.4616 * b * b));
}

/* Starts a tidal pass: saves mass and radius, and starts a source of debris. */
static void begin(struct kd_playground *p, struct kd_playground_body *body)
{
    body->whole_mass = body->mass;
    body->whole_radius = body->radius;
    body->depth = body->shed = body->told = 0;
    kd_debris_advance(&p->debris, p->t, p->params.safety, p->params.feeds);
    body->source = kd_debris_source_begin(&p->debris, body->name, body->mass, p->params.debris_per_body,
                                          kd_tide_spread(body->mass, body->radius))
                       ->number;
}

static void end(struct kd_playground_body *body)
{
    /* radius of the remaining mass, at constant density */
    body->radius = fmax(body->whole_radius * cbrt(1 - body->shed), KD_PLAYGROUND_LEAST);
    body->whole_mass = 0;
}

static void tell(struct kd_playground *p, const struct kd_playground_body *body, double lost, double energy, bool whole)
{
    struct kd_playground_event event = { .t = p->t,
                                         .kind = whole ? KD_PLAYGROUND_DISRUPTION : KD_PLAYGROUND_SHEDDING,
                                         .body = body->id,
                                         .mass = lost,
                                         .other_mass = whole ? 0 : body->mass,
                                         .r = kd_playground_radius(body->x),
                                         .energy = energy,
                                         .tidal_radius = kd_tide_radius(body->whole_mass, body->whole_radius),
                                         .spread = kd_tide_spread(body->whole_mass, body->whole_radius) };
    memcpy(event.name, body->name, sizeof event.name);
    kd_playground_event_add(&p->events, event);
}

/* Removes the mass that is lost at the present depth. Returns true if nothing is left of the star. */
static bool shed(struct kd_playground *p, struct kd_playground_body *body)
{
    struct kd_debris_source *source = kd_debris_source_of(&p->debris, body->source);
    const double share = kd_tide_share(body->depth);
    if (!source) { /* newer sources have replaced this star's source, so this pass ends, and another may begin */
        end(body);
        return false;
    }
    const uint32_t all = (uint32_t)round(fmin(1 / source->worth, KD_PLAYGROUND_DEBRIS_MAX)),
                   torn = (uint32_t)floor(share * all);
    const uint32_t due = body->whole_mass * (1 - (double)torn / all) < KD_PLAYGROUND_LEAST
                             ? all
                             /* the star loses everything if the rest would be below the least mass of a body */
                             : torn;
    if (due <= source->pieces)
        return false;
    kd_debris_advance(&p->debris, p->t, p->params.safety, p->params.feeds);
    kd_debris_shed(&p->debris, source,
                   &(struct kd_debris_shed) { .x = body->x,
                                              .v = body->v,
                                              .radius = body->whole_radius,
                                              .n = due - source->pieces,
                                              .seed = p->params.seed,
                                              .random = &p->random });
    const double mass = body->whole_mass * (1 - (double)due / all), lost = body->mass - mass;
    p->spent.torn_mass += lost;
    body->mass = mass;
    body->shed = (double)due / all;
    const bool whole = due == all;
    if (whole || body->shed >= body->told + TOLD || body->told == 0) {
        tell(p, body, body->whole_mass * (body->shed - (whole ? 0 : body->told)),
             lost * kd_playground_specific(body->x, body->v), whole);
        body->told = body->shed;
    }
    p->forced = false;
    return whole;
}

void kd_playground_tides(struct kd_playground *p)
{
    bool counted = false;
    double before = 0;
    for (size_t i = 0; i < p->n;) {
        struct kd_playground_body *body = &p->bodies[i];
        const bool passes = body->whole_mass > 0;
        i++;
        if (!passes && (!(body->mass > 0) || !(body->radius > 0)))
            continue;
        const double depth =
            (passes ? kd_tide_radius(body->whole_mass, body->whole_radius) : kd_tide_radius(body->mass, body->radius)) /
            kd_playground_radius(body->x);
        if (passes && depth < KD_TIDE_OVER)
            end(body);
        if (!(depth > KD_TIDE_BEGINS))
            continue;
        if (!passes)
            begin(p, body);
        if (!(depth > body->depth))
            continue;
        if (!counted)
            before = kd_playground_totals(p).energy;
        counted = true;
        body->depth = depth;
        if (shed(p, body))
            kd_playground_drop(p, --i);
    }
    if (counted) /* computed once for all stars, because it takes a pass over all pairs */
        p->spent.torn_energy += before - kd_playground_totals(p).energy;
}
