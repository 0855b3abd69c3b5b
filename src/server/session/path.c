/* POST and DELETE of a session's path. Workers parse and check the path in slices, because this takes milliseconds. */
#include "base/clock.h"
#include "document/document.h"
#include "document/members.h"
#include "document/tree.h"
#include "server/asset/store.h"
#include "server/http/reply.h"
#include "server/render/task.h"
#include "server/session/sessions.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PATH_VALUES 50000
/* number of places on the path that are checked; each check takes up to a quarter of a millisecond */
#define PATH_LOOKS 30

struct path_request { struct kd_timeline_items items; };

struct path_task {
    struct kd_task task;  /* must be first: callbacks cast its address to this struct */
    struct kd_scene from; /* the session's scene at the time of the request */
    struct kd_timeline path;
    bool read;
    int look; /* index of the place to check next */
};

static void finish(struct kd_task *task)
{
    struct path_task *p = (struct path_task *)task;
    kd_timeline_finish(&p->path);
}

/* Parses {"keyframes": [{"at": seconds, "scene", "proper_time", "ease", "look_at"}, ...], "interpolation",
 * "distances", "angles", "ease", "look_at"}. The path starts at the present scene. */
static enum kd_status read_path(const struct kd_request *request, const struct kd_scene *now, struct kd_timeline *out,
                                struct kd_error *error)
{
    static const struct kd_timeline_form by_second = { "at", KD_SESSION_PATH_S, false };
    struct path_request asked = { 0 };
    const struct kd_assets *assets = kd_asset_store_assets(request->server->assets);
    const struct kd_buffer *body = &request->body;
    static const struct kd_row rows[] = { KD_TIMELINE_ROWS(struct path_request, items) };
    static const struct kd_document document = { .rows = rows, .n = sizeof rows / sizeof *rows };
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(
        kd_tree_parse(body->data ? (const char *)body->data : "", body->size, KD_BODY_MAX, PATH_VALUES, &root, error));
    if (!cJSON_IsObject(root))
        KD_TRY(kd_error_set(error, KD_EINVAL, "the body is not a JSON object"));
    KD_TRY(kd_document_read(&document, &asked, root, "", NULL, error));
    if (!asked.items.keyframes)
        KD_TRY(kd_error_field(error, "/keyframes",
                              "keyframes is missing; it must be an array, as in \"keyframes\": [{\"at\": 10, "
                              "\"scene\": {\"time\": 100}}]"));
    KD_TRY(kd_timeline_read(&asked.items, &by_second, assets, now, out, error));
    if (!(kd_timeline_end(out) > 0))
        KD_TRY(kd_error_field(error, "/keyframes", "the last keyframe is at 0 s; it must be later"));
done:
    cJSON_Delete(root);
    return status;
}

/* Checks rules that involve several keyframes. */
static enum kd_status check_motion(const struct kd_timeline *path, struct kd_error *error)
{
    bool fallen = false, rates = false;
    for (size_t i = 0; i < path->n_keys; i++) {
        const struct kd_motion *m = &path->keys[i].scene.motion;
        fallen |= path->keys[i].proper_time > 0;
        rates |= m->time_rate != 0 || m->azimuth_rate_deg != 0;
        if (memcmp(m, &path->keys[0].scene.motion, sizeof *m))
            return kd_error_field(error, "/keyframes",
                                  "keyframe %zu changes motion, which must not change along a path", i);
    }
    if (fallen && rates)
        return kd_error_field(error, "/keyframes",
                              "proper_time needs motion.time_rate and motion.azimuth_rate_deg 0, because the "
                              "observer's path determines time and azimuth");
    return KD_OK;
}

static enum kd_status read_whole(struct path_task *p, struct kd_error *error)
{
    enum kd_status status = read_path(p->task.request, &p->from, &p->path, error);
    if (!status)
        status = check_motion(&p->path, error);
    p->read = true;
    return status;
}

/* Checks the scene at one place on the path. If a scene between two such places is not valid, this is found later,
 * because each frame is planned again. */
static enum kd_status look(struct path_task *p, struct kd_error *error)
{
    struct kd_capacity capacity;
    struct kd_scene scene;
    enum kd_status status;
    kd_render_queue_capacity(p->task.request->server->renders, &capacity);
    KD_TRY(kd_timeline_scene(&p->path, kd_timeline_end(&p->path) * p->look / PATH_LOOKS, &scene, error));
    KD_TRY(kd_member_inside(kd_plan_check(&scene, &capacity, error), "/keyframes", error));
    p->look++;
done:
    return status;
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct path_task *p = (struct path_task *)task;
    struct kd_error error = { 0 };
    enum kd_status status = KD_OK;
    if (!p->read)
        status = read_whole(p, &error);
    while (!status && p->look <= PATH_LOOKS) {
        if (kd_clock_ms() > until_ms)
            return KD_SLICE_MORE;
        status = look(p, &error);
    }
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = *error->pointer ? KD_PROBLEM_INVALID_PARAMETERS : KD_PROBLEM_MALFORMED_JSON;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result begin(struct kd_request *request, struct kd_session *session)
{
    static const struct kd_task_kind kind = { "paths", sizeof(struct path_task), work, finish };
    struct kd_session_state state;
    enum MHD_Result refused;
    struct path_task *p = kd_task_begin(request, request->server->scheduler, &kind, &refused);
    if (!p)
        return refused;
    kd_session_state(session, &state);
    p->from = state.scene;
    return kd_task_submit(&p->task);
}

/* Starts the path when all checks have passed. */
static enum MHD_Result follow(struct kd_request *request, struct kd_session *session)
{
    struct path_task *p = (struct path_task *)request->task;
    struct kd_session_state state;
    struct kd_error error = { 0 };
    if (p->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (p->task.status)
        return refuse(request, &p->task.error);
    if (kd_session_follow(session, &p->path, &state, &error))
        return refuse(request, &error);
    return kd_session_answer(request, session, &state);
}

static enum MHD_Result stop(struct kd_request *request, struct kd_session *session)
{
    struct kd_error error = { 0 };
    if (kd_session_stop(session, &error))
        return kd_reply_error(request, &error);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE));
}

enum MHD_Result kd_handle_session_path(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_session *session = kd_session_of(request, &result);
    if (!session)
        return result;
    if (!kd_session_owned(session, kd_token_of(request)))
        result = kd_session_forbid(request);
    else if (!kd_reply_matches(request, NULL))
        result = kd_reply_unmatched(request);
    else if (!strcmp(request->method, "DELETE"))
        result = stop(request, session);
    else
        result = request->task ? follow(request, session) : begin(request, session);
    kd_session_release(session);
    return result;
}
