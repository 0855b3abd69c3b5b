/* POST /v1/rays: reads the request, and streams the answer. */
#include "server/http/negotiate.h"
#include "server/answers/rays_work.h"
#include "server/http/reply.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OFFERED KD_JSON_TYPE ", " KD_NPY_TYPE
/* bytes of a part of the answer; generating a part takes some tenths of a millisecond */
#define BLOCK (64u << 10)
#define TEXT_PER_RAY 180 /* estimated bytes of a ray without crossings, as text; used for the answer's deadline */
#define TEXT_PER_CROSSING 110

/* State of an answer that is being sent. If the client reads slowly, this state outlives the request. */
struct outgoing {
    struct kd_server *server;
    char client[KD_CLIENT];
    size_t held;
    struct kd_rays_answer answer;
    struct kd_rays_stream stream;
};

static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct outgoing *out = cls;
    (void)position; /* the position is not needed, because the library reads the bytes in order */
    size_t n = kd_rays_stream_read(&out->stream, to, size);
    return n ? (ssize_t)n : MHD_CONTENT_READER_END_OF_STREAM;
}

static void release(void *cls)
{
    struct outgoing *out = cls;
    kd_bytes_give(out->server->replies, out->client, out->held);
    kd_rays_stream_finish(&out->stream);
    kd_rays_answer_finish(&out->answer);
    free(out);
}

static struct outgoing *take_answer(struct kd_request *request, enum kd_rays_format format)
{
    struct kd_rays_job *job = (struct kd_rays_job *)request->task;
    struct outgoing *out = calloc(1, sizeof *out);
    if (!out)
        return NULL;
    out->server = request->server;
    memcpy(out->client, request->client, sizeof out->client);
    out->held = job->task.held;
    out->answer = job->answer;
    job->task.held = 0;
    job->answer = (struct kd_rays_answer) { 0 };
    if (!kd_rays_stream_init(&out->stream, &out->answer, format, NULL))
        return out;
    release(out);
    return NULL;
}

/* Adds the headers that both forms of the answer have. They repeat the first members of the JSON form. */
static void describe(struct MHD_Response *response, const struct kd_rays_job *job, const struct kd_rays_answer *answer)
{
    struct kd_buffer text = { 0 };
    char timing[120], accuracy[240];
    struct kd_approximation one;
    snprintf(timing, sizeof timing, "queue;dur=%.3f, read;dur=%.3f, trace;dur=%.3f",
             job->task.begun_ms - job->task.submitted_ms, job->read_ms, job->trace_ms);
    MHD_add_response_header(response, "Server-Timing", timing);
    MHD_add_response_header(response, "Vary", "Accept");
    int n = snprintf(accuracy, sizeof accuracy, "rays=%zu engine=%s precision=%s steps=%u undecided=%zu", answer->n,
                     kd_engine_name(answer->params.engine), kd_precision_name(answer->params.precision),
                     answer->params.steps, answer->undecided);
    if (answer->params.tolerance > 0)
        n += snprintf(accuracy + n, sizeof accuracy - (size_t)n, " tolerance=%.3g followed_again=%zu beyond=%zu",
                      answer->params.tolerance, answer->followed_again, answer->beyond);
    if (!isnan(answer->worst_error))
        snprintf(accuracy + n, sizeof accuracy - (size_t)n, " median=%.1e worst=%.1e", answer->median_error,
                 answer->worst_error);
    MHD_add_response_header(response, "Kerrd-Accuracy", accuracy);
    enum kd_status status = KD_OK;
    for (size_t i = 0; !status && kd_rays_approximation(&answer->params, i, &one); i++)
        status = kd_reply_item(&text, one.name);
    if (!status)
        MHD_add_response_header(response, "Kerrd-Approximations", (const char *)text.data);
    kd_buffer_finish(&text);
}

/* The format that the Accept header prefers; JSON if there is no preference; -1 if no format is acceptable. */
static int choose_format(struct kd_request *request)
{
    static const char *const types[] = { KD_JSON_TYPE, KD_NPY_TYPE };
    static const int formats[] = { KD_RAYS_JSON, KD_RAYS_NPY, -1 };
    return formats[kd_reply_accepted(request, 2, kd_accept_string, types)];
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error, bool malformed, bool quota)
{
    struct kd_problem problem = kd_problem_from(error);
    if (quota)
        problem.type = KD_PROBLEM_QUOTA;
    if (error->status == KD_EINVAL)
        problem.type = malformed ? KD_PROBLEM_MALFORMED_JSON : KD_PROBLEM_INVALID_RAYS;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct kd_rays_job *job = (struct kd_rays_job *)request->task;
    if (job->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (job->task.status)
        return refuse(request, &job->task.error, job->malformed, job->task.quota);
    enum kd_rays_format format = (enum kd_rays_format)choose_format(request);
    struct outgoing *out = take_answer(request, format);
    if (!out)
        return kd_reply_no_memory(request);
    size_t size = kd_rays_stream_size(&out->stream);
    request->reply_bytes = out->held;
    if (!size)
        request->reply_bytes = out->answer.n * (TEXT_PER_RAY + TEXT_PER_CROSSING * out->answer.params.orders);
    struct MHD_Response *response =
        MHD_create_response_from_callback(size ? size : MHD_SIZE_UNKNOWN, BLOCK, produce, out, release);
    if (!response) {
        release(out);
        return kd_reply_no_memory(request);
    }
    MHD_add_response_header(response, "Content-Type", format == KD_RAYS_NPY ? KD_NPY_TYPE : KD_JSON_TYPE);
    if (format == KD_RAYS_NPY)
        kd_reply_file(request, KD_ATTACHMENT, "rays.npy");
    describe(response, job, &out->answer);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

/* Parses the parameters that an NPY body cannot contain. (A JSON body contains them itself.) */
static enum kd_status read_query(const struct kd_target *target, bool npy, struct kd_rays_request *request,
                                 struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(kd_target_distinct(target, error));
    if (target->n_pairs && !npy)
        KD_TRY(kd_error_field(error, "",
                              "the query may have parameters only with a body of " KD_NPY_TYPE
                              "; with JSON they must be in the document"));
    for (size_t i = 0; i < target->n_pairs; i++)
        KD_TRY(kd_rays_request_set(request, target->pairs[i].name, target->pairs[i].value, error));
done:
    return status;
}

enum MHD_Result kd_handle_rays(struct kd_request *request)
{
    struct kd_rays_request rays;
    struct kd_error error = { 0 };
    enum MHD_Result refused;

    if (request->task)
        return deliver(request);
    if (choose_format(request) < 0)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                .offered = OFFERED,
                                                                .detail = "rays are available as " OFFERED });
    bool npy = kd_media_type_is(request->header.content_type, KD_NPY_TYPE);
    kd_rays_request_init(&rays);
    if (read_query(&request->target, npy, &rays, &error))
        return refuse(request, &error, false, false);
    struct kd_rays_job *job = kd_rays_job_begin(request, &refused);
    if (!job)
        return refused;
    job->request = rays;
    job->npy = npy;
    return kd_task_submit(&job->task);
}
