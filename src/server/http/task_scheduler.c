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
#define THREADS_MAX (4 * WORKERS_MAX) /* including threads that are suspended in a slice */
#define PIECE_MS 15.                  /* time that a slice runs before other jobs go first */

/* A suspended slice, on the stack of its thread. It is listed among the jobs, and is resumed when it is the first. */
struct paused {
    struct kd_scheduler_job place; /* must be the first member; its turn is NULL */
    pthread_cond_t resumed;
};

struct kd_scheduler {
    unsigned limit, share;
    _Atomic bool cancel;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool closing;
    /* first: listed jobs, in the order in which they run; parked: jobs that wait */
    struct kd_scheduler_job *first, **end, *parked;
    struct kd_scheduler_job *accepted; /* all jobs that are not done */
    unsigned n_accepted, unfinished;
    pthread_t threads[THREADS_MAX];
    unsigned n_threads, n_workers, busy, idle; /* busy: threads that run a slice, at most n_workers */
};

/* the calling thread's scheduler and job, if it is a worker */
static _Thread_local struct kd_scheduler *mine;
static _Thread_local struct kd_scheduler_job *under_way;
static _Thread_local double piece_ms; /* when the current slice began or was last resumed */

static void append(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    if (job->listed)
        return;
    job->next = NULL;
    job->listed = true;
    *turns->end = job;
    turns->end = &job->next;
    pthread_cond_signal(&turns->changed);
}

static void take_out(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    if (!job->listed)
        return;
    struct kd_scheduler_job **link = &turns->first;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
    if (turns->end == &job->next)
        turns->end = link;
    job->listed = false;
}

static void unpark(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    struct kd_scheduler_job **link = &turns->parked;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
    job->parked = false;
    append(turns, job);
}

static void park(struct kd_scheduler *turns, struct kd_scheduler_job *job, bool away)
{
    if (job->woken || (atomic_load(&turns->cancel) && !away)) {
        append(turns, job);
        return;
    }
    job->parked = true;
    job->away = away;
    job->next = turns->parked;
    turns->parked = job;
    if (job->due_ms > 0)
        pthread_cond_signal(&turns->changed); /* a sleeping worker must wake earlier */
}

/* Resumes the jobs whose parking time has ended. Returns the time at which the next one ends, or INFINITY. */
static double unpark_due(struct kd_scheduler *turns)
{
    double next = INFINITY;
    const double now = turns->parked ? kd_clock_ms() : 0;
    for (struct kd_scheduler_job *job = turns->parked, *after; job; job = after) {
        after = job->next;
        if (!(job->due_ms > 0) || job->away)
            continue;
        if (job->due_ms <= now)
            unpark(turns, job);
        else
            next = fmin(next, job->due_ms);
    }
    return next;
}

static void sleep_until(struct kd_scheduler *turns, double ms)
{
    struct timespec t = { .tv_sec = (time_t)(fmin(ms, 1e15) * 1e-3),
                          .tv_nsec = (long)(fmod(fmin(ms, 1e15), 1e3) * 1e6) };
    if (isinf(ms))
        pthread_cond_wait(&turns->changed, &turns->lock);
    else
        pthread_cond_clockwait(&turns->changed, &turns->lock, CLOCK_MONOTONIC, &t);
}

static void accept(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    job->next_accepted = turns->accepted;
    job->accepted_at = &turns->accepted;
    if (job->next_accepted)
        job->next_accepted->accepted_at = &job->next_accepted;
    turns->accepted = job;
    turns->n_accepted++;
}

static void unref(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    *job->accepted_at = job->next_accepted;
    if (job->next_accepted)
        job->next_accepted->accepted_at = job->accepted_at;
    turns->n_accepted--;
}

/* Lists a job again, if it may have a further slice now. While a slice of a shared job is suspended no other slice of
 * it begins: each would occupy a thread. */
static void list_again(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    if (!job->paused && !job->over)
        append(turns, job);
}

/* Runs a slice of the first job in the list. Locked on entry and exit. */
static void give_turn(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    take_out(turns, job);
    job->workers++;
    job->woken = false;
    if (job->shared)
        list_again(turns, job); /* so that other workers can join */
    pthread_mutex_unlock(&turns->lock);
    under_way = job;
    piece_ms = kd_clock_ms();
    kd_watch_turn_begins();
    enum kd_slice_result turn = job->turn(job);
    kd_watch_turn_ends();
    under_way = NULL; /* done may free the job, and never suspends */
    pthread_mutex_lock(&turns->lock);
    job->workers--;
    if (turn == KD_SLICE_LAST)
        job->over = true;
    if (job->over)
        take_out(turns, job);
    else if (turn == KD_SLICE_PARK || turn == KD_SLICE_AWAY)
        park(turns, job, turn == KD_SLICE_AWAY);
    else
        list_again(turns, job);
    if (!job->over || job->workers)
        return;
    unref(turns, job);
    pthread_mutex_unlock(&turns->lock);
    kd_watch_turn_begins();
    job->done(job);
    kd_watch_turn_ends();
    pthread_mutex_lock(&turns->lock);
    turns->unfinished--;
}

/* Runs the first entry of the list: resumes the thread of a suspended slice, or runs a job's slice on this thread.
 * Locked on entry and exit. */
static void go_on(struct kd_scheduler *turns)
{
    struct kd_scheduler_job *job = turns->first;
    turns->busy++;
    if (!job->turn) {
        take_out(turns, job);
        pthread_cond_signal(&((struct paused *)job)->resumed);
        return;
    }
    give_turn(turns, job);
    turns->busy--;
}

static void let_others_go_first(void);

static void *work(void *user)
{
    struct kd_scheduler *turns = user;
    mine = turns;
    kd_pause_hook = let_others_go_first;
    pthread_mutex_lock(&turns->lock);
    while (!turns->closing) {
        const double next = unpark_due(turns);
        if (turns->first && turns->busy < turns->n_workers) {
            go_on(turns);
            continue;
        }
        turns->idle++;
        sleep_until(turns, next);
        turns->idle--;
    }
    pthread_mutex_unlock(&turns->lock);
    return NULL;
}

/* Starts another thread. Called with the lock, or before other threads exist. */
static bool start_thread(struct kd_scheduler *turns)
{
    if (turns->n_threads == THREADS_MAX || pthread_create(&turns->threads[turns->n_threads], NULL, work, turns))
        return false;
    turns->n_threads++;
    return true;
}

/* Suspends the current slice until its place in the list is reached. Locked on entry and exit. */
static void pause_turn(struct kd_scheduler *turns)
{
    struct paused me = { .resumed = PTHREAD_COND_INITIALIZER };
    append(turns, &me.place);
    turns->busy--;
    pthread_cond_signal(&turns->changed);
    while (me.place.listed && !turns->closing)
        pthread_cond_wait(&me.resumed, &turns->lock);
    if (me.place.listed) { /* shutdown: no worker resumes it any more */
        take_out(turns, &me.place);
        turns->busy++;
    }
    pthread_cond_destroy(&me.resumed);
}

/* Hook of base/pause.h: suspends this thread's slice until the other listed jobs have had theirs. If no other thread
 * can run these, the slice continues. */
static void let_others_go_first(void)
{
    struct kd_scheduler *turns = mine;
    struct kd_scheduler_job *job = under_way;
    if (!job || kd_clock_ms() - piece_ms < PIECE_MS)
        return;
    kd_watch_turn_ends();
    pthread_mutex_lock(&turns->lock);
    unpark_due(turns);
    take_out(turns, job);
    job->paused++;
    if (turns->first && !turns->closing && (turns->idle || start_thread(turns)))
        pause_turn(turns);
    job->paused--;
    if (job->shared)
        list_again(turns, job);
    pthread_mutex_unlock(&turns->lock);
    under_way = job;
    piece_ms = kd_clock_ms();
    kd_watch_turn_begins();
}

static unsigned cores(void)
{
    unsigned n = kd_cores();
    return n > WORKERS_MAX ? WORKERS_MAX : n;
}

enum kd_status kd_scheduler_create(unsigned limit, unsigned share, struct kd_scheduler **out, struct kd_error *error)
{
    struct kd_scheduler *turns = calloc(1, sizeof *turns);
    if (!turns)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    turns->limit = limit;
    turns->share = share;
    turns->end = &turns->first;
    pthread_mutex_init(&turns->lock, NULL);
    pthread_cond_init(&turns->changed, NULL);
    pthread_mutex_lock(&turns->lock);
    turns->n_workers = cores();
    bool started = true;
    for (unsigned i = 0; i < turns->n_workers && started; i++)
        started = start_thread(turns);
    pthread_mutex_unlock(&turns->lock);
    if (!started) {
        kd_scheduler_destroy(turns);
        return kd_error_set(error, KD_ENOMEM, "a worker thread could not be started");
    }
    *out = turns;
    return KD_OK;
}

void kd_scheduler_destroy(struct kd_scheduler *turns)
{
    if (!turns)
        return;
    pthread_mutex_lock(&turns->lock);
    turns->closing = true;
    pthread_cond_broadcast(&turns->changed);
    for (struct kd_scheduler_job *job = turns->first; job; job = job->next)
        if (!job->turn)
            pthread_cond_signal(&((struct paused *)job)->resumed);
    pthread_mutex_unlock(&turns->lock);
    for (unsigned i = 0; i < turns->n_threads; i++)
        pthread_join(turns->threads[i], NULL);
    pthread_cond_destroy(&turns->changed);
    pthread_mutex_destroy(&turns->lock);
    free(turns);
}

enum kd_status kd_scheduler_admit(struct kd_scheduler *turns, const char *client, bool *quota, struct kd_error *error)
{
    unsigned own = 0;
    pthread_mutex_lock(&turns->lock);
    unsigned n = turns->n_accepted;
    for (const struct kd_scheduler_job *job = turns->accepted; job; job = job->next_accepted)
        own += !strcmp(job->client, client);
    pthread_mutex_unlock(&turns->lock);
    *quota = n < turns->limit && own >= turns->share;
    if (n >= turns->limit)
        return kd_error_set(error, KD_EBUSY, "too many such requests are in progress (limit %u)", n);
    return *quota ? kd_error_set(error, KD_EBUSY,
                                 "you have too many such requests in progress (limit %u for one client)", own)
                  : KD_OK;
}

void kd_scheduler_push(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    pthread_mutex_lock(&turns->lock);
    accept(turns, job);
    turns->unfinished++;
    append(turns, job);
    pthread_mutex_unlock(&turns->lock);
}

void kd_scheduler_wake(struct kd_scheduler *turns, struct kd_scheduler_job *job)
{
    pthread_mutex_lock(&turns->lock);
    job->woken = true;
    if (job->parked)
        unpark(turns, job);
    pthread_mutex_unlock(&turns->lock);
}

unsigned kd_scheduler_unfinished(struct kd_scheduler *turns)
{
    pthread_mutex_lock(&turns->lock);
    unsigned n = turns->unfinished;
    pthread_mutex_unlock(&turns->lock);
    return n;
}

void kd_scheduler_cancel(struct kd_scheduler *turns)
{
    pthread_mutex_lock(&turns->lock);
    atomic_store(&turns->cancel, true);
    for (struct kd_scheduler_job *job = turns->parked, *next; job; job = next) {
        next = job->next;
        if (!job->away)
            unpark(turns, job);
    }
    pthread_mutex_unlock(&turns->lock);
}

bool kd_scheduler_cancelled(struct kd_scheduler *turns) { return atomic_load(&turns->cancel); }
