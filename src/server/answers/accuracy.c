/* GET /v1/accuracy: the table that `kerrd bench accuracy` keeps for this device, as it is now on disk. */
#include "server/http/reply.h"
#include "server/http/request.h"
#include "server/render/queue.h"

enum MHD_Result kd_handle_accuracy(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    struct kd_error error = { 0 };
    enum kd_status status = kd_render_queue_accuracy_json(request->server->renders, &json, &error);
    if (status != KD_EIO && status != KD_EINVAL)
        return kd_reply_json(request, status, &json, request->route->answer);
    kd_buffer_finish(&json);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = error.message });
}
