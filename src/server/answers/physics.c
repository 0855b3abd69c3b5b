/* GET /v1/physics/NAME: computes a quantity by its name (quantity/quantity.h). Quick quantities are computed on the
 * HTTP thread, and all others by workers in slices. */
#include "base/clock.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/task.h"

#include "quantity/sound.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* limit in ms of a computation on the HTTP thread, because this thread serves all clients */
#define MOMENT_MS 2.
#define BYTES_PER_NUMBER 26 /* maximum number of bytes in the text of a number */

enum form { FORM_JSON, FORM_CSV, FORM_WAV, FORM_NONE };

struct job {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_quantity_run run;
    enum form form;
    struct kd_buffer text;
};

static void finish(struct kd_task *task)
{
    struct job *job = (struct job *)task;
    kd_quantity_run_finish(&job->run);
    kd_buffer_finish(&job->text);
}

static const char *offered(const struct kd_quantity *quantity)
{
    return quantity->sound ? KD_JSON_TYPE ", " KD_CSV_TYPE ", " KD_WAV_TYPE : KD_JSON_TYPE ", " KD_CSV_TYPE;
}

static enum form accepted(struct kd_request *request, const struct kd_quantity *quantity)
{
    static const char *const types[] = { [FORM_JSON] = KD_JSON_TYPE,
                                         [FORM_CSV] = KD_CSV_TYPE,
                                         [FORM_WAV] = KD_WAV_TYPE };
    size_t n = quantity->sound ? 3 : 2, best = kd_reply_accepted(request, n, kd_accept_string, types);
    return best < n ? (enum form)best : FORM_NONE;
}

/* Parses the query. The parameter `format` can replace the header Accept, for use in links. */
static enum kd_status read_query(const struct kd_target *target, struct kd_quantity_request *quantity, enum form *form,
                                 struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(kd_target_distinct(target, error));
    for (size_t i = 0; i < target->n_pairs; i++) {
        const char *name = target->pairs[i].name, *value = target->pairs[i].value;
        if (strcmp(name, "format"))
            KD_TRY(kd_quantity_request_set(quantity, name, value, error));
        else if (!strcmp(value, "json") || !strcmp(value, "csv") || !strcmp(value, "wav"))
            *form = *value == 'c' ? FORM_CSV : *value == 'w' ? FORM_WAV : FORM_JSON;
        else
            KD_TRY(kd_error_field(error, "/format", "format is \"%.40s\"; it must be \"json\", \"csv\"%s", value,
                                  quantity->quantity->sound ? ", \"wav\"" : ""));
    }
    if (*form == FORM_WAV)
        KD_TRY(kd_quantity_sound_check(quantity, error));
done:
    return status;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = KD_PROBLEM_INVALID_PARAMETERS;
    if (request->task && request->task->quota)
        problem.type = KD_PROBLEM_QUOTA;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result unknown(struct kd_request *request)
{
    char names[300], detail[400];
    kd_quantity_names(names, sizeof names);
    snprintf(detail, sizeof detail, "there is no quantity of this name; the quantities are %s", names);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = detail });
}

static enum kd_status hold(struct job *job, const struct kd_quantity_request *asked, struct kd_error *error)
{
    size_t numbers = asked->quantity->n_outputs + asked->quantity->n_parameters;
    size_t bytes = kd_quantity_points(asked) * numbers * (sizeof(double) + BYTES_PER_NUMBER);
    bytes += job->form == FORM_WAV ? KD_SOUND_BYTES : 0;
    return kd_task_hold(job->task.request->server, job->task.scheduled.client, bytes, &job->task.held, &job->task.quota,
                        error);
}

static enum kd_status write_answer(struct job *job, struct kd_error *error)
{
    const struct kd_quantity_answer *answer = &job->run.answer;
    if (job->form == FORM_WAV)
        return kd_quantity_sound(answer, &job->text, error);
    enum kd_status status =
        job->form == FORM_CSV ? kd_quantity_csv(answer, &job->text) : kd_quantity_json(answer, &job->text);
    return status ? kd_error_set(error, status, "out of memory for %zu points", answer->points) : KD_OK;
}

/* Computes points until the time until_ms. After the last point, formats the answer. */
static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct job *job = (struct job *)task;
    struct kd_quantity_run *run = &job->run;
    struct kd_error error = { 0 };
    enum kd_status status;
    while (run->point < run->answer.points) {
        KD_TRY(kd_quantity_run_next(run, &error));
        if (kd_clock_ms() > until_ms)
            return KD_SLICE_MORE;
    }
    KD_TRY(write_answer(job, &error));
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct job *job = (struct job *)request->task;
    const struct kd_task *task = request->task;
    char timing[80];
    if (task->status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (task->status)
        return refuse(request, &task->error);
    request->reply_bytes = job->text.size;
    const char *type = job->form == FORM_CSV ? KD_CSV_HEADED_TYPE : KD_JSON_TYPE;
    struct MHD_Response *response =
        job->form == FORM_WAV ? kd_reply_take(&job->text, KD_WAV_TYPE) : kd_reply_text(request, &job->text, type);
    if (!response)
        return kd_reply_no_memory(request);
    if (job->form != FORM_JSON)
        kd_reply_file(request, job->form == FORM_WAV ? KD_INLINE : KD_ATTACHMENT, "%s.%s", request->rest,
                      job->form == FORM_WAV ? "wav" : "csv");
    snprintf(timing, sizeof timing, "queue;dur=%.3f, compute;dur=%.3f", task->begun_ms - task->submitted_ms,
             task->done_ms - task->begun_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result compute_here(struct kd_task *task)
{
    task->begun_ms = task->submitted_ms;
    work(task, INFINITY);
    task->done_ms = kd_clock_ms();
    return deliver(task->request);
}

static const struct kd_task_kind KIND = { "long quantities", sizeof(struct job), work, finish };

static enum MHD_Result begin(struct kd_request *request, const struct kd_quantity_request *asked, enum form form)
{
    struct kd_scheduler *workers = request->server->scheduler;
    struct kd_error error = { 0 };
    enum MHD_Result refused;
    bool here = kd_quantity_cost_ms(asked) <= MOMENT_MS && form != FORM_WAV;
    struct job *job =
        here ? kd_task_create(request, workers, &KIND, &refused) : kd_task_begin(request, workers, &KIND, &refused);
    if (!job)
        return refused;
    job->form = form;
    if (kd_quantity_run_begin(&job->run, asked, &error) || hold(job, asked, &error))
        return refuse(request, &error);
    return here ? compute_here(&job->task) : kd_task_submit(&job->task);
}

enum MHD_Result kd_handle_quantity(struct kd_request *request)
{
    if (request->task)
        return deliver(request);
    const struct kd_quantity *quantity = kd_quantity_find(request->rest);
    struct kd_quantity_request asked;
    struct kd_error error = { 0 };
    if (!quantity)
        return unknown(request);
    enum form form = accepted(request, quantity);
    kd_quantity_request_init(&asked, quantity);
    if (read_query(&request->target, &asked, &form, &error))
        return refuse(request, &error);
    if (form == FORM_NONE) {
        char detail[80];
        snprintf(detail, sizeof detail, "%s is available as %s", quantity->name, offered(quantity));
        return kd_reply_problem(
            request,
            &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE, .offered = offered(quantity), .detail = detail });
    }
    return begin(request, &asked, form);
}
