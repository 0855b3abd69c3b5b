#include "server/job/job_internal.h"

#include "base/log.h"
#include "base/clock.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNTS_MS 20. /* maximum time in ms that a reader of counts waits for the lock */

double kd_job_now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Increments the revision of every job, because their places in the queue have changed. */
static void move_up(struct kd_jobs *all)
{
    for (struct kd_job *job = all->first; job; job = job->link)
        job->revision++;
}

void kd_job_end(struct kd_job *job, enum kd_job_state state, const char *why)
{
    job->record.state = state;
    job->record.ended = kd_job_now_s();
    job->ended_ms = kd_clock_ms();
    *job->delayed = 0;
    kd_job_film_drop(job);
    snprintf(job->record.error, sizeof job->record.error, "%s", why);
    move_up(job->all);
    kd_job_write(job);
    kd_log(state == KD_JOB_DONE ? KD_LOG_INFO : KD_LOG_WARN, "job %.4s... %s%s", job->record.id,
           state == KD_JOB_DONE ? "is done" : "has failed: ", why);
}

/* length in ms of the first delay; each delay is twice the previous one, up to the limit below */
#define DELAY_MS 1e3
#define DELAY_MAX_MS 60e3

void kd_job_delay(struct kd_job *job, const char *why)
{
    job->delay_ms = job->delay_ms > 0 ? fmin(2 * job->delay_ms, DELAY_MAX_MS) : DELAY_MS;
    job->due_ms = kd_clock_ms() + job->delay_ms;
    job->fraction = 0;
    job->revision++;
    kd_job_film_drop(job);
    snprintf(job->delayed, sizeof job->delayed, "%.159s", why);
    kd_log(KD_LOG_WARN, "job %.4s... waits for %.0f s: %s", job->record.id, 1e-3 * job->delay_ms, why);
}

static void finish(struct kd_job *job)
{
    kd_job_spec_finish(&job->spec);
    kd_job_film_drop(job);
    kd_sweep_order_finish(&job->order);
    kd_buffer_finish(&job->preview.png);
    free(job->have);
    free(job);
}

static void unref(struct kd_job *job)
{
    if (--job->references)
        return;
    job->link = job->all->gone;
    job->all->gone = job;
}

/* Takes the lock itself, so it is called without the lock. One thread at a time. */
void kd_jobs_bury(struct kd_jobs *all, unsigned files)
{
    pthread_mutex_lock(&all->lock);
    struct kd_job *job = all->gone;
    pthread_mutex_unlock(&all->lock);
    if (job && !job->forgotten) {
        kd_job_store_forget(all->store, job->record.id);
        job->forgotten = true;
    }
    if (!job || !kd_job_store_remove(all->store, job->record.id, files))
        return;
    pthread_mutex_lock(&all->lock);
    struct kd_job **link = &all->gone; /* the job is searched again, because others may have been added before it */
    while (*link != job)
        link = &(*link)->link;
    *link = job->link;
    all->bytes -= job->bytes;
    pthread_mutex_unlock(&all->lock);
    finish(job);
}

void kd_job_append(struct kd_jobs *all, struct kd_job *job)
{
    struct kd_job **link = &all->first;
    while (*link)
        link = &(*link)->link;
    *link = job;
    job->listed = true;
}

void kd_job_unlist(struct kd_job *job)
{
    struct kd_job **link = &job->all->first;
    while (*link != job)
        link = &(*link)->link;
    *link = job->link;
    job->listed = false;
    job->revision++;
    move_up(job->all);
    kd_jobs_drop_frame(job->all, job);
    kd_job_film_drop(job);
    kd_job_wake(job, kd_clock_ms());
}

/* All functions from here on are called without the lock. */

struct kd_job *kd_job_make(struct kd_jobs *all, struct kd_job_spec *spec)
{
    struct kd_job *job = calloc(1, sizeof *job);
    unsigned char *have = calloc(spec->frames ? spec->frames : 1, 1);
    if (!job || !have) {
        free(job);
        free(have);
        return NULL;
    }
    job->all = all;
    job->references = 1; /* the list's reference */
    job->have = have;
    kd_dynamic_bodies_release(
        spec->first); /* the bodies of the first frame are only needed for planning, which is done */
    spec->first = NULL;
    job->spec = *spec;
    job->frames = spec->frames;
    job->series = spec->series;
    job->record.exposure = NAN;
    job->exposure.n = kd_job_exposure_frames(&job->spec, job->exposure.frames);
    *spec = (struct kd_job_spec) { 0 };
    return job;
}

enum kd_status kd_jobs_create(const struct kd_jobs_params *params, struct kd_jobs **out, struct kd_error *error)
{
    struct kd_jobs *all = calloc(1, sizeof *all);
    if (!all)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    all->params = *params;
    all->params.state = NULL;
    all->temporary = !params->state;
    pthread_mutex_init(&all->lock, NULL);
    pthread_mutex_init(&all->opening, NULL);
    if (all->temporary)
        kd_job_store_tidy();
    enum kd_status status = all->temporary ? KD_OK : kd_job_store_open(params->state, &all->store, error);
    if (!status && all->store)
        status = kd_job_store_load(all->store, kd_job_resume, all, error);
    if (status) {
        kd_jobs_destroy(all);
        return status;
    }
    *out = all;
    return KD_OK;
}

void kd_jobs_begin(struct kd_jobs *all)
{
    pthread_mutex_lock(&all->lock);
    all->begun = true;
    kd_jobs_begin_writing(all);
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
}

void kd_jobs_destroy(struct kd_jobs *all)
{
    if (!all)
        return;
    kd_jobs_write_all(all);
    kd_jobs_drop_unplanned(all);
    while (all->first) {
        struct kd_job *job = all->first;
        all->first = job->link;
        finish(job);
    }
    while (all->gone)
        kd_jobs_bury(all, UINT_MAX);
    kd_job_store_close(all->store);
    pthread_mutex_destroy(&all->lock);
    pthread_mutex_destroy(&all->opening);
    free(all);
}

/* True if another job can be accepted. A finished job may be deleted to make room for it. Called with the lock held. */
static enum kd_status admit(struct kd_jobs *all, const char *client, bool *quota, struct kd_error *error)
{
    unsigned unfinished = 0, stored = 0, own = 0;
    bool gives_way = false;
    *quota = false;
    for (struct kd_job *job = all->first; job; job = job->link) {
        stored++;
        unfinished += kd_job_is_active(job);
        own += kd_job_is_active(job) && *client && !strcmp(job->client, client);
        gives_way = gives_way || (!kd_job_is_active(job) && job->references == 1);
    }
    if (all->closed || unfinished >= all->params.limit)
        return kd_error_set(error, KD_EBUSY, "too many unfinished jobs (limit %u)", unfinished);
    if (all->params.client_limit && own >= all->params.client_limit) {
        *quota = true;
        return kd_error_set(error, KD_EBUSY, "you have too many unfinished jobs (limit %u for one client)", own);
    }
    if (stored >= all->params.stored && !gives_way)
        return kd_error_set(error, KD_EBUSY,
                            "too many stored jobs (limit %u), and none can be deleted, because all are being read",
                            stored);
    return KD_OK;
}

/* Creates the temporary store for the first job. Called without the lock. */
static enum kd_status open_store(struct kd_jobs *all, struct kd_error *error)
{
    struct kd_job_store *store = NULL;
    pthread_mutex_lock(&all->opening);
    enum kd_status status = all->store ? KD_OK : kd_job_store_open(NULL, &store, error);
    if (store) {
        pthread_mutex_lock(&all->lock);
        all->store = store;
        pthread_mutex_unlock(&all->lock);
    }
    pthread_mutex_unlock(&all->opening);
    return status;
}

/* Removes a new job from the list, because its files could not be created. Called with the lock held. */
static void take_back(struct kd_job *job)
{
    struct kd_job **link = &job->all->first;
    while (*link != job)
        link = &(*link)->link;
    *link = job->link;
    move_up(job->all);
}

/* If too many jobs are stored, deletes the oldest finished job that nobody is reading. Called with the lock held. */
static void make_room(struct kd_jobs *all)
{
    unsigned stored = 0;
    struct kd_job *oldest = NULL;
    for (struct kd_job *job = all->first; job; job = job->link) {
        stored++;
        if (!kd_job_is_active(job) && job->references == 1 && !oldest)
            oldest = job;
    }
    if (stored <= all->params.stored || !oldest)
        return;
    kd_job_unlist(oldest);
    unref(oldest);
}

/* Adds the job to the list before its files are created, because the lock must not be held during their creation. */
static enum kd_status enter(struct kd_jobs *all, struct kd_job *job, const char *text, size_t length, bool *quota,
                            struct kd_error *error)
{
    enum kd_status status = open_store(all, error);
    if (status)
        return status;
    pthread_mutex_lock(&all->lock);
    status = admit(all, job->client, quota, error);
    if (!status) {
        job->creating = true;
        kd_job_append(all, job);
    }
    pthread_mutex_unlock(&all->lock);
    if (status)
        return status;
    status = kd_job_store_create(all->store, &job->record, text, length, error);
    pthread_mutex_lock(&all->lock);
    job->creating = false;
    if (status)
        take_back(job);
    else {
        make_room(all);
        job->references++;
        kd_jobs_pump(all);
    }
    pthread_mutex_unlock(&all->lock);
    return status;
}

enum kd_status kd_jobs_open(struct kd_jobs *all, struct kd_job_draft *draft, const char *text, size_t length,
                            const char *client, bool *quota, struct kd_job **out, struct kd_error *error)
{
    enum kd_status status;
    *quota = kd_render_queue_afford(all->params.renders, client, error) != KD_OK;
    if (*quota)
        return KD_EBUSY;
    struct kd_job *job = kd_job_make(all, &draft->spec);
    if (!job || !kd_secret_make(job->record.id, sizeof job->record.id) ||
        !kd_secret_make(job->record.token, sizeof job->record.token)) {
        status = kd_error_set(error, KD_ENOMEM, "no memory or no random numbers for a job");
    } else {
        job->order = draft->cost.order;
        draft->cost.order = (struct kd_sweep_order) { 0 };
        job->estimate_ms = draft->cost.ms - draft->cost.shared_ms;
        job->record.created = kd_job_now_s();
        job->record.frames = job->frames;
        job->record.series = job->series;
        job->record.once = draft->once;
        memcpy(job->record.preset, draft->preset, sizeof job->record.preset);
        snprintf(job->client, sizeof job->client, "%s", client);
        status = enter(all, job, text, length, quota, error);
    }
    if (!status) {
        *out = job;
        return KD_OK;
    }
    if (job)
        finish(job);
    return status;
}

struct kd_job *kd_jobs_find(struct kd_jobs *all, const char *id)
{
    pthread_mutex_lock(&all->lock);
    struct kd_job *job = all->first;
    while (job && (job->creating || strcmp(job->record.id, id)))
        job = job->link;
    if (job)
        job->references++;
    pthread_mutex_unlock(&all->lock);
    return job;
}

struct kd_job *kd_jobs_find_once(struct kd_jobs *all, const char *key)
{
    pthread_mutex_lock(&all->lock);
    struct kd_job *job = *key ? all->first : NULL;
    while (job && (job->creating || strcmp(job->record.once.key, key)))
        job = job->link;
    if (job)
        job->references++;
    pthread_mutex_unlock(&all->lock);
    return job;
}

const struct kd_once *kd_job_once(const struct kd_job *job) { return &job->record.once; }

void kd_job_release(struct kd_job *job)
{
    struct kd_jobs *all = job->all;
    pthread_mutex_lock(&all->lock);
    unref(job);
    pthread_mutex_unlock(&all->lock);
}

const char *kd_job_id(const struct kd_job *job) { return job->record.id; }
const char *kd_job_token(const struct kd_job *job) { return job->record.token; }

bool kd_job_frame(struct kd_job *job, unsigned frame, struct kd_job_file *out)
{
    pthread_mutex_lock(&job->all->lock);
    bool there = frame < job->frames && job->have[frame];
    pthread_mutex_unlock(&job->all->lock);
    return there && kd_job_store_get(job->all->store, job->record.id, frame, out);
}

void kd_job_drop(struct kd_job *job)
{
    struct kd_jobs *all = job->all;
    pthread_mutex_lock(&all->lock);
    if (job->listed) {
        kd_job_unlist(job);
        unref(job);
        kd_jobs_pump(all);
    }
    pthread_mutex_unlock(&all->lock);
}

void kd_job_delete(struct kd_job *job)
{
    kd_job_drop(job);
    kd_job_store_forget(job->all->store, job->record.id);
    pthread_mutex_lock(&job->all->lock);
    job->forgotten = true;
    pthread_mutex_unlock(&job->all->lock);
}

static bool is_next(const struct kd_job *job)
{
    const struct kd_job *other = job->all->first;
    while (other != job && !kd_job_is_active(other))
        other = other->link;
    return other == job;
}

/* Number of rendered frames, including frames that are being encoded, and the rendered fraction of the present
 * frame. Called with the lock held. */
static double drawn(const struct kd_job *job)
{
    return fmin(job->finished + job->encoding + job->fraction, job->frames);
}

/* When this fraction of the frames is done, the elapsed time gives a better estimate than the plan. */
#define SURE 0.02

/* Estimates the remaining time; NAN if it is unknown. Called with the lock held. */
static double remaining_s(const struct kd_job *job)
{
    double left = job->frames - drawn(job);
    if (!kd_job_is_active(job) || *job->delayed || job->unordered || !(job->began_ms > 0 || is_next(job)))
        return NAN;
    const double planned_ms = job->estimate_ms / job->frames, done = job->finished_here + job->encoding + job->fraction;
    const double passed_ms = job->began_ms > 0 ? kd_clock_ms() - job->began_ms : 0;
    /* Each further frame is assumed to take as long as the mean of the frames so far, including waiting. Before
     * there is any progress, a frame is assumed to take the planned time, or the elapsed time if that is longer. */
    const double frame_ms = done > SURE ? passed_ms / done : fmax(planned_ms, passed_ms);
    return frame_ms > 0 ? 1e-3 * fmax(left, 0) * frame_ms : NAN;
}

double kd_jobs_remaining_s(struct kd_jobs *all)
{
    pthread_mutex_lock(&all->lock);
    const struct kd_job *job = all->first;
    while (job && !kd_job_is_active(job))
        job = job->link;
    double s = job ? remaining_s(job) : 0;
    pthread_mutex_unlock(&all->lock);
    return s;
}

void kd_job_status(struct kd_job *job, struct kd_job_status *out)
{
    struct kd_jobs *all = job->all;
    pthread_mutex_lock(&all->lock);
    *out = (struct kd_job_status) { .state = job->record.state,
                                    .deleted = !job->listed,
                                    .series = job->series,
                                    .frames = job->frames,
                                    .finished = job->finished,
                                    .created = job->record.created,
                                    .ended = job->record.ended,
                                    .bytes = job->bytes,
                                    .remaining_s = remaining_s(job),
                                    .traced = job->record.traced,
                                    .sweep = job->spec.sweep,
                                    .exposure = job->record.exposure };
    out->fraction = !job->frames ? 0 : (kd_job_is_active(job) ? drawn(job) : job->finished) / job->frames;
    for (const struct kd_job *other = all->first; other && other != job && kd_job_is_active(job); other = other->link)
        out->place += kd_job_is_active(other);
    snprintf(out->error, sizeof out->error, "%s", job->record.error);
    memcpy(out->delayed, job->delayed, sizeof out->delayed);
    if (job->unordered && kd_job_is_active(job) && !*out->delayed)
        snprintf(out->delayed, sizeof out->delayed, "its frames are being sorted");
    pthread_mutex_unlock(&all->lock);
}

bool kd_jobs_counts(struct kd_jobs *all, struct kd_jobs_counts *out)
{
    if (!kd_clock_lock(&all->lock, COUNTS_MS))
        return false;
    *out = (struct kd_jobs_counts) { .frames = all->frames, .bytes = all->bytes };
    for (const struct kd_job *job = all->first; job; job = job->link) {
        out->waiting += kd_job_is_active(job);
        out->done += job->record.state == KD_JOB_DONE;
        out->failed += job->record.state == KD_JOB_FAILED;
    }
    out->running = out->waiting > 0; /* the oldest unfinished job is the one that runs */
    out->waiting -= out->running;
    pthread_mutex_unlock(&all->lock);
    return true;
}
