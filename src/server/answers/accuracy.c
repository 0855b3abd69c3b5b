/* GET /v1/accuracy: the table that `kerrd bench accuracy` stores for this device. A worker thread reads the table,
 * because a disk may be slow. */
#include "server/http/reply.h"
#include "server/render/queue.h"
#include "server/render/task.h"

#include <stdlib.h>

struct reading {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_buffer json;
};

static void finish(struct kd_task *task) { kd_buffer_finish(&((struct reading *)task)->json); }

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct reading *reading = (struct reading *)task;
    struct kd_error error = { 0 };
    (void)until_ms;
    kd_task_fail(task, kd_render_queue_accuracy_json(task->request->server->renders, &reading->json, &error), &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct reading *reading = (struct reading *)request->task;
    enum kd_status status = reading->task.status;
    if (status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (status == KD_EIO || status == KD_EINVAL)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = reading->task.error.message });
    return kd_reply_json(request, status, &reading->json, request->route->answer);
}

enum MHD_Result kd_handle_accuracy(struct kd_request *request)
{
    static const struct kd_task_kind kind = { "readings of the accuracy table", sizeof(struct reading), work, finish };
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    struct reading *reading = kd_task_begin(request, request->server->scheduler, &kind, &refused);
    return reading ? kd_task_submit(&reading->task) : refused;
}
