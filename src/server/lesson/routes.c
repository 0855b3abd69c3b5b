/* Handlers of POST /v1/lessons, of a single lesson, and of pupils' answers. */
#include "base/clock.h"
#include "scene/tree.h"
#include "server/lesson/lesson.h"
#include "server/http/reply.h"
#include "server/session/sessions.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#define BODY_MOST ((size_t)64 << 10) /* maximum size of a body in bytes, enough for a link and a question */
#define BODY_VALUES 32               /* maximum number of JSON values in a body */

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = *error->pointer ? KD_PROBLEM_INVALID_PARAMETERS : KD_PROBLEM_MALFORMED_JSON;
    return kd_reply_problem(request, &problem);
}

static enum kd_status parse(const struct kd_request *request, cJSON **tree, struct kd_error *error)
{
    const struct kd_buffer *body = &request->body;
    enum kd_status status;
    KD_TRY(kd_tree_parse(body->data ? (const char *)body->data : "", body->size, BODY_MOST, BODY_VALUES, tree, error));
    if (!cJSON_IsObject(*tree))
        KD_TRY(kd_error_set(error, KD_EINVAL, "the body is not a JSON object"));
done:
    return status;
}

static enum MHD_Result answer(struct kd_request *request, const struct kd_lesson *one,
                              const struct kd_lesson_view *view)
{
    struct kd_buffer json = { 0 };
    return kd_reply_json(request, kd_lesson_to_json(one, view, &json), &json, KD_JSON_TYPE);
}

static enum kd_status read_change(struct kd_request *request, const cJSON *tree, struct kd_lesson_change *out,
                                  struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(kd_lesson_read_change(tree, out, error));
    struct kd_session *session = out->session ? kd_sessions_find(request->server->sessions, out->session) : NULL;
    if (out->session && !session)
        KD_TRY(kd_error_field(error, "/session", "session is %s; it must be the id of an open session", out->session));
    if (session)
        kd_session_release(session);
done:
    return status;
}

static enum MHD_Result answer_created(struct kd_request *request, struct kd_lesson *one)
{
    struct kd_buffer json = { 0 };
    const enum kd_status status =
        kd_lesson_to_json(one, &(struct kd_lesson_view) { .teacher = true, .token = true }, &json);
    if (status)
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    struct MHD_Response *response = kd_reply_take(&json, KD_JSON_TYPE);
    kd_reply_location(request, response, one->id);
    return kd_reply_send(request, MHD_HTTP_CREATED, response);
}

static enum MHD_Result open_lesson(struct kd_request *request)
{
    struct kd_lesson_change change;
    struct kd_error error = { 0 };
    struct kd_lesson *one = NULL;
    cJSON *tree = NULL;
    bool quota = false;
    enum MHD_Result result;
    enum kd_status status;
    KD_TRY(parse(request, &tree, &error));
    KD_TRY(read_change(request, tree, &change, &error));
    if (!change.session)
        KD_TRY(kd_error_field(&error, "/session", "session is missing; it must be the id of an open session"));
    KD_TRY(kd_lesson_open(request->server->lessons, request->client, &quota, &one, &error));
    kd_lesson_apply(one, &change);
    result = answer_created(request, one);
done:
    if (status == KD_EBUSY) {
        struct kd_problem problem = kd_problem_from(&error);
        kd_problem_limit(&problem, &error, quota, 60);
        result = kd_reply_problem(request, &problem);
    } else if (status)
        result = refuse(request, &error);
    cJSON_Delete(tree);
    return result;
}

static enum MHD_Result forbid(struct kd_request *request)
{
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                                        .detail = "changing a lesson needs its token: Authorization: Bearer TOKEN" });
}

static enum MHD_Result change_lesson(struct kd_request *request, struct kd_lesson *one)
{
    struct kd_lesson_change change;
    struct kd_error error = { 0 };
    cJSON *tree = NULL;
    enum kd_status status;
    KD_TRY(parse(request, &tree, &error));
    KD_TRY(read_change(request, tree, &change, &error));
    kd_lesson_apply(one, &change);
done:
    cJSON_Delete(tree);
    return status ? refuse(request, &error) : answer(request, one, &(struct kd_lesson_view) { .teacher = true });
}

/* Returns the lesson that the path names. If it is NULL, *refused is the result of the handler. */
static struct kd_lesson *lesson_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_lesson *one = kd_lesson_find(request->server->lessons, request->rest);
    if (!one)
        *refused =
            kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                                             .detail = "there is no such lesson, or it has ended" });
    return one;
}

static enum MHD_Result serve_lesson(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_lesson *one = lesson_of(request, &result);
    if (!one)
        return result;
    const bool teacher = kd_secret_equal(one->token, kd_token_of(request));
    if (teacher)
        one->used_ms = kd_clock_ms();
    if (strcmp(request->method, "PATCH") && strcmp(request->method, "DELETE"))
        return answer(request, one, &(struct kd_lesson_view) { .teacher = teacher });
    if (!teacher)
        return forbid(request);
    if (!kd_reply_matches(request, NULL))
        return kd_reply_unmatched(request);
    if (!strcmp(request->method, "PATCH"))
        return change_lesson(request, one);
    kd_lesson_end(request->server->lessons, one);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE));
}

static enum MHD_Result conflict(struct kd_request *request, const char *detail, const char *pointer)
{
    return kd_reply_problem(request,
                            &(struct kd_problem) { .type = KD_PROBLEM_CONFLICT, .detail = detail, .pointer = pointer });
}

static enum MHD_Result raise_hand(struct kd_request *request, struct kd_lesson *one, const struct kd_hand *hand)
{
    const struct kd_question *question = &one->question;
    char detail[80];
    if (hand->answers && (!question->open || question->number != hand->question))
        return conflict(request, "this question is not open any more", "/question");
    if (hand->answers && hand->choice >= question->n_choices) {
        snprintf(detail, sizeof detail, "choice is %u; it must be 0 to %u", hand->choice, question->n_choices - 1);
        return kd_reply_problem(
            request,
            &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail, .pointer = "/choice" });
    }
    struct kd_pupil *pupil = kd_lesson_pupil(one, hand->pupil);
    if (!pupil)
        return conflict(request, "this lesson is full (limit 64 pupils)", "/pupil");
    if (hand->name)
        snprintf(pupil->name, sizeof pupil->name, "%s", hand->name);
    if (hand->answers)
        pupil->answered = hand->question, pupil->choice = hand->choice;
    const bool copies = !request->visitor || request->visitor->role == KD_ROLE_RENDER;
    return answer(request, one, &(struct kd_lesson_view) { .pupil = pupil, .copies = copies });
}

static enum MHD_Result serve_hand(struct kd_request *request)
{
    struct kd_error error = { 0 };
    struct kd_hand hand;
    cJSON *tree = NULL;
    enum MHD_Result result;
    _Static_assert(KD_LESSON_PUPILS == 64, "the refusal says so");
    struct kd_lesson *one = lesson_of(request, &result);
    if (!one)
        return result;
    if (!kd_reply_matches(request, NULL))
        return kd_reply_unmatched(request);
    enum kd_status status;
    KD_TRY(parse(request, &tree, &error));
    KD_TRY(kd_lesson_read_hand(tree, &hand, &error));
    result = raise_hand(request, one, &hand);
done:
    if (status)
        result = refuse(request, &error);
    cJSON_Delete(tree);
    return result;
}

/* Runs a handler with the lock of all lessons held, so that the reaper cannot end a lesson in the meantime. */
static enum MHD_Result locked(struct kd_request *request, enum MHD_Result (*handle)(struct kd_request *))
{
    kd_lessons_lock(request->server->lessons);
    const enum MHD_Result result = handle(request);
    kd_lessons_unlock(request->server->lessons);
    return result;
}

enum MHD_Result kd_handle_lessons(struct kd_request *request) { return locked(request, open_lesson); }
enum MHD_Result kd_handle_lesson(struct kd_request *request) { return locked(request, serve_lesson); }
enum MHD_Result kd_handle_lesson_hands(struct kd_request *request) { return locked(request, serve_hand); }
