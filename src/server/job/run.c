/* Renders the frames of jobs through the render queue. */
#include "server/job/job_internal.h"

#include "base/clock.h"
#include "job/frame.h"
#include "render/output/series.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* maximum number of frames that are rendered but not yet in files: one frame can be rendered while another one is
 * encoded */
#define BEHIND_MAX 2
struct kd_job_render {
    struct kd_render_job render;       /* must be the first member, because the queue stores a pointer to it */
    struct kd_scheduler_job planning;  /* the scheduler job that plans the frame before it enters the render queue */
    struct kd_job *job;                /* a counted reference */
    unsigned number, place;            /* place: position of the frame in the order of rendering */
    struct kd_dynamic_bodies *dynamic; /* a counted reference to the bodies in the scene of a film */
    bool rendered;
    bool measures; /* true if this is a small picture that only measures the common exposure, and is not stored */
};

static void rendered(struct kd_render_job *render);
static void done(struct kd_render_job *render);
static void progress(struct kd_render_job *render, double fraction);

void kd_job_give_up(struct kd_job *job, const struct kd_error *error)
{
    if (error->status == KD_ENOMEM || error->status == KD_EFULL || error->status == KD_EDEVICE)
        kd_job_delay(job, error->message);
    else
        kd_job_end(job, KD_JOB_FAILED, error->message);
}

/* True if the common exposure is still being measured. Called with the lock held. */
static bool still_measures(const struct kd_job *job) { return job->exposure.done < job->exposure.n; }

static unsigned at_place(const struct kd_job *job, unsigned place)
{
    return job->order.frames ? job->order.frames[place] : place;
}

void kd_job_strike(struct kd_job *job)
{
    if (job->begun_here)
        return;
    job->begun_here = job->struck = true;
    job->record.attempts++;
    kd_job_keep(job);
}

/* The frame to render next; the number of frames if there is none. Called with the lock held. */
static unsigned next_frame(struct kd_job *job)
{
    while (job->next < job->frames && job->have[at_place(job, job->next)])
        job->next++;
    if (job->next == job->frames)
        return job->frames;
    return still_measures(job) ? job->exposure.frames[job->exposure.done] : at_place(job, job->next);
}

/* Plans a frame on a worker, without the lock: computing the critical curve of a camera alone takes milliseconds.
 * The members of the job that this function reads do not change during the call, because the exposure is set only
 * while no frame is in progress, and the order only before the first frame. */
static enum kd_slice_result plan(struct kd_scheduler_job *planning)
{
    struct kd_job_render *frame = (struct kd_job_render *)((char *)planning - offsetof(struct kd_job_render, planning));
    const struct kd_jobs *all = frame->job->all;
    const struct kd_job_spec *spec = &frame->job->spec;
    struct kd_render_job *render = &frame->render;
    struct kd_capacity capacity;
    kd_render_queue_capacity(all->params.renders, &capacity);
    render->status = frame->measures ? kd_job_exposure_plan(spec, frame->number, &capacity, &render->scene,
                                                            &render->plan, &render->error)
                                     : kd_job_frame_plan(spec, frame->number, frame->dynamic, 0, all->params.longest_s,
                                                         &capacity, &render->scene, &render->plan, &render->error);
    return KD_SLICE_LAST;
}

static void finish(struct kd_job_render *frame)
{
    kd_buffer_finish(&frame->render.file);
    kd_frame_finish(&frame->render.frame);
    kd_dynamic_bodies_release(frame->dynamic);
    free(frame);
}

/* Marks the frame as not started. Called with the lock held. */
static void take_back(struct kd_job_render *frame)
{
    struct kd_job *job = frame->job;
    job->next = frame->place < job->next ? frame->place : job->next;
}

/* Puts a planned frame into the render queue. Called with the lock held. */
static void push(struct kd_job_render *frame)
{
    struct kd_job *job = frame->job;
    struct kd_dynamic_bodies *next;
    struct kd_error error;
    *job->delayed = 0;
    if (!(job->began_ms > 0))
        job->began_ms = kd_clock_ms();
    job->fraction = 0;
    job->revision++;
    const bool films = frame->dynamic; /* read now, because the queue owns the frame after the push */
    kd_render_queue_push(job->all->params.renders, &frame->render);
    /* The bodies move to the next frame while this frame is rendered. An error is reported when the next frame
     * starts. */
    if (films && job->next < job->frames)
        kd_job_film_at(job, at_place(job, job->next), &next, &error);
}

/* Called when a frame is planned. In the meantime the job may have been deleted or may have failed, or the server
 * may have begun to stop. */
static void planned(struct kd_scheduler_job *planning)
{
    struct kd_job_render *frame = (struct kd_job_render *)((char *)planning - offsetof(struct kd_job_render, planning));
    struct kd_job *job = frame->job;
    struct kd_jobs *all = job->all;
    pthread_mutex_lock(&all->lock);
    const bool wanted = kd_job_is_active(job) && !all->closed;
    if (wanted && !frame->render.status) {
        push(frame);
        pthread_mutex_unlock(&all->lock);
        return;
    }
    all->rendering = NULL;
    take_back(frame);
    if (wanted)
        kd_job_give_up(job, &frame->render.error);
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
    kd_job_release(job);
    finish(frame);
}

/* Makes the next frame of a job. The frame must then be planned. */
static struct kd_job_render *make_frame(struct kd_job *job, unsigned number, struct kd_dynamic_bodies *dynamic)
{
    struct kd_job_render *frame = calloc(1, sizeof *frame);
    if (!frame)
        return NULL;
    const bool measures = still_measures(job);
    frame->planning = (struct kd_scheduler_job) { .turn = plan, .done = planned };
    frame->render.claim.class = KD_CLASS_JOB;
    memcpy(frame->render.claim.client, job->client, sizeof job->client);
    frame->render.format = job->series->frame;
    frame->render.effort = KD_EFFORT_KEEP;
    frame->render.number = number;
    frame->render.socket = -1;
    frame->render.progress = measures ? NULL : progress;
    frame->render.preview = !measures && job->series->frame->carries & KD_CARRIES_PICTURE ? &kd_job_preview_hook : NULL;
    frame->render.rendered = rendered;
    frame->render.done = done;
    if (!measures)
        frame->render.blur = kd_job_frame_blur(&job->spec, number);
    frame->job = job;
    frame->number = number;
    frame->place = job->next;
    frame->measures = measures;
    frame->dynamic = dynamic;
    kd_dynamic_bodies_keep(dynamic);
    return frame;
}

/* Starts the next frame of a job. Returns false if no frame can start now. Called with the lock held. */
static bool begin(struct kd_job *job)
{
    struct kd_jobs *all = job->all;
    struct kd_error error = { 0 };
    struct kd_dynamic_bodies *dynamic = NULL;
    const unsigned number = next_frame(job);
    if (number == job->frames)
        return false;
    kd_job_strike(job);
    if (job->keeping) /* the frame waits, because the attempt must be on disk before the work begins */
        return true;
    enum kd_status status = job->spec.every > 0 ? kd_job_film_at(job, number, &dynamic, &error) : KD_OK;
    if (!status && job->spec.every > 0 && !dynamic)
        return false;
    struct kd_job_render *frame = status ? NULL : make_frame(job, number, dynamic);
    if (!status && !frame)
        status = kd_error_set(&error, KD_ENOMEM, "out of memory for a frame");
    if (status) {
        kd_job_give_up(job, &error);
        return false;
    }
    job->next += !frame->measures;
    job->references++;
    all->rendering = frame;
    kd_scheduler_push(all->params.scheduler, &frame->planning);
    return true;
}

void kd_jobs_drop_unplanned(struct kd_jobs *all)
{
    if (all->rendering)
        finish(all->rendering);
    all->rendering = NULL;
}

struct kd_job *kd_job_of_frame(const void *render, unsigned *number)
{
    const struct kd_job_render *frame = render;
    if (number)
        *number = frame->number;
    return frame->job;
}

void kd_jobs_pump(struct kd_jobs *all)
{
    if (all->closed || all->rendering || all->behind >= BEHIND_MAX || kd_render_queue_lost(all->params.renders, NULL))
        return;
    double now = kd_clock_ms();
    for (struct kd_job *job = all->first; job; job = job->link)
        if (kd_job_is_active(job) && !job->unordered && !job->creating && now >= job->due_ms &&
            kd_render_queue_may_push(all->params.renders, job->client) && begin(job))
            return;
}

void kd_jobs_drop_frame(struct kd_jobs *all, const struct kd_job *job)
{
    if (all->rendering && (!job || all->rendering->job == job))
        atomic_store(&all->rendering->render.drop, true);
}

#define COUNTED_MS 500.0 /* minimum time in ms between two writes of a sweep's number of lens maps to its record */

/* If a lens map was traced for this frame, counts it. For a sweep, the record is written from time to time, so that
 * the number of lens maps survives a restart. */
static void count_map(struct kd_job *job, const struct kd_render_job *render)
{
    const unsigned traced =
        render->status ? 0 : (!render->frame.lens_reused && render->plan.lens.planes) + render->frame.others_traced;
    if (!traced)
        return;
    job->record.traced += traced;
    if (!job->spec.sweep || !kd_job_is_active(job) || kd_clock_ms() < job->counted_ms + COUNTED_MS)
        return;
    kd_job_write(job);
    job->counted_ms = kd_clock_ms();
}

static void finished(struct kd_job *job, unsigned number, uint64_t size)
{
    /* The frame was rendered twice, because the previous frame failed while this one was being encoded. */
    if (job->have[number])
        return;
    job->have[number] = 1;
    if (job->preview.frame == number)
        kd_buffer_finish(&job->preview.png);
    job->finished++;
    job->finished_here++;
    job->all->frames++;
    job->bytes += size;
    job->all->bytes += size;
    job->revision++;
    job->delay_ms = 0;
    if (!kd_job_is_active(job))
        return;
    job->struck = false;
    if (job->record.attempts) {
        job->record.attempts = 0;
        kd_job_write(job);
    }
    if (job->finished == job->frames)
        kd_job_end(job, KD_JOB_DONE, "");
    else if (job->all->bytes > job->all->params.bytes)
        kd_job_end(job, KD_JOB_FAILED, "the frames of all jobs have too many bytes (limit of this server)");
}

/* The three functions below are callbacks of the render queue, and are called without the lock. */

static void progress(struct kd_render_job *render, double fraction)
{
    struct kd_job_render *frame = (struct kd_job_render *)render;
    pthread_mutex_lock(&frame->job->all->lock);
    frame->job->fraction = fraction;
    frame->job->revision++;
    pthread_mutex_unlock(&frame->job->all->lock);
}

/* Stores the exposure that was measured on a small picture. After the last small picture, the common exposure is
 * written to disk (records.c), and then applies to all frames. Called with the lock held. */
static void measured(struct kd_job *job, double stops)
{
    struct kd_job_exposure *exposure = &job->exposure;
    exposure->stops[exposure->done++] = stops;
    if (exposure->done < exposure->n)
        return;
    job->record.exposure = kd_job_exposure_of(exposure->stops, exposure->n);
    job->measured = true;
    kd_job_keep(job);
}

static void rendered(struct kd_render_job *render)
{
    struct kd_job_render *frame = (struct kd_job_render *)render;
    struct kd_jobs *all = frame->job->all;
    pthread_mutex_lock(&all->lock);
    frame->rendered = true;
    all->rendering = NULL;
    all->behind++;
    frame->job->encoding += !frame->measures;
    if (frame->measures)
        measured(frame->job, render->frame.exposure);
    frame->job->fraction = 0; /* the next frame starts without progress */
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
}

static void done(struct kd_render_job *render)
{
    struct kd_job_render *frame = (struct kd_job_render *)render;
    struct kd_job *job = frame->job;
    struct kd_jobs *all = job->all;
    enum kd_status status = render->status;
    bool stored = !status && !frame->measures;
    if (stored)
        status = kd_job_store_put(all->store, job->record.id, frame->number, &render->file, &render->error);
    /* The file could not be written, for whatever reason. The frame can be rendered again. */
    if (stored && status)
        render->error.status = KD_EFULL;
    pthread_mutex_lock(&all->lock);
    if (frame->rendered) {
        all->behind--;
        job->encoding -= !frame->measures;
    } else
        all->rendering = NULL;
    if (frame->measures && frame->rendered)
        status = KD_OK; /* the file of a small picture is not needed, because only its exposure is used */
    else
        count_map(job, render);
    if (!status && !frame->measures)
        finished(job, frame->number, render->file.size);
    else if (status && status != KD_ECANCELLED &&
             !(status == KD_EDEVICE && kd_render_queue_lost(all->params.renders, NULL)) &&
             /* frames that were cancelled, or lost with the device, are rendered after a restart */
             kd_job_is_active(job)) {
        take_back(frame);
        kd_job_give_up(job, &render->error);
    }
    kd_jobs_pump(all);
    pthread_mutex_unlock(&all->lock);
    kd_job_release(job);
    finish(frame);
}

void kd_job_draft_finish(struct kd_job_draft *draft)
{
    kd_job_spec_finish(&draft->spec);
    kd_cost_finish(&draft->cost);
}

/* Checks the cost of a job's frames. Their number has no separate limit. */
static enum kd_status afford(const struct kd_jobs *all, const struct kd_job_draft *draft, struct kd_error *error)
{
    const struct kd_cost *cost = &draft->cost;
    const unsigned frames = draft->spec.frames;
    /* Until all frames are checked, each lens map may turn out to be shared with another frame. The time for tracing
     * is therefore not counted yet. */
    const double not_spent = cost->frames < frames ? cost->trace_ms : cost->shared_ms;
    const double s = 1e-3 * (cost->ms - not_spent), bytes = (double)all->params.bytes;
    if (s > all->params.longest_job_s)
        return kd_error_set(error, KD_ETOOBIG,
                            "%s%u frames would take about %.3g s; for one job it must be at most %.0f s",
                            cost->frames < frames ? "some of the " : "the ", frames, s, all->params.longest_job_s);
    if (cost->file_bytes > bytes)
        return kd_error_set(
            error, KD_ETOOBIG,
            "the files of %u of the %u frames would take %.4g GB; all jobs together must take at most %.4g GB",
            cost->frames, frames, 1e-9 * cost->file_bytes, 1e-9 * bytes);
    return KD_OK;
}

enum kd_status kd_jobs_check(const struct kd_jobs *all, struct kd_job_draft *draft, double until_ms,
                             struct kd_error *error)
{
    const struct kd_job_spec *spec = &draft->spec;
    struct kd_cost *cost = &draft->cost;
    struct kd_capacity capacity;
    struct kd_scene scene;
    struct kd_plan plan;
    enum kd_status status;
    kd_render_queue_capacity(all->params.renders, &capacity);
    do {
        KD_TRY(kd_job_frame_plan(spec, cost->frames, spec->first, cost->frames * spec->every, all->params.longest_s,
                                 &capacity, &scene, &plan, error));
        KD_TRY(kd_cost_add(cost, spec->series, spec->sweep, &scene, &plan, error));
        if (cost->frames < spec->frames)
            KD_TRY(afford(all, draft, error));
    } while (cost->frames < spec->frames && kd_clock_ms() < until_ms);
    if (cost->frames < spec->frames)
        return KD_OK;
    KD_TRY(kd_cost_end(cost, error));
    KD_TRY(afford(all, draft, error));
done:
    return status;
}
