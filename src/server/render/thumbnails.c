#include "server/render/thumbnails.h"

#include "base/buffer.h"
#include "render/output/format.h"
#include "scene/scene.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/queue.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES 3 /* rays along each side of a pixel: so small a picture needs smooth edges */

struct thumbnail {
    char etag[120];
    struct kd_scene scene;
    struct kd_buffer png; /* empty: not yet; never changed again */
    struct kd_request *waiting; /* suspended, the newest first */
    struct kd_error error; /* of the latest try */
};

struct kd_thumbnails {
    struct kd_server *server;
    pthread_mutex_t lock;
    bool busy; /* one is being rendered */
    unsigned rendered;
    size_t n;
    struct thumbnail *all; /* in the order of the presets */
};

/* The job of one, whose thumbnail it is. */
struct work {
    struct kd_render_job job; /* first */
    struct kd_thumbnails *of;
    size_t index;
};

static enum kd_status make(const struct kd_server *server, struct thumbnail *t, size_t i)
{
    char hash[65];
    struct kd_error error;
    enum kd_status status;
    KD_TRY(kd_scene_preset(&t->scene, kd_scene_preset_name(i), &error));
    t->scene.image.width = KD_THUMBNAIL_WIDTH;
    t->scene.image.height = KD_THUMBNAIL_HEIGHT;
    t->scene.image.samples = SAMPLES;
    KD_TRY(kd_scene_hash(&t->scene, hash));
    snprintf(t->etag, sizeof t->etag, "\"%s-%s\"", hash, server->etag_tail);
done:
    return status;
}

enum kd_status kd_thumbnails_create(struct kd_server *server, struct kd_thumbnails **out, struct kd_error *error)
{
    struct kd_thumbnails *s = calloc(1, sizeof *s);
    enum kd_status status = s && (s->all = calloc(kd_scene_preset_count(), sizeof *s->all)) ? KD_OK : KD_ENOMEM;
    if (s) {
        s->server = server;
        pthread_mutex_init(&s->lock, NULL);
    }
    for (; !status && s->n < kd_scene_preset_count(); s->n++)
        status = make(server, &s->all[s->n], s->n);
    if (!status)
        return *out = s, KD_OK;
    kd_thumbnails_destroy(s);
    return kd_error_set(error, KD_ENOMEM, "out of memory for the small pictures of presets");
}

void kd_thumbnails_destroy(struct kd_thumbnails *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < s->n; i++)
        kd_buffer_finish(&s->all[i].png);
    pthread_mutex_destroy(&s->lock);
    free(s->all);
    free(s);
}

unsigned kd_thumbnails_rendered(struct kd_thumbnails *s)
{
    pthread_mutex_lock(&s->lock);
    unsigned n = s->rendered;
    pthread_mutex_unlock(&s->lock);
    return n;
}

/* Takes out who waits, to be resumed without the lock. */
static struct kd_request *take(struct thumbnail *t)
{
    struct kd_request *waiting = t->waiting;
    t->waiting = NULL;
    return waiting;
}

/* One that is resumed may be gone at once. */
static void resume(struct kd_request *waiting)
{
    while (waiting) {
        struct kd_request *next = waiting->also_waiting;
        MHD_resume_connection(waiting->mhd);
        waiting = next;
    }
}

static void done(struct kd_render_job *job);

static enum kd_status push(struct kd_thumbnails *s, size_t i, struct kd_error *error)
{
    struct thumbnail *t = &s->all[i];
    struct kd_capacity capacity;
    if (atomic_load(&s->server->phase) >= KD_REFUSING)
        return kd_error_set(error, KD_ECANCELLED, "the server is stopping and takes no new renders");
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a small picture of a preset");
    work->of = s;
    work->index = i;
    work->job = (struct kd_render_job) { .claim.class = KD_CLASS_JOB, .scene = t->scene, .format = kd_formats[0], .effort = KD_EFFORT_KEEP,
                                         .socket = -1, .done = done };
    memcpy(work->job.claim.client, t->waiting->client, sizeof work->job.claim.client);
    kd_render_queue_capacity(s->server->renders, &capacity);
    enum kd_status status = kd_format_plan(kd_formats[0], &work->job.scene, &capacity, &work->job.plan, error);
    if (status)
        free(work);
    else
        kd_render_queue_push(s->server->renders, &work->job);
    return status;
}

/* Begins with the next one that somebody waits for. Locked; what is returned could not be begun, and is to be resumed. */
static struct kd_request *next(struct kd_thumbnails *s)
{
    struct kd_request *refused = NULL, **end = &refused;
    for (size_t i = 0; i < s->n && !s->busy; i++) {
        struct thumbnail *t = &s->all[i];
        if (!t->waiting)
            continue;
        t->error = (struct kd_error) { 0 };
        s->busy = !push(s, i, &t->error);
        if (s->busy)
            break;
        *end = take(t);
        while (*end)
            end = &(*end)->also_waiting;
    }
    return refused;
}

/* On a thread of the queue. */
static void done(struct kd_render_job *job)
{
    struct work *work = (struct work *)job;
    struct kd_thumbnails *s = work->of;
    struct thumbnail *t = &s->all[work->index];
    pthread_mutex_lock(&s->lock);
    if (job->status) {
        t->error = job->error;
        t->error.status = job->status;
    } else {
        t->png = job->file;
        job->file = (struct kd_buffer) { 0 };
        s->rendered++;
    }
    struct kd_request *waiting = take(t);
    s->busy = false;
    struct kd_request *refused = next(s);
    pthread_mutex_unlock(&s->lock);
    resume(waiting);
    resume(refused);
    kd_buffer_finish(&job->file);
    kd_frame_finish(&job->frame);
    free(work);
}

static struct thumbnail *find(struct kd_thumbnails *s, const char *name)
{
    for (size_t i = 0; i < s->n; i++)
        if (!strcmp(kd_scene_preset_name(i), name))
            return &s->all[i];
    return NULL;
}

static enum MHD_Result answer(struct kd_request *request, const struct thumbnail *t, unsigned status, struct MHD_Response *response)
{
    if (response) {
        MHD_add_response_header(response, "ETag", t->etag);
        MHD_add_response_header(response, "Cache-Control", "private, max-age=3600");
    }
    return kd_reply_send(request, status, response);
}

/* Waits for it, unless it is there, or has just been tried in vain. */
static enum MHD_Result give(struct kd_request *request, struct kd_thumbnails *s, struct thumbnail *t)
{
    pthread_mutex_lock(&s->lock);
    const bool there = t->png.size, tried = request->waited;
    struct kd_request *refused = NULL;
    struct kd_error error = t->error;
    if (!there && !tried) {
        request->waited = true;
        request->also_waiting = t->waiting;
        t->waiting = request;
        MHD_suspend_connection(request->mhd);
        refused = next(s);
    }
    pthread_mutex_unlock(&s->lock);
    resume(refused);
    if (there)
        return answer(request, t, MHD_HTTP_OK, kd_reply_static(t->png.data, t->png.size, "image/png"));
    return !tried ? MHD_YES : error.status == KD_ECANCELLED ? kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .retry_after = 1, .detail = error.message })
                                                            : kd_reply_error(request, &error);
}

enum MHD_Result kd_handle_thumbnail(struct kd_request *request)
{
    struct kd_thumbnails *s = request->server->thumbnails;
    struct thumbnail *t = find(s, request->rest);
    if (!t) {
        struct kd_scene scene;
        struct kd_error error = { 0 };
        kd_scene_preset(&scene, request->rest, &error); /* it says which there are */
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = error.message });
    }
    enum MHD_Result refused;
    if (!kd_reply_only(request, (const char *const[]) { NULL }, &refused))
        return refused;
    struct kd_buffer known = kd_reply_header_list(request, "If-None-Match");
    const bool same = known.data && kd_etag_listed((const char *)known.data, t->etag);
    kd_buffer_finish(&known);
    kd_reply_file(request, KD_INLINE, "kerrd-%s.png", request->rest);
    if (same || request->head)
        return answer(request, t, same ? MHD_HTTP_NOT_MODIFIED : MHD_HTTP_OK, kd_reply_empty(same ? NULL : "image/png"));
    return give(request, s, t);
}
