/* Watchers of playground sessions, and the check of all sessions that is made regularly. */
#include "base/clock.h"
#include "base/log.h"
#include "server/http/connections.h"
#include "server/playground/playground_internal.h"

#include <math.h>

#define LOOK_MS 1000. /* time in ms between two checks for clients that have disconnected */

/* All functions from here on are called with the lock held. */

static bool has_tick(const struct kd_playground_session_watcher *w)
{
    const struct kd_playground_session_tick *tick = w->play->tick;
    return tick && tick->generation >= w->least && (!w->debris || (tick->has_debris && tick->most >= w->debris));
}

static enum kd_playground_session_news news(const struct kd_playground_session_watcher *w, double now)
{
    const struct kd_playground_session *play = w->play;
    if (w->stream && w->event < play->log.last)
        return KD_PLAY_EVENT;
    if (!play->listed)
        return KD_PLAY_OVER;
    if (has_tick(w))
        return KD_PLAY_TICK;
    /* true if such a tick is being made and will come soon */
    const bool comes = !w->stream && play->generation >= w->least;
    return now > w->deadline_ms && !comes ? KD_PLAY_LATE : KD_PLAY_LATER;
}

static void resume(struct kd_playground_session_watcher *w)
{
    w->waiting = false;
    MHD_resume_connection(w->mhd);
}

void kd_playground_session_wake(struct kd_playground_session *play, double now)
{
    for (struct kd_playground_session_watcher *w = play->watchers; w; w = w->next)
        if (w->waiting && news(w, now) != KD_PLAY_LATER)
            resume(w);
}

bool kd_playground_session_awaited(const struct kd_playground_session *play)
{
    for (const struct kd_playground_session_watcher *w = play->watchers; w; w = w->next)
        if (w->waiting)
            return true;
    return false;
}

/* Takes the first event in the log after the one that was sent last. The number of this event in *event shows how
 * many events in between were discarded. */
static void take_event(struct kd_playground_session_watcher *w, struct kd_playground_event *event)
{
    const struct kd_playground_event *found = NULL;
    while (!found && w->event < w->play->log.last)
        found = kd_playground_event_at(&w->play->log, ++w->event);
    *event = found ? *found : (struct kd_playground_event) { .number = 0 };
}

/* All functions from here on take the lock themselves. */

void kd_playground_session_watch(struct kd_playground_session_watcher *w, const uint64_t *after)
{
    struct kd_playground_session *play = w->play;
    pthread_mutex_lock(&play->all->lock);
    w->least = after && *after <= play->generation ? *after + 1 : play->generation;
    /* There was never an event with this number, so the client is treated as having none. */
    if (w->event > play->log.last || w->event < play->log_begin)
        w->event = play->log_begin;
    if (w->debris) {
        const double now = kd_clock_ms();
        if (w->debris >= play->debris || now - play->debris_ms > KD_PLAY_REST_MS) {
            play->debris = w->debris;
            play->debris_ms = now;
        }
    }
    w->previous = NULL;
    w->next = play->watchers;
    if (w->next)
        w->next->previous = w;
    play->watchers = w;
    pthread_mutex_unlock(&play->all->lock);
}

void kd_playground_session_unwatch(struct kd_playground_session_watcher *w)
{
    struct kd_playground_session *play = w->play;
    struct kd_playground_sessions *all = play->all;
    pthread_mutex_lock(&all->lock);
    if (w->previous)
        w->previous->next = w->next;
    else
        play->watchers = w->next;
    if (w->next)
        w->next->previous = w->previous;
    play->used_ms = kd_clock_ms();
    struct kd_playground_session *unused = kd_playground_session_unref(play);
    pthread_mutex_unlock(&all->lock);
    kd_playground_session_destroy(unused);
    w->play = NULL;
}

enum kd_playground_session_news kd_playground_session_await(struct kd_playground_session_watcher *w,
                                                            struct kd_playground_session_tick **tick,
                                                            struct kd_playground_event *event, const char **why)
{
    struct kd_playground_session *play = w->play;
    const double now = kd_clock_ms();
    pthread_mutex_lock(&play->all->lock);
    enum kd_playground_session_news what = news(w, now);
    if (what == KD_PLAY_TICK) {
        *tick = play->tick;
        atomic_fetch_add(&play->tick->references, 1);
        w->least = play->tick->generation + 1;
    } else if (what == KD_PLAY_EVENT) {
        take_event(w, event);
    } else if (what == KD_PLAY_OVER) {
        *why = play->why;
    } else if (what == KD_PLAY_LATER && kd_socket_abandoned(w->socket)) {
        what = KD_PLAY_GONE;
    } else if (what == KD_PLAY_LATER) {
        w->waiting = true;
        /* suspended with the lock held: once it is released, another thread may resume the connection */
        MHD_suspend_connection(w->mhd);
        kd_playground_session_call(play);
    }
    pthread_mutex_unlock(&play->all->lock);
    return what;
}

void kd_playground_sessions_sweep(struct kd_playground_sessions *all)
{
    const double now = kd_clock_ms();
    pthread_mutex_lock(&all->lock);
    const bool look = now - all->looked_ms > LOOK_MS;
    if (look)
        all->looked_ms = now;
    for (struct kd_playground_session *play = all->first, *next; play; play = next) {
        next = play->next;
        if (play->watchers || play->stepping || kd_playground_session_looked_at(play))
            play->used_ms = now;
        kd_playground_session_wake(play, now);
        for (struct kd_playground_session_watcher *w = look ? play->watchers : NULL; w; w = w->next)
            if (w->waiting && kd_socket_abandoned(w->socket))
                resume(w); /* kd_playground_session_await then reports that the client has disconnected */
        if (now - play->used_ms > all->params.idle_ms) {
            kd_log(KD_LOG_INFO, "playground %.4s... ends, because it has no viewer", play->id);
            kd_playground_session_unlist(play, "idle");
        }
    }
    pthread_mutex_unlock(&all->lock);
}
