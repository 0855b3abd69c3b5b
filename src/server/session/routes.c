/* Handlers of POST /v1/sessions, and of GET, PATCH and DELETE of a session. */
#include "render/emit/motion.h"
#include "render/emit/describe.h"
#include "render/output/clock.h"
#include "document/document.h"
#include "document/number.h"
#include "document/tree.h"
#include "scene/sky_scale.h"
#include "server/asset/store.h"
#include "server/http/query.h"
#include "server/http/reply.h"
#include "server/render/planned.h"
#include "server/render/task.h"
#include "server/session/sessions.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define STRIKE_VALUES 16 /* maximum number of JSON values in the body of a ringdown, which has one field */

struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_session *session = kd_sessions_find(request->server->sessions, request->rest);
    if (!session)
        *refused =
            kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                                             .detail = "there is no such session, or it has ended" });
    return session;
}

static const struct {
    unsigned bit;
    const char *word;
} varying[] = {
    { KD_MOVES_WITH_TIME, "moves_with_time" },
    { KD_DIMS_WITH_TIME, "dims_with_time" },
    { KD_MOVES_WITH_AZIMUTH, "moves_with_azimuth" },
};

const char *kd_session_varies_word(size_t index)
{
    return index < sizeof varying / sizeof *varying ? varying[index].word : NULL;
}

/* Writes the list of ways in which the picture depends on time and azimuth, such as ["moves_with_time"]. */
static enum kd_status add_varies(const struct kd_scene *scene, struct kd_buffer *out)
{
    const unsigned varies = kd_emit_varies(scene);
    unsigned n = 0;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, ",\"varies\":["));
    for (size_t i = 0; i < sizeof varying / sizeof *varying; i++)
        if (varies & varying[i].bit)
            KD_TRY(kd_buffer_printf(out, "%s\"%s\"", n++ ? "," : "", varying[i].word));
    KD_TRY(kd_buffer_printf(out, "]"));
done:
    return status;
}

/* Writes {"id", "revision", "frame", "viewers", ["order",] "scene", "varies", "emitters"}. Further members are
 * optional: "path" if there is a path; "rendering" or "refining" while a frame is being made; "clock" in free fall;
 * "token" if the client has just created the session. */
static enum kd_status to_json(const struct kd_session *session, const struct kd_session_state *state, bool token,
                              struct kd_buffer *out)
{
    struct kd_fall_clock clock;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "{\"id\":\"%s\",", kd_session_id(session)));
    if (token)
        KD_TRY(kd_buffer_printf(out, "\"token\":\"%s\",", kd_session_token(session)));
    KD_TRY(kd_buffer_printf(out, "\"revision\":%u,\"frame\":%llu,\"viewers\":%u,", state->revision,
                            (unsigned long long)state->frame, state->viewers));
    if (state->order)
        KD_TRY(kd_buffer_printf(out, "\"order\":%llu,", (unsigned long long)state->order));
    KD_TRY(kd_buffer_printf(out, "\"scene\":"));
    KD_TRY(kd_scene_to_json(&state->scene, out));
    KD_TRY(add_varies(&state->scene, out));
    KD_TRY(kd_buffer_printf(out, ",\"emitters\":"));
    KD_TRY(kd_emit_to_json(&state->scene, out));
    if (state->path_end > 0)
        KD_TRY(kd_buffer_printf(out, ",\"path\":{\"at\":%.9g,\"end\":%.9g}", state->path_at, state->path_end));
    if (!isnan(state->progress.fraction)) {
        KD_TRY(kd_buffer_printf(out, ",\"%s\":", state->progress.refines ? "refining" : "rendering"));
        struct kd_json json = kd_json_begin(out);
        kd_json_object(&json, NULL);
        kd_json_number(&json, "fraction", state->progress.fraction);
        kd_json_number(&json, "remaining_s", state->progress.left_s); /* NAN is written as null */
        kd_json_end(&json);
        KD_TRY(kd_json_finish(&json));
    }
    if (kd_scene_clock(&state->scene, &clock)) {
        KD_TRY(kd_buffer_printf(out, ",\"clock\":"));
        struct kd_json json = kd_json_begin(out);
        kd_fall_clock_json(&clock, &json, NULL);
        KD_TRY(kd_json_finish(&json));
    }
    KD_TRY(kd_buffer_printf(out, "}\n"));
done:
    return status;
}

enum MHD_Result kd_session_answer(struct kd_request *request, const struct kd_session *session,
                                  const struct kd_session_state *state)
{
    struct kd_buffer json = { 0 };
    const struct kd_task *task = request->task;
    char timing[80];
    enum kd_status status = to_json(session, state, false, &json);
    if (status || !task)
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    struct MHD_Response *response = kd_reply_text(request, &json, KD_JSON_TYPE);
    snprintf(timing, sizeof timing, "queue;dur=%.3f, look;dur=%.3f", task->begun_ms - task->submitted_ms,
             task->done_ms - task->begun_ms);
    if (response)
        MHD_add_response_header(response, "Server-Timing", timing);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result answer_created(struct kd_request *request, const struct kd_session *session,
                                      const struct kd_session_state *state)
{
    struct kd_buffer json = { 0 };
    enum kd_status status = to_json(session, state, true, &json);
    if (status)
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    struct MHD_Response *response = kd_reply_take(&json, KD_JSON_TYPE);
    kd_reply_location(request, response, kd_session_id(session));
    return kd_reply_send(request, MHD_HTTP_CREATED, response);
}

/* Parses a query parameter as a number between two bounds. If the parameter is absent, *value is unchanged. */
static enum kd_status read_number(const struct kd_request *request, const char *parameter, double low, double high,
                                  double *value, bool *said, struct kd_error *error)
{
    const char *text, *name;
    char pointer[40];
    const enum kd_status status = kd_route_query(request, parameter, &name, &text, error);
    if (status || !text)
        return *said = false, status;
    const size_t n = strlen(text);
    const double number = n && kd_number_span(text, n) == n ? kd_number_parse(text) : NAN;
    *said = true;
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (!(number >= low && number <= high))
        return kd_error_field(error, pointer, "%s is %.20s; it must be %g to %g", name, text, low, high);
    *value = number;
    return KD_OK;
}

/* Parses the limits of quality reduction from the query. *said: true if the query has at least one of them. */
static enum kd_status read_pace(const struct kd_request *request, struct kd_session_pace *pace, bool *said,
                                struct kd_error *error)
{
    enum kd_status status;
    *pace = (struct kd_session_pace)KD_SESSION_PACE_DEFAULT;
    KD_TRY(read_number(request, "min_scale", KD_MIN_SCALE_MIN, 1, &pace->min_scale, said, error));
    bool limited;
    KD_TRY(read_number(request, "max_frame_ms", KD_MAX_FRAME_MS_MIN, KD_MAX_FRAME_MS_MAX, &pace->max_frame_ms, &limited,
                       error));
    if (limited && !*said) {
        const char *name, *text;
        char pointer[40];
        KD_TRY(kd_route_query(request, "max_frame_ms", &name, &text, error));
        snprintf(pointer, sizeof pointer, "/%s", name);
        KD_TRY(kd_error_field(
            error, pointer,
            "%s cannot be used without min_scale, because it lets frames become narrower than min_scale", name));
    }
done:
    return status;
}

/* Handles Idempotency-Key. Returns true if *result is the answer: the earlier session, or a refusal. */
static bool made_before(struct kd_request *request, enum MHD_Result *result)
{
    struct kd_session_state state;
    struct kd_session *session = kd_sessions_find_once(request->server->sessions, request->once.key);
    const enum kd_once_verdict verdict = kd_once_begin(request, session ? kd_session_once(session) : NULL, result);
    if (verdict == KD_ONCE_AGAIN) {
        kd_session_state(session, &state);
        *result = answer_created(request, session, &state);
    }
    if (session)
        kd_session_release(session);
    return verdict != KD_ONCE_FIRST;
}

enum MHD_Result kd_handle_sessions(struct kd_request *request)
{
    struct kd_server *server = request->server;
    struct kd_session *session = NULL;
    bool quota;
    struct kd_session_state state;
    struct kd_problem problem;
    struct kd_error error = { 0 };
    enum MHD_Result result;
    struct kd_session_pace pace;
    bool said;
    if (read_pace(request, &pace, &said, &error))
        return kd_reply_error(request, &error);
    if (made_before(request, &result))
        return result;
    const struct kd_planned *planned = kd_planned_of(request, &result);
    if (!planned)
        return result;
    if (kd_sessions_takes(server->sessions, &planned->plan, &error))
        return kd_reply_error(request, &error);
    if (atomic_load(&server->phase) >= KD_REFUSING)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                            .retry_after = 1,
                                            .detail = "the server is stopping and accepts no new sessions" });
    if (kd_sessions_open(server->sessions, &planned->scene, &planned->plan, request->client, false, &pace, &quota,
                         &session, &error)) {
        problem = kd_problem_from(&error);
        problem.retry_after = 10;
        kd_problem_limit(&problem, &error, quota, 10);
        return kd_reply_problem(request, &problem);
    }
    kd_session_promise(session, &request->once);
    kd_session_state(session, &state);
    result = answer_created(request, session, &state);
    /* The answer could not be sent. The session ends, because the client does not know its id and, without a key,
     * cannot request it again. */
    if (request->status != MHD_HTTP_CREATED && !*request->once.key)
        kd_session_end(session);
    kd_session_release(session);
    return result;
}

static enum MHD_Result refuse_patch(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL && !*error->pointer)
        problem.type = KD_PROBLEM_MALFORMED_JSON;
    return kd_reply_problem(request, &problem);
}

/* Parses the order of a patch. It ranks patches that are sent at the same time. */
static enum kd_status read_order(const struct kd_request *request, uint64_t *order, struct kd_error *error)
{
    const char *text = kd_target_value(&request->target, "order");
    *order = 0;
    if (text && (!kd_target_whole(&request->target, "order", 0, KD_ORDER_MAX, order) || !*order))
        return kd_error_field(error, "/order",
                              "order is %.20s; it must be a whole number from 1 to 2^53, higher with each patch", text);
    return KD_OK;
}

/* True if the request has "Prefer: return=minimal" (RFC 7240), which asks for an answer without the scene. */
static bool prefers_little(struct kd_request *request)
{
    struct kd_buffer prefer = kd_reply_header_list(request, "Prefer");
    const bool little = prefer.data && strcasestr((const char *)prefer.data, "return=minimal");
    kd_buffer_finish(&prefer);
    return little;
}

static enum MHD_Result answer_little(struct kd_request *request, const struct kd_session_state *state)
{
    struct kd_buffer json = { 0 };
    struct MHD_Response *response = NULL;
    enum kd_status status = kd_buffer_printf(&json, "{\"revision\":%u", state->revision);
    if (!status && state->order)
        status = kd_buffer_printf(&json, ",\"order\":%llu", (unsigned long long)state->order);
    if (!status && !kd_buffer_printf(&json, "}\n"))
        response = kd_reply_take(&json, KD_JSON_TYPE);
    kd_buffer_finish(&json);
    if (response)
        MHD_add_response_header(response, "Preference-Applied", "return=minimal");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

/* Merges a patch (RFC 7396) into the scene. */
static enum kd_status merge(struct kd_scene *scene, const void *to, struct kd_error *error)
{
    const struct kd_buffer *body = to;
    return kd_scene_patch(scene, body->data ? (const char *)body->data : "", body->size, error);
}

static enum MHD_Result change_scene(struct kd_request *request, struct kd_session *session, kd_scene_edit *edit,
                                    const void *to)
{
    struct kd_session_state state;
    struct kd_error error = { 0 };
    struct kd_session_pace pace;
    uint64_t order;
    bool said;
    if (read_pace(request, &pace, &said, &error) || read_order(request, &order, &error) ||
        kd_session_edit(session, edit, to, order, &state, &error))
        return refuse_patch(request, &error);
    if (said)
        kd_session_keep(session, &pace);
    return prefers_little(request) ? answer_little(request, &state) : kd_session_answer(request, session, &state);
}

bool kd_session_change(struct kd_request *request, struct kd_session *session, struct kd_session_state *state,
                       enum MHD_Result *refused)
{
    struct kd_error error = { 0 };
    uint64_t order;
    if (!kd_session_owned(session, kd_token_of(request))) {
        *refused = kd_session_forbid(request);
        return false;
    }
    if (!kd_reply_matches(request, NULL)) {
        *refused = kd_reply_unmatched(request);
        return false;
    }
    if (!read_order(request, &order, &error) && !kd_session_edit(session, merge, &request->body, order, state, &error))
        return true;
    *refused = refuse_patch(request, &error);
    return false;
}

enum MHD_Result kd_session_forbid(struct kd_request *request)
{
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                                        .detail = "changing a session needs its token: Authorization: Bearer TOKEN" });
}

static enum MHD_Result change(struct kd_request *request, struct kd_session *session)
{
    if (!kd_session_owned(session, kd_token_of(request)))
        return kd_session_forbid(request);
    if (!kd_reply_matches(request, NULL))
        return kd_reply_unmatched(request);
    if (!strcmp(request->method, "PATCH"))
        return change_scene(request, session, merge, &request->body);
    kd_session_end(session);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE));
}

enum MHD_Result kd_handle_session(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_session_state state;
    struct kd_session *session = kd_session_of(request, &result);
    if (!session)
        return result;
    if (!strcmp(request->method, "PATCH") || !strcmp(request->method, "DELETE")) {
        result = change(request, session);
    } else {
        kd_session_state(session, &state);
        result = kd_session_answer(request, session, &state);
    }
    kd_session_release(session);
    return result;
}

struct ringdown { double amplitude, time; };

static enum kd_status ring(struct kd_scene *scene, const void *to, struct kd_error *error)
{
    const struct ringdown *ringdown = to;
    (void)error;
    scene->style.ringdown = ringdown->amplitude;
    scene->style.ringdown_time = ringdown->time;
    kd_scene_settle(scene, NULL);
    return KD_OK;
}

/* Parses {"amplitude": x}, {} or an empty body. If the member is absent, *amplitude is unchanged. Returns KD_EINVAL
 * without a pointer if the body is not a JSON object. */
static enum kd_status read_strike(const struct kd_buffer *body, double *amplitude, struct kd_error *error)
{
    static const struct kd_row row = { .name = "amplitude", .kind = KD_KIND_REAL, .most = 1 };
    static const struct kd_document document = { .rows = &row, .n = 1 };
    cJSON *tree = NULL;
    enum kd_status status = KD_OK;
    if (body->size)
        KD_TRY(kd_tree_parse((const char *)body->data, body->size, KD_BODY_MAX, STRIKE_VALUES, &tree, error));
    if (tree && !cJSON_IsObject(tree))
        KD_TRY(kd_error_set(error, KD_EINVAL, "the body is not a JSON object"));
    if (tree)
        KD_TRY(kd_document_read(&document, amplitude, tree, "", NULL, error));
done:
    cJSON_Delete(tree);
    return status;
}

static enum MHD_Result strike(struct kd_request *request, struct kd_session *session)
{
    struct kd_session_state state;
    struct kd_error error = { 0 };
    char number[KD_NUMBER_SIZE], detail[160];
    kd_session_state(session, &state);
    const double rate = state.scene.motion.time_rate;
    struct ringdown ringdown = { state.scene.style.ringdown > 0 ? state.scene.style.ringdown : 1,
                                 state.scene.top.time };
    if (read_strike(&request->body, &ringdown.amplitude, &error)) {
        struct kd_problem problem = kd_problem_from(&error);
        if (error.status == KD_EINVAL)
            problem.type = *error.pointer ? KD_PROBLEM_INVALID_PARAMETERS : KD_PROBLEM_MALFORMED_JSON;
        return kd_reply_problem(request, &problem);
    }
    if (rate > 0)
        return change_scene(request, session, ring, &ringdown);
    kd_number_format(number, rate);
    snprintf(detail, sizeof detail,
             "motion.time_rate is %s; for a strike it must be more than 0 M per second, because the ringing evolves in "
             "coordinate time",
             number);
    return kd_reply_problem(
        request,
        &(struct kd_problem) { .type = KD_PROBLEM_CONFLICT, .pointer = "/motion/time_rate", .detail = detail });
}

enum MHD_Result kd_handle_session_ringdown(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_session *session = kd_session_of(request, &result);
    if (!session)
        return result;
    result = !kd_session_owned(session, kd_token_of(request)) ? kd_session_forbid(request)
             : kd_reply_matches(request, NULL)                ? strike(request, session)
                                                              : kd_reply_unmatched(request);
    kd_session_release(session);
    return result;
}
