/* The integrator: a sub-step of all bodies (kick, drift, kick), and strides of geodesics. */
#include "playground/hole.h"
#include "playground/playground.h"
#include "playground/wave.h"

#include <math.h>
#include <string.h>

#define PIECE 256 /* number of steps of geodesics in a piece; each takes a microsecond or two */
#define CLEARANCE \
    1.25 /* ratio of the rate aimed at to the minimum, because the rate of single steps oscillates about the rate that \
          * the positions require */

void kd_playground_force(struct kd_playground *p)
{
    if (p->forced)
        return;
    kd_playground_mutual_fill(&p->mutual, p->bodies, p->n, p->params.softening, p->margin);
    p->forced = true;
}

/* 1/h for the largest step h that playground.h allows at the present positions. */
static double demanded(const struct kd_playground *p)
{
    const struct kd_playground_params *s = &p->params;
    double rate = 1 / s->h_max;
    /* limits the step to the longest stride of the debris */
    rate = fmax(rate, 1 / kd_debris_stride(&p->debris, s->safety));
    for (size_t i = 0; i < p->n; i++) {
        const double r = kd_playground_radius(p->bodies[i].x);
        rate = fmax(rate, 1 / (s->safety * (r - KD_PLAYGROUND_HORIZON)));
        rate = fmax(rate, sqrt(p->mutual.rate[i]) / s->safety);
    }
    return rate;
}

/* Caps the speed at 1. others: true if the attraction of other bodies exceeds that of the hole. If the hole has caused
 * the speed, the cap does not affect the balance of momentum, because the hole's momentum is not counted. */
static void hold(struct kd_playground *p, struct kd_playground_body *body, bool others)
{
    const double v = kd_playground_radius(body->v);
    if (!(v > 1))
        return;
    for (int k = 0; k < 3; k++)
        body->v[k] /= v;
    p->spent.capped += 0.5 * body->mass * (v * v - 1);
    for (int k = 0; others && k < 3; k++)
        p->spent.capped_momentum[k] += body->mass * (v - 1) * body->v[k];
}

/* Applies the acceleration a for the time share * time, and adds the energy lost to waves to the sums. */
static void lose(struct kd_playground *p, struct kd_playground_body *body, const double a[3], double share, double time)
{
    double work = 0;
    for (int k = 0; k < 3; k++) {
        const double kick = share * a[k] * time;
        work += body->mass * kick * (body->v[k] + 0.5 * kick);
        body->v[k] += kick;
    }
    body->radiated -= work;
    p->spent.radiated -= work;
}

/* Applies gravitational-wave losses over `time`. Bodies of bound pairs radiate with each other, and all other bodies
 * with the hole. */
static void radiate(struct kd_playground *p, double time)
{
    size_t partners[KD_WAVE_PAIRS_MAX];
    const bool pairs = p->n <= KD_WAVE_PAIRS_MAX;
    double a[3];
    if (pairs)
        kd_wave_partners(p->bodies, p->n, p->params.softening, partners);
    for (size_t i = 0; i < p->n; i++) {
        struct kd_playground_body *one = &p->bodies[i];
        const size_t j = pairs ? partners[i] : p->n;
        if (j == p->n) {
            p->held |= kd_wave_reaction_hole(one->mass, one->x, one->v, p->params.amplification, a);
            lose(p, one, a, 1, time);
        } else if (j > i) {
            struct kd_playground_body *two = &p->bodies[j];
            double x[3], v[3];
            for (int k = 0; k < 3; k++) {
                x[k] = one->x[k] - two->x[k];
                v[k] = one->v[k] - two->v[k];
            }
            p->held |= kd_wave_reaction(one->mass, two->mass, x, v, p->params.amplification, a);
            lose(p, one, a, two->mass / (one->mass + two->mass), time);
            lose(p, two, a, -one->mass / (one->mass + two->mass), time);
        }
    }
}

static void kick(struct kd_playground *p, double time)
{
    const struct kd_playground_mutual *m = &p->mutual;
    for (size_t i = 0; i < p->n; i++) {
        struct kd_playground_body *body = &p->bodies[i];
        const double pull = kd_playground_pull(kd_playground_radius(body->x)), a[3] = { m->ax[i], m->ay[i], m->az[i] };
        for (int k = 0; k < 3; k++)
            body->v[k] += time * (pull * body->x[k] + a[k]);
    }
    if (p->params.waves)
        radiate(p, time);
    for (size_t i = 0; i < p->n; i++) {
        const double r = kd_playground_radius(p->bodies[i].x), hole = r * kd_playground_pull(r);
        hold(p, &p->bodies[i], m->ax[i] * m->ax[i] + m->ay[i] * m->ay[i] + m->az[i] * m->az[i] > hole * hole);
    }
}

/* Moves all bodies on straight lines. The hole no longer attracts bodies that pass its capture radius; they are
 * captured after the step. */
static void drift(struct kd_playground *p, double time)
{
    for (size_t i = 0; i < p->n; i++)
        for (int k = 0; k < 3; k++)
            p->bodies[i].x[k] += time * p->bodies[i].v[k];
    p->forced = false;
}

/* Returns h, or 0 (state unchanged) if h is below the resolution of t. */
static double step(struct kd_playground *p)
{
    kd_playground_force(p);
    const double least = demanded(p), aim = CLEARANCE * least,
                 rate = p->rate > 0 ? fmax(2 * aim - p->rate, least) : aim, h = 1 / rate;
    if (!(p->t + h > p->t))
        return 0;
    p->rate = rate;
    kick(p, 0.5 * h);
    drift(p, h);
    /* the margin includes bodies that touch within the step and are apart again at its end */
    p->margin = fmin(2 * h, 1e6);
    kd_playground_force(p);
    kick(p, 0.5 * h);
    p->t += h;
    p->steps++;
    return h;
}

/* For gravity "kerr": moves the bodies and the playground to the time p->aim, which all geodesics have approached. */
static void arrive(struct kd_playground *p)
{
    p->t = p->aim;
    for (size_t i = 0; i < p->n;) {
        struct kd_playground_body *body = &p->bodies[i];
        const enum kd_geodesic_fate fate = kd_geodesic_at(&p->geodesics[i], p->t, body->x, body->v);
        if (fate == KD_GEODESIC_GOES) {
            i++;
            continue;
        }
        struct kd_playground_event event = { .t = p->t,
                                             .kind = fate == KD_GEODESIC_CAPTURED ? KD_PLAYGROUND_CAPTURED
                                                                                  : KD_PLAYGROUND_ESCAPE,
                                             .body = body->id,
                                             .mass = body->mass,
                                             .r = kd_playground_radius(body->x),
                                             .energy = body->mass * p->geodesics[i].path.orbit.energy,
                                             .tidal_radius = NAN,
                                             .spread = NAN };
        memcpy(event.name, body->name, sizeof event.name);
        kd_playground_event_add(&p->events, event);
        if (fate == KD_GEODESIC_CAPTURED) {
            p->spent.captured_mass += body->mass;
            p->spent.captured_energy += event.energy;
        }
        kd_playground_drop(p, i);
    }
    p->approached = 0;
    p->steps++;
}

void kd_playground_series_row(struct kd_playground *p, double row[KD_SERIES_N])
{
    const struct kd_playground_totals now = kd_playground_totals(p);
    const struct kd_playground_spent *s = &p->spent;
    double back = 0;
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++)
        back += p->debris.sources[i].piece_mass * p->debris.sources[i].all_back;
    const double now_row[KD_SERIES_N] = { [KD_SERIES_t] = p->t,
                                          [KD_SERIES_bodies] = (double)p->n,
                                          [KD_SERIES_energy] = now.energy,
                                          [KD_SERIES_energy_balance] = now.energy + s->captured_energy + s->merged +
                                                                       s->capped + s->radiated + s->torn_energy -
                                                                       s->given,
                                          [KD_SERIES_angular_momentum_x] = now.angular[0],
                                          [KD_SERIES_angular_momentum_y] = now.angular[1],
                                          [KD_SERIES_angular_momentum_z] = now.angular[2],
                                          [KD_SERIES_radiated] = s->radiated,
                                          [KD_SERIES_separation] = now.separation,
                                          [KD_SERIES_wave_frequency] = now.wave_frequency,
                                          [KD_SERIES_h_plus] = now.h_plus,
                                          [KD_SERIES_h_cross] = now.h_cross,
                                          [KD_SERIES_debris] = p->debris.alive,
                                          [KD_SERIES_debris_back] = back };
    memcpy(row, now_row, sizeof now_row);
}

void kd_playground_series_begin(struct kd_playground *p, double span)
{
    double row[KD_SERIES_N];
    kd_playground_settle(p);
    kd_playground_series_row(p, row);
    kd_series_begin(&p->series, row, span, p->params.h_max);
}

/* Saves the present values as a row if a step of length `longest` could pass the time of the series' next row. */
static void record_before(struct kd_playground *p, double longest)
{
    p->last_row[KD_SERIES_t] = NAN;
    if (kd_series_next(&p->series) <= p->t + longest)
        kd_playground_series_row(p, p->last_row);
}

static void record(struct kd_playground *p)
{
    double now[KD_SERIES_N];
    if (p->t < kd_series_next(&p->series))
        return;
    kd_playground_series_row(p, now);
    kd_series_add(&p->series, p->last_row, now);
}

/* Moves debris to the present time, once every h_max, or more often if a piece is near the hole. */
static void advance_debris(struct kd_playground *p)
{
    struct kd_playground_debris *debris = &p->debris;
    if (!debris->alive) {
        debris->t = p->t;
        return;
    }
    const double stride = fmin(p->params.h_max, kd_debris_stride(debris, p->params.safety));
    if (p->t - debris->t >= stride)
        kd_debris_advance(debris, p->t, p->params.safety, p->params.feeds);
}

/* Takes one sub-step, and handles mergers, captures and tides. If only debris is left, the step is the longest stride
 * that the debris allows. Returns false if h is below the resolution of t. */
static bool go(struct kd_playground *p)
{
    record_before(p, p->params.h_max); /* no step is longer than h_max */
    if (p->n) {
        const double h = step(p);
        if (!(h > 0))
            return false;
        if (p->params.mergers)
            kd_playground_merge(p, h);
        kd_playground_capture(p);
        if (p->params.tides)
            kd_playground_tides(p);
    } else {
        const double h = fmin(p->params.h_max, kd_debris_stride(&p->debris, p->params.safety));
        if (!(p->t + h > p->t))
            return false;
        p->t += h;
        p->steps++;
    }
    advance_debris(p);
    record(p);
    return true;
}

void kd_playground_begin(struct kd_playground *p, double time, struct kd_playground_run *run)
{
    *run = (struct kd_playground_run) {
        .begin = p->t, .end = p->t + time, .stride = p->params.h_max, .first = p->steps, .left = p->params.budget
    };
    kd_playground_settle(p);
    if (!p->series.n)
        kd_playground_series_begin(p, 0);
    if (p->params.gravity != KD_GRAVITY_KERR || !(p->aim > run->end))
        return;
    /* moves the bodies back to the start of the stride, because the stride leads beyond the end of this run */
    for (size_t i = 0; i < p->n; i++)
        kd_geodesic_back(&p->geodesics[i]);
    p->aim = p->t;
}

static bool is_over(const struct kd_playground *p, const struct kd_playground_run *run)
{
    return run->stuck || !(p->t < run->end) || !(p->t < KD_PLAYGROUND_TIME) || !run->left ||
           p->steps - run->first >= p->params.budget;
}

/* Longest stride that takes half of the remaining budget, estimated from the present motion. */
static double affordable(const struct kd_playground *p, uint32_t left)
{
    double pace = 0;
    for (size_t i = 0; i < p->n; i++)
        pace += kd_geodesic_pace(&p->geodesics[i]);
    return pace > 0 ? 0.5 * left / pace : INFINITY;
}

/* For gravity "kerr": advances by strides. The geodesics approach the end of the stride one after the other; then all
 * bodies move. If the budget is spent before that, no body has moved, and the next run continues towards the same end.
 */
static void follow_on(struct kd_playground *p, struct kd_playground_run *run)
{
    if (!(p->aim > p->t)) {
        p->aim = fmin(p->t + fmin(run->stride, affordable(p, run->left)), run->end);
        p->approached = 0;
        run->stuck = !(p->aim > p->t); /* true if the step is below the resolution of t */
    }
    const uint32_t piece = run->left < PIECE ? run->left : PIECE;
    uint32_t left = piece;
    while (!run->stuck && p->approached < p->n && kd_geodesic_approach(&p->geodesics[p->approached], p->aim, &left))
        p->approached++;
    run->left -= piece - left;
    if (run->stuck || p->approached < p->n)
        return;
    record_before(p, p->aim - p->t);
    arrive(p);
    record(p);
}

bool kd_playground_go_on(struct kd_playground *p, struct kd_playground_run *run, uint32_t pieces)
{
    for (; pieces && !is_over(p, run); pieces--)
        if (p->params.gravity == KD_GRAVITY_KERR)
            follow_on(p, run);
        else if (go(p))
            run->left--;
        else
            run->stuck = true;
    return !is_over(p, run);
}

struct kd_playground_progress kd_playground_progress(const struct kd_playground *p, const struct kd_playground_run *run)
{
    return (struct kd_playground_progress) { .asked = run->end - run->begin,
                                             .done = p->t - run->begin,
                                             .steps = (uint32_t)(p->steps - run->first),
                                             .slowed = p->t < run->end,
                                             .ended = !(p->t < KD_PLAYGROUND_TIME) };
}

void kd_playground_advance(struct kd_playground *p, double time, struct kd_playground_progress *progress)
{
    struct kd_playground_run run;
    kd_playground_begin(p, time, &run);
    while (kd_playground_go_on(p, &run, UINT32_MAX))
        ;
    *progress = kd_playground_progress(p, &run);
    progress->asked = time;
}
