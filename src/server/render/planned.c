#include "server/render/planned.h"

#include "render/output/format.h"
#include "server/http/reply.h"
#include "server/render/scene_source.h"
#include "server/render/shared.h"
#include "server/render/queue.h"

#include <stdlib.h>

#define SMALL (64u << 10) /* a body of at most this size in bytes is parsed in 2 ms or less */
/* Maximum number of pixels for which planning takes 2 ms or less. The planner follows the critical curve from pixel
 * to pixel. */
#define FEW_PIXELS (4u << 20)

/* Records a problem. The texts are copied into the task, because the problem outlives the call. */
static bool fail(struct kd_planned *p, enum kd_status status, const struct kd_error *error, struct kd_problem problem)
{
    kd_task_fail(&p->task, status ? status : KD_EINVAL, error);
    problem.detail = p->task.error.message;
    problem.pointer = p->task.error.pointer;
    p->problem = problem;
    return false;
}

static bool read_scene(struct kd_planned *p)
{
    struct kd_error error = { 0 };
    struct kd_problem problem;
    const struct kd_request *request = p->task.request;
    const bool read = request->route->takes == KD_TAKES_LINK
                          ? kd_shared_preview(request, &p->scene, &problem, &error)
                          : kd_scene_of_request(request, &p->scene, &problem, &error);
    return read || fail(p, error.status, &error, problem);
}

/* Returns the first format that the request accepts and that can contain the scene. If there is none, returns the
 * first accepted format. */
static const struct kd_format *format_of(const struct kd_request *request, const struct kd_scene *scene)
{
    struct kd_error error;
    for (size_t i = 0; i < sizeof request->accepts / sizeof *request->accepts && request->accepts[i]; i++)
        if (!kd_format_holds(request->accepts[i], scene, &error))
            return request->accepts[i];
    return request->format;
}

static bool make_plan(struct kd_planned *p, bool check)
{
    struct kd_error error = { 0 };
    struct kd_capacity capacity;
    const struct kd_format *format = p->format = format_of(p->task.request, &p->scene);
    kd_render_queue_capacity(p->task.request->server->renders, &capacity);
    p->drawn = p->scene;
    enum kd_status status = check    ? kd_plan_check(&p->scene, &capacity, &error)
                            : format ? kd_format_plan(format, &p->drawn, &capacity, &p->plan, &error)
                                     : kd_plan_make(&p->scene, &capacity, &p->plan, &error);
    return !status || fail(p, status, &error, kd_problem_from(&error));
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct kd_planned *p = (struct kd_planned *)task;
    (void)until_ms;
    if (task->request->body.size <= SMALL || read_scene(p))
        make_plan(p, false);
    return KD_SLICE_LAST;
}

static bool few_pixels(const struct kd_scene *scene)
{
    const struct kd_window window = kd_scene_window(scene);
    return (uint64_t)window.width * window.height <= FEW_PIXELS;
}

static struct kd_planned *outcome(struct kd_request *request, struct kd_planned *p, enum MHD_Result *result)
{
    if (!p->task.status) {
        request->format = p->format;
        return p;
    }
    if (!p->problem.detail) /* the client disconnected between the two steps */
        p->problem = kd_problem_from(&p->task.error);
    *result = p->task.status == KD_ECANCELLED ? kd_reply_cancelled(request) : kd_reply_problem(request, &p->problem);
    return NULL;
}

struct kd_planned *kd_planned_of(struct kd_request *request, enum MHD_Result *result)
{
    static const struct kd_task_kind kind = { "large plans", sizeof(struct kd_planned), work };
    struct kd_planned *p = (struct kd_planned *)request->task;
    if (p)
        return outcome(request, p, result);
    if (!(p = kd_task_create(request, request->server->scheduler, &kind, result)))
        return NULL;
    if (request->body.size <= SMALL) {
        /* The limits are checked here, so that a scene that is too large is refused without a worker. */
        if (!read_scene(p) || !make_plan(p, !few_pixels(&p->scene)) || few_pixels(&p->scene))
            return outcome(request, p, result);
    }
    if (kd_task_admit(request, request->server->scheduler, kind.what, result))
        *result = kd_task_submit(&p->task);
    return NULL;
}
