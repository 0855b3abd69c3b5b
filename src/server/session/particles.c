/* GET /v1/sessions/ID/particles: the positions of a session's particles, as numbers. They are listed in slices, and
 * others may use the device between two slices. */
#include "document/number.h"
#include "base/clock.h"
#include "server/http/reply.h"
#include "server/render/task.h"

#include "render/output/particle_list.h"
#include "server/session/sessions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MAX ((size_t)128 << 20) /* maximum size of an answer in bytes; 10 000 000 positions take 114 MiB */

/* The work of listing particles. The request owns it. */
struct kd_particles_job {
    struct kd_render_job device; /* must be first: callbacks cast its address to this struct */
    struct kd_request *request;
    struct kd_particle_list list;
    size_t done;
    struct kd_buffer rows;
    size_t held;
    double begun_ms, spent_ms;
};

void kd_particles_job_destroy(struct kd_particles_job *job)
{
    if (!job)
        return;
    kd_bytes_give(job->request->server->replies, job->request->client, job->held);
    kd_buffer_finish(&job->rows);
    free(job);
}

static size_t slice_of(const struct kd_particles_job *job)
{
    size_t left = job->list.n - job->done;
    return left < KD_PARTICLE_LIST_SLICE ? left : KD_PARTICLE_LIST_SLICE;
}

/* Lists the particles of one slice, on the thread that owns the device. */
static enum kd_status list_slice(struct kd_render_job *device, struct kd_renderer *renderer, kd_progress_fn progress,
                                 void *user)
{
    struct kd_particles_job *job = (struct kd_particles_job *)device;
    float *to = (float *)job->rows.data + job->done * job->list.n_columns;
    double start = kd_clock_ms();
    (void)progress, (void)user;
    enum kd_status status = kd_particle_list_fill(renderer, &job->list, job->done, slice_of(job), to, &device->error);
    job->spent_ms += kd_clock_ms() - start;
    job->done += status ? 0 : slice_of(job);
    device->more = job->done < job->list.n;
    return status;
}

static enum kd_status ask(struct kd_renderer *renderer, const void *device)
{
    return kd_particle_list_ask(renderer, &((const struct kd_particles_job *)device)->list);
}

static void done(struct kd_render_job *device)
{
    struct kd_particles_job *job = (struct kd_particles_job *)device;
    MHD_resume_connection(job->request->mhd);
}

static void describe(struct MHD_Response *response, const struct kd_particle_list *list)
{
    char text[KD_PARTICLE_NAMES];
    kd_particle_list_names(list, text);
    MHD_add_response_header(response, "Kerrd-Fields", text);
    snprintf(text, sizeof text, "%zu", list->n);
    MHD_add_response_header(response, "Kerrd-Count", text);
    snprintf(text, sizeof text, "%u", list->grid.count);
    MHD_add_response_header(response, "Kerrd-Particles", text);
    kd_number_format(text, list->scene.top.time);
    MHD_add_response_header(response, "Kerrd-Time", text);
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error, bool quota)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = KD_PROBLEM_INVALID_PARAMETERS;
    kd_problem_limit(&problem, error, quota, 1);
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct kd_particles_job *job = request->particles;
    char timing[80];
    if (job->device.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (job->device.status) {
        job->device.error.status = job->device.status;
        return refuse(request, &job->device.error, false);
    }
    request->reply_bytes = job->rows.size;
    /* The answer's bytes stay reserved until the request ends. */
    struct MHD_Response *response = kd_reply_take(&job->rows, KD_BYTES_TYPE);
    if (!response)
        return kd_reply_no_memory(request);
    describe(response, &job->list);
    kd_reply_file(request, KD_ATTACHMENT, "particles.f32");
    double waited_ms = kd_clock_ms() - job->begun_ms - job->spent_ms;
    snprintf(timing, sizeof timing, "queue;dur=%.3f, particles;dur=%.3f", waited_ms, job->spent_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

/* Allocates the answer, and reserves its bytes. */
static enum kd_status allocate(struct kd_particles_job *job, bool *quota, struct kd_error *error)
{
    size_t bytes = job->list.n * kd_particle_list_row(&job->list);
    if (kd_task_hold(job->request->server, job->request->client, bytes, &job->held, quota, error))
        return KD_EBUSY;
    job->rows.data = malloc(bytes);
    if (!job->rows.data)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu particles", job->list.n);
    job->rows.size = job->rows.capacity = bytes;
    return KD_OK;
}

static enum kd_status read_query(const struct kd_target *target, struct kd_particle_list *list, struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(kd_target_distinct(target, error));
    for (size_t i = 0; i < target->n_pairs; i++)
        KD_TRY(kd_particle_list_set(list, target->pairs[i].name, target->pairs[i].value, error));
    KD_TRY(kd_particle_list_settle(list, BYTES_MAX, error));
done:
    return status;
}

static enum MHD_Result submit(struct kd_request *request)
{
    struct kd_particles_job *job = request->particles;
    struct kd_server *server = request->server;
    struct kd_error error = { 0 };
    struct kd_capacity capacity;
    bool quota;
    if (atomic_load(&server->phase) >= KD_REFUSING)
        return kd_reply_problem(request,
                                &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                                       .retry_after = 1,
                                                       .detail = "the server is stopping and starts no long tasks" });
    if (kd_render_queue_admit(server->renders, request->client, &quota, &error) || allocate(job, &quota, &error))
        return refuse(request, &error, quota);
    kd_render_queue_capacity(server->renders, &capacity);
    job->begun_ms = kd_clock_ms();
    job->device = (struct kd_render_job) {
        .claim.class = KD_CLASS_RAYS,
        .run = list_slice,
        .ask = ask,
        .socket = kd_connection_socket(request->connection),
        .done = done,
    };
    memcpy(job->device.claim.client, request->client, sizeof request->client);
    job->device.plan.cost.estimate_ms = (double)job->list.n * capacity.ns[KD_NS_PARTICLE] * 1e-6;
    /* The request is suspended first, because the job may be done before the push returns. A suspended request and its
     * socket outlive the job. */
    MHD_suspend_connection(request->mhd);
    kd_render_queue_push(server->renders, &job->device);
    return MHD_YES;
}

enum MHD_Result kd_handle_session_particles(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_error error = { 0 };
    struct kd_session_state state;
    if (request->particles)
        return deliver(request);
    struct kd_session *session = kd_session_of(request, &refused);
    if (!session)
        return refused;
    kd_session_state(session, &state);
    kd_session_release(session);
    struct kd_particles_job *job = request->connection ? calloc(1, sizeof *job) : NULL;
    if (!job)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    request->particles = job;
    job->request = request;
    if (kd_particle_list_init(&job->list, &state.scene, &error))
        return kd_reply_problem(
            request,
            &(struct kd_problem) { .type = KD_PROBLEM_CONFLICT, .pointer = error.pointer, .detail = error.message });
    if (read_query(&request->target, &job->list, &error))
        return refuse(request, &error, false);
    if (!request->head)
        return submit(request);
    struct MHD_Response *response = kd_reply_empty(KD_BYTES_TYPE);
    if (response)
        describe(response, &job->list);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}
