#include "server/sessions.h"

#include "base/log.h"
#include "image/png_live.h"
#include "render/governor.h"
#include "server/clock.h"
#include "server/secret.h"

#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LOOK_MS 1000.0 /* how late a client that has hung up may be noticed */
#define TARGET_MS 33.0 /* of a frame while the scene changes */
#define ENCODING_MAX 2 /* frames of a session behind the renderer: one is traced while one is encoded */

struct kd_session {
    struct kd_sessions *all;
    unsigned references;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    struct kd_scene scene; /* as at since_ms */
    double since_ms, used_ms;
    char lens_key[65];            /* of the scene as asked */
    struct kd_governor governor;
    unsigned revision;            /* of the scene */
    uint64_t begun;               /* frames */
    bool listed;
    struct live_job *rendering;   /* before it is encoded */
    unsigned encoding;
    struct kd_live_frame *latest;
    double shown_ms, interval_ms; /* when the latest came; between frames, smoothed */
    enum kd_status failed;        /* the latest render, with `error`; a patch starts anew */
    struct kd_error error;
    struct kd_viewer *viewers;
    struct kd_session *next;
};

struct kd_sessions {
    struct kd_sessions_params params;
    pthread_mutex_t lock;
    struct kd_session *first;
    unsigned count;
    uint64_t frames;
    bool closed;
    double looked_ms;
    struct kd_png_live *encoders[KD_ENCODERS];
};

struct live_job {
    struct kd_render_job job; /* first: the queue's pointer is ours */
    struct kd_session *session;
    uint64_t number;
    unsigned revision;
    struct kd_turn turn;
    bool rendered;
};

enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out, struct kd_error *error)
{
    struct kd_sessions *all = calloc(1, sizeof *all);
    if (!all)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    all->params = *params;
    pthread_mutex_init(&all->lock, NULL);
    for (unsigned i = 0; i < KD_ENCODERS; i++)
        if (kd_png_live_create(kd_deflate_fastest(), &all->encoders[i], error)) {
            kd_sessions_destroy(all);
            return KD_ENOMEM;
        }
    *out = all;
    return KD_OK;
}

/* The rest of this file is locked where nothing else is said. */

static void release(struct kd_session *s)
{
    if (--s->references)
        return;
    kd_live_frame_release(s->latest);
    free(s);
}

static void wake(struct kd_viewer *viewer)
{
    if (!viewer->waiting)
        return;
    viewer->waiting = false;
    MHD_resume_connection(viewer->mhd);
}

static void wake_all(struct kd_session *s)
{
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        wake(v);
}

static void unlist(struct kd_session *s)
{
    if (!s->listed)
        return;
    struct kd_session **link = &s->all->first;
    while (*link != s)
        link = &(*link)->next;
    *link = s->next;
    s->listed = false;
    s->all->count--;
    wake_all(s);
    release(s);
}

static struct kd_scene scene_at(const struct kd_session *s, double now)
{
    struct kd_scene scene = s->scene;
    kd_scene_advance(&scene, 1e-3 * (now - s->since_ms));
    return scene;
}

/* Whether somebody waits; the first frame is made before anybody asks. */
static bool awaited(const struct kd_session *s)
{
    for (const struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting)
            return true;
    return !s->begun;
}

static enum kd_status encode(struct kd_render_job *job, unsigned encoder);
static void rendered(struct kd_render_job *job);
static void done(struct kd_render_job *job);

static void fail(struct kd_session *s, const struct kd_error *error)
{
    s->failed = error->status ? error->status : KD_EDEVICE;
    s->error = *error;
    wake_all(s);
}

/* Begin a frame if one is awaited, would differ, and there is room for it. */
static void pump(struct kd_session *s)
{
    if (!s->listed || s->failed || s->rendering || s->encoding >= ENCODING_MAX || !awaited(s))
        return;
    double now = kd_clock_ms();
    const struct kd_scene scene = scene_at(s, now);
    if (kd_scene_moves(&scene))
        kd_governor_changed(&s->governor, now, &scene, false);
    const struct kd_turn turn = kd_governor_turn(&s->governor, now);
    if (turn.wait_ms > 0)
        return; /* the sweep comes back */
    struct live_job *live = calloc(1, sizeof *live);
    struct kd_capacity capacity;
    struct kd_error error = { 0 };
    if (!live) {
        kd_error_set(&error, KD_ENOMEM, "out of memory for a frame");
        fail(s, &error);
        return;
    }
    live->session = s;
    live->turn = turn;
    live->job = (struct kd_render_job) { .live = true, .socket = -1, .encode = encode, .rendered = rendered, .done = done };
    kd_quality_apply(&turn.quality, &scene, &live->job.scene);
    live->job.scene.image.bit_depth = 8;
    kd_render_queue_capacity(s->all->params.renders, &capacity);
    enum kd_status status = kd_plan_make(&live->job.scene, &capacity, &live->job.plan, &error);
    if (status) {
        free(live);
        fail(s, &error);
        return;
    }
    live->number = ++s->begun;
    live->revision = s->revision;
    s->rendering = live;
    s->references++;
    kd_render_queue_push(s->all->params.renders, &live->job);
}

/* On an encoder's thread, unlocked. */
static enum kd_status encode(struct kd_render_job *job, unsigned encoder)
{
    const struct live_job *live = (const struct live_job *)job;
    return kd_png_live_encode(live->session->all->encoders[encoder], job->frame.width, job->frame.height, job->frame.pixels, &job->png,
                              &job->error);
}

/* Encoding is left out: it overlaps with the next frame, and takes a tenth of the time or less (bench/live.py). */
static struct kd_frame_cost cost_of(const struct kd_frame *frame)
{
    struct kd_frame_cost cost = { .lens_reused = frame->lens_reused };
    for (size_t i = 0; i < frame->n_timings; i++) {
        const struct kd_timing *t = &frame->timings[i];
        if (!strcmp(t->name, "trace") || !strcmp(t->name, "audit") || !strcmp(t->name, "transfer"))
            cost.rays_ms += t->ms;
        else if (!strcmp(t->name, "expose") || !strcmp(t->name, "post") || !strcmp(t->name, "readback"))
            cost.pixels_ms += t->ms;
        else if (!strcmp(t->name, "total"))
            cost.total_ms = t->ms;
    }
    return cost;
}

/* On the render thread, unlocked: the next frame may be traced while this one is encoded. */
static void rendered(struct kd_render_job *job)
{
    struct live_job *live = (struct live_job *)job;
    struct kd_session *s = live->session;
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    live->rendered = true;
    s->rendering = NULL;
    s->encoding++;
    const struct kd_frame_cost cost = cost_of(&job->frame);
    kd_governor_frame(&s->governor, kd_clock_ms(), &live->turn, &cost);
    pump(s);
    pthread_mutex_unlock(&all->lock);
}

static void publish(struct kd_session *s, struct live_job *live)
{
    double now = kd_clock_ms();
    if (s->latest && s->latest->number > live->number)
        return; /* overtaken */
    if (s->shown_ms > 0 && now - s->shown_ms < 1000)
        s->interval_ms += (s->interval_ms > 0 ? 0.2 : 1) * (now - s->shown_ms - s->interval_ms);
    else
        s->interval_ms = 0;
    s->shown_ms = now;
    const struct kd_live_note note = { live->number, live->revision, live->turn.quality.final, s->interval_ms > 0 ? 1e3 / s->interval_ms : 0 };
    struct kd_live_frame *frame = kd_live_frame_make(&live->job, &note);
    if (!frame)
        return; /* the next one may have more luck */
    kd_live_frame_release(s->latest);
    s->latest = frame;
    s->all->frames++;
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->seen < frame->number)
            wake(v);
}

/* On a thread of the queue, unlocked. */
static void done(struct kd_render_job *job)
{
    struct live_job *live = (struct live_job *)job;
    struct kd_session *s = live->session;
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    if (live->rendered)
        s->encoding--;
    else
        s->rendering = NULL;
    job->error.status = job->status;
    if (!job->status)
        publish(s, live);
    else if (job->status != KD_ECANCELLED)
        fail(s, &job->error);
    pump(s);
    release(s);
    pthread_mutex_unlock(&all->lock);
    kd_buffer_finish(&job->png);
    kd_frame_finish(&job->frame);
    free(live);
}

/* Unlocked from here on. */

enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                struct kd_session **out, struct kd_error *error)
{
    struct kd_session *s = calloc(1, sizeof *s);
    if (!s || !kd_secret_make(s->id, sizeof s->id) || !kd_secret_make(s->token, sizeof s->token)) {
        free(s);
        return kd_error_set(error, KD_ENOMEM, "no memory, or no random numbers, for a session");
    }
    s->all = all;
    s->references = 2; /* the list's and the caller's */
    s->scene = *scene;
    s->revision = 1;
    s->since_ms = s->used_ms = kd_clock_ms();
    memcpy(s->lens_key, plan->lens_key, sizeof s->lens_key);
    kd_governor_init(&s->governor, kd_governor_params(.target_ms = TARGET_MS));
    kd_governor_changed(&s->governor, s->since_ms, scene, true);
    kd_governor_expect(&s->governor, &(struct kd_frame_cost) { .total_ms = plan->estimate_ms });
    pthread_mutex_lock(&all->lock);
    if (all->closed || all->count >= all->params.limit) {
        unsigned n = all->count;
        pthread_mutex_unlock(&all->lock);
        free(s);
        return kd_error_set(error, KD_EBUSY, "%u sessions are open, as many as may", n);
    }
    s->listed = true;
    s->next = all->first;
    all->first = s;
    all->count++;
    pump(s);
    pthread_mutex_unlock(&all->lock);
    *out = s;
    return KD_OK;
}

struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id)
{
    pthread_mutex_lock(&all->lock);
    struct kd_session *s = all->first;
    while (s && strcmp(s->id, id))
        s = s->next;
    if (s) {
        s->references++;
        s->used_ms = kd_clock_ms();
    }
    pthread_mutex_unlock(&all->lock);
    return s;
}

void kd_session_release(struct kd_session *s)
{
    struct kd_sessions *all = s->all;
    pthread_mutex_lock(&all->lock);
    release(s);
    pthread_mutex_unlock(&all->lock);
}

const char *kd_session_id(const struct kd_session *s) { return s->id; }
const char *kd_session_token(const struct kd_session *s) { return s->token; }

bool kd_session_owned(const struct kd_session *s, const char *token)
{
    return kd_secret_equal(s->token, token);
}

static void state(const struct kd_session *s, struct kd_session_state *out) /* locked */
{
    *out = (struct kd_session_state) { .scene = scene_at(s, kd_clock_ms()), .revision = s->revision,
                                       .frame = s->latest ? s->latest->number : 0 };
    for (const struct kd_viewer *v = s->viewers; v; v = v->next)
        out->viewers++;
}

void kd_session_state(struct kd_session *s, struct kd_session_state *out)
{
    pthread_mutex_lock(&s->all->lock);
    state(s, out);
    pthread_mutex_unlock(&s->all->lock);
}

enum kd_status kd_session_patch(struct kd_session *s, const char *text, size_t length, struct kd_session_state *out,
                                struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    double now = kd_clock_ms();
    kd_render_queue_capacity(s->all->params.renders, &capacity);
    pthread_mutex_lock(&s->all->lock);
    struct kd_scene scene = scene_at(s, now);
    pthread_mutex_unlock(&s->all->lock); /* only the HTTP thread patches, so that it stays what it is */
    enum kd_status status = kd_scene_patch(&scene, text, length, error);
    if (!status)
        status = kd_scene_validate(&scene, error);
    if (!status)
        status = kd_plan_make(&scene, &capacity, &plan, error);
    if (status)
        return status;
    pthread_mutex_lock(&s->all->lock);
    s->scene = scene;
    s->since_ms = now;
    s->revision++;
    s->failed = KD_OK;
    kd_governor_changed(&s->governor, now, &scene, strcmp(s->lens_key, plan.lens_key) != 0);
    memcpy(s->lens_key, plan.lens_key, sizeof s->lens_key);
    if (s->rendering && s->rendering->turn.refining)
        atomic_store(&s->rendering->job.drop, true); /* long, and nobody waits for it any more */
    pump(s);
    state(s, out);
    pthread_mutex_unlock(&s->all->lock);
    return KD_OK;
}

void kd_session_end(struct kd_session *s)
{
    pthread_mutex_lock(&s->all->lock);
    unlist(s);
    pthread_mutex_unlock(&s->all->lock);
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
    s->used_ms = kd_clock_ms();
    release(s);
    pthread_mutex_unlock(&all->lock);
    viewer->session = NULL;
}

struct kd_live_frame *kd_viewer_next(struct kd_viewer *viewer, bool *over, struct kd_error *error)
{
    struct kd_session *s = viewer->session;
    struct kd_live_frame *frame = NULL;
    pthread_mutex_lock(&s->all->lock);
    *over = !s->listed || s->failed || viewer->gone;
    if (s->failed && error)
        *error = s->error;
    if (!*over && s->latest && s->latest->number > viewer->seen) {
        frame = kd_live_frame_share(s->latest);
        viewer->seen = frame->number;
    } else if (!*over && !viewer->late) {
        viewer->waiting = true;
        MHD_suspend_connection(viewer->mhd); /* before anybody can wake it: that takes the lock */
        pump(s);
    }
    pthread_mutex_unlock(&s->all->lock);
    return frame;
}

static void sweep_deadlines(struct kd_session *s, double now) /* locked */
{
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting && now > v->deadline_ms) {
            v->late = true;
            wake(v);
        }
}

/* All waiting sockets in one call: hundreds of idle viewers cost nothing that can be measured. Locked. */
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
        if (s->viewers || s->rendering || s->encoding)
            s->used_ms = now;
        pump(s);
        if (now - s->used_ms > all->params.idle_ms) {
            kd_log(KD_LOG_INFO, "session %.4s... ends: nobody watches", s->id);
            unlist(s);
        }
    }
    pthread_mutex_unlock(&all->lock);
}

void kd_sessions_close(struct kd_sessions *all)
{
    pthread_mutex_lock(&all->lock);
    all->closed = true;
    while (all->first)
        unlist(all->first);
    pthread_mutex_unlock(&all->lock);
}

unsigned kd_sessions_count(struct kd_sessions *all)
{
    pthread_mutex_lock(&all->lock);
    unsigned n = all->count;
    pthread_mutex_unlock(&all->lock);
    return n;
}

uint64_t kd_sessions_frames(struct kd_sessions *all)
{
    pthread_mutex_lock(&all->lock);
    uint64_t n = all->frames;
    pthread_mutex_unlock(&all->lock);
    return n;
}

void kd_sessions_destroy(struct kd_sessions *all)
{
    if (!all)
        return;
    kd_sessions_close(all);
    for (unsigned i = 0; i < KD_ENCODERS; i++)
        kd_png_live_destroy(all->encoders[i]);
    pthread_mutex_destroy(&all->lock);
    free(all);
}
