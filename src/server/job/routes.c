/* Handlers of /v1/jobs: creating, listing, status, events and deletion. */
#include "base/json.h"
#include "base/clock.h"
#include "server/asset/store.h"
#include "server/job/routes.h"
#include "server/http/reply.h"
#include "server/render/scene_source.h"
#include "server/render/task.h"
#include "server/job/jobs.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEARTBEAT_MS 15000.0 /* interval in ms of the comments that serve as heartbeats in an event stream */

struct kd_job *kd_job_of(struct kd_request *request, enum MHD_Result *refused)
{
    struct kd_job *job = kd_jobs_find(request->server->jobs, request->rest);
    if (!job)
        *refused =
            kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                                             .detail = "there is no such job, or it was deleted" });
    return job;
}

static const char *const states[] = { "waiting", "running", "done", "failed", "deleted" };
enum { WAITING, RUNNING, DONE, FAILED, DELETED };

const char *kd_job_state_word(size_t i) { return i < sizeof states / sizeof *states ? states[i] : NULL; }

static const char *state_word(const struct kd_job_status *s)
{
    return states[s->deleted                  ? DELETED
                  : s->state == KD_JOB_DONE   ? DONE
                  : s->state == KD_JOB_FAILED ? FAILED
                  : s->place || *s->delayed   ? WAITING
                                              : RUNNING];
}

/* Writes "axes": {"spacetime.spin": 3, ...}. */
static void write_axes(struct kd_json *json, const struct kd_sweep *sweep)
{
    kd_json_object(json, "axes");
    for (size_t i = 0; i < sweep->n_axes; i++)
        kd_json_number(json, sweep->axes[i].path, (double)sweep->axes[i].n);
    kd_json_end(json);
}

static enum kd_status to_json(struct kd_job *job, const struct kd_job_status *s, bool token, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "id", kd_job_id(job));
    if (token)
        kd_json_string(&json, "token", kd_job_token(job));
    kd_json_string(&json, "state", state_word(s));
    kd_json_string(&json, "output", s->series->name);
    kd_json_number(&json, "place", s->place);
    kd_json_number(&json, "frames", s->frames);
    kd_json_number(&json, "finished", s->finished);
    kd_json_number(&json, "fraction", s->fraction);
    kd_json_number(&json, "remaining_s", s->remaining_s); /* NAN is written as null */
    kd_json_number(&json, "bytes", (double)s->bytes);
    kd_json_number(&json, "lens_maps_traced", s->traced);
    if (!isnan(s->exposure))
        kd_json_number(&json, "exposure", s->exposure);
    if (s->sweep)
        write_axes(&json, s->sweep);
    kd_json_number(&json, "created", s->created);
    kd_json_number(&json, "ended", s->ended > 0 ? s->ended : NAN);
    if (*s->delayed)
        kd_json_string(&json, "delayed", s->delayed);
    if (s->state == KD_JOB_FAILED)
        kd_json_string(&json, "error", s->error);
    kd_json_end(&json);
    return kd_json_finish(&json);
}

static enum MHD_Result answer(struct kd_request *request, struct kd_job *job, bool created)
{
    struct kd_buffer json = { 0 };
    struct kd_job_status state;
    kd_job_status(job, &state);
    enum kd_status status = to_json(job, &state, created, &json);
    if (!status)
        status = kd_buffer_append(&json, "\n", 1);
    if (status || !created)
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    struct MHD_Response *response = kd_reply_take(&json, KD_JSON_TYPE);
    kd_reply_location(request, response, kd_job_id(job));
    return kd_reply_send(request, MHD_HTTP_ACCEPTED, response);
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error, bool quota)
{
    struct kd_problem problem = kd_problem_from(error);
    double s = kd_jobs_remaining_s(request->server->jobs);
    if (error->status == KD_EINVAL)
        problem.type = *error->pointer ? KD_PROBLEM_INVALID_JOB : KD_PROBLEM_MALFORMED_JSON;
    kd_problem_limit(&problem, error, quota, s < 3600 ? 1 + (unsigned)s : s >= 3600 ? 3600 : 10);
    return kd_reply_problem(request, &problem);
}

/* A request for a job, which workers parse and check. */
struct draft {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_job_draft draft;
    bool read;
    struct kd_job *job; /* a counted reference to the created job; NULL until there is one */
};

static void finish(struct kd_task *task)
{
    struct draft *d = (struct draft *)task;
    kd_job_draft_finish(&d->draft);
    if (d->job)
        kd_job_release(d->job);
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct draft *d = (struct draft *)task;
    struct kd_jobs *jobs = task->request->server->jobs;
    const struct kd_assets *assets = kd_asset_store_assets(task->request->server->assets);
    const struct kd_buffer *body = &task->request->body;
    const char *text = body->data ? (const char *)body->data : "";
    struct kd_error error = { 0 };
    enum kd_status status;
    if (!d->read)
        KD_TRY(kd_job_spec_parse(text, body->size, &(struct kd_job_base) { .preset = d->draft.preset }, assets,
                                 &d->draft.spec, &error));
    d->read = true;
    KD_TRY(kd_jobs_check(jobs, &d->draft, until_ms, &error));
    if (task->status) /* since the slice began, the client has disconnected, or the deadline has passed */
        return KD_SLICE_LAST;
    if (d->draft.cost.frames < d->draft.spec.frames)
        return KD_SLICE_MORE;
    KD_TRY(kd_jobs_open(jobs, &d->draft, text, body->size, task->request->client, &task->quota, &d->job, &error));
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result deliver(struct kd_request *request)
{
    const struct draft *d = (const struct draft *)request->task;
    enum MHD_Result result = d->task.status == KD_ECANCELLED ? kd_reply_cancelled(request)
                             : d->task.status                ? refuse(request, &d->task.error, d->task.quota)
                                                             : answer(request, d->job, true);
    /* The answer could not be sent. The job is deleted, because the client does not know its id and, without a key,
     * cannot request it again. */
    if (d->job && request->status != MHD_HTTP_ACCEPTED && !*request->once.key)
        kd_job_drop(d->job);
    return result;
}

/* Handles Idempotency-Key. Returns true if *result is the answer: the earlier job, or a refusal. */
static bool made_before(struct kd_request *request, enum MHD_Result *result)
{
    struct kd_job *job = kd_jobs_find_once(request->server->jobs, request->once.key);
    const enum kd_once_verdict verdict = kd_once_begin(request, job ? kd_job_once(job) : NULL, result);
    if (verdict == KD_ONCE_AGAIN)
        *result = answer(request, job, true);
    if (job)
        kd_job_release(job);
    return verdict != KD_ONCE_FIRST;
}

enum MHD_Result kd_handle_jobs(struct kd_request *request)
{
    static const struct kd_task_kind kind = { "jobs", sizeof(struct draft), work, finish };
    const char *preset = kd_target_value(&request->target, "preset");
    struct kd_error error = { 0 };
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    if (kd_scene_query_check(&request->target, false, request->route, &error))
        return refuse(request, &error, false);
    if (made_before(request, &refused))
        return refused;
    struct draft *d = kd_task_begin(request, request->server->scheduler, &kind, &refused);
    if (!d)
        return refused;
    d->draft.once = request->once;
    snprintf(d->draft.preset, sizeof d->draft.preset, "%s", preset ? preset : "");
    return kd_task_submit(&d->task);
}

/* State of a deletion. A worker deletes the job's files, so that they are gone when the request is answered. */
struct removing {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_job *job;  /* a counted reference */
};

static enum kd_slice_result remove_work(struct kd_task *task, double until_ms)
{
    (void)until_ms;
    kd_job_delete(((struct removing *)task)->job);
    return KD_SLICE_LAST;
}

static void remove_finish(struct kd_task *task)
{
    struct removing *r = (struct removing *)task;
    if (r->job)
        kd_job_release(r->job);
}

static const struct kd_task_kind REMOVAL = { "jobs", sizeof(struct removing), remove_work, remove_finish };

static enum MHD_Result deliver_removal(struct kd_request *request)
{
    const struct kd_task *task = request->task;
    if (task->status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (task->status) {
        struct kd_problem problem = kd_problem_from(&task->error);
        return kd_reply_problem(request, &problem);
    }
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE));
}

/* Begins a deletion, and takes over the reference to the job. */
static enum MHD_Result begin_removal(struct kd_request *request, struct kd_job *job)
{
    enum MHD_Result refused = MHD_NO;
    struct removing *r =
        request->connection ? kd_task_create(request, request->server->scheduler, &REMOVAL, &refused) : NULL;
    if (r) {
        r->job = job;
        return kd_task_submit(&r->task);
    }
    kd_job_release(job);
    return request->connection ? refused : kd_reply_no_memory(request);
}

enum MHD_Result kd_handle_job(struct kd_request *request)
{
    enum MHD_Result result;
    if (request->task)
        return deliver_removal(request);
    struct kd_job *job = kd_job_of(request, &result);
    if (!job)
        return result;
    if (strcmp(request->method, "DELETE")) {
        result = answer(request, job, false);
    } else if (!kd_secret_equal(kd_job_token(job), kd_token_of(request))) {
        result = kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                                            .detail = "deleting a job needs its token: Authorization: Bearer TOKEN" });
    } else if (!kd_reply_matches(request, NULL)) {
        result = kd_reply_unmatched(request);
    } else
        return begin_removal(request, job);
    kd_job_release(job);
    return result;
}

struct events {
    struct kd_job_watcher watcher; /* must be first: callbacks cast its address to this struct */
    struct kd_buffer text;         /* text of the event that is being sent */
    size_t at;
    bool over;
};

static enum kd_status write_event(struct events *e)
{
    struct kd_job_status s;
    struct kd_buffer json = { 0 };
    kd_job_status(e->watcher.job, &s);
    e->over = s.deleted || s.state != KD_JOB_ACTIVE;
    enum kd_status status = to_json(e->watcher.job, &s, false, &json);
    if (!status)
        status = kd_buffer_printf(&e->text, "event: %s\ndata: %s\n\n", e->over ? "end" : "progress",
                                  (const char *)json.data);
    kd_buffer_finish(&json);
    return status;
}

static enum kd_status next_event(struct events *e, ssize_t *instead)
{
    e->text.size = e->at = 0;
    if (e->over) {
        *instead = MHD_CONTENT_READER_END_OF_STREAM;
        return KD_OK;
    }
    switch (kd_job_await(&e->watcher)) {
    case KD_JOB_NEWS: return write_event(e);
    case KD_JOB_OVER:
        *instead = MHD_CONTENT_READER_END_OF_STREAM;
        return KD_OK; /* no final event: the server is stopping, and the job may continue after a restart */
    case KD_JOB_LATER: *instead = 0; return KD_OK;
    case KD_JOB_LATE: /* sends a heartbeat, which also detects clients that have vanished */
        e->watcher.deadline_ms = kd_clock_ms() + HEARTBEAT_MS;
        return kd_buffer_printf(&e->text, ":\n\n");
    }
    return KD_OK;
}

static ssize_t produce_events(void *cls, uint64_t position, char *to, size_t size)
{
    struct events *e = cls;
    ssize_t instead = 0;
    (void)position;
    if (e->at == e->text.size && next_event(e, &instead))
        return MHD_CONTENT_READER_END_WITH_ERROR;
    return kd_job_hand_over(&e->text, &e->at, to, size, instead);
}

static void release_events(void *cls)
{
    struct events *e = cls;
    kd_job_unwatch(&e->watcher);
    kd_buffer_finish(&e->text);
    free(e);
}

enum MHD_Result kd_job_stream(struct kd_request *request, const char *type, MHD_ContentReaderCallback produce,
                              void *cls, MHD_ContentReaderFreeCallback release)
{
    struct MHD_Response *response =
        MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 64 << 10, produce, cls, release);
    if (!response) {
        release(cls);
        return kd_reply_no_memory(request);
    }
    MHD_add_response_header(response, "Content-Type", type);
    MHD_add_response_header(response, "X-Accel-Buffering", "no"); /* tells proxies not to buffer the stream */
    enum MHD_Result result = kd_reply_send(request, MHD_HTTP_OK, response);
    /* A stream has no deadline. If a client stops reading, libmicrohttpd's timeout ends the connection. */
    kd_connections_stage(request->server->connections, request->connection, KD_STAGE_WORK, 0);
    return result;
}

enum MHD_Result kd_handle_job_events(struct kd_request *request)
{
    enum MHD_Result result;
    struct kd_job *job = kd_job_of(request, &result);
    if (!job)
        return result;
    struct events *e = request->head ? NULL : calloc(1, sizeof *e);
    if (!e) {
        kd_job_release(job);
        return request->head
                   ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(request->route->answer))
                   : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    e->watcher = (struct kd_job_watcher) {
        .job = job, .mhd = request->mhd, .revision = UINT_MAX, .deadline_ms = kd_clock_ms() + HEARTBEAT_MS
    };
    kd_job_watch(&e->watcher);
    return kd_job_stream(request, request->route->answer, produce_events, e, release_events);
}
