/* GET /v1/physics and /v1/physics/NAME: quantities by name (quantity/quantity.h). What takes a moment is computed here, all
 * else by the workers, in turns. */
#include "server/clock.h"
#include "server/negotiate.h"
#include "server/reply.h"

#include "quantity/quantity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JSON_TYPE "application/json"
#define CSV_TYPE "text/csv"
#define OFFERED JSON_TYPE ", " CSV_TYPE
#define MOMENT_MS 2.       /* of this thread, which serves everybody */
#define TURN_MS 10.
#define BYTES_PER_NUMBER 26 /* as text at its longest */

enum form { FORM_JSON, FORM_CSV, FORM_NONE };

/* Owned by its request. */
struct kd_physics_job {
    struct kd_turns_job turns; /* first */
    struct kd_request *request;
    struct kd_quantity_run run;
    enum form form;
    struct kd_buffer text;
    size_t held;
    double submitted_ms, begun_ms, done_ms, deadline_ms;
    enum kd_status status;
    struct kd_error error;
};

void kd_physics_job_destroy(struct kd_physics_job *job)
{
    if (!job)
        return;
    atomic_fetch_sub(&job->request->server->reply_bytes, job->held);
    kd_quantity_run_finish(&job->run);
    kd_buffer_finish(&job->text);
    free(job);
}

enum MHD_Result kd_handle_quantities(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    return kd_reply_json(request, kd_quantity_list_json(&json), &json, request->route->answer);
}

static enum form accepted(struct kd_request *request)
{
    struct kd_buffer accept = kd_reply_header_list(request, "Accept");
    int json = kd_accept_weight((const char *)accept.data, JSON_TYPE);
    int csv = kd_accept_weight((const char *)accept.data, CSV_TYPE);
    kd_buffer_finish(&accept);
    return csv > json ? FORM_CSV : json ? FORM_JSON : FORM_NONE;
}

/* What the query says; `format` is ours, for links that cannot say Accept. */
static enum kd_status read_query(const struct kd_target *target, struct kd_quantity_request *quantity, enum form *form,
                                 struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < target->n_pairs && !status; i++) {
        const char *name = target->pairs[i].name, *value = target->pairs[i].value;
        for (size_t k = 0; k < i && !status; k++)
            if (!strcmp(target->pairs[k].name, name))
                status = kd_error_field(error, "", "the query gives %.100s twice", name);
        if (status)
            break;
        if (strcmp(name, "format"))
            status = kd_quantity_request_set(quantity, name, value, error);
        else if (!strcmp(value, "json") || !strcmp(value, "csv"))
            *form = *value == 'c' ? FORM_CSV : FORM_JSON;
        else
            status = kd_error_field(error, "/format", "format is \"%.40s\", allowed are \"json\", \"csv\"", value);
    }
    return status;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = KD_PROBLEM_INVALID_PARAMETERS;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result unknown(struct kd_request *request)
{
    char names[300], detail[400];
    kd_quantity_names(names, sizeof names);
    snprintf(detail, sizeof detail, "there is no quantity of this name; known are %s", names);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = detail });
}

/* Count the answer's bytes as held, or say that there are too many. */
static enum kd_status hold(struct kd_physics_job *job, const struct kd_quantity_request *asked, struct kd_error *error)
{
    struct kd_server *server = job->request->server;
    size_t numbers = asked->quantity->n_outputs + asked->quantity->n_parameters;
    size_t bytes = kd_quantity_points(asked) * numbers * (sizeof(double) + BYTES_PER_NUMBER);
    size_t held = atomic_load(&server->reply_bytes);
    do {
        if (held && held + bytes > KD_REPLIES_MAX)
            return kd_error_set(error, KD_EBUSY, "too many answers wait for their clients to take them");
    } while (!atomic_compare_exchange_weak(&server->reply_bytes, &held, held + bytes));
    job->held = bytes;
    return KD_OK;
}

/* Points until it is time, then the text. */
static enum kd_turn work(struct kd_physics_job *job, double until_ms)
{
    struct kd_quantity_run *run = &job->run;
    while (!job->status && run->point < run->answer.points) {
        job->status = kd_quantity_run_next(run, &job->error);
        if (kd_clock_ms() > until_ms)
            return KD_TURN_MORE;
    }
    if (job->status)
        return KD_TURN_LAST;
    job->status = job->form == FORM_CSV ? kd_quantity_csv(&run->answer, &job->text) : kd_quantity_json(&run->answer, &job->text);
    if (job->status)
        kd_error_set(&job->error, job->status, "out of memory for %zu points", run->answer.points);
    return KD_TURN_LAST;
}

static enum kd_turn take_turn(struct kd_turns_job *turns)
{
    struct kd_physics_job *job = (struct kd_physics_job *)turns;
    struct kd_server *server = job->request->server;
    double now = kd_clock_ms();
    if (!job->begun_ms)
        job->begun_ms = now;
    if (kd_turns_cancelled(server->turns) || kd_socket_abandoned(kd_connection_socket(job->request->connection)))
        job->status = kd_error_set(&job->error, KD_ECANCELLED, "the client has gone, or the server stops");
    else if (now > job->deadline_ms)
        job->status = kd_error_set(&job->error, KD_ETOOBIG, "the computation was given up after %u s, as long as this server "
                                   "lets one take", server->longest_s);
    return job->status ? KD_TURN_LAST : work(job, now + TURN_MS);
}

static void done(struct kd_turns_job *turns)
{
    struct kd_physics_job *job = (struct kd_physics_job *)turns;
    job->done_ms = kd_clock_ms();
    MHD_resume_connection(job->request->mhd);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct kd_physics_job *job = request->physics;
    char timing[80];
    if (job->status == KD_ECANCELLED)
        return MHD_NO; /* nobody listens */
    if (job->status)
        return refuse(request, &job->error);
    request->reply_bytes = job->text.size;
    struct MHD_Response *response =
        kd_reply_text(request, &job->text, job->form == FORM_CSV ? CSV_TYPE "; charset=utf-8; header=present" : JSON_TYPE);
    if (!response)
        return MHD_NO;
    snprintf(timing, sizeof timing, "queue;dur=%.3f, compute;dur=%.3f", job->begun_ms - job->submitted_ms,
             job->done_ms - job->begun_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result compute_here(struct kd_physics_job *job)
{
    job->begun_ms = job->submitted_ms;
    work(job, INFINITY);
    job->done_ms = kd_clock_ms();
    return deliver(job->request);
}

static enum MHD_Result submit(struct kd_physics_job *job)
{
    struct kd_request *request = job->request;
    struct kd_server *server = request->server;
    if (atomic_load(&server->phase) >= KD_REFUSING)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                                                .retry_after = 1,
                                                                .detail = "the server is stopping and begins nothing long" });
    struct kd_error error = { 0 };
    if (kd_turns_admit(server->turns, &error))
        return refuse(request, &error);
    job->turns.turn = take_turn;
    job->turns.done = done;
    job->deadline_ms = job->submitted_ms + 1e3 * server->longest_s;
    /* First: a job may be done before push returns. Suspended, the request and its socket outlive the job. */
    MHD_suspend_connection(request->mhd);
    kd_turns_push(server->turns, &job->turns);
    return MHD_YES;
}

static enum MHD_Result begin(struct kd_request *request, const struct kd_quantity_request *asked, enum form form)
{
    struct kd_error error = { 0 };
    struct kd_physics_job *job = calloc(1, sizeof *job);
    if (!job || !request->connection) {
        free(job);
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    request->physics = job;
    job->request = request;
    job->form = form;
    job->submitted_ms = kd_clock_ms();
    if (kd_quantity_run_begin(&job->run, asked, &error) || hold(job, asked, &error))
        return refuse(request, &error);
    return kd_quantity_cost_ms(asked) > MOMENT_MS ? submit(job) : compute_here(job);
}

enum MHD_Result kd_handle_quantity(struct kd_request *request)
{
    if (request->physics)
        return deliver(request);
    const struct kd_quantity *quantity = kd_quantity_find(request->rest);
    struct kd_quantity_request asked;
    struct kd_error error = { 0 };
    if (!quantity)
        return unknown(request);
    enum form form = accepted(request);
    kd_quantity_request_init(&asked, quantity);
    if (read_query(&request->target, &asked, &form, &error))
        return refuse(request, &error);
    if (form == FORM_NONE)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                .offered = OFFERED,
                                                                .detail = "quantities are offered as " OFFERED });
    return begin(request, &asked, form);
}
