#include "server/rays_queue.h"

#include "server/clock.h"
#include "server/connections.h"

#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

#define WORKERS_MAX 16
#define SLICE 4096             /* rays: some 35 ms of one core */
#define BYTES_PER_RAY 32       /* of a body not yet read: to guess from */
#define GUESS_RAYS_PER_MS 120. /* of one worker, until it has been measured */

struct kd_rays_queue {
    struct kd_render_queue *renders;
    _Atomic size_t *held;
    size_t held_max;
    unsigned limit;
    _Atomic bool cancel;

    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool closing;
    struct kd_rays_job *first, **end; /* have work for a worker, in the order of their turns */
    unsigned accepted, unfinished; /* the former no longer counts what is being handed back */
    double backlog_rays; /* of all that is unfinished */
    double rays_per_ms;  /* of one worker, smoothed */
    pthread_t workers[WORKERS_MAX];
    unsigned n_workers;
};

static void append(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    job->next = NULL;
    job->listed = true;
    *queue->end = job;
    queue->end = &job->next;
    pthread_cond_signal(&queue->changed);
}

static void take_out(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    if (!job->listed)
        return;
    struct kd_rays_job **link = &queue->first;
    while (*link != job)
        link = &(*link)->next;
    *link = job->next;
    if (queue->end == &job->next)
        queue->end = link;
    job->listed = false;
}

static double guess_rays(const struct kd_rays_job *job)
{
    return job->request.n ? (double)(job->request.n - job->begun) : (double)job->body->size / BYTES_PER_RAY;
}

static void fail(struct kd_rays_job *job, enum kd_status status, const struct kd_error *error)
{
    if (job->status)
        return;
    job->status = status;
    job->error = *error;
    job->error.status = status;
}

static bool dropped(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    return atomic_load(&queue->cancel) || kd_socket_abandoned(job->socket);
}

/* Count the answer's bytes as held, or say that there are too many. */
static enum kd_status hold(struct kd_rays_queue *queue, struct kd_rays_job *job, struct kd_error *error)
{
    size_t bytes = kd_rays_answer_bytes(&job->request.params, job->request.n), held = atomic_load(queue->held);
    do {
        if (held && held + bytes > queue->held_max)
            return kd_error_set(error, KD_EBUSY, "too many answers wait for their clients to take them");
    } while (!atomic_compare_exchange_weak(queue->held, &held, held + bytes));
    job->held = bytes;
    return KD_OK;
}

static enum kd_status read_body(struct kd_rays_queue *queue, struct kd_rays_job *job, struct kd_error *error)
{
    struct kd_rays_request *request = &job->request;
    const char *text = job->body->data ? (const char *)job->body->data : "";
    enum kd_status status = job->npy ? kd_rays_request_npy(request, text, job->body->size, error)
                                     : kd_rays_request_json(request, text, job->body->size, error);
    job->malformed = status == KD_EINVAL && !*error->pointer;
    job->read(job);
    struct kd_capacity capacity;
    kd_render_queue_capacity(queue->renders, &capacity);
    if (!status)
        status = kd_rays_request_settle(request, &capacity, error);
    if (!status)
        status = kd_rays_request_check(request, error);
    if (!status)
        status = hold(queue, job, error);
    if (status)
        return status;
    double *alpha_beta = request->alpha_beta;
    request->alpha_beta = NULL;
    return kd_rays_answer_init(&job->answer, &request->params, alpha_beta, request->n, error);
}

/* On the render thread. */
static enum kd_status trace_on_device(struct kd_render_job *device, struct kd_renderer *renderer,
                                      kd_progress_fn progress, void *progress_user)
{
    struct kd_rays_job *job = device->user;
    struct kd_rays_answer *answer = &job->answer;
    enum kd_status status = kd_rays_trace(renderer, &answer->params, answer->alpha_beta, answer->n, answer->crossings,
                                          answer->ends, progress, progress_user, &device->error);
    /* A device without double precision is not a lost one. */
    return status == KD_EDEVICE && *device->error.pointer ? KD_EINVAL : status;
}

static void device_done(struct kd_render_job *device)
{
    struct kd_rays_job *job = device->user;
    struct kd_rays_queue *queue = job->queue;
    pthread_mutex_lock(&queue->lock);
    if (device->status)
        fail(job, device->status, &device->error);
    job->state = KD_RAYS_TRACED;
    append(queue, job);
    pthread_mutex_unlock(&queue->lock);
}

static enum kd_status push_to_device(struct kd_rays_queue *queue, struct kd_rays_job *job, struct kd_error *error)
{
    struct kd_capacity capacity;
    enum kd_status status = kd_render_queue_admit(queue->renders, error);
    if (status)
        return status;
    kd_render_queue_capacity(queue->renders, &capacity);
    job->device = (struct kd_render_job) {
        .run = trace_on_device, .socket = job->socket, .done = device_done, .user = job,
    };
    job->device.plan.estimate_ms = (double)job->answer.n * job->answer.params.orders * capacity.ns_per_ray_full * 1e-6;
    kd_render_queue_push(queue->renders, &job->device);
    return KD_OK;
}

/* The first turn. Locked on entry and exit, not in between; the job is in no list. */
static void begin(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    struct kd_error error = { 0 };
    double start = kd_clock_ms();
    job->queue_ms = start - job->submitted_ms;
    queue->backlog_rays -= guess_rays(job);
    pthread_mutex_unlock(&queue->lock);

    enum kd_status status = dropped(queue, job) ? kd_error_set(&error, KD_ECANCELLED, "the client has gone")
                                                : read_body(queue, job, &error);
    job->read_ms = kd_clock_ms() - start;
    job->traced_from_ms = kd_clock_ms();
    bool device = !status && job->answer.params.engine != KD_ENGINE_CLOSED;
    if (device) {
        status = push_to_device(queue, job, &error);
        if (!status) { /* no longer ours */
            pthread_mutex_lock(&queue->lock);
            return;
        }
    }
    pthread_mutex_lock(&queue->lock);
    if (status)
        fail(job, status, &error);
    else
        queue->backlog_rays += (double)job->answer.n;
    job->state = status ? KD_RAYS_TRACED : KD_RAYS_TRACING;
    append(queue, job);
}

/* One slice. Locked on entry and exit; the job is in the list on entry. */
static void trace(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    struct kd_rays_answer *answer = &job->answer;
    size_t first = job->begun, n = answer->n - first < SLICE ? answer->n - first : SLICE;
    struct kd_error error = { 0 };
    job->begun += n;
    job->workers++;
    take_out(queue, job);
    if (job->begun < answer->n)
        append(queue, job); /* the end of the line: its next turn */
    pthread_mutex_unlock(&queue->lock);

    double start = kd_clock_ms();
    enum kd_status status =
        dropped(queue, job)
            ? kd_error_set(&error, KD_ECANCELLED, "the client has gone")
            : kd_rays_trace(NULL, &answer->params, answer->alpha_beta + 2 * first, n,
                            answer->crossings + first * answer->params.orders, answer->ends + first, NULL, NULL, &error);
    double ms = kd_clock_ms() - start;

    pthread_mutex_lock(&queue->lock);
    queue->backlog_rays -= (double)n;
    if (status) {
        fail(job, status, &error);
        queue->backlog_rays -= (double)(answer->n - job->begun);
        job->begun = answer->n;
        take_out(queue, job);
    } else if (n == SLICE && ms > 0) {
        queue->rays_per_ms += 0.2 * ((double)n / ms - queue->rays_per_ms);
    }
    if (!--job->workers && job->begun == answer->n) {
        take_out(queue, job);
        job->state = KD_RAYS_TRACED;
        append(queue, job);
    }
}

static void finish(struct kd_rays_queue *queue, struct kd_rays_job *job) /* as begin */
{
    pthread_mutex_unlock(&queue->lock);
    job->trace_ms = kd_clock_ms() - job->traced_from_ms;
    if (!job->status)
        job->status = kd_rays_answer_summarise(&job->answer, &job->error);
    pthread_mutex_lock(&queue->lock);
    queue->accepted--;
    pthread_mutex_unlock(&queue->lock);
    job->done(job);
    pthread_mutex_lock(&queue->lock);
    queue->unfinished--;
}

static void *work(void *user)
{
    struct kd_rays_queue *queue = user;
    pthread_mutex_lock(&queue->lock);
    while (!queue->closing) {
        struct kd_rays_job *job = queue->first;
        if (!job) {
            pthread_cond_wait(&queue->changed, &queue->lock);
            continue;
        }
        if (job->state == KD_RAYS_TRACING) {
            trace(queue, job);
            continue;
        }
        take_out(queue, job);
        (job->state == KD_RAYS_NEW ? begin : finish)(queue, job);
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

static unsigned cores(void)
{
    cpu_set_t set;
    int n = sched_getaffinity(0, sizeof set, &set) ? 1 : CPU_COUNT(&set);
    return n < 1 ? 1 : n > WORKERS_MAX ? WORKERS_MAX : (unsigned)n;
}

enum kd_status kd_rays_queue_create(unsigned limit, struct kd_render_queue *renders, _Atomic size_t *held,
                                    size_t held_max, struct kd_rays_queue **out, struct kd_error *error)
{
    struct kd_rays_queue *queue = calloc(1, sizeof *queue);
    if (!queue)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    queue->renders = renders;
    queue->held = held;
    queue->held_max = held_max;
    queue->limit = limit;
    queue->end = &queue->first;
    queue->rays_per_ms = GUESS_RAYS_PER_MS;
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->changed, NULL);
    for (unsigned n = cores(); queue->n_workers < n; queue->n_workers++)
        if (pthread_create(&queue->workers[queue->n_workers], NULL, work, queue)) {
            kd_rays_queue_destroy(queue);
            return kd_error_set(error, KD_ENOMEM, "a worker thread could not be started");
        }
    *out = queue;
    return KD_OK;
}

void kd_rays_queue_destroy(struct kd_rays_queue *queue)
{
    if (!queue)
        return;
    pthread_mutex_lock(&queue->lock);
    queue->closing = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    for (unsigned i = 0; i < queue->n_workers; i++)
        pthread_join(queue->workers[i], NULL);
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}

enum kd_status kd_rays_queue_admit(struct kd_rays_queue *queue, struct kd_error *error)
{
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->accepted;
    pthread_mutex_unlock(&queue->lock);
    return n < queue->limit ? KD_OK
                            : kd_error_set(error, KD_EBUSY, "%u requests for rays are under way, as many as may", n);
}

double kd_rays_queue_backlog_ms(struct kd_rays_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    double ms = queue->backlog_rays / (queue->rays_per_ms * queue->n_workers);
    pthread_mutex_unlock(&queue->lock);
    return ms > 0 ? ms : 0;
}

void kd_rays_queue_push(struct kd_rays_queue *queue, struct kd_rays_job *job)
{
    job->queue = queue;
    job->submitted_ms = kd_clock_ms();
    pthread_mutex_lock(&queue->lock);
    queue->accepted++;
    queue->unfinished++;
    queue->backlog_rays += guess_rays(job);
    append(queue, job);
    pthread_mutex_unlock(&queue->lock);
}

unsigned kd_rays_queue_unfinished(struct kd_rays_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    unsigned n = queue->unfinished;
    pthread_mutex_unlock(&queue->lock);
    return n;
}

void kd_rays_queue_cancel(struct kd_rays_queue *queue)
{
    atomic_store(&queue->cancel, true);
}
