#include "server/http/reply.h"

#include "image/gzip.h"
#include "server/http/cors.h"
#include "server/http/negotiate.h"
#include "server/http/query.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct MHD_Response *kd_reply_take(struct kd_buffer *body, const char *type)
{
    struct MHD_Response *response = MHD_create_response_from_buffer(body->size, body->data, MHD_RESPMEM_MUST_FREE);
    if (!response)
        free(body->data);
    *body = (struct kd_buffer) { 0 };
    if (response)
        MHD_add_response_header(response, "Content-Type", type);
    return response;
}

/* Limits of compression. Below PACK_LEAST, gzip's header costs more than compression saves. Above PACK_MOST,
 * compression would block the HTTP thread for more than some 20 ms. */
enum { PACK_LEAST = 1 << 10, PACK_MOST = 1 << 20 };

struct MHD_Response *kd_reply_text(struct kd_request *request, struct kd_buffer *body, const char *type)
{
    struct kd_buffer codings = kd_reply_header_list(request, "Accept-Encoding");
    bool packed = body->size >= PACK_LEAST && body->size <= PACK_MOST &&
                  kd_accepts_coding((const char *)codings.data, "gzip") && kd_gzip(body, KD_GZIP_ONCE);
    kd_buffer_finish(&codings);
    struct MHD_Response *response = kd_reply_take(body, type);
    if (response)
        MHD_add_response_header(response, "Vary", "Accept-Encoding");
    if (response && packed)
        MHD_add_response_header(response, "Content-Encoding", "gzip");
    return response;
}

struct MHD_Response *kd_reply_static(const void *data, size_t size, const char *type)
{
    union {
        const void *in;
        void *out;
    } bytes = { data }; /* removes const, which is safe because libmicrohttpd does not write to these bytes */
    struct MHD_Response *response = MHD_create_response_from_buffer(size, bytes.out, MHD_RESPMEM_PERSISTENT);
    if (response && type)
        MHD_add_response_header(response, "Content-Type", type);
    return response;
}

static ssize_t nothing(void *cls, uint64_t position, char *to, size_t size)
{
    (void)cls, (void)position, (void)to, (void)size;
    return MHD_CONTENT_READER_END_OF_STREAM;
}

struct MHD_Response *kd_reply_empty(const char *type)
{
    struct MHD_Response *response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 64, nothing, NULL, NULL);
    /* Without this option, libmicrohttpd announces chunks and sends the final chunk "0" although there is no body. A
     * client that keeps the connection open would read this chunk as the start of the next answer. With the option,
     * the library closes the connection. */
    if (response)
        MHD_set_response_options(response, MHD_RF_HTTP_1_0_COMPATIBLE_STRICT, MHD_RO_END);
    if (response && type)
        MHD_add_response_header(response, "Content-Type", type);
    return response;
}

void kd_reply_file(struct kd_request *request, enum kd_disposition disposition, const char *format, ...)
{
    char name[60];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    snprintf(request->file, sizeof request->file, "%s; filename=\"%s\"",
             disposition == KD_INLINE ? "inline" : "attachment", name);
}

void kd_reply_location(const struct kd_request *request, struct MHD_Response *response, const char *id)
{
    char to[120];
    snprintf(to, sizeof to, "%s/%s", strrchr(request->route->path, '/') + 1, id);
    if (response)
        MHD_add_response_header(response, "Location", to);
}

/* Allocates nothing. */
enum MHD_Result kd_reply_bare(struct MHD_Connection *mhd)
{
    static const char text[] = "{\"type\":\"urn:kerrd:problem:out-of-memory\",\"title\":\"Memory ran "
                               "out\",\"status\":503,\"detail\":\"out of memory\"}\n";
    struct MHD_Response *response = kd_reply_static(text, sizeof text - 1, KD_PROBLEM_TYPE);
    if (!response)
        return MHD_NO;
    MHD_add_response_header(response, "Retry-After", "5");
    MHD_add_response_header(response, "Cache-Control", "no-store");
    MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
    MHD_add_response_header(response, "Connection", "close");
    enum MHD_Result result = MHD_queue_response(mhd, MHD_HTTP_SERVICE_UNAVAILABLE, response);
    MHD_destroy_response(response);
    return result;
}

enum MHD_Result kd_reply_no_memory(struct kd_request *request)
{
    request->status = MHD_HTTP_SERVICE_UNAVAILABLE;
    return kd_reply_bare(request->mhd);
}

bool kd_reply_matches(struct kd_request *request, const char *etag)
{
    struct kd_buffer tags = kd_reply_header_list(request, "If-Match");
    bool yes = !tags.data || kd_etag_matches((const char *)tags.data, etag);
    kd_buffer_finish(&tags);
    return yes;
}

enum MHD_Result kd_reply_unmatched(struct kd_request *request)
{
    return kd_reply_problem(request,
                            &(struct kd_problem) { .type = KD_PROBLEM_PRECONDITION,
                                                   .detail = "no resource at this address has an ETag of If-Match" });
}

static bool only_asks(const struct kd_request *request)
{
    return request->head || !strcmp(request->method, "GET") || (request->route && request->route->question);
}

/* Adds the client's quota in the headers of draft-ietf-httpapi-ratelimit-headers-11. */
static void add_quota(const struct kd_request *request, struct MHD_Response *response)
{
    char text[80];
    const char *caching = MHD_get_response_header(response, "Cache-Control");
    /* public answers have no quota, because a shared cache would send one client's quota to all clients */
    if (caching && !strncmp(caching, "public", 6))
        return;
    if (!request->server->quota || !request->route || strncmp(request->route->path, "/v1/", 4))
        return;
    const struct kd_quota quota = request->server->quota(request->server, request->client);
    snprintf(text, sizeof text, "\"device-seconds\";q=%u;w=60", quota.seconds);
    MHD_add_response_header(response, "RateLimit-Policy", text);
    snprintf(text, sizeof text, "\"device-seconds\";r=%u;t=%u", quota.left_s, quota.whole_in_s);
    MHD_add_response_header(response, "RateLimit", text);
}

/* Adds the header Deprecation (RFC 9745) if the query uses the former name of a parameter. */
static void add_deprecation(const struct kd_request *request, struct MHD_Response *response)
{
    char link[KD_BASE_PATH_MOST + 40];
    snprintf(link, sizeof link, "<%s/docs>; rel=\"deprecation\"", request->server->base.path);
    MHD_add_response_header(response, "Deprecation", KD_DEPRECATION);
    MHD_add_response_header(response, "Link", link);
}

enum MHD_Result kd_reply_send(struct kd_request *request, unsigned status, struct MHD_Response *response)
{
    struct kd_server *server = request->server;
    if (!response)
        return kd_reply_no_memory(request);
    if ((status / 100 == 2 || status == MHD_HTTP_NOT_MODIFIED) && only_asks(request) &&
        !kd_reply_matches(request, MHD_get_response_header(response, "ETag"))) {
        MHD_destroy_response(response);
        *request->file = 0;
        return kd_reply_unmatched(request);
    }
    const char *type = MHD_get_response_header(response, "Content-Type");
    /* answers with these statuses have no body */
    if (type && (status == MHD_HTTP_NO_CONTENT || status == MHD_HTTP_NOT_MODIFIED))
        MHD_del_response_header(response, "Content-Type", type);
    MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
    MHD_add_response_header(response, "Cross-Origin-Resource-Policy",
                            server->cross_site || request->link.on ? "cross-origin" : "same-site");
    if (!MHD_get_response_header(response, "Cache-Control"))
        MHD_add_response_header(response, "Cache-Control", "no-store");
    /* with Vary, caches use the answer only for requests with the same token */
    if (server->access && !request->link.on)
        MHD_add_response_header(response, "Vary", "Authorization, " KD_ACCESS_HEADER ", Cookie");
    kd_cors_add(request, response);
    if (status < 400 && kd_route_is_dated(request))
        add_deprecation(request, response);
    add_quota(request, response);
    if (*request->file && (status == MHD_HTTP_OK || status == MHD_HTTP_PARTIAL_CONTENT))
        MHD_add_response_header(response, "Content-Disposition", request->file);
    if (*request->id)
        MHD_add_response_header(response, KD_REQUEST_ID_HEADER, request->id);
    /* During shutdown, the connection is closed, so that a client with a persistent connection looks for another
     * server. */
    if (request->close || atomic_load(&server->phase) != KD_SERVING)
        MHD_add_response_header(response, "Connection", "close");
    kd_connections_stage(server->connections, request->connection, KD_STAGE_REPLY, request->reply_bytes);
    request->status = status;
    enum MHD_Result result = MHD_queue_response(request->mhd, status, response);
    MHD_destroy_response(response);
    return result;
}

enum MHD_Result kd_reply_problem(struct kd_request *request, const struct kd_problem *problem)
{
    struct kd_buffer body = { 0 };
    struct kd_problem named = *problem;
    named.request_id = request->id;
    if (kd_problem_to_json(&named, &body)) {
        kd_buffer_finish(&body);
        return kd_reply_no_memory(request);
    }
    struct MHD_Response *response = kd_reply_take(&body, KD_PROBLEM_TYPE);
    return response ? kd_reply_refuse(request, problem, response) : kd_reply_no_memory(request);
}

enum MHD_Result kd_reply_refuse(struct kd_request *request, const struct kd_problem *problem,
                                struct MHD_Response *response)
{
    if (problem->allow)
        MHD_add_response_header(response, "Allow", problem->allow);
    if (problem->content_range)
        MHD_add_response_header(response, "Content-Range", problem->content_range);
    if (kd_problem_status(problem->type) == MHD_HTTP_UNAUTHORIZED)
        MHD_add_response_header(response, "WWW-Authenticate", "Bearer");
    if (problem->retry_after) {
        char seconds[12];
        snprintf(seconds, sizeof seconds, "%u", problem->retry_after);
        MHD_add_response_header(response, "Retry-After", seconds);
    }
    request->close |= problem->close;
    return kd_reply_send(request, kd_problem_status(problem->type), response);
}

enum MHD_Result kd_reply_options(struct kd_request *request, const char *allow)
{
    struct MHD_Response *response = kd_reply_static("", 0, NULL);
    if (response)
        MHD_add_response_header(response, "Allow", allow);
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, response);
}

enum MHD_Result kd_reply_error(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    return kd_reply_problem(request, &problem);
}

enum MHD_Result kd_reply_cancelled(struct kd_request *request)
{
    if (!atomic_load(&request->server->ended))
        return MHD_NO; /* the client has disconnected */
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_STOPPING,
                                        .retry_after = 1,
                                        .detail = "the server stopped before the request was finished: repeat it when "
                                                  "the server is back, or at another server" });
}

enum MHD_Result kd_reply_json(struct kd_request *request, enum kd_status status, struct kd_buffer *json,
                              const char *type)
{
    if (status) {
        struct kd_error error;
        kd_error_set(&error, status, "the document could not be written");
        kd_buffer_finish(json);
        return kd_reply_error(request, &error);
    }
    return kd_reply_send(request, MHD_HTTP_OK, kd_reply_text(request, json, type));
}

struct joined {
    const char *name;
    struct kd_buffer text;
    bool failed;
};

static enum MHD_Result join(void *cls, enum MHD_ValueKind kind, const char *key, const char *value)
{
    struct joined *all = cls;
    (void)kind;
    if (value && !strcasecmp(key, all->name))
        all->failed |= kd_buffer_printf(&all->text, "%s%s", all->text.size ? "," : "", value) != KD_OK;
    return MHD_YES;
}

struct kd_buffer kd_reply_header_list(struct kd_request *request, const char *name)
{
    struct joined all = { .name = name };
    MHD_get_connection_values(request->mhd, MHD_HEADER_KIND, join, &all);
    if (all.failed)
        kd_buffer_finish(&all.text);
    return all.text;
}

size_t kd_reply_accepted(struct kd_request *request, size_t n, const char *(*type)(size_t i, const void *list),
                         const void *list)
{
    struct kd_buffer accept = kd_reply_header_list(request, "Accept");
    size_t best = kd_accept_best((const char *)accept.data, n, type, list);
    kd_buffer_finish(&accept);
    return best;
}

enum kd_status kd_reply_item(struct kd_buffer *out, const char *name)
{
    return kd_buffer_printf(out, "%s%s", out->size ? ", " : "", name);
}

const char *kd_bearer_of(struct kd_request *request)
{
    const char *header = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Authorization");
    return header && !strncasecmp(header, "Bearer ", 7) ? header + 7 : NULL;
}

const char *kd_token_of(struct kd_request *request)
{
    const char *bearer = request->spent ? NULL : kd_bearer_of(request);
    if (bearer)
        return bearer;
    for (size_t i = 0; i < request->target.n_pairs; i++)
        if (!strcmp(request->target.pairs[i].name, "token"))
            return request->target.pairs[i].value;
    return NULL;
}
