/* Handlers of /v1/render, and of /v1/pixel, which renders a picture and explains one of its pixels. */
#include "render/explain/explain.h"
#include "render/output/notes.h"
#include "scene/link.h"
#include "server/http/link_budgets.h"
#include "server/http/negotiate.h"
#include "server/http/query.h"
#include "server/render/planned.h"
#include "server/http/reply.h"
#include "server/render/queue.h"
#include "server/render/shared.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char *type_of(size_t i, const void *formats)
{
    return ((const struct kd_format *const *)formats)[i]->media_type;
}

/* The formats in which a request may be answered. If the query has the parameter quality, only formats with a
 * quality are offered. */
struct offer {
    const struct kd_format *formats[KD_FORMATS_MAX];
    size_t n;
};

static struct offer offer_of(bool lossy)
{
    struct offer offer = { 0 };
    for (size_t i = 0; i < kd_n_formats; i++)
        if (kd_formats[i]->lossy || !lossy)
            offer.formats[offer.n++] = kd_formats[i];
    return offer;
}

/* Lists those offered formats that Accept permits, the preferred one first. */
static void rank(struct kd_request *request, struct offer offer)
{
    _Static_assert(sizeof request->accepts / sizeof *request->accepts >= KD_FORMATS_MAX, "all formats have a place");
    for (size_t n = 0, best; offer.n; n++) {
        if ((best = kd_reply_accepted(request, offer.n, type_of, offer.formats)) == offer.n)
            return;
        request->accepts[n] = offer.formats[best];
        offer.n--;
        memmove(offer.formats + best, offer.formats + best + 1, (offer.n - best) * sizeof *offer.formats);
    }
}

static enum MHD_Result refuse(struct kd_request *request, const struct offer *offer)
{
    struct kd_buffer offered = { 0 }, detail = { 0 };
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < offer->n && !status; i++)
        status = kd_buffer_printf(&offered, "%s%s", i ? ", " : "", offer->formats[i]->media_type);
    if (!status)
        status = kd_buffer_printf(&detail, "pictures are available only as %s", (const char *)offered.data);
    enum MHD_Result result =
        status ? kd_reply_no_memory(request)
               : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                  .offered = (const char *)offered.data,
                                                                  .detail = (const char *)detail.data });
    kd_buffer_finish(&offered);
    kd_buffer_finish(&detail);
    return result;
}

static void refuse_name(const char *name, struct kd_error *error)
{
    char names[100] = "";
    for (size_t i = 0; i < kd_n_formats; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s",
                 !i                     ? ""
                 : i + 1 < kd_n_formats ? ", "
                                        : " or ",
                 kd_formats[i]->name);
    kd_error_field(error, "/format", "format is \"%.40s\"; it must be %s", name, names);
}

/* Reads the parameters format, quality and v, and chooses the format from them and from Accept. Returns false if the
 * request was answered, with *result. */
static bool choose(struct kd_request *request, enum MHD_Result *result)
{
    struct kd_error error;
    uint64_t quality;
    const char *name = kd_target_value(&request->target, "format"), *v = kd_target_value(&request->target, "v"),
               *text = kd_target_value(&request->target, "quality");
    const struct kd_format *format = name ? kd_format_named(name) : NULL;
    if (!kd_target_whole(&request->target, "quality", KD_QUALITY, KD_QUALITY_MAX, &quality) || !quality)
        kd_error_field(&error, "/quality", "quality is \"%.40s\"; it must be a whole number, 1 to %d", text,
                       KD_QUALITY_MAX);
    else if (v && (!*v || strlen(v) > KD_VERSION_LETTERS))
        kd_error_field(&error, "/v",
                       "v is \"%.60s\"; it must be a version, such as \"" KD_VERSION "\", of 1 to %d letters", v,
                       KD_VERSION_LETTERS);
    else if (name && !format)
        refuse_name(name, &error);
    else if (name && text && !format->lossy)
        kd_error_field(&error, "/quality", "quality is %s; it cannot be used with format %s, which is exact", text,
                       name);
    else {
        const struct offer offer = offer_of(text);
        if (name)
            request->accepts[0] = format;
        else
            rank(request, offer);
        request->quality = (unsigned)quality;
        request->format = request->accepts[0];
        if (!request->format)
            *result = refuse(request, &offer);
        return request->format;
    }
    *result = kd_reply_error(request, &error);
    return false;
}

static bool client_has(struct kd_request *request)
{
    struct kd_buffer tags = kd_reply_header_list(request, "If-None-Match");
    bool yes = tags.data && kd_etag_listed((const char *)tags.data, request->etag);
    kd_buffer_finish(&tags);
    return yes;
}

static void add_approximations(struct MHD_Response *response, const struct kd_plan *plan,
                               const struct kd_accuracy_report *report)
{
    struct kd_buffer list = { 0 };
    struct kd_approximation one;
    enum kd_status status = KD_OK;
    for (size_t i = 0; kd_picture_approximation(&plan->report, report, i, &one); i++)
        KD_TRY(kd_reply_item(&list, one.name));
    if (list.data)
        MHD_add_response_header(response, "Kerrd-Approximations", (const char *)list.data);
done:
    kd_buffer_finish(&list);
}

#define YEAR_S 31536000u
#define DAY_S 86400u
enum { CACHING = 60 };

/* Writes Cache-Control. Pictures of shared links may be cached publicly, unless the server requires access tokens.
 * If the address of a picture names this version of kerrd, the picture may be cached for long: it can change only
 * with the device, and only within its stated error. Scenes that name an asset are an exception, because the name
 * may later belong to another file. No cache may keep a picture for longer than its signed link is valid. */
static void caching(const struct kd_request *request, const struct kd_scene *scene, char out[CACHING])
{
    struct kd_error ignored;
    const char *v = kd_target_value(&request->target, "v");
    const bool public = !request->server->access || request->link.on;
    const bool lasting = v && request->route->gives == KD_GIVES_PICTURE && !strcmp(v, KD_VERSION) &&
                         !kd_scene_link_check(scene, &ignored);
    uint64_t age = lasting ? YEAR_S : DAY_S;
    if (request->link.on) {
        const uint64_t now = (uint64_t)time(NULL), expires = request->link.terms.expires_s;
        const uint64_t left = expires > now ? expires - now : 0;
        age = left < age ? left : age;
    }
    if (lasting)
        snprintf(out, CACHING, "%s, max-age=%u, immutable", public ? "public" : "private", (unsigned)age);
    else if (request->route->takes == KD_TAKES_LINK && public)
        snprintf(out, CACHING, "public, max-age=%u", (unsigned)age);
    else
        snprintf(out, CACHING, "private, no-cache");
}

/* Adds the headers that the answers 200, 304 and HEAD have in common. report: zeros if nothing was rendered. */
static struct MHD_Response *describe(struct kd_request *request, struct MHD_Response *response,
                                     const struct kd_scene *scene, const struct kd_plan *plan,
                                     const struct kd_accuracy_report *report)
{
    char hash[65], clock[KD_CLOCK_TEXT], cache[CACHING];
    if (!response)
        return NULL;
    snprintf(hash, sizeof hash, "%.64s", request->etag + 1);
    kd_reply_file(request, KD_INLINE, "kerrd.%s", request->format->name);
    MHD_add_response_header(response, "ETag", request->etag);
    caching(request, scene, cache);
    MHD_add_response_header(response, "Cache-Control", cache);
    if (!kd_target_value(&request->target, "format"))
        MHD_add_response_header(response, "Vary", "Accept");
    MHD_add_response_header(response, "Kerrd-Scene-Hash", hash);
    add_approximations(response, plan, report);
    kd_fall_clock_text(scene, clock);
    if (*clock)
        MHD_add_response_header(response, "Kerrd-Clock", clock);
    return response;
}

static void add_accuracy(struct MHD_Response *response, const struct kd_render_job *job)
{
    char text[KD_ACCURACY_TEXT], flux[KD_FLUX_TEXT];
    kd_accuracy_text(&job->frame.accuracy, &job->plan.lens, text);
    MHD_add_response_header(response, "Kerrd-Accuracy", text);
    kd_flux_text(&job->scene, &job->frame, flux);
    if (*flux)
        MHD_add_response_header(response, "Kerrd-Flux", flux);
}

static void add_timings(struct MHD_Response *response, const struct kd_render_job *job)
{
    struct kd_buffer list = { 0 };
    enum kd_status status;
    KD_TRY(kd_buffer_printf(&list, "queue;dur=%.3f", job->queue_ms));
    if (job->frame.lens_reused)
        KD_TRY(kd_buffer_printf(&list, ", trace;desc=\"reused\";dur=0"));
    for (size_t i = 0; i < job->frame.n_timings; i++)
        KD_TRY(kd_buffer_printf(&list, ", %s;dur=%.3f", job->frame.timings[i].name, job->frame.timings[i].ms));
    KD_TRY(kd_buffer_printf(&list, ", encode;dur=%.3f", job->encode_ms));
    MHD_add_response_header(response, "Server-Timing", (const char *)list.data);
done:
    kd_buffer_finish(&list);
}

struct picture {
    struct kd_server *server;
    char client[KD_CLIENT];
    void *data;
    size_t size;
};

static void release_picture(void *cls)
{
    struct picture *picture = cls;
    kd_bytes_give(picture->server->replies, picture->client, picture->size);
    free(picture->data);
    free(picture);
}

static struct MHD_Response *picture_response(struct kd_request *request)
{
    struct kd_buffer *file = &request->job->file;
    struct picture *picture = malloc(sizeof *picture);
    if (!picture)
        return NULL;
    *picture = (struct picture) { .server = request->server, .data = file->data, .size = file->size };
    memcpy(picture->client, request->client, sizeof picture->client);
    struct MHD_Response *response =
        MHD_create_response_from_buffer_with_free_callback_cls(file->size, file->data, release_picture, picture);
    if (!response) {
        free(picture);
        return NULL;
    }
    kd_bytes_add(request->server->replies, request->client, file->size);
    request->reply_bytes = file->size;
    *file = (struct kd_buffer) { 0 };
    MHD_add_response_header(response, "Content-Type", request->format->media_type);
    return response;
}

static enum MHD_Result deliver(struct kd_request *request)
{
    struct kd_render_job *job = request->job;
    if (job->status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (job->status) {
        job->error.status = job->status;
        return kd_reply_error(request, &job->error);
    }
    struct MHD_Response *response =
        describe(request, picture_response(request), &job->scene, &job->plan, &job->frame.accuracy);
    if (response) {
        add_accuracy(response, job);
        add_timings(response, job);
    }
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static void wake(struct kd_render_job *job)
{
    struct kd_request *request = job->user;
    /* The device time is charged before the client gets the picture and can request the next one. It is charged even
     * if the client has disconnected. */
    if (request->link.on)
        kd_link_charge(request->server->links, &request->link, job->used_ms, (uint64_t)time(NULL));
    MHD_resume_connection(request->mhd);
}

/* Estimated number of seconds until all accepted work is done. */
static unsigned retry_after(struct kd_server *server)
{
    double s = ceil(kd_render_queue_backlog_ms(server->renders) * 1e-3);
    return s < 1 ? 1 : s > 120 ? 120 : (unsigned)s;
}

static bool admitted(struct kd_request *request, const struct kd_plan_cost *cost, struct kd_problem *problem,
                     struct kd_error *error)
{
    struct kd_server *server = request->server;

    if (cost->estimate_ms > server->longest_s * 1e3) {
        kd_error_set(error, KD_ETOOBIG, "this picture would take about %.0f s; it must be at most %u s",
                     cost->estimate_ms * 1e-3, server->longest_s);
        *problem = kd_problem_from(error);
        return false;
    }
    if (atomic_load(&server->phase) >= KD_REFUSING) {
        *problem = (struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                         .retry_after = 1,
                                         .detail = "the server is stopping and accepts no new renders" };
        return false;
    }
    bool quota;
    enum kd_status status;
    KD_TRY(kd_render_queue_admit(server->renders, request->client, &quota, error));
    /* The size of the answer is known only after encoding, but is less than the size of the pixels. */
    if (kd_bytes_take(server->replies, request->client, 0, cost->host_bytes, &quota))
        KD_TRY(kd_error_set(error, KD_EBUSY,
                            quota ? "too many bytes of your pictures are waiting to be read (limit for one client)"
                                  : "too many bytes of pictures are waiting to be read"));
done:
    if (!status)
        return true;
    *problem = kd_problem_from(error);
    kd_problem_limit(problem, error, quota, retry_after(server));
    return false;
}

static enum MHD_Result submit(struct kd_request *request, const struct kd_planned *planned)
{
    struct kd_render_job *job = calloc(1, sizeof *job);
    if (!job || !request->connection) {
        free(job);
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    job->claim.class = request->format == &kd_format_pixel ? KD_CLASS_PIXEL : KD_CLASS_PICTURE;
    memcpy(job->claim.client, request->client, sizeof job->claim.client);
    job->scene = planned->drawn;
    job->plan = planned->plan;
    if (!memcmp(&planned->scene, &planned->drawn, sizeof planned->drawn))
        memcpy(job->hash, planned->hash, sizeof job->hash);
    job->format = request->format;
    job->lossy = request->quality;
    job->effort = KD_EFFORT_QUICK;
    job->socket = kd_connection_socket(request->connection);
    job->done = wake;
    job->user = request;
    request->job = job;
    /* The request is suspended first, because the job may be done before the push returns. A suspended request and its
     * socket outlive the job. */
    MHD_suspend_connection(request->mhd);
    kd_render_queue_push(request->server->renders, job);
    return MHD_YES;
}

static enum kd_status tag(struct kd_request *request, struct kd_planned *planned)
{
    const struct kd_plan *plan = &planned->plan;
    char at[36] = "";
    if (request->format->lossy)
        snprintf(at, sizeof at, "-%u", request->quality);
    if (plan->report.probe.on)
        snprintf(at, sizeof at, "-%u-%u%s", plan->report.probe.x, plan->report.probe.y,
                 plan->report.probe.steps ? "-steps" : "");
    const char *name = request->format == kd_formats[0] ? "" : request->format->name;
    enum kd_status status = kd_scene_hash(&planned->scene, planned->hash);
    if (!status)
        snprintf(request->etag, sizeof request->etag, "\"%s-%s%s%s%s\"", planned->hash, request->server->etag_tail,
                 *name ? "-" : "", name, at);
    return status;
}

/* Sets the pixel of the plan to the one that the query names. */
static enum kd_status name_pixel(const struct kd_request *request, struct kd_plan *plan, struct kd_error *error)
{
    const char *at = kd_target_value(&request->target, "at"), *trace = kd_target_value(&request->target, "trace");
    if (!at)
        return kd_error_field(error, "/at", "at is missing; it must be the position of the pixel, as in at=320,180");
    enum kd_status status = kd_explain_at(at, plan, error);
    return status || !trace ? status : kd_explain_trace(trace, plan, error);
}

/* If possible, reduces the picture that is rendered to the requested pixel. */
static enum kd_status narrow(const struct kd_request *request, struct kd_planned *planned, struct kd_error *error)
{
    struct kd_capacity capacity;
    if (request->format != &kd_format_pixel)
        return KD_OK;
    kd_render_queue_capacity(request->server->renders, &capacity);
    return kd_explain_narrow(&capacity, &planned->drawn, &planned->plan, error);
}

enum MHD_Result kd_handle_render(struct kd_request *request)
{
    struct kd_problem problem;
    struct kd_error error;
    enum MHD_Result result;

    if (request->job)
        return deliver(request);
    if (!request->format && !choose(request, &result))
        return result;
    struct kd_planned *planned = kd_planned_of(request, &result);
    if (!planned)
        return result;
    const struct kd_scene *scene = &planned->scene;
    const struct kd_plan *plan = &planned->plan;
    if (request->format == &kd_format_pixel && name_pixel(request, &planned->plan, &error))
        return kd_reply_error(request, &error);
    if (tag(request, planned))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    if (client_has(request))
        return kd_reply_send(request, MHD_HTTP_NOT_MODIFIED,
                             describe(request, kd_reply_empty(NULL), scene, plan, &(struct kd_accuracy_report) { 0 }));
    if (request->head)
        return kd_reply_send(request, MHD_HTTP_OK,
                             describe(request, kd_reply_empty(request->format->media_type), scene, plan,
                                      &(struct kd_accuracy_report) { 0 }));
    if (narrow(request, planned, &error))
        return kd_reply_error(request, &error);
    if (!admitted(request, &plan->cost, &problem, &error))
        return kd_reply_problem(request, &problem);
    return submit(request, planned);
}

enum MHD_Result kd_handle_shared_picture(struct kd_request *request)
{
    request->format = kd_formats[0];
    return kd_handle_render(request);
}

enum MHD_Result kd_handle_pixel(struct kd_request *request)
{
    request->format = &kd_format_pixel;
    return kd_handle_render(request);
}
