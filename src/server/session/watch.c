/* Viewers of sessions, and the check of all sessions that is made regularly. */
#include "base/log.h"
#include "base/clock.h"
#include "server/session/session_internal.h"
#include "server/session/sessions.h"

#include <poll.h>
#include <stdlib.h>

#define LOOK_MS 1000.0 /* time in ms between two checks for clients that have disconnected */

/* Resumes the connection of the viewer. Called with the lock held. */
static void wake(struct kd_viewer *viewer)
{
    if (!viewer->waiting)
        return;
    viewer->waiting = false;
    MHD_resume_connection(viewer->mhd);
}

void kd_session_wake(struct kd_session *s)
{
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        if (!s->listed || s->failed || v->owed ||
            (s->latest && s->latest->number > v->seen && (v->any || kd_session_file(v, s->latest))))
            wake(v);
}

bool kd_session_awaited(const struct kd_session *s)
{
    for (const struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting)
            return true;
    return !s->begun;
}

void kd_viewer_attach(struct kd_viewer *viewer)
{
    struct kd_session *s = viewer->session;
    pthread_mutex_lock(&s->all->lock);
    viewer->previous = NULL;
    viewer->next = s->viewers;
    if (viewer->next)
        viewer->next->previous = viewer;
    s->viewers = viewer;
    pthread_mutex_unlock(&s->all->lock);
}

void kd_viewer_detach(struct kd_viewer *viewer)
{
    struct kd_session *s = viewer->session;
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    if (viewer->previous)
        viewer->previous->next = viewer->next;
    else
        s->viewers = viewer->next;
    if (viewer->next)
        viewer->next->previous = viewer->previous;
    kd_live_frame_release(viewer->owed);
    viewer->owed = NULL;
    s->used_ms = kd_clock_ms();
    kd_session_unref(s);
    pthread_mutex_unlock(&all->lock);
    viewer->session = NULL;
}

/* Stores a reference to the frame in *out. */
static void give(struct kd_viewer *viewer, struct kd_live_frame *frame, struct kd_live_frame **out)
{
    kd_live_frame_release(viewer->owed);
    viewer->owed = NULL;
    viewer->file = viewer->any ? NULL : kd_session_file(viewer, frame);
    viewer->seen = frame->number;
    *out = frame;
}

/* Determines the result of kd_viewer_next. Called with the lock held. */
static enum kd_viewer_news news(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error)
{
    struct kd_session *s = viewer->session;
    if (s->failed && error)
        *error = s->error;
    if (!s->listed || s->failed)
        return KD_VIEWER_OVER;
    if (viewer->gone)
        return KD_VIEWER_GONE;
    const bool newer = s->latest && s->latest->number > viewer->seen;
    if (newer && (viewer->any || kd_session_file(viewer, s->latest))) {
        give(viewer, kd_live_frame_share(s->latest), frame);
        return KD_VIEWER_FRAME;
    }
    if (viewer->owed) {
        struct kd_live_frame *owed = viewer->owed;
        viewer->owed = NULL;
        give(viewer, owed, frame);
        return KD_VIEWER_FRAME;
    }
    /* if there is a newer frame, it is sent as soon as it is encoded, even after the deadline */
    if (viewer->late && !newer) {
        viewer->late = false;
        return KD_VIEWER_LATE;
    }
    viewer->waiting = true;
    /* suspended with the lock held: once it is released, another thread may resume the connection */
    MHD_suspend_connection(viewer->mhd);
    kd_session_add_kinds(s);
    kd_session_pump(s);
    return KD_VIEWER_LATER;
}

enum kd_viewer_news kd_viewer_next(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error)
{
    pthread_mutex_lock(&viewer->session->all->lock);
    enum kd_viewer_news what = news(viewer, frame, error);
    pthread_mutex_unlock(&viewer->session->all->lock);
    return what;
}

static void sweep_deadlines(struct kd_session *s, double now) /* called with the lock held */
{
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting && now > v->deadline_ms) {
            v->late = true;
            wake(v);
        }
}

/* Polls all waiting sockets in one call, so that hundreds of idle viewers cost no measurable time. Called with the
 * lock held. */
static void sweep_gone(struct kd_sessions *all)
{
    size_t n = 0, i = 0;
    for (struct kd_session *s = all->first; s; s = s->next)
        for (struct kd_viewer *v = s->viewers; v; v = v->next)
            n += v->waiting;
    struct pollfd *list = n ? calloc(n, sizeof *list) : NULL;
    if (!list)
        return;
    for (struct kd_session *s = all->first; s; s = s->next)
        for (struct kd_viewer *v = s->viewers; v; v = v->next)
            if (v->waiting)
                list[i++] = (struct pollfd) { .fd = v->socket, .events = POLLRDHUP };
    poll(list, n, 0);
    i = 0;
    for (struct kd_session *s = all->first; s; s = s->next)
        for (struct kd_viewer *v = s->viewers; v; v = v->next)
            if (v->waiting && (list[i++].revents & (POLLRDHUP | POLLHUP | POLLERR))) {
                v->gone = true;
                wake(v);
            }
    free(list);
}

void kd_sessions_sweep(struct kd_sessions *all)
{
    double now = kd_clock_ms();
    pthread_mutex_lock(&all->lock);
    if (now - all->looked_ms > LOOK_MS) {
        all->looked_ms = now;
        sweep_gone(all);
    }
    for (struct kd_session *s = all->first, *next; s; s = next) {
        next = s->next;
        sweep_deadlines(s, now);
        if (s->viewers)
            s->used_ms = now;
        else if (now - s->used_ms > LOOK_MS)
            kd_session_drop_refinement(s);
        kd_session_forget_pixels(s, now);
        kd_session_pump(s);
        if (now - s->used_ms > all->params.idle_ms) {
            kd_log(KD_LOG_INFO, "session %.4s... ends, because it has no viewer", s->id);
            kd_session_unlist(s);
        }
    }
    pthread_mutex_unlock(&all->lock);
}
