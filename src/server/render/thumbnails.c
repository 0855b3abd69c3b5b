#include "server/render/thumbnails.h"

#include "base/buffer.h"
#include "scene/scene.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/painter.h"
#include "server/render/queue.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES 3 /* number of rays along each side of a pixel; small pictures need smooth edges */

struct thumbnail {
    /* must be first: callbacks cast its address to this struct. painting.png is immutable after `there` is set. */
    struct kd_painting painting;
    char etag[120];
    struct kd_error error; /* error of the latest attempt */
    /* there: true if the picture exists; busy: true while the painter owns the thumbnail, which no other thread may
     * then read */
    bool there, busy;
    struct kd_request *waiting; /* suspended requests, newest first */
    struct kd_thumbnails *of;
};

struct kd_thumbnails {
    struct kd_server *server;
    struct kd_painter *painter;
    pthread_mutex_t lock;
    unsigned rendered;
    size_t n;
    struct thumbnail *all; /* a thumbnail for each preset, in the order of the presets */
};

static void done(struct kd_painting *painting);

static enum kd_status make(const struct kd_server *server, struct thumbnail *t, size_t i)
{
    char hash[65];
    struct kd_error error;
    enum kd_status status;
    struct kd_scene *scene = &t->painting.scene;
    KD_TRY(kd_scene_preset(scene, kd_scene_preset_name(i), &error));
    scene->image.width = KD_THUMBNAIL_WIDTH;
    scene->image.height = KD_THUMBNAIL_HEIGHT;
    scene->image.samples = SAMPLES;
    KD_TRY(kd_scene_hash(scene, hash));
    snprintf(t->etag, sizeof t->etag, "\"%s-%s\"", hash, server->etag_tail);
    t->painting.name = kd_scene_preset_name(i);
    t->painting.mark = t->etag;
    t->painting.done = done;
done:
    return status;
}

enum kd_status kd_thumbnails_create(struct kd_server *server, const struct kd_renderer_params *renderer,
                                    struct kd_thumbnails **out, struct kd_error *error)
{
    struct kd_thumbnails *s = calloc(1, sizeof *s);
    enum kd_status status = s && (s->all = calloc(kd_scene_preset_count(), sizeof *s->all)) ? KD_OK : KD_ENOMEM;
    if (s) {
        s->server = server;
        pthread_mutex_init(&s->lock, NULL);
    }
    for (; !status && s->n < kd_scene_preset_count(); s->n++) {
        s->all[s->n].of = s;
        status = make(server, &s->all[s->n], s->n);
    }
    if (status)
        kd_error_set(error, KD_ENOMEM, "out of memory for the small pictures of presets");
    else
        status = kd_painter_create(renderer, kd_render_queue_device_name(server->renders),
                                   kd_render_queue_cache_file(server->renders, ".preset-"), &s->painter, error);
    if (!status)
        return *out = s, KD_OK;
    kd_thumbnails_destroy(s);
    return status;
}

void kd_thumbnails_destroy(struct kd_thumbnails *s)
{
    if (!s)
        return;
    kd_painter_destroy(s->painter);
    for (size_t i = 0; i < s->n; i++)
        kd_buffer_finish(&s->all[i].painting.png);
    pthread_mutex_destroy(&s->lock);
    free(s->all);
    free(s);
}

bool kd_thumbnails_hang(struct kd_thumbnails *s) { return kd_painter_hangs(s->painter); }

unsigned kd_thumbnails_rendered(struct kd_thumbnails *s)
{
    pthread_mutex_lock(&s->lock);
    unsigned n = s->rendered;
    pthread_mutex_unlock(&s->lock);
    return n;
}

/* Takes the list of waiting requests out of the thumbnail. The caller must resume them without the lock. */
static struct kd_request *take(struct thumbnail *t)
{
    struct kd_request *waiting = t->waiting;
    t->waiting = NULL;
    return waiting;
}

/* Resumes requests. Each may be freed at once. */
static void resume(struct kd_request *waiting)
{
    while (waiting) {
        struct kd_request *next = waiting->also_waiting;
        MHD_resume_connection(waiting->mhd);
        waiting = next;
    }
}

/* Does not wait for the painter, which may first have to finish compiling a kernel. */
void kd_thumbnails_cancel(struct kd_thumbnails *s)
{
    kd_painter_cancel(s->painter);
    for (size_t i = 0; i < s->n; i++) {
        pthread_mutex_lock(&s->lock);
        struct kd_request *waiting = take(&s->all[i]);
        pthread_mutex_unlock(&s->lock);
        resume(waiting);
    }
}

/* Called on the painter's thread when a thumbnail was rendered or has failed. */
static void done(struct kd_painting *painting)
{
    struct thumbnail *t = (struct thumbnail *)painting;
    struct kd_thumbnails *s = t->of;
    pthread_mutex_lock(&s->lock);
    t->there = !painting->status;
    t->error = painting->error;
    t->busy = false;
    s->rendered += painting->painted;
    struct kd_request *waiting = take(t);
    pthread_mutex_unlock(&s->lock);
    resume(waiting);
}

static struct thumbnail *find(struct kd_thumbnails *s, const char *name)
{
    const char *now = kd_scene_preset_name_now(name);
    for (size_t i = 0; i < s->n; i++)
        if (!strcmp(kd_scene_preset_name(i), now))
            return &s->all[i];
    return NULL;
}

static enum MHD_Result answer(struct kd_request *request, const struct thumbnail *t, unsigned status,
                              struct MHD_Response *response)
{
    if (response) {
        MHD_add_response_header(response, "ETag", t->etag);
        MHD_add_response_header(response, "Cache-Control", "private, max-age=3600");
    }
    return kd_reply_send(request, status, response);
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    if (error->status == KD_ECANCELLED || atomic_load(&request->server->phase) >= KD_REFUSING)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                            .retry_after = 1,
                                            .detail = "the server is stopping and renders no more small pictures" });
    return kd_reply_error(request, error);
}

/* Answers at once if the thumbnail is ready, or if rendering it has just failed. Otherwise suspends the request
 * until the thumbnail is ready. */
static enum MHD_Result give(struct kd_request *request, struct kd_thumbnails *s, struct thumbnail *t)
{
    pthread_mutex_lock(&s->lock);
    const bool there = t->there,
               waits = !there && !request->waited && atomic_load(&request->server->phase) < KD_REFUSING,
               begin = waits && !t->busy;
    const struct kd_error error = t->error;
    if (waits) {
        request->waited = true;
        request->also_waiting = t->waiting;
        t->waiting = request;
        MHD_suspend_connection(request->mhd);
    }
    if (begin) {
        t->busy = true;
        t->painting.status = KD_OK;
        t->painting.error = (struct kd_error) { 0 };
        kd_painter_paint(s->painter, &t->painting);
    }
    pthread_mutex_unlock(&s->lock);
    if (waits)
        return MHD_YES;
    return there ? answer(request, t, MHD_HTTP_OK,
                          kd_reply_static(t->painting.png.data, t->painting.png.size, KD_PNG_TYPE))
                 : refuse(request, &error);
}

enum MHD_Result kd_handle_thumbnail(struct kd_request *request)
{
    struct kd_thumbnails *s = request->server->thumbnails;
    struct thumbnail *t = find(s, request->rest);
    if (!t) {
        struct kd_scene scene;
        struct kd_error error = { 0 };
        kd_scene_preset(&scene, request->rest, &error); /* called only for its error message, which lists the presets */
        return kd_reply_problem(request,
                                &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = error.message });
    }
    struct kd_buffer known = kd_reply_header_list(request, "If-None-Match");
    const bool same = known.data && kd_etag_listed((const char *)known.data, t->etag);
    kd_buffer_finish(&known);
    kd_reply_file(request, KD_INLINE, "kerrd-%s.png", request->rest);
    if (same || request->head)
        return answer(request, t, same ? MHD_HTTP_NOT_MODIFIED : MHD_HTTP_OK,
                      kd_reply_empty(same ? NULL : KD_PNG_TYPE));
    return give(request, s, t);
}
