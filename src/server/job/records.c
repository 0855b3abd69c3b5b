/* Writes records of jobs on a worker, one record per slice, so that threads that change a record never wait for the
 * disk. */
#include "server/job/job_internal.h"

#include "base/log.h"

#include <math.h>
#include <stddef.h>

/* Continues the work that was waiting for the record. Called with the lock held. */
static void written(struct kd_job *job, enum kd_status status, const struct kd_error *error)
{
    if (status && job->listed)
        kd_log(KD_LOG_ERROR, "job %.4s...: %s", job->record.id, error->message);
    job->keeping = job->unwritten && job->keeping;
    if (job->keeping || !job->measured)
        return;
    job->measured = false;
    if (!status) {
        job->spec.exposure = job->record.exposure;
        job->revision++;
        return;
    }
    /* The measured exposure is discarded, because it is not on disk. If it were used, frames would exist without a
     * stored exposure after a restart, and the missing frames would be rendered with another exposure. */
    job->record.exposure = NAN;
    job->exposure.done = 0;
    if (kd_job_is_active(job))
        kd_job_delay(job, error->message);
}

/* Finds a job whose record has changed since it was last written; NULL if there is none. Called with the lock held. */
static struct kd_job *first_unwritten(const struct kd_jobs *all)
{
    struct kd_job *job = all->first;
    while (job && (!job->unwritten || job->creating))
        job = job->link;
    return job;
}

static enum kd_slice_result turn(struct kd_scheduler_job *writer)
{
    struct kd_jobs *all = (struct kd_jobs *)((char *)writer - offsetof(struct kd_jobs, writer));
    struct kd_error error = { 0 };
    pthread_mutex_lock(&all->lock);
    struct kd_job *job = first_unwritten(all);
    const struct kd_job_record record = job ? job->record : (struct kd_job_record) { 0 };
    if (job) {
        job->unwritten = false;
        job->references++;
    }
    pthread_mutex_unlock(&all->lock);
    if (!job)
        return KD_SLICE_LAST;
    enum kd_status status = kd_job_store_update(all->store, &record, &error);
    pthread_mutex_lock(&all->lock);
    written(job, status, &error);
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
    kd_job_release(job);
    return KD_SLICE_MORE;
}

/* Called when the scheduler has finished the writer. After this the writer may be pushed again. */
static void done(struct kd_scheduler_job *writer)
{
    struct kd_jobs *all = (struct kd_jobs *)((char *)writer - offsetof(struct kd_jobs, writer));
    pthread_mutex_lock(&all->lock);
    all->writes = false;
    kd_jobs_begin_writing(all);
    pthread_mutex_unlock(&all->lock);
}

void kd_jobs_begin_writing(struct kd_jobs *all)
{
    /* At shutdown, kd_jobs_write_all writes the remaining records instead. */
    if (all->writes || !all->begun || all->closed || !first_unwritten(all))
        return;
    all->writes = true;
    all->writer = (struct kd_scheduler_job) { .turn = turn, .done = done };
    kd_scheduler_push(all->params.scheduler, &all->writer);
}

void kd_job_write(struct kd_job *job)
{
    job->unwritten = true;
    kd_jobs_begin_writing(job->all);
}

void kd_job_keep(struct kd_job *job)
{
    job->keeping = true;
    kd_job_write(job);
}

void kd_jobs_write_all(struct kd_jobs *all)
{
    struct kd_error error;
    for (struct kd_job *job = all->first; job; job = job->link)
        if (job->unwritten && kd_job_store_update(all->store, &job->record, &error))
            kd_log(KD_LOG_ERROR, "job %.4s...: %s", job->record.id, error.message);
}
