/* Watchers of jobs, and the check of all jobs that is made regularly. */
#include "base/log.h"
#include "base/clock.h"
#include "server/job/job_internal.h"

/* Maximum number of files that one check of all jobs removes. This takes some milliseconds, and must not delay the
 * other work of the thread. */
#define FILES_A_SWEEP 200

void kd_job_watch(struct kd_job_watcher *watcher)
{
    struct kd_job *job = watcher->job;
    pthread_mutex_lock(&job->all->lock);
    watcher->next_watcher = job->watchers;
    if (job->watchers)
        job->watchers->previous = watcher;
    job->watchers = watcher;
    pthread_mutex_unlock(&job->all->lock);
}

void kd_job_unwatch(struct kd_job_watcher *watcher)
{
    struct kd_job *job = watcher->job;
    pthread_mutex_lock(&job->all->lock);
    if (watcher->previous)
        watcher->previous->next_watcher = watcher->next_watcher;
    else
        job->watchers = watcher->next_watcher;
    if (watcher->next_watcher)
        watcher->next_watcher->previous = watcher->previous;
    pthread_mutex_unlock(&job->all->lock);
    kd_job_release(job);
}

/* Returns what has happened for a watcher. Called with the lock held. */
static enum kd_job_news news(const struct kd_job_watcher *w, double now)
{
    const struct kd_job *job = w->job;
    if (w->by_frame ? w->next < job->frames && job->have[w->next] : w->revision != job->revision)
        return KD_JOB_NEWS;
    if (!kd_job_is_active(job) || job->all->closed || w->next >= job->frames)
        return KD_JOB_OVER;
    return now > w->deadline_ms ? KD_JOB_LATE : KD_JOB_LATER;
}

enum kd_job_news kd_job_await(struct kd_job_watcher *w)
{
    pthread_mutex_lock(&w->job->all->lock);
    enum kd_job_news what = news(w, kd_clock_ms());
    w->revision = w->job->revision;
    if (what == KD_JOB_LATER) {
        w->waiting = true;
        /* suspended with the lock held: once it is released, another thread may resume the connection */
        MHD_suspend_connection(w->mhd);
    }
    pthread_mutex_unlock(&w->job->all->lock);
    return what;
}

void kd_job_wake(struct kd_job *job, double now)
{
    for (struct kd_job_watcher *w = job->watchers; w; w = w->next_watcher)
        if (w->waiting && news(w, now) != KD_JOB_LATER) {
            w->waiting = false;
            MHD_resume_connection(w->mhd);
        }
}

/* Removes from the list a finished job that has expired and that nobody is reading. The caller gets the list's
 * reference. Called with the lock held. */
static struct kd_job *take_old(struct kd_jobs *all)
{
    double now = kd_clock_ms();
    for (struct kd_job *job = all->first; job; job = job->link)
        if (!kd_job_is_active(job) && job->references == 1 && now - job->ended_ms > 1e3 * all->params.keep_s) {
            kd_log(KD_LOG_INFO, "job %.4s... expired after %.0f s", job->record.id, all->params.keep_s);
            kd_job_unlist(job);
            return job;
        }
    return NULL;
}

#define ORDER_MS 20.0 /* maximum time in ms that one check of all jobs spends on the order of frames */

/* Continues, after a restart, to compute the order of a sweep's frames. Called without the lock. */
static void put_in_order(struct kd_jobs *all)
{
    pthread_mutex_lock(&all->lock);
    struct kd_job *job = all->first;
    while (job && !job->unordered)
        job = job->link;
    if (job)
        job->references++;
    pthread_mutex_unlock(&all->lock);
    if (!job)
        return;
    enum kd_status status = kd_sweep_order_go_on(&job->order, job->spec.sweep, kd_clock_ms() + ORDER_MS);
    if (status) {
        kd_log(KD_LOG_WARN,
               "job %.4s...: out of memory for sorting its frames by lens map; it will trace more maps than necessary",
               job->record.id);
        kd_sweep_order_finish(&job->order);
    }
    pthread_mutex_lock(&all->lock);
    job->unordered = !status && !job->order.frames;
    pthread_mutex_unlock(&all->lock);
    kd_job_release(job);
}

void kd_jobs_sweep(struct kd_jobs *all)
{
    put_in_order(all);
    double now = kd_clock_ms();
    pthread_mutex_lock(&all->lock);
    for (struct kd_job *job = all->first; job; job = job->link)
        kd_job_wake(job, now);
    kd_jobs_pump(all); /* because a job's delay may be over */
    struct kd_job *old = take_old(all);
    pthread_mutex_unlock(&all->lock);
    if (old)
        kd_job_release(old);
    kd_jobs_bury(all, FILES_A_SWEEP);
}

/* At an orderly shutdown, undoes the counting of attempts of the jobs in progress, because these jobs have not
 * crashed the server. */
static void take_back_strikes(struct kd_jobs *all)
{
    for (struct kd_job *job = all->first; job; job = job->link)
        if (job->struck && job->record.attempts) {
            job->struck = false;
            job->record.attempts--;
            kd_job_write(job);
        }
}

void kd_jobs_close(struct kd_jobs *all)
{
    pthread_mutex_lock(&all->lock);
    all->closed = true;
    if (!kd_render_queue_lost(all->params.renders, NULL))
        take_back_strikes(all);
    kd_jobs_drop_frame(all, NULL);
    for (struct kd_job *job = all->first; job; job = job->link)
        kd_job_wake(job, kd_clock_ms());
    pthread_mutex_unlock(&all->lock);
}
