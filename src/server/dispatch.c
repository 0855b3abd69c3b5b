#include "server/dispatch.h"

#include "base/clock.h"
#include "base/watch.h"
#include "server/http/cors.h"
#include "server/http/library.h"
#include "server/http/measures.h"
#include "server/http/negotiate.h"
#include "server/http/sched_slice.h"
#include "server/http/request_log.h"
#include "server/answers/orbits.h"
#include "server/asset/store.h"
#include "server/http/reply.h"
#include "server/render/task.h"
#include "server/job/jobs.h"
#include "server/playground/routes.h"
#include "server/render/queue.h"
#include "server/session/sessions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODIES_TOO_MANY "too many bodies are being received"
#define BODIES_OF_CLIENT "too many bytes of your requests are being received at once (limit for one client)"
/* the largest body that can arrive at 32 kB/s within the default deadline of 30 s, in bytes */
#define PACE ((size_t)960000)

static int socket_of(struct MHD_Connection *mhd)
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_CONNECTION_FD);
    return info ? info->connect_fd : -1;
}

static struct kd_connection *connection_of(struct MHD_Connection *mhd)
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

void kd_request_connection(void *cls, struct MHD_Connection *mhd, void **socket_context,
                           enum MHD_ConnectionNotificationCode what)
{
    struct kd_server *server = cls;
    if (what == MHD_CONNECTION_NOTIFY_STARTED) {
        int socket = socket_of(mhd);
        kd_watch_answers();
        kd_library_works_on(socket);
        *socket_context = kd_connections_find(server->connections, socket);
        if (kd_connection_is_health(*socket_context))
            /* called here, because this is kerrd's first function that runs on a thread of the daemon */
            kd_sched_short_slices();
    } else {
        kd_connections_remove(server->connections, *socket_context);
        *socket_context = NULL;
    }
}

static void stage(struct kd_request *request, enum kd_stage to)
{
    kd_connections_stage(request->server->connections, request->connection, to, 0);
}

/* libmicrohttpd 0.9.75 parses the query itself, into the memory of the connection. Some hundred parameters exhaust
 * that memory, and then the connection hangs. This function runs before the library parses. It replaces every "&",
 * so that the library finds only one parameter; target.c parses the query from kerrd's own copy. */
static void hide_pairs(const char *uri)
{
    union {
        const char *in;
        char *out;
    } text = { uri }; /* the library's own copy, in which it decodes escapes in place */
    for (char *p = text.out; *p; p++)
        if (*p == '&')
            *p = '_';
}

void *kd_request_open(void *cls, const char *uri, struct MHD_Connection *mhd)
{
    struct kd_server *server = cls;
    struct kd_request *request = calloc(1, sizeof *request);
    kd_library_works_on(socket_of(mhd));
    if (!request)
        return NULL;
    request->server = server;
    request->mhd = mhd;
    request->connection = connection_of(mhd);
    /* A connection to the health routes serves only one request, because the next request might belong to the other
     * daemon. */
    request->close = kd_connection_is_health(request->connection);
    kd_client_of(mhd, request->client);
    request->raw = strdup(uri);
    if (request->raw && kd_target_origin(request->raw, &request->authority)) {
        free(request->raw);
        request->raw = NULL;
    }
    hide_pairs(uri);
    request->start_ms = kd_clock_ms();
    atomic_fetch_add(&server->requests, 1);
    stage(request, KD_STAGE_HEADER);
    kd_request_log_begin(request);
    return request;
}

void kd_request_close(void *cls, struct MHD_Connection *mhd, void **state, enum MHD_RequestTerminationCode why)
{
    struct kd_server *server = cls;
    struct kd_request *request = *state;
    kd_library_works_on(socket_of(mhd));
    if (!request)
        return;
    const double ms = kd_clock_ms() - request->start_ms;
    kd_request_log_end(request, ms, why != MHD_REQUEST_TERMINATED_COMPLETED_OK);
    kd_measures_add(server->measures, request->matched, request->status, ms);
    atomic_fetch_add(&server->answers[request->status / 100 % KD_STATUS_CLASSES], 1);
    stage(request, KD_STAGE_IDLE);
    kd_bytes_give(server->bodies, request->client, request->body.size);
    if (request->job) {
        kd_buffer_finish(&request->job->file);
        kd_frame_finish(&request->job->frame);
        free(request->job);
    }
    kd_orbits_job_abandon(request->orbits);
    kd_particles_job_destroy(request->particles);
    kd_task_destroy(request->task);
    kd_live_abandon(request);
    kd_playground_session_abandon(request);
    kd_once_end(request);
    kd_buffer_finish(&request->body);
    kd_target_finish(&request->target);
    free(request->raw);
    free(request->authority);
    free(request);
    *state = NULL;
    atomic_fetch_sub(&server->requests, 1);
}

static size_t most_of(const struct kd_request *request)
{
    const size_t most = kd_taken[request->route->takes].most;
    return most ? most : KD_BODY_MAX;
}

/* Texts of a refusal. */
struct told { char detail[300], offered[200]; };

static const char *too_large(const struct kd_request *request, struct told *told)
{
    const char *what = kd_taken[request->route->takes].what;
    snprintf(told->detail, sizeof told->detail, "%s must have at most %zu bytes", what ? what : "a body",
             most_of(request));
    return told->detail;
}

static bool media_type_fault(const struct kd_request *request, bool patch, struct told *told,
                             struct kd_problem *problem)
{
    const struct kd_taken *taken = &kd_taken[request->route->takes];
    const char *types = patch ? KD_JSON_TYPE " " KD_PATCH_TYPE : taken->types ? taken->types : KD_JSON_TYPE;
    size_t said = (size_t)snprintf(told->detail, sizeof told->detail,
                                   "%s must have Content-Type: ", taken->types && !patch ? taken->what : "a body"),
           offered = 0;
    for (const char *at = types; *at; at += strspn(at, " ")) {
        char type[64];
        snprintf(type, sizeof type, "%.*s", (int)strcspn(at, " "), at);
        if (kd_media_type_is(request->header.content_type, type))
            return false;
        at += strlen(type);
        said += (size_t)snprintf(told->detail + said, sizeof told->detail - said, "%s%s",
                                 !offered ? ""
                                 : *at    ? ", "
                                          : " or ",
                                 type);
        offered += (size_t)snprintf(told->offered + offered, sizeof told->offered - offered, "%s%s",
                                    offered ? ", " : "", type);
    }
    *problem = (struct kd_problem) { .type = KD_PROBLEM_MEDIA_TYPE, .offered = told->offered, .detail = told->detail };
    return true;
}

/* True if the body that the header announces must be refused. *problem may then point into *told. */
static bool body_fault(const struct kd_request *request, struct told *told, struct kd_problem *problem)
{
    bool patch = !strcmp(request->method, "PATCH");
    if (!patch && strcmp(request->method, "POST") && strcmp(request->method, "PUT")) {
        *problem = (struct kd_problem) { .type = KD_PROBLEM_BAD_REQUEST, .detail = "this method accepts no body" };
        return request->body_announced;
    }
    if (kd_taken[request->route->takes].may_lack && !request->body_announced)
        return false;
    if (media_type_fault(request, patch, told, problem))
        return true;
    if (request->header.content_length > most_of(request)) {
        *problem = (struct kd_problem) { .type = KD_PROBLEM_BODY_TOO_LARGE, .detail = too_large(request, told) };
        return true;
    }
    bool quota,
        refused = kd_bytes_take(request->server->bodies, request->client, 0, request->header.content_length, &quota);
    *problem = (struct kd_problem) { .type = quota ? KD_PROBLEM_QUOTA : KD_PROBLEM_CROWDED,
                                     .retry_after = 1,
                                     .detail = quota ? BODIES_OF_CLIENT : BODIES_TOO_MANY };
    return refused;
}

/* True if a page of another site has made the browser send this request (Fetch Metadata, W3C). Such a page could use
 * the visitor's access to this server, so the request is refused. Two kinds of requests are permitted nevertheless:
 * navigations, such as a link to a picture, and signed links, which do not use the visitor's access. */
static bool is_foreign(const struct kd_request *request)
{
    const char *site = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Sec-Fetch-Site");
    const char *mode = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Sec-Fetch-Mode");
    const char *to = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Sec-Fetch-Dest");
    if (request->server->cross_site || request->link.on || !site || strcmp(site, "cross-site") ||
        kd_cors_origin(request))
        return false;
    bool visit = mode && !strcmp(mode, "navigate") && to && !strcmp(to, "document") && strcmp(request->method, "POST");
    return !visit && !strncmp(request->route->path, "/v1/", 4);
}

/* Finds the route, and checks the access. Clients without access do not learn which routes exist. */
static bool find_route(struct kd_request *request, struct kd_problem *problem, struct kd_error *error)
{
    struct kd_problem nowhere;
    const bool found = kd_route_find(request, &nowhere);
    if (!found)
        request->route = NULL;
    if (!kd_access_check(request, problem, error))
        return false;
    if (request->visitor)
        kd_client_named(request->visitor->name, request->client);
    if (!found)
        *problem = nowhere;
    return found;
}

/* True if the request creates an object that has no address yet, so that If-Match can never be true. If the object
 * already has an address, the handler evaluates If-Match. */
static bool makes_something(const struct kd_request *request)
{
    return !request->route->question && !strchr(request->route->path, '{') &&
           (!strcmp(request->method, "POST") || !strcmp(request->method, "PUT"));
}

static bool is_options(const struct kd_request *request) { return !strcmp(request->method, "OPTIONS"); }

/* True for OPTIONS on the whole server. Its target is then "*", or an address without a path (RFC 9112 3.2.4). */
static bool asks_of_all(const struct kd_request *request)
{
    return is_options(request) && !request->body_announced &&
           (!strcmp(request->raw, "*") || (request->authority && !strcmp(request->raw, "/")));
}

/* True if the query has a parameter that the route does not support. error: storage for the problem's text. */
static bool query_fault(const struct kd_request *request, struct kd_error *error, struct kd_problem *problem)
{
    *error = (struct kd_error) { 0 };
    if (!kd_route_only(request, error))
        return false;
    *problem = kd_problem_from(error);
    problem->type = KD_PROBLEM_INVALID_PARAMETERS;
    problem->close = request->body_announced;
    return true;
}

/* Decides whether the request is handled. Returns false if it was already answered; the caller then returns *result. */
static bool choose(struct kd_request *request, enum MHD_Result *result)
{
    struct kd_problem problem;
    struct kd_error error = { 0 };
    struct told told;
    char key[KD_ONCE_TEXT];

    if (kd_target_parse(&request->target, request->raw, &error))
        problem =
            (struct kd_problem) { .detail = error.message,
                                  .type = error.status == KD_ENOMEM ? KD_PROBLEM_NO_MEMORY : KD_PROBLEM_BAD_REQUEST };
    else if (!kd_route_is_health(&request->server->base, request->raw) &&
             kd_connections_crowded(request->server->connections, request->connection))
        problem = (struct kd_problem) {
            .type = KD_PROBLEM_CROWDED, .retry_after = 1, .close = true, .detail = "too many connections are open"
        };
    /* handled here, because browsers send preflights without an access token */
    else if (kd_cors_is_preflight(request)) {
        *result = kd_cors_preflight(request);
        return false;
    } else if (asks_of_all(request)) {
        *result = kd_reply_options(request, kd_route_allow(NULL));
        return false;
    } else if (*request->raw != '/') {
        problem = (struct kd_problem) { .type = KD_PROBLEM_BAD_REQUEST,
                                        .detail = "the request target is neither a path nor an address" };
    } else if (!find_route(request, &problem, &error)) {
        const bool options = is_options(request) && problem.type == KD_PROBLEM_METHOD;
        if (options && !request->body_announced) {
            *result = kd_reply_options(request, problem.allow);
            return false;
        }
        if (options)
            problem = (struct kd_problem) { .type = KD_PROBLEM_BAD_REQUEST, .detail = "this method accepts no body" };
        request->route = NULL;
    } else if (is_foreign(request))
        problem = (struct kd_problem) {
            .type = KD_PROBLEM_CROSS_SITE,
            .close = request->body_announced,
            .detail = "the request comes from a page of another site (Sec-Fetch-Site: cross-site); this server accepts "
                      "such requests only from origins of --cors-origin, or with --allow-cross-site"
        };
    else if (makes_something(request) && !kd_reply_matches(request, NULL))
        problem = (struct kd_problem) { .type = KD_PROBLEM_PRECONDITION,
                                        .close = request->body_announced,
                                        .detail = "no resource at this address has an ETag of If-Match" };
    else if (!query_fault(request, &error, &problem) && !body_fault(request, &told, &problem) &&
             kd_once_read(request, &problem, key))
        return true;
    *result =
        kd_sign_in_wanted(request, &problem) ? kd_sign_in_page(request, &problem) : kd_reply_problem(request, &problem);
    return false;
}

/* Reads the header traceparent. If it occurs more than once, it counts as malformed and is ignored. */
static void read_trace(struct kd_request *request)
{
    struct kd_buffer value = kd_reply_header_list(request, "traceparent");
    kd_trace_read((const char *)value.data, &request->trace);
    kd_buffer_finish(&value);
}

/* Handles the complete header. If the announced body must be refused, this is done here, and libmicrohttpd then
 * closes the connection. A request without a body is answered only in the next call, so that its connection stays
 * open. */
static enum MHD_Result begin(struct kd_request *request, const char *version)
{
    struct kd_server *server = request->server;
    struct kd_problem problem;
    enum MHD_Result result;

    const bool sound =
        request->raw && kd_guard_check(request->mhd, version, request->authority, server->hosts,
                                       kd_route_is_health(&server->base, request->raw), &request->header, &problem);
    kd_request_id_choose(MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, KD_REQUEST_ID_HEADER), request->id);
    read_trace(request);
    if (!request->raw)
        return kd_reply_no_memory(request);
    if (!sound) {
        kd_connection_linger(request->connection);
        return kd_reply_problem(request, &problem);
    }
    request->body_announced = request->header.content_length > 0 || request->header.chunked;
    if (request->body_announced && !choose(request, &result)) {
        kd_connection_linger(request->connection);
        return result;
    }
    kd_connections_stage(server->connections, request->connection, KD_STAGE_BODY, 0);
    return MHD_YES;
}

/* Refuses a request while its body is arriving. libmicrohttpd cannot send an answer at that point, so the answer is
 * written directly to the socket, and the connection is closed. */
static enum MHD_Result cut_body(struct kd_request *request, enum kd_problem_type type, const char *detail)
{
    request->status = kd_problem_status(type);
    kd_connection_linger(request->connection);
    if (request->connection)
        kd_problem_send_raw(kd_connection_socket(request->connection), type, detail, request->id);
    return MHD_NO;
}

static enum MHD_Result receive(struct kd_request *request, const char *data, size_t *size)
{
    struct kd_server *server = request->server;

    struct told told;

    if (*size > most_of(request) - request->body.size)
        return cut_body(request, KD_PROBLEM_BODY_TOO_LARGE, too_large(request, &told));
    size_t all = request->body.size + *size;
    bool quota;
    if (kd_bytes_take(server->bodies, request->client, *size,
                      all > request->header.content_length ? all : request->header.content_length, &quota))
        return quota ? cut_body(request, KD_PROBLEM_QUOTA, BODIES_OF_CLIENT)
                     : cut_body(request, KD_PROBLEM_CROWDED, BODIES_TOO_MANY);
    if (kd_buffer_append(&request->body, data, *size)) {
        kd_bytes_give(server->bodies, request->client, *size);
        return cut_body(request, KD_PROBLEM_NO_MEMORY, "out of memory for the body");
    }
    kd_once_take(request, data, *size);
    *size = 0;
    /* the body arrives fast enough, so its next part gets the same time again */
    if (all - request->body_mark >= PACE) {
        request->body_mark = all;
        stage(request, KD_STAGE_BODY);
    }
    return MHD_YES;
}

enum MHD_Result kd_request_handle(void *cls, struct MHD_Connection *mhd, const char *url, const char *method,
                                  const char *version, const char *data, size_t *size, void **state)
{
    struct kd_request *request = *state;
    (void)cls, (void)url;
    kd_library_works_on(socket_of(mhd));
    if (!request) /* out of memory */
        return kd_reply_bare(mhd);
    if (!request->begun) {
        request->begun = true;
        request->method = method;
        request->head = !strcmp(method, "HEAD");
        return begin(request, version);
    }
    if (*size)
        return receive(request, data, size);
    stage(request, KD_STAGE_WORK);
    enum MHD_Result result;
    if (!request->route && !choose(request, &result))
        return result;
    return request->route->handle(request);
}
