/* POST /v1/plan: cost of rendering a scene, or of all scenes of a sweep. For a sweep, the body is the same as for a job
 * with axes, and workers plan the scenes in slices. */
#include "render/output/cost.h"
#include "document/scan.h"
#include "server/asset/store.h"
#include "server/http/reply.h"
#include "job/spec.h"
#include "server/render/planned.h"
#include "server/render/queue.h"
#include "server/render/scene_source.h"

#include <stdio.h>
#include <stdlib.h>

struct sweep {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_job_spec spec;
    char preset[32];
    struct kd_cost cost;
    struct kd_buffer json;
};

static void finish(struct kd_task *task)
{
    struct sweep *s = (struct sweep *)task;
    kd_job_spec_finish(&s->spec);
    kd_cost_finish(&s->cost);
    kd_buffer_finish(&s->json);
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct sweep *s = (struct sweep *)task;
    struct kd_server *server = task->request->server;
    const struct kd_buffer *body = &task->request->body;
    struct kd_capacity capacity;
    struct kd_error error = { 0 };
    enum kd_status status;
    if (!s->spec.sweep)
        KD_TRY(kd_job_spec_parse((const char *)body->data, body->size, &(struct kd_job_base) { .preset = s->preset },
                                 kd_asset_store_assets(server->assets), &s->spec, &error));
    kd_render_queue_capacity(server->renders, &capacity);
    KD_TRY(kd_cost_sweep(&s->cost, s->spec.series, s->spec.sweep, &capacity, until_ms, &error));
    if (s->cost.frames < s->spec.frames)
        return KD_SLICE_MORE;
    if (kd_cost_json(&s->cost, s->spec.sweep, &s->json))
        KD_TRY(kd_error_set(&error, KD_ENOMEM, "out of memory for the plan"));
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = *error->pointer ? KD_PROBLEM_INVALID_JOB : KD_PROBLEM_MALFORMED_JSON;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct sweep *s = (struct sweep *)request->task;
    if (s->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    return s->task.status ? refuse(request, &s->task.error)
                          : kd_reply_json(request, KD_OK, &s->json, request->route->answer);
}

static const struct kd_task_kind KIND = { "plans of sweeps", sizeof(struct sweep), work, finish };

static enum MHD_Result plan_sweep(struct kd_request *request)
{
    const char *preset = kd_target_value(&request->target, "preset");
    struct kd_error error = { 0 };
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    if (kd_scene_query_check(&request->target, false, request->route, &error))
        return refuse(request, &error);
    struct sweep *s = kd_task_begin(request, request->server->scheduler, &KIND, &refused);
    if (!s)
        return refused;
    snprintf(s->preset, sizeof s->preset, "%s", preset ? preset : "");
    return kd_task_submit(&s->task);
}

static enum MHD_Result plan_scene(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_buffer json = { 0 };
    struct kd_planned *planned = kd_planned_of(request, &result);
    if (!planned)
        return result;
    planned->plan.cost.kernels_ms =
        kd_render_queue_kernels_ms(request->server->renders, &planned->drawn, &planned->plan);
    return kd_reply_json(request, kd_plan_to_json(&planned->plan, &json), &json, request->route->answer);
}

enum MHD_Result kd_handle_plan(struct kd_request *request)
{
    const struct kd_buffer *body = &request->body;
    const bool sweep = body->size && kd_scan_names((const char *)body->data, body->size, "axes");
    return sweep ? plan_sweep(request) : plan_scene(request);
}
