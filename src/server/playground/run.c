/* Runs a playground session in slices. The goal is a time that advances with the clock at the requested rate. The
 * bodies follow in sub-steps until they have passed the goal. They may lag behind by LAG_S times the rate, and catch
 * up later; a larger lag is skipped. The setting `budget` limits the number of sub-steps per beat, which is a
 * thirtieth of a second. */
#include "base/clock.h"
#include "playground/show.h"
#include "server/playground/playground_internal.h"

#include <math.h>

#define TURN_MS 10.
#define TICK_MS 33. /* interval between ticks */
#define LEAST_MS 8. /* minimum time in ms between two slices */
#define MOST_MS 100.
#define LAG_S 0.1
#define BEATS 30.    /* number of beats per second */
#define RATE_MS 500. /* period in ms over which the achieved rate is measured */
#define FEW 64       /* number of bodies up to which a sub-step takes only a microsecond or two */
#define PIECES 16    /* number of sub-steps between two reads of the clock, if there are few bodies */

/* Data that a slice needs; they are read at its start. */
struct order {
    bool over, goes, anew, awaited;
    double rate;
    uint32_t debris;          /* number of pieces of debris that clients want */
    struct kd_session *shown; /* a counted reference to the playground's picture if it has viewers; otherwise NULL */
};

/* Maximum number of pieces of debris that a client waits for, or has requested recently. Called with the lock held. */
static uint32_t wanted_debris(const struct kd_playground_session *play, double now)
{
    uint32_t most = now - play->debris_ms < KD_PLAY_REST_MS ? play->debris : 0;
    for (const struct kd_playground_session_watcher *w = play->watchers; w; w = w->next)
        most = w->debris > most ? w->debris : most;
    return most;
}

static struct order look(struct kd_playground_session *play, double now)
{
    pthread_mutex_lock(&play->all->lock);
    const struct order order = { .over = !play->listed,
                                 .anew = play->anew,
                                 .rate = play->pace.rate,
                                 .awaited = kd_playground_session_awaited(play),
                                 .goes = !play->pace.paused && !play->stepping && play->pace.rate > 0 &&
                                         kd_playground_session_awake(play, now),
                                 .debris = wanted_debris(play, now),
                                 .shown = kd_playground_session_shown(play, now) };
    play->anew = false;
    if (play->unshown)
        play->shown = 0;
    play->unshown = false;
    if (!order.goes)
        play->reached = 0;
    pthread_mutex_unlock(&play->all->lock);
    return order;
}

void kd_playground_session_log(struct kd_playground_session *play, const struct kd_playground *p)
{
    struct kd_playground_events *log = &play->log;
    /* No lock is needed, because only the job that owns the playground changes these two lists of events. */
    if (p->events.last == log->last)
        return;
    pthread_mutex_lock(&play->all->lock);
    play->all->events += p->events.last - log->last;
    while (log->last < p->events.last) {
        const struct kd_playground_event *event = kd_playground_event_at(&p->events, ++log->last);
        if (event)
            log->ring[log->last % KD_PLAYGROUND_EVENTS] = *event;
    }
    pthread_mutex_unlock(&play->all->lock);
}

uint32_t kd_playground_session_pieces(const struct kd_playground *p)
{
    return p->n <= FEW && p->debris.alive <= FEW && p->params.gravity != KD_GRAVITY_KERR ? PIECES : 1;
}

static void start_clock(struct kd_playground_session *play, double now)
{
    play->looked_ms = play->measured_ms = now;
    play->goal = play->measured_t = play->p->t;
    play->allowance = play->p->params.budget;
}

/* Computes sub-steps until the goal is reached, the allowance is used up, or the slice is over. */
static void follow(struct kd_playground_session *play, double until)
{
    struct kd_playground *p = play->p;
    struct kd_playground_run run;
    if (!(play->goal > p->t) || play->allowance < 1)
        return;
    kd_playground_begin(p, play->goal - p->t, &run);
    const uint32_t most = run.left = (uint32_t)fmin(play->allowance, run.left);
    bool more = true;
    while (more && kd_clock_ms() < until) {
        more = kd_playground_go_on(p, &run, kd_playground_session_pieces(p));
        kd_playground_session_log(play, p);
    }
    play->allowance -= most - run.left;
    if (run.stuck)
        play->allowance = 0;
}

/* Advances the playground. Returns true if it lags. */
static bool advance(struct kd_playground_session *play, double rate, double now)
{
    struct kd_playground *p = play->p;
    const double seconds = 1e-3 * (now - play->looked_ms), begin = p->t;
    const uint64_t steps = p->steps;
    play->looked_ms = now;
    play->goal += rate * seconds;
    play->allowance = fmin(play->allowance + p->params.budget * seconds * BEATS, p->params.budget);
    follow(play, now + TURN_MS);
    const bool spent = play->allowance<1, slowed = play->goal - p->t>(spent ? 0 : rate * LAG_S);
    if (slowed)
        play->goal = p->t + (spent ? 0 : rate * LAG_S);
    const double end = kd_clock_ms();
    pthread_mutex_lock(&play->all->lock);
    if (slowed)
        play->slowed_ms = end;
    if (end - play->measured_ms > RATE_MS) {
        play->reached = 1e3 * (p->t - play->measured_t) / (end - play->measured_ms);
        play->measured_ms = end;
        play->measured_t = p->t;
    }
    play->generation += p->t > begin;
    play->all->steps += p->steps - steps;
    pthread_mutex_unlock(&play->all->lock);
    return play->goal > p->t;
}

static bool has_debris(const struct kd_playground_session_tick *tick, uint32_t wanted)
{
    return !wanted || (tick->has_debris && tick->most >= wanted);
}

/* Publishes a tick if a client waits for one and it is due. Returns the time when this must be called again, or 0 if
 * that is not necessary. */
static double publish(struct kd_playground_session *play, const struct order *order, double now)
{
    const struct kd_playground_session_state state = kd_playground_session_state(play);
    pthread_mutex_lock(&play->all->lock);
    const bool fresh =
        play->tick && play->tick->generation == state.generation && has_debris(play->tick, order->debris);
    const bool first = !play->tick;
    pthread_mutex_unlock(&play->all->lock);
    if (fresh || (!order->awaited && !first))
        return 0;
    if (order->goes && now - play->ticked_ms < TICK_MS)
        return play->ticked_ms + TICK_MS;
    struct kd_playground_session_tick *tick = kd_playground_session_tick_make(play->p, &state, order->debris);
    if (!tick)
        return now + MOST_MS; /* out of memory: tries again later */
    play->ticked_ms = now;
    pthread_mutex_lock(&play->all->lock);
    kd_playground_session_tick_release(play->tick);
    play->tick = tick;
    kd_playground_session_wake(play, now);
    pthread_mutex_unlock(&play->all->lock);
    return 0;
}

/* Passes the new bodies to the picture. Returns the time when this must be called again, or 0 if that is not
 * necessary. */
static double show(struct kd_playground_session *play, const struct order *order, double now)
{
    struct kd_dynamic_bodies *dynamic = NULL;
    const uint64_t generation = kd_playground_session_state(play).generation;
    if (!order->shown || play->shown == generation)
        return 0;
    if (order->goes && play->shown && now - play->shown_ms < TICK_MS)
        return play->shown_ms + TICK_MS;
    if (play->shown && !kd_session_hungry(order->shown))
        return now + TICK_MS; /* one set of bodies per frame is enough */
    if (kd_playground_show(play->p, &dynamic, NULL))
        return now + MOST_MS; /* out of memory: tries again later */
    play->shown = generation;
    play->shown_ms = now;
    kd_session_show(order->shown, dynamic);
    return 0;
}

static double sooner(double one, double other) { return one > 0 && (one < other || !(other > 0)) ? one : other; }

enum kd_slice_result kd_playground_session_turn(struct kd_scheduler_job *job)
{
    struct kd_playground_session *play = (struct kd_playground_session *)job;
    bool behind = false;
    /* The playground is taken before look(), because its present owner may change what this slice must do. */
    if (!kd_playground_session_take(play, &play->waiter))
        return KD_SLICE_AWAY;
    double now = kd_clock_ms();
    const struct order order = look(play, now);
    if (order.over) {
        kd_playground_session_give(play, play->p);
        if (order.shown)
            kd_session_release(order.shown);
        return KD_SLICE_LAST;
    }
    if (!order.goes)
        play->looked_ms = 0;
    else if (order.anew || !(play->looked_ms > 0))
        start_clock(play, now);
    else
        behind = advance(play, order.rate, now);
    now = kd_clock_ms();
    const double ahead = play->p->t - play->goal,
                 next = order.goes ? now + fmin(fmax(1e3 * ahead / order.rate, LEAST_MS), MOST_MS) : 0;
    job->due_ms = sooner(publish(play, &order, now), sooner(show(play, &order, now), next));
    kd_playground_session_give(play, play->p);
    if (order.shown)
        kd_session_release(order.shown);
    return behind ? KD_SLICE_MORE : KD_SLICE_PARK;
}
