#include "server/http/task_scheduler.h"
#include "base/clock.h"
#include "base/cores.h"
#include "base/pause.h"
#include "base/watch.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define WORKERS_MAX 16
#define THREADS_MAX (4 * WORKERS_MAX) /* maximum number of threads, including threads whose slice is suspended */
#define PIECE_MS 15.                  /* time in ms after which a slice is suspended if other jobs wait */

/* A suspended slice. The struct is on the stack of the slice's thread. It is listed among the jobs, and the slice is
 * resumed when it is the first in the list. */
struct paused {
    /* must be the first member; its callback `turn` is NULL, which marks a suspended slice */
    struct kd_scheduler_job place;
    pthread_cond_t resumed;
};

struct kd_scheduler {
    unsigned limit, share;
    _Atomic bool cancel;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool closing;
    /* first: list of jobs, in the order in which they run; parked: list of jobs that wait for an event */
    struct kd_scheduler_job *first, **end, *parked;
    struct kd_scheduler_job *accepted; /* list of all unfinished jobs */
    unsigned n_accepted, unfinished;
    pthread_t threads[THREADS_MAX];
    unsigned n_threads, n_workers, busy, idle; /* busy: number of threads that run a slice, at most n_workers */
};

/* scheduler and job of the calling thread, if it is a worker */
static _Thread_local struct kd_scheduler *mine;
static _Thread_local struct kd_scheduler_job *under_way;
static _Thread_local double piece_ms; /* time when the current slice began or was last resumed */
static _Thread_local bool stops;      /* true if nobody wants the result of the job whose slice is running */

static void append(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    if (job->listed)
        return;
    job->next = NULL;
    job->listed = true;
    *scheduler->end = job;
    scheduler->end = &job->next;
    pthread_cond_signal(&scheduler->changed);
}

static void take_out(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    if (!job->listed)
        return;
    struct kd_scheduler_job **link = &scheduler->first;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
    if (scheduler->end == &job->next)
        scheduler->end = link;
    job->listed = false;
}

static void unpark(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    struct kd_scheduler_job **link = &scheduler->parked;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
    job->parked = false;
    append(scheduler, job);
}

static void park(struct kd_scheduler *scheduler, struct kd_scheduler_job *job, bool away)
{
    if (job->woken || (atomic_load(&scheduler->cancel) && !away)) {
        append(scheduler, job);
        return;
    }
    job->parked = true;
    job->away = away;
    job->next = scheduler->parked;
    scheduler->parked = job;
    if (job->due_ms > 0)
        pthread_cond_signal(&scheduler->changed); /* a sleeping worker may have to wake up earlier than planned */
}

/* Resumes the jobs whose parking time is over. Returns the earliest end of the remaining parking times, or INFINITY. */
static double unpark_due(struct kd_scheduler *scheduler)
{
    double next = INFINITY;
    const double now = scheduler->parked ? kd_clock_ms() : 0;
    for (struct kd_scheduler_job *job = scheduler->parked, *after; job; job = after) {
        after = job->next;
        if (!(job->due_ms > 0) || job->away)
            continue;
        if (job->due_ms <= now)
            unpark(scheduler, job);
        else
            next = fmin(next, job->due_ms);
    }
    return next;
}

static void sleep_until(struct kd_scheduler *scheduler, double ms)
{
    struct timespec t = { .tv_sec = (time_t)(fmin(ms, 1e15) * 1e-3),
                          .tv_nsec = (long)(fmod(fmin(ms, 1e15), 1e3) * 1e6) };
    if (isinf(ms))
        pthread_cond_wait(&scheduler->changed, &scheduler->lock);
    else
        pthread_cond_clockwait(&scheduler->changed, &scheduler->lock, CLOCK_MONOTONIC, &t);
}

static void accept(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    job->next_accepted = scheduler->accepted;
    job->accepted_at = &scheduler->accepted;
    if (job->next_accepted)
        job->next_accepted->accepted_at = &job->next_accepted;
    scheduler->accepted = job;
    scheduler->n_accepted++;
}

static void unref(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    *job->accepted_at = job->next_accepted;
    if (job->next_accepted)
        job->next_accepted->accepted_at = job->accepted_at;
    scheduler->n_accepted--;
}

/* Puts a job back into the list if it may have another slice now. While a slice of a shared job is suspended, no
 * other slice of that job starts, because each would occupy a thread. */
static void list_again(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    if (!job->paused && !job->over)
        append(scheduler, job);
}

/* Runs a slice of the first job in the list. The lock is held on entry and exit. */
static void give_turn(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    take_out(scheduler, job);
    job->workers++;
    job->woken = false;
    if (job->shared)
        list_again(scheduler, job); /* from now on, other workers can run slices of this job too */
    pthread_mutex_unlock(&scheduler->lock);
    under_way = job;
    piece_ms = kd_clock_ms();
    kd_watch_turn_begins();
    enum kd_slice_result turn = job->turn(job);
    kd_watch_turn_ends();
    under_way = NULL; /* `done`, which may free the job, must not be suspended */
    stops = false;
    pthread_mutex_lock(&scheduler->lock);
    job->workers--;
    if (turn == KD_SLICE_LAST)
        job->over = true;
    if (job->over)
        take_out(scheduler, job);
    else if (turn == KD_SLICE_PARK || turn == KD_SLICE_AWAY)
        park(scheduler, job, turn == KD_SLICE_AWAY);
    else
        list_again(scheduler, job);
    if (!job->over || job->workers)
        return;
    unref(scheduler, job);
    pthread_mutex_unlock(&scheduler->lock);
    kd_watch_turn_begins();
    job->done(job);
    kd_watch_turn_ends();
    pthread_mutex_lock(&scheduler->lock);
    scheduler->unfinished--;
}

/* Runs the first entry of the list: resumes the thread of a suspended slice, or runs a slice of a job on this
 * thread. The lock is held on entry and exit. */
static void go_on(struct kd_scheduler *scheduler)
{
    struct kd_scheduler_job *job = scheduler->first;
    scheduler->busy++;
    if (!job->turn) {
        take_out(scheduler, job);
        pthread_cond_signal(&((struct paused *)job)->resumed);
        return;
    }
    give_turn(scheduler, job);
    scheduler->busy--;
}

static bool let_others_go_first(void);

static void *work(void *user)
{
    struct kd_scheduler *scheduler = user;
    mine = scheduler;
    kd_pause_hook = let_others_go_first;
    pthread_mutex_lock(&scheduler->lock);
    while (!scheduler->closing) {
        const double next = unpark_due(scheduler);
        if (scheduler->first && scheduler->busy < scheduler->n_workers) {
            go_on(scheduler);
            continue;
        }
        scheduler->idle++;
        sleep_until(scheduler, next);
        scheduler->idle--;
    }
    pthread_mutex_unlock(&scheduler->lock);
    return NULL;
}

/* Starts another thread. Called with the lock held, or before there are other threads. */
static bool start_thread(struct kd_scheduler *scheduler)
{
    if (scheduler->n_threads == THREADS_MAX ||
        pthread_create(&scheduler->threads[scheduler->n_threads], NULL, work, scheduler))
        return false;
    scheduler->n_threads++;
    return true;
}

/* Suspends the current slice until it is the first in the list. The lock is held on entry and exit. */
static void pause_turn(struct kd_scheduler *scheduler)
{
    struct paused me = { .resumed = PTHREAD_COND_INITIALIZER };
    append(scheduler, &me.place);
    scheduler->busy--;
    pthread_cond_signal(&scheduler->changed);
    while (me.place.listed && !scheduler->closing)
        pthread_cond_wait(&me.resumed, &scheduler->lock);
    if (me.place.listed) { /* at shutdown no worker resumes this slice, so it is still in the list */
        take_out(scheduler, &me.place);
        scheduler->busy++;
    }
    pthread_cond_destroy(&me.resumed);
}

/* Hook of base/pause.h. Suspends this thread's slice until each other job in the list has had a slice. If no other
 * thread can run those jobs, the slice continues. */
static bool let_others_go_first(void)
{
    struct kd_scheduler *scheduler = mine;
    struct kd_scheduler_job *job = under_way;
    if (stops || !job || kd_clock_ms() - piece_ms < PIECE_MS)
        return stops;
    kd_watch_turn_ends();
    pthread_mutex_lock(&scheduler->lock);
    unpark_due(scheduler);
    take_out(scheduler, job);
    job->paused++;
    if (scheduler->first && !scheduler->closing && (scheduler->idle || start_thread(scheduler)))
        pause_turn(scheduler);
    job->paused--;
    if (job->shared)
        list_again(scheduler, job);
    pthread_mutex_unlock(&scheduler->lock);
    under_way = job;
    piece_ms = kd_clock_ms();
    kd_watch_turn_begins();
    return stops = job->unwanted && job->unwanted(job);
}

static unsigned cores(void)
{
    unsigned n = kd_cores();
    return n > WORKERS_MAX ? WORKERS_MAX : n;
}

enum kd_status kd_scheduler_create(unsigned limit, unsigned share, struct kd_scheduler **out, struct kd_error *error)
{
    struct kd_scheduler *scheduler = calloc(1, sizeof *scheduler);
    if (!scheduler)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    scheduler->limit = limit;
    scheduler->share = share;
    scheduler->end = &scheduler->first;
    pthread_mutex_init(&scheduler->lock, NULL);
    pthread_cond_init(&scheduler->changed, NULL);
    pthread_mutex_lock(&scheduler->lock);
    scheduler->n_workers = cores();
    bool started = true;
    for (unsigned i = 0; i < scheduler->n_workers && started; i++)
        started = start_thread(scheduler);
    pthread_mutex_unlock(&scheduler->lock);
    if (!started) {
        kd_scheduler_destroy(scheduler);
        return kd_error_set(error, KD_ENOMEM, "a worker thread could not be started");
    }
    *out = scheduler;
    return KD_OK;
}

void kd_scheduler_destroy(struct kd_scheduler *scheduler)
{
    if (!scheduler)
        return;
    pthread_mutex_lock(&scheduler->lock);
    scheduler->closing = true;
    pthread_cond_broadcast(&scheduler->changed);
    for (struct kd_scheduler_job *job = scheduler->first; job; job = job->next)
        if (!job->turn)
            pthread_cond_signal(&((struct paused *)job)->resumed);
    pthread_mutex_unlock(&scheduler->lock);
    for (unsigned i = 0; i < scheduler->n_threads; i++)
        pthread_join(scheduler->threads[i], NULL);
    pthread_cond_destroy(&scheduler->changed);
    pthread_mutex_destroy(&scheduler->lock);
    free(scheduler);
}

enum kd_status kd_scheduler_admit(struct kd_scheduler *scheduler, const char *client, bool *quota,
                                  struct kd_error *error)
{
    unsigned own = 0;
    pthread_mutex_lock(&scheduler->lock);
    unsigned n = scheduler->n_accepted;
    for (const struct kd_scheduler_job *job = scheduler->accepted; job; job = job->next_accepted)
        own += !strcmp(job->client, client);
    pthread_mutex_unlock(&scheduler->lock);
    *quota = n < scheduler->limit && own >= scheduler->share;
    if (n >= scheduler->limit)
        return kd_error_set(error, KD_EBUSY, "too many requests of this kind are in progress (limit %u)", n);
    return *quota ? kd_error_set(error, KD_EBUSY,
                                 "you have too many requests of this kind in progress (limit %u for one client)", own)
                  : KD_OK;
}

void kd_scheduler_push(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    pthread_mutex_lock(&scheduler->lock);
    accept(scheduler, job);
    scheduler->unfinished++;
    append(scheduler, job);
    pthread_mutex_unlock(&scheduler->lock);
}

void kd_scheduler_wake(struct kd_scheduler *scheduler, struct kd_scheduler_job *job)
{
    pthread_mutex_lock(&scheduler->lock);
    job->woken = true;
    if (job->parked)
        unpark(scheduler, job);
    pthread_mutex_unlock(&scheduler->lock);
}

unsigned kd_scheduler_unfinished(struct kd_scheduler *scheduler)
{
    pthread_mutex_lock(&scheduler->lock);
    unsigned n = scheduler->unfinished;
    pthread_mutex_unlock(&scheduler->lock);
    return n;
}

void kd_scheduler_cancel(struct kd_scheduler *scheduler)
{
    pthread_mutex_lock(&scheduler->lock);
    atomic_store(&scheduler->cancel, true);
    for (struct kd_scheduler_job *job = scheduler->parked, *next; job; job = next) {
        next = job->next;
        if (!job->away)
            unpark(scheduler, job);
    }
    pthread_mutex_unlock(&scheduler->lock);
}

bool kd_scheduler_cancelled(struct kd_scheduler *scheduler) { return atomic_load(&scheduler->cancel); }
