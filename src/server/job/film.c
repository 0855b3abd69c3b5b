/* Films of playgrounds. While one frame is rendered, workers move the bodies to the next frame. Each frame depends
 * on all frames before it. If a frame must be rendered again, or a film is resumed after a restart, the motion is
 * therefore computed again from its beginning. The result is identical to the bit. Only one film is made at a time,
 * so that only one uses memory and slices of the workers; all others wait. */
#include "server/job/job_internal.h"

#include "base/clock.h"
#include "playground/show.h"

#include <stdlib.h>
#include <string.h>

#define TURN_MS 10. /* length of a slice in ms, as for a playground session */

/* A task that moves a film's playground to the next frame. */
struct stride {
    struct kd_scheduler_job scheduled; /* must be first: callbacks cast its address to this struct */
    struct kd_job *job;                /* a counted reference */
    unsigned to;
    bool under_way; /* `run` has begun */
    struct kd_playground_run run;
};

void kd_job_film_drop(struct kd_job *job)
{
    struct kd_job_film *film = &job->film;
    kd_dynamic_bodies_release(film->dynamic);
    film->dynamic = NULL;
    if (film->moving)
        return; /* the playground is freed later, by the worker that owns it */
    kd_playground_destroy(film->p);
    film->p = NULL;
    if (job->all->filming == job)
        job->all->filming = NULL;
}

static enum kd_status begin_anew(struct kd_job *job, struct kd_error *error)
{
    struct kd_job_film *film = &job->film;
    struct kd_buffer request = { 0 };
    enum kd_status status;
    kd_playground_destroy(film->p);
    film->p = NULL;
    KD_TRY(kd_job_store_request(job->all->store, job->record.id, &request, error));
    KD_TRY(kd_job_spec_playground((const char *)request.data, request.size, &film->p, error));
    film->begin = film->p->t;
    film->at = 0;
    film->spent_ms = 0;
done:
    kd_buffer_finish(&request);
    return status;
}

/* Moves the playground until the time until_ms. Returns false if the frame is not reached by then. */
static bool go_on(struct stride *s, double until_ms)
{
    struct kd_job_film *film = &s->job->film;
    struct kd_playground *p = film->p;
    bool more = true;
    while (film->at < s->to && kd_clock_ms() < until_ms) {
        const double time = film->begin + (film->at + 1) * s->job->spec.every - p->t;
        if (!s->under_way && time > 0)
            kd_playground_begin(p, time, &s->run);
        more = time > 0 || s->under_way;
        while (more && kd_clock_ms() < until_ms)
            more = kd_playground_go_on(p, &s->run, 1);
        s->under_way = more;
        film->at += !more;
    }
    return film->at == s->to;
}

/* True if this server still has to finish the job. Called with the lock held. */
static bool wanted(const struct kd_job *job) { return kd_job_is_active(job) && !job->all->closed; }

static enum kd_slice_result turn(struct kd_scheduler_job *scheduled)
{
    struct stride *s = (struct stride *)scheduled;
    struct kd_job *job = s->job;
    struct kd_jobs *all = job->all;
    struct kd_job_film *film = &job->film;
    struct kd_dynamic_bodies *dynamic = NULL;
    struct kd_error error = { 0 };
    enum kd_status status = KD_OK;
    const double begun = kd_clock_ms();
    pthread_mutex_lock(&all->lock);
    const bool goes = wanted(job);
    pthread_mutex_unlock(&all->lock);
    if (goes && (!film->p || film->at > s->to))
        status = begin_anew(job, &error);
    const bool there = goes && !status && go_on(s, begun + TURN_MS);
    if (there)
        status = kd_playground_show_named(film->p, &dynamic, &error);
    film->spent_ms += kd_clock_ms() - begun;
    if (goes && !status && !there && film->spent_ms > 1e3 * all->params.longest_job_s)
        status = kd_error_set(&error, KD_ETOOBIG,
                              "the simulation of its bodies reached the time limit of a job, %.0f s, at frame %u",
                              all->params.longest_job_s, film->at);
    if (goes && !status && !there)
        return KD_SLICE_MORE;
    pthread_mutex_lock(&all->lock);
    film->moving = false;
    film->dynamic = dynamic;
    if (!wanted(job))
        kd_job_film_drop(job);
    else if (status)
        kd_job_give_up(job, &error);
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
    return KD_SLICE_LAST;
}

static void done(struct kd_scheduler_job *scheduled)
{
    struct stride *s = (struct stride *)scheduled;
    kd_job_release(s->job);
    free(s);
}

/* Starts a task that moves the playground to a frame. */
static enum kd_status move_on(struct kd_job *job, unsigned frame, struct kd_error *error)
{
    struct kd_scheduler *scheduler = job->all->params.scheduler;
    struct stride *s = kd_scheduler_cancelled(scheduler) ? NULL : calloc(1, sizeof *s);
    if (!s)
        return kd_scheduler_cancelled(scheduler) ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a film");
    *s = (struct stride) { .scheduled = { .turn = turn, .done = done }, .job = job, .to = frame };
    memcpy(s->scheduled.client, job->client, sizeof s->scheduled.client);
    kd_dynamic_bodies_release(job->film.dynamic);
    job->film.dynamic = NULL;
    job->film.to = frame;
    job->film.moving = true;
    kd_job_strike(job); /* counts an attempt, because moving the bodies may crash the server, just as rendering may */
    job->references++;
    kd_scheduler_push(scheduler, &s->scheduled);
    return KD_OK;
}

enum kd_status kd_job_film_at(struct kd_job *job, unsigned frame, struct kd_dynamic_bodies **out,
                              struct kd_error *error)
{
    struct kd_job_film *film = &job->film;
    if (!job->all->filming)
        job->all->filming = job;
    *out = film->dynamic && film->to == frame ? film->dynamic : NULL;
    return *out || film->moving || job->all->filming != job ? KD_OK : move_on(job, frame, error);
}
