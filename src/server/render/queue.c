#include "server/render/render_internal.h"

#include "render/device/accuracy_store.h"
#include "base/clock.h"
#include "server/http/connections.h"

#include <math.h>
#include <string.h>
#include <stdlib.h>

#define REST_MS 60e3 /* time in ms without work after which memory is freed */

void kd_render_list_append(struct kd_render_list *list, struct kd_render_job *job)
{
    job->next = NULL;
    *list->end = job;
    list->end = &job->next;
}

struct kd_render_job *kd_render_list_take(struct kd_render_list *list, struct kd_render_job **link)
{
    struct kd_render_job *job = *link;
    *link = job->next;
    if (!*link)
        list->end = link;
    return job;
}

void kd_render_take_out(struct kd_render_queue *queue, struct kd_render_job *job)
{
    struct kd_render_job **link = &queue->jobs.first;
    while (*link != job)
        link = &(*link)->next;
    kd_render_list_take(&queue->jobs, link);
    kd_render_forget_kernels(queue, job);
    kd_shares_remove(&queue->shares, &job->claim);
}

void kd_render_finish(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->done(job);
    pthread_mutex_lock(&queue->lock);
    queue->unfinished--;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

bool kd_render_unwanted(struct kd_render_queue *queue, struct kd_render_job *job)
{
    return atomic_load(&queue->cancel) || atomic_load(&job->drop) || kd_socket_abandoned(job->socket);
}

static enum kd_status start_lanes(struct kd_render_queue *queue, struct kd_error *error)
{
    for (unsigned i = 0; i < KD_BACKGROUND_RENDERS; i++) {
        queue->lanes[i].queue = queue;
        if (pthread_create(&queue->lanes[i].thread, NULL, kd_render_lane_main, &queue->lanes[i]))
            return kd_error_set(error, KD_ENOMEM, "a thread for long renders could not be started");
        pthread_mutex_lock(&queue->lock);
        queue->n_lanes++;
        pthread_mutex_unlock(&queue->lock);
    }
    return KD_OK;
}

static enum kd_status start(struct kd_render_queue *queue, struct kd_error *error)
{
    if (pthread_create(&queue->render_thread, NULL, kd_render_short_main, queue))
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
    if (start_lanes(queue, error))
        return KD_ENOMEM;
    if (kd_compilation_helps(queue->renderer)) {
        if (pthread_create(&queue->compiler, NULL, kd_render_compile_main, queue))
            return kd_error_set(error, KD_ENOMEM, "the thread that compiles kernels could not be started");
        queue->compiles = true;
    }
    for (; queue->n_encoders < KD_ENCODERS; queue->n_encoders++)
        if (pthread_create(&queue->encoders[queue->n_encoders], NULL, kd_render_encode_main, queue))
            return kd_error_set(error, KD_ENOMEM, "an encoder could not be started");
    return KD_OK;
}

/* Called when an asset was read, because jobs that have waited for it may now own the device. */
static void asset_read(void *user)
{
    struct kd_render_queue *queue = user;
    pthread_mutex_lock(&queue->lock);
    kd_render_next(queue);
    pthread_mutex_unlock(&queue->lock);
}

enum kd_status kd_render_queue_create(const struct kd_renderer_params *params, unsigned limit, unsigned client_limit,
                                      unsigned client_s, unsigned reopenings, struct kd_render_queue **out,
                                      struct kd_error *error)
{
    struct kd_render_queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    queue->params = *params;
    queue->params.asset_read = asset_read;
    queue->params.asset_read_user = queue->params.lacks_user = queue;
    queue->params.lacks = kd_render_lacks;
    queue->limit = limit;
    queue->client_limit = client_limit;
    queue->allowance.seconds = client_s;
    queue->reopenings = reopenings == KD_REOPENINGS_NONE ? 0 : reopenings ? reopenings : KD_REOPENINGS;
    queue->rest_ms = REST_MS;
    queue->worked_ms = queue->trimmed_ms = kd_clock_ms();
    queue->jobs.end = &queue->jobs.first;
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
    for (unsigned i = 0; i < queue->n_lanes; i++)
        pthread_join(queue->lanes[i].thread, NULL);
    for (unsigned i = 0; i < queue->n_encoders; i++)
        pthread_join(queue->encoders[i], NULL);
    if (queue->compiles)
        pthread_join(queue->compiler, NULL);
    if (queue->compiled && !queue->lost)
        kd_render_take_kernels(queue);
    if (queue->ahead)
        kd_compilation_drop(queue->ahead);
    if (queue->renderer)
        kd_renderer_assets_stop(queue->renderer);
    if (!queue->lost)
        kd_renderer_destroy(queue->renderer);
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

char *kd_render_queue_cache_file(const struct kd_render_queue *queue, const char *suffix)
{
    return kd_renderer_cache_file(queue->renderer, suffix);
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

unsigned kd_render_queue_unfinished(struct kd_render_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->unfinished;
    pthread_mutex_unlock(&queue->lock);
    return n;
}

double kd_render_queue_backlog_ms(struct kd_render_queue *queue)
{
    double ms = 0;
    pthread_mutex_lock(&queue->lock);
    for (const struct kd_render_job *job = queue->jobs.first; job; job = job->next)
        ms += kd_render_is_awaited(job) ? job->claim.left_ms : 0;
    pthread_mutex_unlock(&queue->lock);
    return ms;
}

/* Estimated time of the work for which this client waits. Called with the lock held. */
static double awaited_ms(const struct kd_render_queue *queue, const char *client)
{
    double ms = 0;
    for (const struct kd_render_job *job = queue->jobs.first; job; job = job->next)
        if (kd_render_is_awaited(job) && !strcmp(job->claim.client, client))
            ms += job->claim.left_ms;
    return ms;
}

enum kd_status kd_render_queue_afford(struct kd_render_queue *queue, const char *client, struct kd_error *error)
{
    pthread_mutex_lock(&queue->lock);
    const double wait_ms = kd_allowance_wait_ms(&queue->allowance, client, awaited_ms(queue, client), kd_clock_ms());
    pthread_mutex_unlock(&queue->lock);
    if (!(wait_ms > 0))
        return KD_OK;
    const unsigned s = wait_ms < 1e6 * 1e3 ? (unsigned)ceil(wait_ms * 1e-3) : 1000000;
    kd_error_set(error, KD_EBUSY,
                 "your requests have used up the device time of one client (%u s a minute); the next one will be "
                 "accepted in %u s",
                 queue->allowance.seconds, s);
    if (error)
        error->retry_s = s;
    return KD_EBUSY;
}

struct kd_quota kd_render_queue_quota(struct kd_render_queue *queue, const char *client)
{
    pthread_mutex_lock(&queue->lock);
    const struct kd_quota quota =
        kd_allowance_quota(&queue->allowance, client, awaited_ms(queue, client), kd_clock_ms());
    pthread_mutex_unlock(&queue->lock);
    return quota;
}

enum kd_status kd_render_queue_admit(struct kd_render_queue *queue, const char *client, bool *quota,
                                     struct kd_error *error)
{
    unsigned n = 0, own = 0;
    *quota = false;
    if (kd_render_queue_lost(queue, error))
        return KD_EDEVICE;
    pthread_mutex_lock(&queue->lock);
    for (const struct kd_render_job *job = queue->jobs.first; job; job = job->next) {
        bool waits = kd_render_is_awaited(job) && !kd_render_has_begun(job);
        n += waits;
        own += waits && !strcmp(job->claim.client, client);
    }
    /* Number of jobs that are about to start: 1 if the device is idle. Such a job does not count as waiting. */
    unsigned next = !queue->holder;
    pthread_mutex_unlock(&queue->lock);
    if (n >= queue->limit + next)
        return kd_error_set(error, KD_EBUSY, "too many waiting renders (limit %u)", n);
    *quota = true;
    if (own < queue->client_limit + next) {
        *quota = kd_render_queue_afford(queue, client, error) != KD_OK;
        return *quota ? KD_EBUSY : KD_OK;
    }
    return kd_error_set(error, KD_EBUSY, "you have too many waiting renders (limit %u for one client)", own);
}

/* True if a job runs in slices. A picture of /v1/jobs always does, because nobody waits for it. A live frame never
 * does: the governor predicts its time better than the plan, which does not know whether the lens map is cached. */
static bool wants_lane(const struct kd_render_job *job)
{
    switch (job->claim.class) {
    case KD_CLASS_JOB: return !job->run;
    case KD_CLASS_LIVE:
    case KD_CLASS_IDLE: return false;
    default: return !job->run && job->plan.cost.estimate_ms > KD_MOMENT_MS;
    }
}

void kd_render_stand_in_line(struct kd_render_job *job)
{
    job->claim.left_ms = job->plan.cost.estimate_ms;
    job->kernels = KD_KERNELS_UNKNOWN;
    job->stage = wants_lane(job) ? KD_RENDER_WAITS_FOR_LANE : KD_RENDER_WAITS;
}

static void prepare(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->queue = queue;
    job->submitted_ms = job->away_ms = kd_clock_ms();
    job->kernels_ms = 0;
    job->compilation = job->lacked = NULL;
    job->lacks = 0;
    kd_render_stand_in_line(job);
}

static void append(struct kd_render_queue *queue, struct kd_render_job *job)
{
    kd_render_list_append(&queue->jobs, job);
    kd_shares_add(&queue->shares, &job->claim);
    queue->unfinished++;
    queue->worked_ms = job->submitted_ms;
    queue->rested = job == &queue->rest;
    kd_render_next(queue);
}

void kd_render_queue_push(struct kd_render_queue *queue, struct kd_render_job *job)
{
    prepare(queue, job);
    job->reads = !job->run && kd_renderer_assets_begin(queue->renderer, &job->scene);
    pthread_mutex_lock(&queue->lock);
    append(queue, job);
    pthread_mutex_unlock(&queue->lock);
}

void kd_render_queue_push_locked(struct kd_render_queue *queue, struct kd_render_job *job)
{
    prepare(queue, job);
    append(queue, job);
}

void kd_render_queue_encode(struct kd_render_queue *queue, struct kd_render_job *job)
{
    job->queue = queue;
    job->submitted_ms = kd_clock_ms();
    pthread_mutex_lock(&queue->lock);
    queue->unfinished++;
    kd_render_encode(queue, job);
    pthread_mutex_unlock(&queue->lock);
}

void kd_render_queue_sky_ahead(struct kd_render_queue *queue, const char *hash, uint32_t width, uint32_t height)
{
    struct kd_capacity c;
    kd_render_queue_capacity(queue, &c);
    /* each pixel takes six bytes for the file and twelve for its radiance */
    if (18ull * width * height <= c.memory_bytes / 4)
        kd_renderer_sky_ahead(queue->renderer, hash);
}

/* Cancels jobs that have not started. Jobs that have started end at their next turn. */
void kd_render_queue_sweep(struct kd_render_queue *queue)
{
    struct kd_render_list gone = { .end = &gone.first };
    pthread_mutex_lock(&queue->lock);
    for (struct kd_render_job *job = queue->jobs.first, *next; job; job = next) {
        next = job->next;
        if (!kd_socket_abandoned(job->socket))
            continue;
        atomic_store(&job->drop, true);
        if (kd_render_has_begun(job))
            continue;
        kd_render_take_out(queue, job);
        kd_render_list_append(&gone, job);
    }
    kd_render_next(queue);
    kd_render_rest_if_idle(queue);
    pthread_mutex_unlock(&queue->lock);
    kd_render_trim_if_due(queue);
    while (gone.first) {
        struct kd_render_job *job = kd_render_list_take(&gone, &gone.first);
        job->status = kd_error_set(&job->error, KD_ECANCELLED, "the client has disconnected");
        kd_render_finish(queue, job);
    }
}

void kd_render_queue_cancel(struct kd_render_queue *queue)
{
    atomic_store(&queue->cancel, true);
    atomic_store(&queue->uncompiled, true);
    pthread_mutex_lock(&queue->lock);
    kd_render_next(queue);
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}
