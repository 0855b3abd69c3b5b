/* Resumes the jobs in the state folder when the server starts. */
#include "server/job/job_internal.h"

#include "base/clock.h"
#include "base/log.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool stands_at(int fd, uint64_t at, const char *text)
{
    char found[16];
    const size_t n = strlen(text);
    return n <= sizeof found && pread(fd, found, n, (off_t)at) == (ssize_t)n && !memcmp(found, text, n);
}

/* True if a frame's file has the size, the beginning and the end that its format requires. kerrd writes files
 * completely, but a file system that was not unmounted may have truncated the file. */
static bool is_whole(int fd, uint64_t size, const struct kd_series *series)
{
    const struct kd_format *format = series->frame;
    const size_t end = format->end ? strlen(format->end) : 0;
    if (series->row_bytes)
        return size == series->row_bytes;
    return size > 0 && size >= end && stands_at(fd, 0, format->magic) &&
           (!end || stands_at(fd, size - end, format->end));
}

/* Finds the frames that exist. Damaged frames count as missing. */
static void find_frames(struct kd_job *job)
{
    for (unsigned i = 0; i < job->frames; i++) {
        struct kd_job_file file;
        if (!kd_job_store_get(job->all->store, job->record.id, i, &file))
            continue;
        job->have[i] = is_whole(file.fd, file.size, job->record.series);
        job->finished += job->have[i];
        job->bytes += job->have[i] ? file.size : 0;
        if (!job->have[i])
            kd_log(KD_LOG_WARN, "frame %u of job %.4s... is damaged", i, job->record.id);
        close(file.fd);
    }
    kd_job_films_find(job);
    job->all->bytes += job->bytes;
}

/* Resumes a finished job that has lost frames. They are rendered again if this version can parse the job's request. */
static void reopen(struct kd_job *job)
{
    if (job->record.state != KD_JOB_DONE || job->finished == job->frames)
        return;
    kd_log(KD_LOG_WARN, "job %.4s... was done, but has only %u of %u frames: the others are rendered again",
           job->record.id, job->finished, job->frames);
    job->record.state = KD_JOB_ACTIVE;
    job->record.ended = 0;
}

/* Time since the job ended. It is 0 if the system clock was set back. If the clock was set forward, the time is
 * limited, so that one hour remains for downloading the result. */
static double age_ms(const struct kd_jobs *all, const struct kd_job_record *record)
{
    double s = kd_job_now_s() - record->ended, most = fmax(all->params.keep_s - 3600, 0);
    return 1e3 * fmin(fmax(s, 0), most);
}

/* Delays a job that may have crashed servers. Other jobs run first (kd_job_store_load). The number of retries is not
 * limited. */
static void wait_after_strikes(struct kd_job *job)
{
    unsigned n = job->record.attempts;
    if (n < KD_JOB_ATTEMPTS)
        return;
    job->due_ms =
        kd_clock_ms() +
        fmin(ldexp(KD_JOB_WAIT_MS, (int)(n - KD_JOB_ATTEMPTS > 20 ? 20 : n - KD_JOB_ATTEMPTS)), KD_JOB_WAIT_MAX_MS);
    snprintf(job->delayed, sizeof job->delayed, "the server ended %u times before a new frame of this job was finished",
             n);
    kd_log(KD_LOG_WARN, "job %.4s... waits: %s", job->record.id, job->delayed);
}

/* Resumes a job from the store. */
void kd_job_resume(void *user, const struct kd_job_record *known, struct kd_buffer *request)
{
    struct kd_jobs *all = user;
    struct kd_job_spec spec = { 0 };
    struct kd_error error = { 0 };
    char why[sizeof error.message] = "";
    enum kd_status status = kd_job_spec_parse((const char *)request->data, request->size,
                                              &(struct kd_job_base) { .preset = known->preset }, NULL, &spec, &error);
    kd_buffer_finish(request);
    if (status == KD_ENOMEM) {
        kd_log(KD_LOG_ERROR, "out of memory for job %.4s...; the next start tries it again", known->id);
        return;
    }
    if (status)
        snprintf(why, sizeof why, "this version cannot read the request: %.400s", error.message);
    if (*why) { /* the results stay readable, although this version cannot parse the request */
        spec.frames = known->frames;
        spec.series = known->series;
    }
    struct kd_job *job = kd_job_make(all, &spec);
    if (!job) {
        kd_job_spec_finish(&spec);
        kd_log(KD_LOG_ERROR, "out of memory for job %.4s...; the next start tries it again", known->id);
        return;
    }
    job->record = *known;
    if (!job->record.frames) {
        job->record.frames = job->frames;
        job->record.series = job->series;
    }
    find_frames(job);
    if (!*why)
        reopen(job);
    job->spec.exposure = known->exposure;
    /* If frames exist without a measured exposure, an older version has made them, each with its own exposure. */
    if (!isnan(known->exposure) || job->finished)
        job->exposure.n = 0;
    job->unordered = job->record.state == KD_JOB_ACTIVE && job->spec.sweep;
    kd_job_append(all, job);
    if (job->record.state != KD_JOB_ACTIVE) {
        job->ended_ms = kd_clock_ms() - age_ms(all, known);
        return;
    }
    wait_after_strikes(job);
    if (*why) { /* the job waits for a version of kerrd that can parse its request */
        job->due_ms = INFINITY;
        snprintf(job->delayed, sizeof job->delayed, "%.159s", why);
        kd_log(KD_LOG_WARN, "job %.4s... waits: %s", known->id, why);
    } else if (job->finished == job->frames)
        kd_job_end(job, KD_JOB_DONE, "");
}
