/* Handlers of playground sessions: opening, reading, changing, stepping, ending, and downloads. Work on the
 * playground itself is a task that workers run. */
#include "server/playground/routes.h"

#include "base/clock.h"
#include "playground/show.h"
#include "document/tree.h"
#include "server/asset/store.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/playground/document.h"
#include "server/render/task.h"
#include "server/session/sessions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum what { OPEN, AGAIN, STATE, CHANGE, STEP, SNAPSHOT, SERIES, FALLBACK };

struct play_task {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    enum what what;
    const char *type;                   /* media type of the answer */
    struct kd_playground_session *play; /* a counted reference; for OPEN, to the session that was opened */
    struct kd_playground_session_waiter waiter;
    struct kd_buffer out;
    /* steps: true if this task steps the session; told: true if the client has received the session's token */
    bool conflict, steps, begun, told;
    double by;
    struct kd_playground_run run;
};

struct kd_playground_session *kd_playground_session_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_playground_session *play = kd_playground_sessions_find(request->server->playgrounds, request->rest);
    if (!play)
        *refused = kd_reply_problem(request,
                                    &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                                           .detail = "there is no such playground, or it has ended" });
    return play;
}

enum MHD_Result kd_playground_session_ended(struct kd_request *request)
{
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = "the playground has ended" });
}

static void finish(struct kd_task *task)
{
    struct play_task *t = (struct play_task *)task;
    if (t->steps)
        kd_playground_session_stepped(t->play);
    if (t->what == OPEN && t->play && !t->told && !*task->request->once.key)
        kd_playground_session_end(t->play, "failed");
    kd_playground_session_release(t->play);
    kd_buffer_finish(&t->out);
}

/* All functions from here on run on a worker. */

static const char *body_of(const struct kd_task *task)
{
    return task->request->body.data ? (const char *)task->request->body.data : "";
}

static enum kd_status tell(struct play_task *t, struct kd_playground *p,
                           const struct kd_playground_session_json_options *what, struct kd_error *error)
{
    const struct kd_playground_session_state state = kd_playground_session_state(t->play);
    struct kd_playground_session_json_options told = *what;
    struct kd_scene scene;
    kd_playground_session_scene(t->play, &scene);
    told.scene = &scene;
    return kd_playground_session_to_json(t->play, &state, p, &told, &t->out)
               ? kd_error_set(error, KD_ENOMEM, "out of memory for the answer")
               : KD_OK;
}

static enum kd_status open_play(struct play_task *t, struct kd_error *error)
{
    struct kd_server *server = t->task.request->server;
    struct kd_playground_session_pace pace = { 0 };
    struct kd_playground *p = NULL;
    struct kd_scene scene;
    cJSON *tree = NULL, *look = NULL;
    enum kd_status status;
    KD_TRY(kd_playground_parse(body_of(&t->task), t->task.request->body.size, &tree, error));
    pace.rate = kd_playground_session_usual_rate(tree);
    KD_TRY(kd_playground_session_read_pace(tree, &pace, error));
    look = cJSON_DetachItemFromObjectCaseSensitive(tree, "scene");
    KD_TRY(kd_playground_read_tree(tree, &p, error));
    KD_TRY(kd_playground_usual_scene(kd_playground_preset_in(tree), p, &scene, error));
    KD_TRY(kd_playground_session_read_scene(look, p, kd_asset_store_assets(server->assets), &scene, error));
    if (look)
        KD_TRY(kd_playground_sessions_takes(server->playgrounds, &scene, error));
    struct kd_playground *opened = p;
    KD_TRY(kd_playground_sessions_open(server->playgrounds, &p, &pace, &scene, t->task.request->client, &t->task.quota,
                                       &t->play, error));
    kd_playground_session_promise(t->play, &t->task.request->once);
    status =
        tell(t, opened, &(struct kd_playground_session_json_options) { .token = true, .before = UINT32_MAX }, error);
    kd_playground_session_give(t->play, opened);
done:
    kd_playground_destroy(p);
    cJSON_Delete(look);
    kd_tree_free(tree);
    kd_task_drop_body(t->task.request);
    return status;
}

/* Reserves memory for the debris capacity that a patch requests. */
static enum kd_status make_room(struct play_task *t, const struct kd_playground *p, const cJSON *tree,
                                struct kd_error *error)
{
    const cJSON *capacity = cJSON_GetObjectItemCaseSensitive(tree, "debris_capacity");
    if (!cJSON_IsNumber(capacity) || !(capacity->valuedouble >= 0 && capacity->valuedouble <= KD_PLAYGROUND_DEBRIS_MAX))
        return KD_OK; /* an invalid capacity is refused later, when the settings are parsed */
    return capacity->valuedouble > p->params.debris_capacity
               ? kd_playground_session_room(t->play, (uint32_t)capacity->valuedouble, &t->task.quota, error)
               : KD_OK;
}

static enum kd_status change_taken(struct play_task *t, struct kd_playground **p, cJSON *tree, struct kd_error *error)
{
    const struct kd_playground_session_state state = kd_playground_session_state(t->play);
    struct kd_playground_session_pace pace = state.pace;
    const uint32_t before = (*p)->last_id;
    struct kd_server *server = t->task.request->server;
    cJSON *look = cJSON_DetachItemFromObjectCaseSensitive(tree, "scene");
    struct kd_scene scene;
    bool quota;
    enum kd_status status = KD_OK;
    t->conflict = state.stepping;
    if (t->conflict)
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            "the playground cannot change during a step; repeat the request after the step"));
    KD_TRY(kd_playground_session_read_pace(tree, &pace, error));
    kd_playground_session_scene(t->play, &scene);
    KD_TRY(kd_playground_session_read_scene(look, *p, kd_asset_store_assets(server->assets), &scene, error));
    struct kd_scene old;
    kd_playground_session_scene(t->play, &old);
    if (look) { /* The scene is set first: this can fail, and it can be undone if a later change fails. */
        KD_TRY(kd_playground_session_set_scene(t->play, &scene, error));
        kd_playground_session_moved(t->play);
    }
    if (tree->child) {
        status = make_room(t, *p, tree, error);
        status = status ? status : kd_playground_patch_tree(p, tree, error);
        if (status && look)
            kd_playground_session_set_scene(t->play, &old, &(struct kd_error) { 0 });
        kd_playground_session_room(
            t->play, (*p)->params.debris_capacity, &quota,
            &(struct kd_error) { 0 }); /* keeps the memory for the capacity that now applies, and releases the rest */
        KD_TRY(status);
        kd_playground_session_moved(t->play);
    }
    if (pace.rate != state.pace.rate || pace.paused != state.pace.paused)
        kd_playground_session_set_pace(t->play, &pace);
    KD_TRY(tell(t, *p, &(struct kd_playground_session_json_options) { .before = before }, error));
done:
    cJSON_Delete(look);
    return status;
}

static enum kd_status change(struct play_task *t, struct kd_playground **p, struct kd_error *error)
{
    cJSON *tree = NULL;
    enum kd_status status = kd_playground_parse(body_of(&t->task), t->task.request->body.size, &tree, error);
    if (!status)
        status = change_taken(t, p, tree, error);
    kd_tree_free(tree);
    kd_task_drop_body(t->task.request);
    return status;
}

static enum kd_slice_result step(struct play_task *t, struct kd_playground *p, double until_ms, struct kd_error *error)
{
    if (!t->begun) {
        if (kd_playground_session_read_step(body_of(&t->task), t->task.request->body.size, &t->by, error))
            return KD_SLICE_LAST;
        t->steps = kd_playground_session_step(t->play);
        t->conflict = !t->steps;
        if (t->conflict) {
            kd_error_set(error, KD_EINVAL,
                         "a step needs a paused playground, and only one request may step it at a time");
            return KD_SLICE_LAST;
        }
    }
    bool more = true;
    if (!t->begun)
        kd_playground_begin(p, t->by, &t->run);
    t->begun = true;
    while (more && kd_clock_ms() < until_ms) {
        more = kd_playground_go_on(p, &t->run, kd_playground_session_pieces(p));
        kd_playground_session_log(t->play, p);
    }
    kd_playground_session_moved(t->play);
    if (!more) {
        struct kd_playground_progress progress = kd_playground_progress(p, &t->run);
        progress.asked = t->by;
        tell(t, p, &(struct kd_playground_session_json_options) { .before = UINT32_MAX, .progress = &progress }, error);
    }
    return more && !kd_playground_session_state(t->play).over ? KD_SLICE_MORE : KD_SLICE_LAST;
}

static enum kd_status write_file(struct play_task *t, struct kd_playground *p, struct kd_error *error)
{
    const bool npy = !strcmp(t->type, KD_NPY_TYPE);
    double now[KD_SERIES_N];
    enum kd_status status = KD_OK;
    switch (t->what) {
    case SNAPSHOT: status = kd_playground_write(p, true, &t->out); break;
    case SERIES:
        kd_playground_series_row(p, now);
        status = npy                            ? kd_series_npy(&p->series, now, &t->out)
                 : strcmp(t->type, KD_CSV_TYPE) ? kd_playground_session_series_json(&p->series, now, &t->out)
                                                : kd_series_csv(&p->series, now, &t->out);
        break;
    case FALLBACK: status = npy ? kd_debris_npy(&p->debris, &t->out) : kd_debris_csv(&p->debris, &t->out); break;
    default:
        status =
            tell(t, p, &(struct kd_playground_session_json_options) { .token = t->what == AGAIN, .before = UINT32_MAX },
                 error);
    }
    return status ? kd_error_set(error, status, "out of memory for the answer") : KD_OK;
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct play_task *t = (struct play_task *)task;
    struct kd_error error = { 0 };
    enum kd_slice_result end = KD_SLICE_LAST;
    struct kd_playground *p = t->what == OPEN ? NULL : kd_playground_session_take(t->play, &t->waiter);
    if (!p && t->what != OPEN)
        return KD_SLICE_AWAY;
    switch (t->what) {
    case OPEN: open_play(t, &error); break;
    case CHANGE: change(t, &p, &error); break;
    case STEP: end = step(t, p, until_ms, &error); break;
    default: write_file(t, p, &error);
    }
    if (p)
        kd_playground_session_give(t->play, p);
    kd_task_fail(task, error.status, &error);
    if (!error.status)
        kd_task_fail(
            task,
            kd_task_hold(task->request->server, task->scheduled.client, t->out.size, &task->held, &task->quota, &error),
            &error);
    return end;
}

/* All functions from here on run on the HTTP thread. */

static enum MHD_Result refuse(struct kd_request *request, const struct play_task *t)
{
    struct kd_problem problem = kd_problem_from(&t->task.error);
    if (t->conflict)
        problem.type = KD_PROBLEM_CONFLICT;
    else if ((t->task.error.status == KD_EINVAL || t->task.error.status == KD_ETOOBIG) && *t->task.error.pointer)
        problem.type = KD_PROBLEM_INVALID_PLAYGROUND;
    else if (t->task.error.status == KD_EINVAL)
        problem.type = KD_PROBLEM_MALFORMED_JSON;
    else
        kd_problem_limit(&problem, &t->task.error, t->task.quota, 10);
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct play_task *t = (struct play_task *)request->task;
    if (t->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (t->task.status)
        return refuse(request, t);
    if (!t->out.size)
        return kd_playground_session_ended(request);
    struct MHD_Response *response = kd_reply_text(request, &t->out, t->type);
    const bool opened = t->what == OPEN || t->what == AGAIN;
    if (opened)
        kd_reply_location(request, response, kd_playground_session_id(t->play));
    if (response && t->what == SNAPSHOT)
        kd_reply_file(request, KD_ATTACHMENT, "playground.json");
    const enum MHD_Result result = kd_reply_send(request, opened ? MHD_HTTP_CREATED : MHD_HTTP_OK, response);
    t->told = request->status == MHD_HTTP_CREATED;
    return result;
}

/* Starts the task, and takes over the reference `play`. */
static enum MHD_Result begin(struct kd_request *request, struct kd_playground_session *play, enum what what,
                             const char *type)
{
    static const struct kd_task_kind kind = { "playgrounds", sizeof(struct play_task), work, finish };
    enum MHD_Result refused;
    struct play_task *t = kd_task_begin(request, request->server->scheduler, &kind, &refused);
    if (!t) {
        kd_playground_session_release(play);
        return refused;
    }
    t->play = play;
    t->waiter = (struct kd_playground_session_waiter) { .scheduler = t->task.queue, .job = &t->task.scheduled };
    t->what = what;
    t->type = type;
    return kd_task_submit(&t->task);
}

static enum MHD_Result forbid(struct kd_request *request)
{
    return kd_reply_problem(
        request,
        &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                               .detail = "changing a playground needs its token: Authorization: Bearer TOKEN" });
}

static enum MHD_Result begin_opening(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_playground_session *play =
        kd_playground_sessions_find_once(request->server->playgrounds, request->once.key);
    const enum kd_once_verdict verdict =
        kd_once_begin(request, play ? kd_playground_session_once(play) : NULL, &refused);
    if (verdict == KD_ONCE_AGAIN)
        return begin(request, play, AGAIN, KD_JSON_TYPE);
    kd_playground_session_release(play);
    return verdict == KD_ONCE_REFUSED ? refused : begin(request, NULL, OPEN, KD_JSON_TYPE);
}

enum MHD_Result kd_handle_playgrounds(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    if (strcmp(request->method, "POST")) {
        const enum kd_status status = kd_playground_session_catalogue_json(&json);
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    }
    return request->task ? deliver(request) : begin_opening(request);
}

static enum MHD_Result end(struct kd_request *request, struct kd_playground_session *play)
{
    kd_playground_session_end(play, "deleted");
    kd_playground_session_release(play);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE));
}

/* Like begin, for requests that only the owner of the session may send. */
static enum MHD_Result begin_owned(struct kd_request *request, enum what what)
{
    enum MHD_Result refused;
    struct kd_playground_session *play = kd_playground_session_of(request, &refused);
    if (!play)
        return refused;
    if (!kd_playground_session_owned(play, kd_token_of(request))) {
        kd_playground_session_release(play);
        return forbid(request);
    }
    if (!kd_reply_matches(request, NULL)) {
        kd_playground_session_release(play);
        return kd_reply_unmatched(request);
    }
    return !strcmp(request->method, "DELETE") ? end(request, play) : begin(request, play, what, KD_JSON_TYPE);
}

static enum MHD_Result begin_reading(struct kd_request *request, enum what what, const char *type)
{
    enum MHD_Result refused;
    struct kd_playground_session *play = kd_playground_session_of(request, &refused);
    return play ? begin(request, play, what, type) : refused;
}

enum MHD_Result kd_handle_play(struct kd_request *request)
{
    if (request->task)
        return deliver(request);
    const bool reads = !strcmp(request->method, "GET") || request->head;
    return reads ? begin_reading(request, STATE, KD_JSON_TYPE) : begin_owned(request, CHANGE);
}

enum MHD_Result kd_handle_play_step(struct kd_request *request)
{
    return request->task ? deliver(request) : begin_owned(request, STEP);
}

enum MHD_Result kd_handle_play_snapshot(struct kd_request *request)
{
    return request->task ? deliver(request) : begin_reading(request, SNAPSHOT, KD_JSON_TYPE);
}

static enum MHD_Result table(struct kd_request *request, enum what what, const char *const *types, size_t n)
{
    if (request->task)
        return deliver(request);
    const size_t i = kd_reply_accepted(request, n, kd_accept_string, types);
    if (i == n)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                            .offered = n == 3 ? KD_CSV_TYPE ", " KD_NPY_TYPE ", " KD_JSON_TYPE
                                                              : KD_CSV_TYPE ", " KD_NPY_TYPE,
                                            .detail = "a table is available only as the listed media types" });
    return begin_reading(request, what, types[i]);
}

enum MHD_Result kd_handle_play_series(struct kd_request *request)
{
    static const char *const types[] = { KD_CSV_TYPE, KD_NPY_TYPE, KD_JSON_TYPE };
    return table(request, SERIES, types, 3);
}

enum MHD_Result kd_handle_play_fallback(struct kd_request *request)
{
    static const char *const types[] = { KD_CSV_TYPE, KD_NPY_TYPE };
    return table(request, FALLBACK, types, 2);
}

/* Gets the session that renders the picture. Returns a reference, or NULL with *refused. */
static struct kd_session *picture_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_session *picture = NULL;
    struct kd_error error = { 0 };
    bool quota;
    struct kd_playground_session *play = kd_playground_session_of(request, refused);
    if (!play)
        return NULL;
    if (kd_playground_session_picture(play, &quota, &picture, &error)) {
        struct kd_problem problem = kd_problem_from(&error);
        kd_problem_limit(&problem, &error, quota, 10);
        *refused = kd_reply_problem(request, &problem);
    }
    kd_playground_session_release(play);
    return picture;
}

enum MHD_Result kd_handle_play_frame(struct kd_request *request) { return kd_live_newest(request, picture_of, false); }
enum MHD_Result kd_handle_play_frames(struct kd_request *request) { return kd_live_frames(request, picture_of); }
