/* This answers POST /v1/line and its like: integrals over a thin disk (integral/answer.h), which a worker computes. */
#include "integral/answer.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/task.h"

#include <stdio.h>
#include <string.h>

#define OFFERED "application/json, text/csv, " KD_NPY_TYPE
#define BYTES_PER_ROW (KD_INTEGRAL_COLUMNS * (sizeof(double) + 26)) /* with its text */

static const char *const types[] = { [KD_INTEGRAL_JSON] = "application/json", [KD_INTEGRAL_CSV] = "text/csv", [KD_INTEGRAL_NPY] = KD_NPY_TYPE };

struct job {
    struct kd_task task; /* first */
    struct kd_integral_request request;
    enum kd_integral_format format;
    bool malformed;
    struct kd_buffer text;
};

static void finish(struct kd_task *task)
{
    struct job *job = (struct job *)task;
    kd_integral_request_finish(&job->request);
    kd_buffer_finish(&job->text);
}

static enum kd_turn_end work(struct kd_task *task, double until_ms)
{
    struct job *job = (struct job *)task;
    struct kd_buffer *body = &task->request->body;
    struct kd_integral_answer answer = { 0 };
    struct kd_error error = { 0 };
    (void)until_ms; /* one piece: mostly some hundredths of a second, and 0.3 s for the most that can be asked */
    enum kd_status status = kd_integral_request_json(&job->request, body->data ? (const char *)body->data : "", body->size, &error);
    job->malformed = status == KD_EINVAL && !*error.pointer;
    kd_task_drop_body(task->request);
    if (!status)
        status = kd_task_hold(task->request->server, task->turns.client, kd_integral_rows(&job->request) * BYTES_PER_ROW, &task->held, &task->quota, &error);
    if (!status)
        status = kd_integral_compute(&job->request, &answer, &error);
    if (!status && (status = kd_integral_write(&answer, job->format, &job->text)))
        kd_error_set(&error, status, "out of memory for %zu rows", answer.rows);
    kd_integral_answer_finish(&answer);
    kd_task_fail(task, status, &error);
    return KD_TURN_LAST;
}

static enum MHD_Result refuse(struct kd_request *request, const struct job *job)
{
    struct kd_problem problem = kd_problem_from(&job->task.error);
    if (job->task.error.status == KD_EINVAL)
        problem.type = job->malformed ? KD_PROBLEM_MALFORMED_JSON : KD_PROBLEM_INVALID_PARAMETERS;
    if (job->task.quota)
        problem.type = KD_PROBLEM_QUOTA;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct job *job = (struct job *)request->task;
    const struct kd_task *task = request->task;
    char timing[80];
    if (task->status == KD_ECANCELLED)
        return MHD_NO; /* nobody listens */
    if (task->status)
        return refuse(request, job);
    request->reply_bytes = job->text.size;
    struct MHD_Response *response = job->format == KD_INTEGRAL_NPY   ? kd_reply_take(&job->text, types[KD_INTEGRAL_NPY])
                                    : job->format == KD_INTEGRAL_CSV ? kd_reply_text(request, &job->text, "text/csv; charset=utf-8; header=present")
                                                                     : kd_reply_text(request, &job->text, types[KD_INTEGRAL_JSON]);
    if (!response)
        return kd_reply_no_memory(request);
    if (job->format != KD_INTEGRAL_JSON)
        kd_reply_file(request, KD_ATTACHMENT, "%s.%s", kd_integral_name(job->request.what), job->format == KD_INTEGRAL_CSV ? "csv" : "npy");
    snprintf(timing, sizeof timing, "queue;dur=%.3f, compute;dur=%.3f", task->begun_ms - task->submitted_ms, task->done_ms - task->begun_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static const struct kd_task_kind KIND = { "integrals", sizeof(struct job), work, finish, .answer = NULL };

enum MHD_Result kd_handle_integral(struct kd_request *request)
{
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    size_t format = kd_reply_accepted(request, 3, kd_accept_string, types);
    if (format >= 3)
        return kd_reply_problem(request,
                                &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE, .offered = OFFERED, .detail = "integrals are offered as " OFFERED });
    if (request->target.n_pairs)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS,
                                                                .detail = "parameters belong to the document, not to the query" });
    struct job *job = kd_task_begin(request, request->server->turns, &KIND, &refused);
    if (!job)
        return refused;
    job->format = (enum kd_integral_format)format;
    kd_integral_request_init(&job->request, kd_integral_of_route(request->route->path));
    return kd_task_submit(&job->task);
}
