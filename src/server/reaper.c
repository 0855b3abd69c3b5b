#include "server/reaper.h"

#include "base/clock.h"
#include "base/log.h"
#include "server/job/jobs.h"
#include "server/lesson/lesson.h"
#include "server/playground/sessions.h"
#include "server/render/queue.h"
#include "server/render/thumbnails.h"
#include "server/session/sessions.h"

#include <poll.h>
#include <unistd.h>

#define TICK_MS 100          /* time in ms between two checks for deadlines and clients that have disconnected */
#define LAST_ANSWERS_MS 10e3 /* time in ms for sending the last answers, and for waiting for a driver that may hang */

static void sleep_a_tick(struct kd_server *server)
{
    struct pollfd p = { .fd = server->stop_fd, .events = POLLIN };
    /* The eventfd is not polled during the shutdown: it stays readable, so poll would always return at once. */
    if (atomic_load(&server->phase) == KD_SERVING)
        poll(&p, 1, TICK_MS);
    else
        poll(NULL, 0, TICK_MS / 4);
}

static void enter(struct kd_server *server, enum kd_phase phase, double *since)
{
    atomic_store(&server->phase, phase);
    *since = kd_clock_ms();
}

static void stop_listening(struct kd_server *server)
{
    kd_front_destroy(server->front);
    server->front = NULL;
}

static bool hangs(struct kd_server *server)
{
    return kd_render_queue_hangs(server->renders, kd_thumbnails_hang(server->thumbnails));
}

static bool cut_short(struct kd_server *server)
{
    return atomic_load(&server->abandon) || hangs(server) || kd_render_queue_lost(server->renders, NULL);
}

/* Counts unfinished work. A request may be counted more than once. */
static unsigned unfinished(struct kd_server *server)
{
    return kd_render_queue_unfinished(server->renders) + kd_scheduler_unfinished(server->rays) +
           kd_scheduler_unfinished(server->scheduler) + kd_playground_sessions_unfinished(server->playgrounds);
}

static void refuse(struct kd_server *server, double *since)
{
    const unsigned n = unfinished(server);
    if (n && !cut_short(server))
        kd_log(KD_LOG_WARN,
               "stopping: %u accepted requests are unfinished, with an estimated device time of %.0f s; after %u s the "
               "rest is cancelled (--drain-seconds)",
               n, kd_render_queue_backlog_ms(server->renders) * 1e-3, server->drain_s);
    enter(server, KD_REFUSING, since);
}

static void cancel_all(struct kd_server *server)
{
    kd_render_queue_cancel(server->renders);
    kd_scheduler_cancel(server->rays);
    kd_scheduler_cancel(server->scheduler);
}

/* Cancels accepted work whose time has run out. */
static void end_the_rest(struct kd_server *server)
{
    if (!atomic_load(&server->ended))
        kd_log(KD_LOG_WARN, "stopping: %u requests are unfinished after %u s and are cancelled", unfinished(server),
               server->drain_s);
    atomic_store(&server->ended, true);
    cancel_all(server);
}

/* Advances the shutdown by one check. *since: time when the present phase began. Returns true when the shutdown is
 * complete. */
static bool step_down(struct kd_server *server, double *since)
{
    double age = kd_clock_ms() - *since;

    switch (atomic_load(&server->phase)) {
    case KD_SERVING:
        if (cut_short(server))
            refuse(server, since);
        *since = kd_clock_ms();
        return false;
    case KD_DRAINING:
        if (age >= server->drain_ms || cut_short(server))
            refuse(server, since);
        return false;
    case KD_REFUSING:
        kd_sessions_close(server->sessions);
        kd_playground_sessions_close(server->playgrounds);
        kd_jobs_close(server->jobs);
        kd_thumbnails_cancel(server->thumbnails);
        if (atomic_load(&server->abandon))
            cancel_all(server);
        else if (age + server->drain_ms >= 1e3 * server->drain_s && unfinished(server))
            end_the_rest(server);
        if (unfinished(server))
            return hangs(server) && age >= LAST_ANSWERS_MS;
        stop_listening(server);
        enter(server, KD_CLOSING, since);
        return false;
    default:
        kd_thumbnails_cancel(server->thumbnails); /* repeated for requests that have arrived since this phase began */
        kd_connections_cut_stalled(server->connections);
        return !atomic_load(&server->requests) || age >= LAST_ANSWERS_MS || atomic_load(&server->abandon);
    }
}

void *kd_reaper_main(void *user)
{
    struct kd_server *server = user;
    double since = kd_clock_ms();

    do {
        sleep_a_tick(server);
        kd_connections_sweep(server->connections);
        kd_render_queue_sweep(server->renders);
        kd_sessions_sweep(server->sessions);
        kd_playground_sessions_sweep(server->playgrounds);
        kd_jobs_sweep(server->jobs);
        kd_lessons_sweep(server->lessons);
    } while (!step_down(server, &since));
    if (!hangs(server)) { /* all queues are empty and closed, so no connection is suspended */
        stop_listening(server);
        MHD_stop_daemon(server->daemon);
        MHD_stop_daemon(server->health_daemon);
        server->daemon = server->health_daemon = NULL;
    }
    atomic_store(&server->phase, KD_STOPPED);
    kd_log(KD_LOG_INFO, "stopped");

    pthread_mutex_lock(&server->lock);
    server->stopped = true;
    pthread_cond_broadcast(&server->changed);
    pthread_mutex_unlock(&server->lock);
    return NULL;
}
