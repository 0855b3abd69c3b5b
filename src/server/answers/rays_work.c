#include "server/answers/rays_work.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SLICE 2048 /* number of rays in a slice; a slice takes some 18 to 25 ms on one core */

/* FIRST_TURN is the number of rays in the first call on the device. Each later call gets as many rays as take about
 * TURN_MS. The number adapts because the time for a ray differs by a factor of a million between the fastest engine on
 * a GPU and the slowest engine on one core. */
#define FIRST_TURN 256
#define TURN_MS 40.0

static enum kd_status read_body(struct kd_rays_job *job, struct kd_error *error)
{
    struct kd_server *server = job->task.request->server;
    struct kd_rays_request *request = &job->request;
    const struct kd_buffer *body = &job->task.request->body;
    const char *text = body->data ? (const char *)body->data : "";
    enum kd_status status = job->npy ? kd_rays_request_npy(request, text, body->size, error)
                                     : kd_rays_request_json(request, text, body->size, error);
    job->malformed = status == KD_EINVAL && !*error->pointer;
    kd_task_drop_body(job->task.request);
    if (status)
        return status;
    struct kd_capacity capacity;
    kd_render_queue_capacity(server->renders, &capacity);
    KD_TRY(kd_rays_request_settle(request, &capacity, error));
    KD_TRY(kd_rays_request_check(request, error));
    KD_TRY(kd_task_hold(server, job->task.scheduled.client, kd_rays_answer_bytes(&request->params, request->n),
                        &job->task.held, &job->task.quota, error));
    double *alpha_beta = request->alpha_beta;
    request->alpha_beta = NULL;
    KD_TRY(kd_rays_answer_init(&job->answer, &request->params, alpha_beta, request->n, error));
done:
    return status;
}

/* Traces the next rays on the device. Called by the thread that owns the device. */
static enum kd_status trace_on_device(struct kd_render_job *device, struct kd_renderer *renderer,
                                      kd_progress_fn progress, void *progress_user)
{
    struct kd_rays_job *job = device->user;
    struct kd_rays_answer *answer = &job->answer;
    size_t first = job->traced, left = answer->n - first, n = left < job->turn ? left : job->turn;
    double begun = kd_clock_ms();
    enum kd_status status = kd_rays_trace(renderer, &answer->params, answer->alpha_beta + 2 * first, n,
                                          answer->crossings + first * answer->params.orders, answer->ends + first,
                                          progress, progress_user, &device->error);
    job->traced += status ? 0 : n; /* these rays are not traced again if the device is reopened */
    job->turn = (size_t)fmax(1, (double)n * fmin(8, TURN_MS / fmax(kd_clock_ms() - begun, 1e-3)));
    device->more = job->traced < answer->n;
    /* On a device without double precision, rays that need it fail. That is not a failure of the device itself. */
    return status == KD_EDEVICE && *device->error.pointer ? KD_EINVAL : status;
}

static enum kd_status ask(struct kd_renderer *renderer, const void *user)
{
    const struct kd_rays_job *job = ((const struct kd_render_job *)user)->user;
    return kd_rays_ask_kernels(renderer, &job->answer.params, job->answer.n);
}

static void device_done(struct kd_render_job *device)
{
    struct kd_rays_job *job = device->user;
    kd_task_fail(&job->task, device->status, &device->error);
    kd_scheduler_wake(job->task.queue, &job->task.scheduled);
}

static enum kd_status push_to_device(struct kd_rays_job *job, struct kd_error *error)
{
    struct kd_render_queue *renders = job->task.request->server->renders;
    struct kd_capacity capacity;
    enum kd_status status = kd_render_queue_admit(renders, job->task.request->client, &job->task.quota, error);
    if (status)
        return status;
    kd_render_queue_capacity(renders, &capacity);
    job->device = (struct kd_render_job) {
        .claim.class = KD_CLASS_RAYS,
        .run = trace_on_device,
        .ask = ask,
        .socket = kd_connection_socket(job->task.request->connection),
        .done = device_done,
        .user = job,
    };
    memcpy(job->device.claim.client, job->task.request->client, sizeof job->device.claim.client);
    job->turn = FIRST_TURN;
    job->device.plan.cost.estimate_ms =
        (double)job->answer.n * job->answer.params.orders * capacity.ns[KD_NS_RAY_FULL] * 1e-6;
    kd_render_queue_push(renders, &job->device);
    return KD_OK;
}

static enum kd_slice_result begin(struct kd_rays_job *job)
{
    struct kd_error error = { 0 };
    enum kd_status status = read_body(job, &error);
    job->traced_from_ms = kd_clock_ms();
    job->read_ms = job->traced_from_ms - job->task.begun_ms;
    bool device = !status && job->answer.params.engine != KD_ENGINE_CLOSED;
    job->where = device ? KD_RAYS_ON_DEVICE : KD_RAYS_HERE;
    job->task.scheduled.shared = !device;
    if (device)
        status = push_to_device(job, &error);
    kd_task_fail(&job->task, status, &error);
    return status ? KD_SLICE_LAST : device ? KD_SLICE_AWAY : KD_SLICE_MORE;
}

static enum kd_slice_result trace_slice(struct kd_rays_job *job)
{
    struct kd_rays_answer *answer = &job->answer;
    struct kd_error error = { 0 };
    size_t first = atomic_fetch_add(&job->begun, SLICE);
    if (first >= answer->n)
        return KD_SLICE_LAST;
    size_t n = answer->n - first < SLICE ? answer->n - first : SLICE;
    struct kd_ray_crossing *crossings = answer->crossings + first * answer->params.orders;
    enum kd_status status = kd_rays_trace(NULL, &answer->params, answer->alpha_beta + 2 * first, n, crossings,
                                          answer->ends + first, NULL, NULL, &error);
    kd_task_fail(&job->task, status, &error);
    return status || first + n == answer->n ? KD_SLICE_LAST : KD_SLICE_MORE;
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct kd_rays_job *job = (struct kd_rays_job *)task;
    (void)until_ms;
    switch (job->where) {
    case KD_RAYS_NEW: return begin(job);
    case KD_RAYS_HERE: return trace_slice(job);
    case KD_RAYS_ON_DEVICE: break; /* finished */
    }
    return KD_SLICE_LAST;
}

static void last(struct kd_task *task)
{
    struct kd_rays_job *job = (struct kd_rays_job *)task;
    struct kd_error error = { 0 };
    job->trace_ms = kd_clock_ms() - job->traced_from_ms;
    if (!task->status)
        kd_task_fail(task, kd_rays_answer_summarise(&job->answer, &error), &error);
}

static void finish(struct kd_task *task)
{
    struct kd_rays_job *job = (struct kd_rays_job *)task;
    kd_rays_request_finish(&job->request);
    kd_rays_answer_finish(&job->answer);
}

struct kd_rays_job *kd_rays_job_begin(struct kd_request *request, enum MHD_Result *refused)
{
    static const struct kd_task_kind kind = { "requests for rays", sizeof(struct kd_rays_job), work, finish,
                                              .last = last };
    struct kd_rays_job *job = kd_task_begin(request, request->server->rays, &kind, refused);
    if (job)
        job->task.deadline_ms = INFINITY; /* no deadline is needed, because the number of rays is limited */
    return job;
}
