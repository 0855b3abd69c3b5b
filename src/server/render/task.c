#include "server/render/task.h"

#include "base/clock.h"
#include "server/http/reply.h"

#include <stdio.h>
#include <stdlib.h>

#define TURN_MS 10.

enum kd_status kd_task_over(struct kd_server *server, struct kd_scheduler *queue, bool gone, double deadline_ms,
                            struct kd_error *error)
{
    if (gone || kd_scheduler_cancelled(queue))
        return kd_error_set(error, KD_ECANCELLED, "the client has disconnected, or the server is stopping");
    if (kd_clock_ms() > deadline_ms)
        return kd_error_set(error, KD_ETOOBIG, "the request exceeded the time limit of this server, %u s",
                            server->longest_s);
    return KD_OK;
}

void kd_task_fail(struct kd_task *task, enum kd_status status, const struct kd_error *error)
{
    enum kd_status none = KD_OK;
    if (!status || !atomic_compare_exchange_strong(&task->status, &none, status))
        return;
    task->error = *error;
    task->error.status = status;
}

/* True if the task has failed or must end. Records the reason in the task. */
static bool unwanted(struct kd_scheduler_job *scheduled)
{
    struct kd_task *task = (struct kd_task *)scheduled;
    struct kd_request *request = task->request;
    struct kd_error error = { 0 };
    const bool gone = kd_socket_abandoned(kd_connection_socket(request->connection));
    kd_task_fail(task, kd_task_over(request->server, task->queue, gone, task->deadline_ms, &error), &error);
    return task->status;
}

static enum kd_slice_result take_turn(struct kd_scheduler_job *scheduled)
{
    struct kd_task *task = (struct kd_task *)scheduled;
    const double now = kd_clock_ms();
    if (!(task->begun_ms > 0))
        task->begun_ms = now;
    return unwanted(scheduled) ? KD_SLICE_LAST : task->kind->work(task, now + TURN_MS);
}

static void done(struct kd_scheduler_job *scheduled)
{
    struct kd_task *task = (struct kd_task *)scheduled;
    if (task->kind->last)
        task->kind->last(task);
    task->done_ms = kd_clock_ms();
    MHD_resume_connection(task->request->mhd);
}

void *kd_task_create(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                     enum MHD_Result *refused)
{
    struct kd_task *task = calloc(1, kind->size);
    if (!task) {
        *refused = kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
        return NULL;
    }
    *task = (struct kd_task) { .scheduled = { .turn = take_turn, .done = done, .unwanted = unwanted },
                               .kind = kind,
                               .queue = queue,
                               .request = request,
                               .submitted_ms = kd_clock_ms() };
    snprintf(task->scheduled.client, sizeof task->scheduled.client, "%s", request->client);
    task->deadline_ms = task->submitted_ms + 1e3 * request->server->longest_s;
    request->task = task;
    return task;
}

void *kd_task_begin(struct kd_request *request, struct kd_scheduler *queue, const struct kd_task_kind *kind,
                    enum MHD_Result *refused)
{
    return kd_task_admit(request, queue, kind->what, refused) ? kd_task_create(request, queue, kind, refused) : NULL;
}

void kd_task_destroy(struct kd_task *task)
{
    if (!task)
        return;
    kd_bytes_give(task->request->server->replies, task->scheduled.client, task->held);
    if (task->kind->finish)
        task->kind->finish(task);
    free(task);
}

bool kd_task_admit(struct kd_request *request, struct kd_scheduler *queue, const char *what, enum MHD_Result *refused)
{
    struct kd_error error = { 0 };
    struct kd_problem problem;
    bool quota;
    char stopping[80];
    snprintf(stopping, sizeof stopping, "the server is stopping and accepts no new %s", what);
    if (atomic_load(&request->server->phase) >= KD_REFUSING)
        *refused = kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .retry_after = 1, .detail = stopping });
    else if (!request->connection)
        *refused = kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    else if (kd_scheduler_admit(queue, request->client, &quota, &error)) {
        problem = kd_problem_from(&error);
        if (quota)
            problem.type = KD_PROBLEM_QUOTA;
        *refused = kd_reply_problem(request, &problem);
    } else
        return true;
    return false;
}

enum MHD_Result kd_task_submit(struct kd_task *task)
{
    /* The request is suspended first, because the task may be done before the push returns. A suspended request and its
     * socket outlive the task. */
    MHD_suspend_connection(task->request->mhd);
    kd_scheduler_push(task->queue, &task->scheduled);
    return MHD_YES;
}

enum kd_status kd_task_hold(struct kd_server *server, const char *client, size_t bytes, size_t *held, bool *quota,
                            struct kd_error *error)
{
    if (kd_bytes_take(server->replies, client, bytes, bytes, quota))
        return kd_error_set(error, KD_EBUSY,
                            *quota ? "too many bytes of your answers are waiting to be read (limit for one client)"
                                   : "too many bytes of answers are waiting to be read");
    *held = bytes;
    return KD_OK;
}

void kd_task_drop_body(struct kd_request *request)
{
    kd_bytes_give(request->server->bodies, request->client, request->body.size);
    kd_buffer_finish(&request->body);
}
