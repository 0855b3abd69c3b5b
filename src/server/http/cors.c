#include "server/http/cors.h"

#include "server/http/reply.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* number of seconds for which a browser may cache a preflight; Chromium accepts up to two hours */
#define MAX_AGE_S "600"
#define NAME "abcdefghijklmnopqrstuvwxyz0123456789"
#define EXPOSED \
    "Accept-Ranges, Allow, Content-Digest, Content-Disposition, Content-Encoding, Content-Range, Deprecation, ETag, " \
    "Kerrd-Accuracy, " \
    "Kerrd-Approximations, Kerrd-Azimuth, " \
    "Kerrd-Clock, Kerrd-Count, Kerrd-Fields, Kerrd-Flux, Kerrd-Frame, " \
    "Kerrd-Generation, Kerrd-Particles, Kerrd-Patched, Kerrd-Quality, Kerrd-Revision, Kerrd-Rows, Kerrd-Scene-Hash, " \
    "Kerrd-Sentences, Kerrd-Time, Kerrd-Waited, Link, Location, " \
    "Preference-Applied, RateLimit, RateLimit-Policy, Repr-Digest, Retry-After, Server-Timing, WWW-Authenticate, " \
    "X-Request-Id"

struct kd_cors {
    char **origins;
    size_t n;
    struct kd_buffer embedders; /* separated by blanks */
};

/* Checks an origin. Returns NULL if it is valid, or otherwise the fault, worded as the end of a sentence. */
static const char *fault_of(const char *origin)
{
    if (!strcmp(origin, "null"))
        return NULL;
    if (strchr(origin, '*'))
        return "it must be an origin; * is not accepted";
    const char *host = strstr(origin, "://");
    if (!host || host == origin || strspn(origin, NAME "+-.") != (size_t)(host - origin))
        return "it must be SCHEME://HOST or SCHEME://HOST:PORT in lower case, or null";
    host += 3;
    const char *port = strrchr(host, *host == '[' ? ']' : ':');
    if (port && *host == '[')
        port = port[1] == ':' ? port + 1 : NULL;
    const size_t size = port ? (size_t)(port - host) : strlen(host);
    if (!size || strspn(host, NAME "-._[:]") < size)
        return "it must be SCHEME://HOST or SCHEME://HOST:PORT in lower case, without a path and a final slash";
    if (port && (!port[1] || strlen(port + 1) > 5 || port[1 + strspn(port + 1, "0123456789")]))
        return "the port must be a number, without a slash after it";
    if (port && ((!strncmp(origin, "http://", 7) && !strcmp(port, ":80")) ||
                 (!strncmp(origin, "https://", 8) && !strcmp(port, ":443"))))
        return "it must not have the default port of the scheme, because browsers omit that port";
    return NULL;
}

static const char *embed_fault_of(const char *origin)
{
    return strcmp(origin, "null") ? fault_of(origin)
                                  : "it must not be null, because a page without an origin cannot embed this server";
}

static enum kd_status add_one(struct kd_cors *cors, const char *origin, bool embeds, struct kd_error *error)
{
    const char *fault = (embeds ? embed_fault_of : fault_of)(origin);
    if (fault)
        return kd_error_set(error, KD_EINVAL, "--%s-origin is \"%.200s\"; %s", embeds ? "embed" : "cors", origin,
                            fault);
    if (embeds && kd_buffer_printf(&cors->embedders, "%s%s", cors->embedders.size ? " " : "", origin))
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    char **origins = realloc(cors->origins, (cors->n + 1) * sizeof *origins);
    if (!origins)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    cors->origins = origins;
    origins[cors->n] = strdup(origin);
    return origins[cors->n++] ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
}

static enum kd_status add_all(struct kd_cors *cors, const char *text, bool embeds, struct kd_error *error)
{
    char *copy = strdup(text), *rest = copy;
    enum kd_status status = copy ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
    for (const char *origin; !status && (origin = strsep(&rest, ","));)
        status = add_one(cors, origin, embeds, error);
    free(copy);
    return status;
}

enum kd_status kd_cors_create(const char *const *texts, const char *const *embeds, struct kd_cors **out,
                              struct kd_error *error)
{
    struct kd_cors *cors = calloc(1, sizeof *cors);
    enum kd_status status = cors ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory");
    for (; !status && texts && *texts; texts++)
        status = add_all(cors, *texts, false, error);
    for (; !status && embeds && *embeds; embeds++)
        status = add_all(cors, *embeds, true, error);
    if (status)
        kd_cors_destroy(cors);
    else
        *out = cors;
    return status;
}

void kd_cors_destroy(struct kd_cors *cors)
{
    if (!cors)
        return;
    for (size_t i = 0; i < cors->n; i++)
        free(cors->origins[i]);
    free(cors->origins);
    kd_buffer_finish(&cors->embedders);
    free(cors);
}

const char *kd_cors_embedders(const struct kd_cors *cors) { return cors ? (const char *)cors->embedders.data : NULL; }

static const char *header(const struct kd_request *request, const char *name)
{
    return MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, name);
}

const char *kd_cors_origin(const struct kd_request *request)
{
    const struct kd_cors *cors = request->server->cors;
    const char *origin = cors ? header(request, "Origin") : NULL;
    for (size_t i = 0; origin && i < cors->n; i++)
        if (!strcmp(cors->origins[i], origin))
            return origin;
    return NULL;
}

bool kd_cors_foreign(const struct kd_request *request)
{
    const char *origin = kd_cors_origin(request), *site = header(request, "Sec-Fetch-Site"),
               *host = origin ? strstr(origin, "://") : NULL;
    if (!origin || (site && !strcmp(site, "same-origin")))
        return false;
    return !host || !request->header.host || strcmp(host + 3, request->header.host);
}

void kd_cors_add(const struct kd_request *request, struct MHD_Response *response)
{
    const char *origin = kd_cors_origin(request);
    if (request->server->cors)
        MHD_add_response_header(response, "Vary", "Origin");
    if (!origin)
        return;
    MHD_add_response_header(response, "Access-Control-Allow-Origin", origin);
    MHD_add_response_header(response, "Access-Control-Expose-Headers", EXPOSED);
}

bool kd_cors_is_preflight(const struct kd_request *request)
{
    return request->server->cors && !strcmp(request->method, "OPTIONS") && header(request, "Origin") &&
           header(request, "Access-Control-Request-Method");
}

static void allowed_headers(const struct kd_route *route, char *out, size_t size)
{
    const bool body = route->methods & (KD_POST | KD_PATCH | KD_PUT),
               kept = route->status[0] == 304 || route->status[1] == 304;
    const bool events = route->answer && !strcmp(route->answer, KD_EVENTS_TYPE);
    snprintf(out, size, "Authorization, X-Request-Id, traceparent, " KD_ACCESS_HEADER "%s%s%s%s%s%s",
             body ? ", Content-Type" : "", kept ? ", If-None-Match" : "", route->parts ? ", Range, If-Range" : "",
             events ? ", Last-Event-ID" : "", route->methods & KD_PATCH ? ", Prefer" : "",
             route->once ? ", " KD_ONCE_HEADER : "");
}

enum MHD_Result kd_cors_preflight(struct kd_request *request)
{
    char headers[160];
    struct kd_problem nowhere;
    if (!kd_cors_origin(request))
        return kd_reply_problem(
            request,
            &(struct kd_problem) {
                .type = KD_PROBLEM_CROSS_SITE,
                .close = request->body_announced,
                .detail =
                    "the Origin of the browser's request is not among those of --cors-origin and --embed-origin" });
    request->route = NULL;
    if (!kd_route_find(request, &nowhere) && !request->route)
        return kd_reply_problem(request, &nowhere);
    struct MHD_Response *response = MHD_create_response_from_buffer(0, NULL, MHD_RESPMEM_PERSISTENT);
    if (!response)
        return kd_reply_no_memory(request);
    allowed_headers(request->route, headers, sizeof headers);
    MHD_add_response_header(response, "Access-Control-Allow-Methods", kd_route_methods(request->route));
    MHD_add_response_header(response, "Access-Control-Allow-Headers", headers);
    MHD_add_response_header(response, "Access-Control-Max-Age", MAX_AGE_S);
    if (header(request, "Access-Control-Request-Private-Network"))
        MHD_add_response_header(response, "Access-Control-Allow-Private-Network", "true");
    return kd_reply_send(request, MHD_HTTP_NO_CONTENT, response);
}
