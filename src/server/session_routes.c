/* POST /v1/sessions; GET, PATCH and DELETE of one. */
#include "server/reply.h"
#include "server/scene_source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define JSON_TYPE "application/json"

struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_session *session = kd_sessions_find(request->server->sessions, request->rest);
    if (!session)
        *refused = kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                                                    .detail = "there is no such session, or it has ended" });
    return session;
}

const char *kd_token_of(struct kd_request *request)
{
    const char *header = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Authorization");
    if (header && !strncasecmp(header, "Bearer ", 7))
        return header + 7;
    for (size_t i = 0; i < request->target.n_pairs; i++)
        if (!strcmp(request->target.pairs[i].name, "token"))
            return request->target.pairs[i].value;
    return NULL;
}

/* {"id", "revision", "frame", "viewers", "scene"}, and for who has just made it the token. */
static enum kd_status to_json(const struct kd_session *session, const struct kd_session_state *state, bool token, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_printf(out, "{\"id\":\"%s\",", kd_session_id(session));
    if (!status && token)
        status = kd_buffer_printf(out, "\"token\":\"%s\",", kd_session_token(session));
    if (!status)
        status = kd_buffer_printf(out, "\"revision\":%u,\"frame\":%llu,\"viewers\":%u,\"scene\":", state->revision,
                                  (unsigned long long)state->frame, state->viewers);
    if (!status)
        status = kd_scene_to_json(&state->scene, out);
    return status ? status : kd_buffer_printf(out, "}\n");
}

static enum MHD_Result answer(struct kd_request *request, const struct kd_session *session, const struct kd_session_state *state,
                              bool created)
{
    struct kd_buffer json = { 0 };
    enum kd_status status = to_json(session, state, created, &json);
    if (status || !created)
        return kd_reply_json(request, status, &json, JSON_TYPE);
    char location[60];
    snprintf(location, sizeof location, "/v1/sessions/%s", kd_session_id(session));
    struct MHD_Response *response = kd_reply_take(&json, JSON_TYPE);
    if (response)
        MHD_add_response_header(response, "Location", location);
    return kd_reply_send(request, MHD_HTTP_CREATED, response);
}

static bool can_be_drawn(struct kd_server *server, const struct kd_scene *scene, struct kd_plan *plan, struct kd_error *error)
{
    struct kd_capacity capacity;
    kd_render_queue_capacity(server->renders, &capacity);
    if (kd_plan_make(scene, &capacity, plan, error))
        return false;
    if (plan->estimate_ms <= server->longest_s * 1e3)
        return true;
    kd_error_set(error, KD_ETOOBIG, "a frame of this scene would take about %.0f s, more than the %u s a render may take",
                 plan->estimate_ms * 1e-3, server->longest_s);
    return false;
}

enum MHD_Result kd_handle_sessions(struct kd_request *request)
{
    struct kd_server *server = request->server;
    struct kd_session *session = NULL;
    struct kd_session_state state;
    struct kd_problem problem;
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_error error = { 0 };
    if (!kd_scene_of_request(request, &scene, &problem, &error))
        return kd_reply_problem(request, &problem);
    if (!can_be_drawn(server, &scene, &plan, &error))
        return kd_reply_error(request, &error);
    if (atomic_load(&server->phase) >= KD_REFUSING)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING, .retry_after = 1,
                                                                .detail = "the server is stopping and takes no new sessions" });
    if (kd_sessions_open(server->sessions, &scene, &plan, &session, &error)) {
        problem = kd_problem_from(&error);
        problem.retry_after = 10;
        return kd_reply_problem(request, &problem);
    }
    kd_session_state(session, &state);
    enum MHD_Result result = answer(request, session, &state, true);
    kd_session_release(session);
    return result;
}

static enum MHD_Result patch(struct kd_request *request, struct kd_session *session)
{
    struct kd_session_state state;
    struct kd_error error = { 0 };
    const char *text = request->body.data ? (const char *)request->body.data : "";
    if (!kd_session_patch(session, text, request->body.size, &state, &error))
        return answer(request, session, &state, false);
    struct kd_problem problem = kd_problem_from(&error);
    if (error.status == KD_EINVAL && !*error.pointer)
        problem.type = KD_PROBLEM_MALFORMED_JSON;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result change(struct kd_request *request, struct kd_session *session)
{
    if (!kd_session_owned(session, kd_token_of(request)))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                                                                .detail = "changing a session takes its token: Authorization: Bearer TOKEN" });
    if (!strcmp(request->method, "PATCH"))
        return patch(request, session);
    kd_session_end(session);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, JSON_TYPE));
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
        result = answer(request, session, &state, false);
    }
    kd_session_release(session);
    return result;
}
