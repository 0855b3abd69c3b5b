/* POST /v1/line and other integrals over a thin disk, or over pictures of a scene (integral/run.h). A worker
 * computes the integral. If it needs pictures, the render queue renders them one after the other. */
#include "integral/run.h"
#include "server/asset/store.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/render/queue.h"
#include "server/render/task.h"

#include <stdio.h>
#include <string.h>

#define OFFERED KD_JSON_TYPE ", " KD_CSV_TYPE ", " KD_NPY_TYPE ", " KD_NPZ_TYPE
/* estimated time in ns of one product on one core; there is one product for each pair of a baseline and a pixel (or an
 * image order of a pixel) */
#define NS_A_PRODUCT 1.2
/* bytes of an answer per row, including the text of the numbers */
#define BYTES_PER_ROW (KD_INTEGRAL_COLUMNS * (sizeof(double) + 26))

static const char *const types[] = { [KD_INTEGRAL_JSON] = KD_JSON_TYPE,
                                     [KD_INTEGRAL_CSV] = KD_CSV_TYPE,
                                     [KD_INTEGRAL_NPY] = KD_NPY_TYPE,
                                     [KD_INTEGRAL_NPZ] = KD_NPZ_TYPE,
                                     [KD_INTEGRAL_UVFITS] = KD_UVFITS_TYPE };
static const char *const endings[] = { "json", "csv", "npy", "npz", "uvfits" };

struct job {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_integral_request request;
    enum kd_integral_format format;
    bool malformed;
    enum { NEW, RENDERS, SUMS } stage;
    struct kd_integral_run run;
    struct kd_render_job picture; /* job in the render queue; valid while `stage` is RENDERS */
    struct kd_buffer text;
    double planned_ms; /* total planned time of the pictures up to the present one, in ms */
    /* for each size of pictures: the first picture of that size, as begin() has planned it */
    struct {
        struct kd_scene scene;
        struct kd_plan plan;
    } first[2];
    unsigned planned;
};

static void finish(struct kd_task *task)
{
    struct job *job = (struct job *)task;
    kd_integral_run_finish(&job->run);
    kd_integral_request_finish(&job->request);
    kd_buffer_finish(&job->picture.file);
    kd_buffer_finish(&job->text);
}

/* Plans the pictures and adds up their estimated times. All pictures of the same size take equally long. */
static enum kd_status plan_pictures(struct job *job, size_t *bytes, struct kd_error *error)
{
    struct kd_server *server = job->task.request->server;
    const unsigned n = kd_integral_pictures(&job->request), sizes = n < 2 || job->request.unchecked ? 1 : 2;
    struct kd_capacity capacity;
    double ms = 0;
    *bytes = kd_integral_rows(&job->request) * BYTES_PER_ROW + 2 * job->request.file_size +
             (job->request.what == KD_INTEGRAL_SETS ? job->request.sets->n * sizeof *job->request.sets->at : 0);
    kd_render_queue_capacity(server->renders, &capacity);
    for (unsigned i = 0; i < sizes && n; i++) {
        struct kd_plan *plan = &job->first[i].plan;
        job->first[i].scene = kd_integral_scene(&job->request, i);
        enum kd_status status = kd_integral_plan(&job->request, &job->first[i].scene, &capacity, plan, error);
        if (status) {
            kd_integral_name_set(&job->request, i, status, error);
            return status;
        }
        job->planned = i + 1;
        ms += plan->cost.estimate_ms * n / sizes +
              (double)plan->picture.n_layers * plan->picture.width * plan->picture.height * (double)job->request.u.n *
                  NS_A_PRODUCT * 1e-6 * (i ? 1 : kd_integral_evaluations(&job->request)) *
                  (job->request.what == KD_INTEGRAL_SETS ? (double)job->request.sets->n : 1);
        *bytes += 4 * (1 + plan->picture.n_layers) * (size_t)plan->picture.width * plan->picture.height;
    }
    if (ms > server->longest_s * 1e3)
        return kd_error_set(error, KD_ETOOBIG,
                            "%u pictures and their evaluation would take about %.0f s; it must be at most %u s: reduce "
                            "pixels, frequencies or baselines, or set check \"none\"",
                            n, ms * 1e-3, server->longest_s);
    return KD_OK;
}

static enum kd_status begin(struct job *job, struct kd_error *error)
{
    struct kd_task *task = &job->task;
    struct kd_buffer *body = &task->request->body;
    size_t bytes = 0;
    enum kd_status status =
        kd_integral_request_json(&job->request, body->data ? (const char *)body->data : "", body->size, error);
    job->malformed = status == KD_EINVAL && !*error->pointer;
    kd_task_drop_body(task->request);
    if (status)
        return status;
    KD_TRY(kd_integral_check_format(&job->request, job->format, error));
    KD_TRY(plan_pictures(job, &bytes, error));
    KD_TRY(kd_task_hold(task->request->server, task->scheduled.client, bytes, &task->held, &task->quota, error));
    /* An integral without pictures is computed in one slice, during which other work may run (base/pause.h). Most
     * integrals take some hundredths of a second. Lines and echoes of a corona off the axis take up to some seconds. */
    KD_TRY(kd_integral_run_begin(&job->run, &job->request, error));
done:
    return status;
}

static void rendered(struct kd_render_job *picture)
{
    struct job *job = picture->user;
    kd_integral_name_set(&job->request, job->run.picture, picture->status, &picture->error);
    kd_task_fail(&job->task, picture->status, &picture->error);
    kd_scheduler_wake(job->task.queue, &job->task.scheduled);
}

/* Puts the next picture into the render queue. */
static enum kd_status push_picture(struct job *job, struct kd_error *error)
{
    struct kd_request *request = job->task.request;
    struct kd_render_queue *renders = request->server->renders;
    const unsigned at = job->run.picture;
    struct kd_capacity capacity;
    /* Only the first picture needs admission to the queue. Each later picture takes the place of the previous one,
     * so that a request is never refused halfway. */
    enum kd_status status = at ? KD_OK : kd_render_queue_admit(renders, request->client, &job->task.quota, error);
    if (status)
        return status;
    kd_render_queue_capacity(renders, &capacity);
    job->picture = (struct kd_render_job) {
        .claim.class = KD_CLASS_PICTURE,
        .scene = at < job->planned ? job->first[at].scene : kd_integral_scene(&job->request, at),
        .format = kd_integral_picture_format(job->request.what),
        .effort = KD_EFFORT_QUICK,
        .socket = kd_connection_socket(request->connection),
        .done = rendered,
        .user = job,
    };
    memcpy(job->picture.claim.client, request->client, sizeof job->picture.claim.client);
    if (at < job->planned)
        job->picture.plan = job->first[at].plan;
    else
        KD_TRY(kd_integral_plan(&job->request, &job->picture.scene, &capacity, &job->picture.plan, error));
    job->planned_ms += job->picture.plan.cost.estimate_ms;
    /* begin() has estimated the total cost from the cost of the first picture. But a set may make its pictures more
     * expensive, so the total is checked again here. */
    if (job->request.what == KD_INTEGRAL_SETS && job->planned_ms > request->server->longest_s * 1e3)
        KD_TRY(
            kd_error_set(error, KD_ETOOBIG,
                         "the pictures up to this one would take about %.0f s; it must be at most %u s: reduce pixels, "
                         "the number of sets, or the accuracy",
                         job->planned_ms * 1e-3, request->server->longest_s));
    kd_render_queue_push(renders, &job->picture);
done:
    kd_integral_name_set(&job->request, at, status, error);
    return status;
}

/* Runs one slice. *end: KD_SLICE_LAST if the job is done, KD_SLICE_AWAY while a picture is rendered, and otherwise
 * KD_SLICE_MORE. */
static enum kd_status piece(struct job *job, double until_ms, enum kd_slice_result *end, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    *end = KD_SLICE_MORE;
    if (job->stage == NEW)
        KD_TRY(begin(job, error));
    else if (job->stage == RENDERS)
        KD_TRY(
            kd_integral_run_take(&job->run, &job->picture.file, &job->picture.scene, &job->picture.plan.report, error));
    if (job->stage != NEW && kd_integral_run_step(&job->run, until_ms)) {
        job->stage = SUMS;
        return KD_OK;
    }
    if (job->run.picture < job->run.pictures) {
        KD_TRY(push_picture(job, error));
        job->stage = RENDERS;
        *end = KD_SLICE_AWAY;
        return KD_OK;
    }
    if ((status = kd_integral_write(&job->run.answer, job->format, &job->text)))
        kd_error_set(error, status, "out of memory for %zu rows", job->run.answer.rows);
    *end = KD_SLICE_LAST;
done:
    return status;
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    enum kd_slice_result end;
    struct kd_error error = { 0 };
    enum kd_status status = piece((struct job *)task, until_ms, &end, &error);
    kd_task_fail(task, status, &error);
    return status ? KD_SLICE_LAST : end;
}

static enum MHD_Result refuse(struct kd_request *request, const struct job *job)
{
    struct kd_problem problem = kd_problem_from(&job->task.error);
    if (job->task.error.status == KD_EINVAL)
        problem.type = job->malformed ? KD_PROBLEM_MALFORMED_JSON : KD_PROBLEM_INVALID_PARAMETERS;
    if (job->task.quota)
        problem.type = KD_PROBLEM_QUOTA;
    return kd_reply_problem(request, &problem);
}

/* The EHT's CSV has two lines before its rows, so its media type differs. */
static const char *csv_type(const struct job *job)
{
    return job->request.what == KD_INTEGRAL_OBSERVE ? KD_CSV_TYPE "; charset=utf-8" : KD_CSV_HEADED_TYPE;
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct job *job = (struct job *)request->task;
    const struct kd_task *task = request->task;
    char timing[80];
    if (task->status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (task->status)
        return refuse(request, job);
    request->reply_bytes = job->text.size;
    struct MHD_Response *response = job->format >= KD_INTEGRAL_NPY ? kd_reply_take(&job->text, types[job->format])
                                    : job->format == KD_INTEGRAL_CSV
                                        ? kd_reply_text(request, &job->text, csv_type(job))
                                        : kd_reply_text(request, &job->text, types[KD_INTEGRAL_JSON]);
    if (!response)
        return kd_reply_no_memory(request);
    if (job->format != KD_INTEGRAL_JSON)
        kd_reply_file(request, KD_ATTACHMENT, "%s.%s", kd_integral_name(job->request.what), endings[job->format]);
    snprintf(timing, sizeof timing, "queue;dur=%.3f, compute;dur=%.3f", task->begun_ms - task->submitted_ms,
             task->done_ms - task->begun_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static const struct kd_task_kind KIND = { "integrals", sizeof(struct job), work, finish, .answer = NULL };

enum MHD_Result kd_handle_integral(struct kd_request *request)
{
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    const bool observe = kd_integral_of_route(request->route->path) == KD_INTEGRAL_OBSERVE;
    const size_t formats = observe ? KD_INTEGRAL_UVFITS + 1 : KD_INTEGRAL_UVFITS;
    size_t format = kd_reply_accepted(request, formats, kd_accept_string, types);
    if (format >= formats)
        return kd_reply_problem(request,
                                &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                       .offered = observe ? OFFERED ", " KD_UVFITS_TYPE : OFFERED,
                                                       .detail = observe ? "observations are available as " OFFERED
                                                                           ", " KD_UVFITS_TYPE
                                                                         : "integrals are available as " OFFERED });
    if (request->target.n_pairs)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS,
                                            .detail = "parameters must be in the document, not in the query" });
    struct job *job = kd_task_begin(request, request->server->scheduler, &KIND, &refused);
    if (!job)
        return refused;
    job->format = (enum kd_integral_format)format;
    kd_integral_request_init(&job->request, kd_integral_of_route(request->route->path));
    job->request.assets = kd_asset_store_assets(request->server->assets);
    return kd_task_submit(&job->task);
}
