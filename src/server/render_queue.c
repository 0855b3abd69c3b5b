#include "server/render_queue.h"

#include "base/log.h"
#include "render/accuracy_store.h"
#include "render/picture.h"
#include "server/clock.h"
#include "server/connections.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#define FRAME_BYTES ((size_t)256 << 20) /* rendered and not yet encoded; one frame may exceed it */

#define QUIET_MS 1000.0 /* without a live frame */
#define OTHERS 10.0 /* times as long as a slice of what is in the background may what goes before it take */

struct list {
    struct kd_render_job *first, **end;
};

struct kd_render_queue {
    struct kd_renderer_params params;
    struct kd_renderer *renderer;
    struct kd_buffer device_json;
    enum kd_status open_status;
    struct kd_error open_error;

    pthread_mutex_t lock;
    pthread_cond_t changed; /* anything below; few threads wait, so one condition serves all */
    bool opened, closing, running, encoding_background;
    bool aside; /* something is under way that others go between the slices of */
    struct list waiting, encoding;
    unsigned limit, n_waiting, unfinished;
    size_t frame_bytes;
    double resumed_ms;             /* when what is aside went on */
    double live_ms;                /* when a live frame was begun */
    double waiting_ms, running_ms; /* estimates: of the waiting jobs, and what is left of the running one */
    bool lost;
    struct kd_error lost_error;
    _Atomic bool cancel;

    pthread_t render_thread, encoders[KD_ENCODERS];
    unsigned n_encoders, encoders_begun;
    bool render_thread_runs;
};

static void append(struct list *list, struct kd_render_job *job)
{
    job->next = NULL;
    *list->end = job;
    list->end = &job->next;
}

enum { LIVE, PICTURE, PATIENT, BACKGROUND, ANY };

static int rank(const struct kd_render_job *job)
{
    return job->patient ? PATIENT : job->live ? LIVE : job->background ? BACKGROUND : PICTURE;
}

/* Behind its like, before the lower ranks. */
static void append_ranked(struct list *list, struct kd_render_job *job)
{
    struct kd_render_job **link = &list->first;
    while (*link && rank(*link) <= rank(job))
        link = &(*link)->next;
    if (!*link) {
        append(list, job);
        return;
    }
    job->next = *link;
    *link = job;
}

static struct kd_render_job *take(struct list *list, struct kd_render_job **link)
{
    struct kd_render_job *job = *link;
    *link = job->next;
    if (!*link)
        list->end = link;
    return job;
}

static struct kd_render_job *take_first(struct list *list) { return take(list, &list->first); }

static bool overdue(const struct kd_render_job *job, double now)
{
    double patience_ms = fmin(KD_BACKGROUND_MS, OTHERS * job->plan.estimate_ms);
    return (rank(job) >= PATIENT || job->sliced) && now - job->submitted_ms > patience_ms;
}

/* One that is wanted no more, which takes no time and which others may wait for the end of; else the first of the ranks below, or
 * of ANY rank one that has waited long enough. NULL: none. */
static struct kd_render_job *take_next(struct list *list, int below)
{
    double now = kd_clock_ms();
    for (struct kd_render_job **link = &list->first; *link; link = &(*link)->next)
        if (atomic_load(&(*link)->drop))
            return take(list, link);
    for (struct kd_render_job **link = &list->first; *link && below == ANY; link = &(*link)->next)
        if (overdue(*link, now))
            return take(list, link);
    return list->first && rank(list->first) < below ? take_first(list) : NULL;
}

/* The job, no longer in the list, stops counting as waiting. */
static void leave(struct kd_render_queue *queue, const struct kd_render_job *job)
{
    if (rank(job) != PICTURE)
        return;
    queue->n_waiting--;
    queue->waiting_ms = queue->n_waiting ? queue->waiting_ms - job->plan.estimate_ms : 0;
}

/* The job may be gone when done() returns; until `unfinished` falls, its connection counts as ours. */
static void finish(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->done(job);
    pthread_mutex_lock(&queue->lock);
    queue->unfinished--;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

static size_t frame_bytes(const struct kd_render_job *job)
{
    return (size_t)job->plan.width * job->plan.height * 3 * (job->scene.image.bit_depth > 8 ? 2 : 1);
}

static bool unwanted(struct kd_render_queue *queue, struct kd_render_job *job)
{
    return atomic_load(&queue->cancel) || atomic_load(&job->drop) || kd_socket_abandoned(job->socket);
}

static void render_one(struct kd_render_queue *queue, struct kd_render_job *job);

/* What may go between the slices of this: nothing to whose end others then would have to wait. */
static int passed_by(const struct kd_render_queue *queue, const struct kd_render_job *job)
{
    return rank(job) == BACKGROUND && kd_clock_ms() - queue->live_ms < QUIET_MS ? PATIENT : rank(job);
}

/* Between two slices: those that wait, as long as they may. Locked. */
static void make_way(struct kd_render_queue *queue, const struct kd_render_job *job)
{
    double now = kd_clock_ms(), until = now + OTHERS * (now - queue->resumed_ms), left_ms = queue->running_ms;
    struct kd_render_job *other;
    while (queue->frame_bytes <= FRAME_BYTES && !queue->lost && kd_clock_ms() < until &&
           (other = take_next(&queue->waiting, passed_by(queue, job))))
        render_one(queue, other);
    queue->running = true;
    queue->running_ms = left_ms;
    queue->resumed_ms = kd_clock_ms();
}

static bool progress(void *user, double fraction)
{
    struct kd_render_job *job = user;
    struct kd_render_queue *queue = job->queue;

    pthread_mutex_lock(&queue->lock);
    queue->running_ms = job->plan.estimate_ms * (1 - fraction);
    if (job->aside)
        make_way(queue, job);
    const bool yields = job->patient && !job->aside && queue->waiting.first && rank(queue->waiting.first) == LIVE;
    pthread_mutex_unlock(&queue->lock);
    if (job->progress)
        job->progress(job, fraction);
    return !yields && !unwanted(queue, job);
}

static void mark_lost(struct kd_render_queue *queue, const struct kd_error *error)
{
    kd_log(KD_LOG_ERROR, "the device is lost: %s", error->message);
    pthread_mutex_lock(&queue->lock);
    queue->lost = true;
    queue->lost_error = *error;
    pthread_mutex_unlock(&queue->lock);
}

/* Only this thread may ask the renderer, and what it says of its speed changes as it measures itself. */
static enum kd_status describe_device(struct kd_render_queue *queue)
{
    struct kd_buffer json = { 0 }, old = { 0 };
    enum kd_status status = kd_renderer_device_json(queue->renderer, &json);
    if (status) {
        kd_buffer_finish(&json);
        return status;
    }
    pthread_mutex_lock(&queue->lock);
    old = queue->device_json;
    queue->device_json = json;
    pthread_mutex_unlock(&queue->lock);
    kd_buffer_finish(&old);
    return KD_OK;
}

/* True when there is a frame to encode. */
static bool render(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->queue_ms = kd_clock_ms() - job->submitted_ms;
    if (kd_render_queue_lost(queue, &job->error)) {
        job->status = KD_EDEVICE;
        return false;
    }
    if (unwanted(queue, job)) {
        job->status = kd_error_set(&job->error, KD_ECANCELLED, "the render was dropped before it began");
        return false;
    }
    queue->resumed_ms = job->aside ? kd_clock_ms() : queue->resumed_ms;
    if (job->run)
        job->status = job->run(job, queue->renderer, progress, job);
    else if (job->aside)
        job->status = kd_render_aside(queue->renderer, &job->scene, &job->plan, progress, job->glance, job, &job->frame, &job->error);
    else
        job->status = kd_render(queue->renderer, &job->scene, &job->plan, progress, job, &job->frame, &job->error);
    if (job->status == KD_EDEVICE)
        mark_lost(queue, &job->error);
    else
        describe_device(queue);
    return job->status == KD_OK && !job->run;
}

static void open_renderer(struct kd_render_queue *queue)
{
    enum kd_status status = kd_renderer_create(&queue->params, &queue->renderer, &queue->open_error);
    if (!status) {
        status = describe_device(queue);
        if (status)
            kd_error_set(&queue->open_error, status, "the device could not be described");
    }
    pthread_mutex_lock(&queue->lock);
    queue->open_status = status;
    queue->opened = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

/* No longer in the list. Locked; unlocks while it works. */
static void render_one(struct kd_render_queue *queue, struct kd_render_job *job)
{
    size_t bytes = frame_bytes(job);
    leave(queue, job);
    queue->running = true;
    queue->running_ms = job->plan.estimate_ms;
    queue->live_ms = rank(job) == LIVE ? kd_clock_ms() : queue->live_ms;
    bool aside = rank(job) >= PATIENT && !queue->aside;
    job->aside = aside;
    queue->aside |= aside;
    pthread_mutex_unlock(&queue->lock);

    bool encode = render(queue, job);
    if (!encode)
        finish(queue, job);
    else if (job->rendered)
        job->rendered(job);

    pthread_mutex_lock(&queue->lock);
    queue->aside &= !aside;
    queue->running = false;
    queue->running_ms = 0;
    if (encode) {
        append_ranked(&queue->encoding, job);
        queue->frame_bytes += bytes;
        pthread_cond_broadcast(&queue->changed);
    }
}

static void *render_main(void *user)
{
    struct kd_render_queue *queue = user;

    open_renderer(queue);
    if (!queue->open_status) {
        pthread_mutex_lock(&queue->lock);
        while (!queue->closing || queue->waiting.first) {
            if (queue->waiting.first && queue->frame_bytes <= FRAME_BYTES)
                render_one(queue, take_next(&queue->waiting, ANY));
            else
                pthread_cond_wait(&queue->changed, &queue->lock);
        }
        pthread_mutex_unlock(&queue->lock);
    }
    if (!queue->lost)
        kd_renderer_destroy(queue->renderer);
    return NULL;
}

static void *encode_main(void *user)
{
    struct kd_render_queue *queue = user;

    pthread_mutex_lock(&queue->lock);
    unsigned encoder = queue->encoders_begun++;
    while (!queue->closing || queue->unfinished) {
        if (!queue->encoding.first || (queue->encoding.first->background && queue->encoding_background)) {
            pthread_cond_wait(&queue->changed, &queue->lock);
            continue;
        }
        struct kd_render_job *job = take_first(&queue->encoding);
        size_t bytes = frame_bytes(job);
        bool background = job->background;
        queue->encoding_background |= background;
        pthread_mutex_unlock(&queue->lock);

        double start = kd_clock_ms();
        job->status = job->encode ? job->encode(job, encoder)
                                  : kd_picture_encode(&job->frame, &job->scene, &job->plan, kd_render_queue_device_name(queue),
                                                      job->compression, &job->png, &job->error);
        job->encode_ms = kd_clock_ms() - start;
        free(job->frame.pixels);
        job->frame.pixels = NULL;

        pthread_mutex_lock(&queue->lock);
        queue->frame_bytes -= bytes;
        pthread_mutex_unlock(&queue->lock);
        finish(queue, job);
        pthread_mutex_lock(&queue->lock);
        if (background)
            queue->encoding_background = false;
        pthread_cond_broadcast(&queue->changed);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

static enum kd_status start(struct kd_render_queue *queue, struct kd_error *error)
{
    if (pthread_create(&queue->render_thread, NULL, render_main, queue))
        return kd_error_set(error, KD_ENOMEM, "the render thread could not be started");
    queue->render_thread_runs = true;
    pthread_mutex_lock(&queue->lock);
    while (!queue->opened)
        pthread_cond_wait(&queue->changed, &queue->lock);
    pthread_mutex_unlock(&queue->lock);
    if (queue->open_status) {
        if (error)
            *error = queue->open_error;
        return queue->open_status;
    }
    for (; queue->n_encoders < KD_ENCODERS; queue->n_encoders++)
        if (pthread_create(&queue->encoders[queue->n_encoders], NULL, encode_main, queue))
            return kd_error_set(error, KD_ENOMEM, "an encoder could not be started");
    return KD_OK;
}

enum kd_status kd_render_queue_create(const struct kd_renderer_params *params, unsigned limit,
                                      struct kd_render_queue **out, struct kd_error *error)
{
    struct kd_render_queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    queue->params = *params;
    queue->limit = limit;
    queue->waiting.end = &queue->waiting.first;
    queue->encoding.end = &queue->encoding.first;
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->changed, NULL);
    enum kd_status status = start(queue, error);
    if (status) {
        kd_render_queue_destroy(queue);
        return status;
    }
    *out = queue;
    return KD_OK;
}

void kd_render_queue_destroy(struct kd_render_queue *queue)
{
    if (!queue)
        return;
    kd_render_queue_cancel(queue);
    pthread_mutex_lock(&queue->lock);
    queue->closing = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    if (queue->render_thread_runs)
        pthread_join(queue->render_thread, NULL);
    for (unsigned i = 0; i < queue->n_encoders; i++)
        pthread_join(queue->encoders[i], NULL);
    kd_buffer_finish(&queue->device_json);
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

void kd_render_queue_capacity(struct kd_render_queue *queue, struct kd_capacity *out)
{
    kd_renderer_capacity(queue->renderer, out);
}

const char *kd_render_queue_device_name(const struct kd_render_queue *queue)
{
    return kd_renderer_device_name(queue->renderer);
}

enum kd_status kd_render_queue_device_json(struct kd_render_queue *queue, struct kd_buffer *out)
{
    pthread_mutex_lock(&queue->lock);
    enum kd_status status = kd_buffer_append(out, queue->device_json.data, queue->device_json.size);
    pthread_mutex_unlock(&queue->lock);
    return status;
}

enum kd_status kd_render_queue_accuracy_json(const struct kd_render_queue *queue, struct kd_buffer *out,
                                             struct kd_error *error)
{
    return kd_renderer_accuracy_json(queue->renderer, out, error);
}

bool kd_render_queue_lost(struct kd_render_queue *queue, struct kd_error *error)
{
    pthread_mutex_lock(&queue->lock);
    bool lost = queue->lost;
    if (lost && error)
        *error = queue->lost_error;
    pthread_mutex_unlock(&queue->lock);
    return lost;
}

unsigned kd_render_queue_unfinished(struct kd_render_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->unfinished;
    pthread_mutex_unlock(&queue->lock);
    return n;
}

double kd_render_queue_backlog_ms(struct kd_render_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    double ms = queue->waiting_ms + queue->running_ms;
    pthread_mutex_unlock(&queue->lock);
    return ms > 0 ? ms : 0;
}

enum kd_status kd_render_queue_admit(struct kd_render_queue *queue, struct kd_error *error)
{
    if (kd_render_queue_lost(queue, error))
        return KD_EDEVICE;
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->n_waiting;
    bool full = n >= queue->limit + !queue->running; /* what an idle device is about to take does not wait */
    pthread_mutex_unlock(&queue->lock);
    if (full)
        return kd_error_set(error, KD_EBUSY, "%u renders are waiting, as many as may", n);
    return KD_OK;
}

void kd_render_queue_push(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->queue = queue;
    job->submitted_ms = kd_clock_ms();
    pthread_mutex_lock(&queue->lock);
    append_ranked(&queue->waiting, job);
    queue->unfinished++;
    if (rank(job) == PICTURE) {
        queue->n_waiting++;
        queue->waiting_ms += job->plan.estimate_ms;
    }
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

void kd_render_queue_sweep(struct kd_render_queue *queue)
{
    struct list gone = { .end = &gone.first };

    pthread_mutex_lock(&queue->lock);
    for (struct kd_render_job **link = &queue->waiting.first; *link;) {
        struct kd_render_job *job = *link;
        if (!kd_socket_abandoned(job->socket)) {
            link = &job->next;
            continue;
        }
        *link = job->next;
        if (queue->waiting.end == &job->next)
            queue->waiting.end = link;
        leave(queue, job);
        append(&gone, job);
    }
    pthread_mutex_unlock(&queue->lock);
    while (gone.first) {
        struct kd_render_job *job = take_first(&gone);
        job->status = kd_error_set(&job->error, KD_ECANCELLED, "the client has gone");
        finish(queue, job);
    }
}

void kd_render_queue_cancel(struct kd_render_queue *queue)
{
    atomic_store(&queue->cancel, true);
    pthread_mutex_lock(&queue->lock);
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}
