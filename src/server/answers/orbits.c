/* POST /v1/orbits: workers integrate the orbits in slices. A long answer may be streamed while the integration
 * continues. */
#include "server/answers/orbits.h"

#include "orbit/feed.h"
#include "base/clock.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/task.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OFFERED KD_JSON_TYPE ", " KD_NDJSON_TYPE ", " KD_CSV_TYPE ", " KD_NPY_TYPE
/* The integration pauses when this many bytes of a stream are unsent. It continues when only a quarter of them is
 * left. */
#define FULL (1u << 20)
#define BYTES_PER_SAMPLE 220 /* estimated size of a sample in an answer, as text */
#define BYTES_PER_ORBIT 2400

static const char *const types[] = { [KD_ORBIT_JSON] = KD_JSON_TYPE,
                                     [KD_ORBIT_NDJSON] = KD_NDJSON_TYPE,
                                     [KD_ORBIT_CSV] = KD_CSV_TYPE,
                                     [KD_ORBIT_NPY] = KD_NPY_TYPE };

/* A job with two owners, the request and the scheduler. The owner that releases the job last frees it. */
struct kd_orbits_job {
    struct kd_scheduler_job scheduled; /* must be first: callbacks cast its address to this struct */
    struct kd_server *server;
    _Atomic unsigned holders;
    enum kd_orbit_format format;
    struct kd_request *owner; /* the request, which is suspended; valid only in the first slice */
    struct kd_orbit_request request;
    struct kd_orbit_feed feed;
    double submitted_ms, begun_ms, deadline_ms, queue_ms, run_ms;
    size_t held;
    enum { READING, RUNNING } state;

    pthread_mutex_t lock;       /* protects all members below */
    struct MHD_Connection *mhd; /* connection of the request; NULL after the request was closed */
    int socket;
    bool suspended, full, finished;
    struct kd_buffer out;
    size_t taken;
    enum kd_status status;
    struct kd_error error;
    /* malformed: true if the body is not JSON; quota: true if KD_EBUSY is due to the client's share */
    bool malformed, quota;
};

static void unref(struct kd_orbits_job *job)
{
    if (atomic_fetch_sub(&job->holders, 1) != 1)
        return;
    kd_bytes_give(job->server->replies, job->scheduled.client, job->held);
    kd_orbit_feed_finish(&job->feed);
    kd_orbit_request_finish(&job->request);
    kd_buffer_finish(&job->out);
    pthread_mutex_destroy(&job->lock);
    free(job);
}

void kd_orbits_job_abandon(struct kd_orbits_job *job)
{
    if (!job)
        return;
    pthread_mutex_lock(&job->lock);
    job->mhd = NULL;
    bool wake = !job->finished;
    pthread_mutex_unlock(&job->lock);
    if (wake) /* only a job that is parked must be woken */
        kd_scheduler_wake(job->server->scheduler, &job->scheduled);
    unref(job);
}

/* Resumes the connection of the request if it is suspended. Called with the lock held. */
static void resume(struct kd_orbits_job *job)
{
    if (job->suspended && job->mhd) {
        job->suspended = false;
        MHD_resume_connection(job->mhd);
    }
}

static enum kd_status over(struct kd_orbits_job *job, struct kd_error *error)
{
    pthread_mutex_lock(&job->lock);
    bool gone = !job->mhd || kd_socket_abandoned(job->socket);
    pthread_mutex_unlock(&job->lock);
    return kd_task_over(job->server, job->server->scheduler, gone, job->deadline_ms, error);
}

static bool stopped(void *user)
{
    struct kd_error error;
    return over(user, &error) != KD_OK;
}

static enum kd_status hold(struct kd_orbits_job *job, struct kd_error *error)
{
    const struct kd_orbit_request *r = &job->request;
    size_t rows = r->many && !r->params.series ? 0 : (size_t)r->params.samples * r->n;
    size_t bytes = job->format == KD_ORBIT_NDJSON ? 2 * FULL : rows * BYTES_PER_SAMPLE + r->n * BYTES_PER_ORBIT;
    if (r->many)
        bytes += kd_orbit_batch_bytes(r);
    return kd_task_hold(job->server, job->scheduled.client, bytes, &job->held, &job->quota, error);
}

static enum kd_status read_body(struct kd_orbits_job *job, struct kd_error *error)
{
    struct kd_buffer *body = &job->owner->body;
    enum kd_status status =
        kd_orbit_request_json(&job->request, body->data ? (const char *)body->data : "", body->size, error);
    job->malformed = status == KD_EINVAL && !*error->pointer;
    kd_task_drop_body(job->owner);
    if (!status)
        status = hold(job, error);
    if (!status)
        status = kd_orbit_feed_init(&job->feed, &job->request, job->format, error);
    job->feed.batch.stop = stopped;
    job->feed.batch.user = job;
    job->scheduled.shared = job->request.many;
    return status;
}

/* Frees the part of `out` that was sent. True if `out` then has room for the output of another slice. Called with
 * the lock held. */
static bool has_room(struct kd_orbits_job *job)
{
    if (job->format != KD_ORBIT_NDJSON)
        return true;
    if (job->taken && (job->taken > FULL / 2 || job->taken == job->out.size)) {
        memmove(job->out.data, job->out.data + job->taken, job->out.size - job->taken);
        job->out.size -= job->taken;
        job->taken = 0;
    }
    job->full = job->out.size - job->taken > FULL;
    return !job->full;
}

static enum kd_slice_result end(struct kd_orbits_job *job, enum kd_status status, const struct kd_error *error)
{
    pthread_mutex_lock(&job->lock);
    if (!job->status && status) {
        job->status = status;
        job->error = *error;
        job->error.status = status;
    }
    pthread_mutex_unlock(&job->lock);
    return KD_SLICE_LAST;
}

static enum kd_slice_result one_piece(struct kd_orbits_job *job)
{
    struct kd_error error = { 0 };
    struct kd_buffer piece = { 0 };
    enum kd_status status = kd_orbit_feed_more(&job->feed, &piece, &error);
    pthread_mutex_lock(&job->lock);
    if (!status && piece.size)
        status = kd_buffer_append(&job->out, piece.data, piece.size);
    if (!status && job->format == KD_ORBIT_NDJSON && piece.size)
        resume(job);
    bool room = has_room(job);
    pthread_mutex_unlock(&job->lock);
    kd_buffer_finish(&piece);
    if (status || kd_orbit_feed_done(&job->feed))
        return end(job, status, &error);
    return room ? KD_SLICE_MORE : KD_SLICE_PARK;
}

static enum kd_slice_result take_turn(struct kd_scheduler_job *scheduled)
{
    struct kd_orbits_job *job = (struct kd_orbits_job *)scheduled;
    struct kd_error error = { 0 };
    if (job->state == READING)
        job->queue_ms = (job->begun_ms = kd_clock_ms()) - job->submitted_ms;
    enum kd_status status = over(job, &error);
    if (status)
        return end(job, status, &error);
    if (job->state == RUNNING && job->request.many)
        return kd_orbit_feed_help(&job->feed) ? KD_SLICE_MORE : KD_SLICE_LAST;
    if (job->state == RUNNING)
        return one_piece(job);
    job->state = RUNNING;
    status = read_body(job, &error);
    return status ? end(job, status, &error) : KD_SLICE_MORE;
}

static void done(struct kd_scheduler_job *scheduled)
{
    struct kd_orbits_job *job = (struct kd_orbits_job *)scheduled;
    struct kd_error error = { 0 };
    if (!job->status && job->request.many) {
        enum kd_status status = over(job, &error);
        if (!status)
            status = kd_orbit_feed_more(&job->feed, &job->out, &error);
        end(job, status, &error);
    }
    pthread_mutex_lock(&job->lock);
    job->run_ms = kd_clock_ms() - job->begun_ms;
    job->finished = true;
    resume(job);
    pthread_mutex_unlock(&job->lock);
    unref(job);
}

/* Appends the error to the stream, because the status line was already sent. Called with the lock held. */
static void say_in_stream(struct kd_orbits_job *job)
{
    struct kd_problem problem = kd_problem_from(&job->error);
    struct kd_buffer text = { 0 };
    if (!kd_problem_to_json(&problem, &text) && !kd_buffer_printf(&job->out, "{\"problem\":"))
        if (!kd_buffer_append(&job->out, text.data, text.size - (text.data[text.size - 1] == '\n')))
            kd_buffer_printf(&job->out, "}\n");
    kd_buffer_finish(&text);
    job->status = KD_OK;
}

static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct kd_orbits_job *job = cls;
    (void)position; /* the position is not needed, because the library reads the bytes in order */
    pthread_mutex_lock(&job->lock);
    if (job->finished && job->status)
        say_in_stream(job);
    size_t n = job->out.size - job->taken < size ? job->out.size - job->taken : size;
    if (n)
        memcpy(to, job->out.data + job->taken, n);
    job->taken += n;
    bool over = !n && job->finished, wake = job->full && job->out.size - job->taken < FULL / 4;
    if (wake)
        job->full = false;
    if (!n && !over) {
        job->suspended = true;
        MHD_suspend_connection(job->mhd);
    }
    pthread_mutex_unlock(&job->lock);
    if (wake)
        kd_scheduler_wake(job->server->scheduler, &job->scheduled);
    return over ? MHD_CONTENT_READER_END_OF_STREAM : (ssize_t)n;
}

/* The format that the Accept header prefers; JSON if there is no preference; -1 if no format is acceptable. */
static int choose_format(struct kd_request *request)
{
    size_t best = kd_reply_accepted(request, 4, kd_accept_string, types);
    return best < 4 ? (int)best : -1;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error, bool malformed, bool quota)
{
    struct kd_problem problem = kd_problem_from(error);
    if (quota)
        problem.type = KD_PROBLEM_QUOTA;
    if (error->status == KD_EINVAL)
        problem.type = malformed ? KD_PROBLEM_MALFORMED_JSON : KD_PROBLEM_INVALID_ORBIT;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct kd_orbits_job *job = request->orbits;
    struct MHD_Response *response;
    char timing[80];
    pthread_mutex_lock(&job->lock);
    bool finished = job->finished;
    enum kd_status status = job->out.size && job->format == KD_ORBIT_NDJSON ? KD_OK : job->status;
    pthread_mutex_unlock(&job->lock);
    if (status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (status)
        return refuse(request, &job->error, job->malformed, job->quota);
    if (job->format == KD_ORBIT_NDJSON) {
        response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 32u << 10, produce, job, NULL);
        /* the deadline of the reply is extended to that of the integration */
        request->reply_bytes = (unsigned long)job->server->longest_s << 24;
        if (response)
            MHD_add_response_header(response, "Content-Type", types[job->format]);
    } else {
        request->reply_bytes = job->out.size;
        response = kd_reply_text(request, &job->out, types[job->format]);
        if (job->format != KD_ORBIT_JSON)
            kd_reply_file(request, KD_ATTACHMENT, job->format == KD_ORBIT_CSV ? "orbit.csv" : "orbit.npy");
    }
    if (!response)
        return kd_reply_no_memory(request);
    if (finished) {
        snprintf(timing, sizeof timing, "queue;dur=%.3f, integrate;dur=%.3f", job->queue_ms, job->run_ms);
        MHD_add_response_header(response, "Server-Timing", timing);
    }
    MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result submit(struct kd_request *request, enum kd_orbit_format format)
{
    struct kd_server *server = request->server;
    struct kd_orbits_job *job = calloc(1, sizeof *job);
    if (!job)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    job->scheduled.turn = take_turn;
    job->scheduled.done = done;
    job->server = server;
    job->format = format;
    job->owner = request;
    job->mhd = request->mhd;
    snprintf(job->scheduled.client, sizeof job->scheduled.client, "%s", request->client);
    job->socket = kd_connection_socket(request->connection);
    job->suspended = true;
    job->submitted_ms = kd_clock_ms();
    job->deadline_ms = job->submitted_ms + 1e3 * server->longest_s;
    atomic_store(&job->holders, 2);
    pthread_mutex_init(&job->lock, NULL);
    kd_orbit_request_init(&job->request);
    request->orbits = job;
    /* The connection is suspended first, because the job may be done before the push returns. */
    MHD_suspend_connection(request->mhd);
    kd_scheduler_push(server->scheduler, &job->scheduled);
    return MHD_YES;
}

enum MHD_Result kd_handle_orbits(struct kd_request *request)
{
    enum MHD_Result refused;

    if (request->orbits)
        return deliver(request);
    int format = choose_format(request);
    if (format < 0)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                .offered = OFFERED,
                                                                .detail = "orbits are available as " OFFERED });
    if (request->target.n_pairs)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_ORBIT,
                                            .detail = "parameters must be in the document, not in the query" });
    if (!kd_task_admit(request, request->server->scheduler, "orbits", &refused))
        return refused;
    return submit(request, (enum kd_orbit_format)format);
}
