#include "server/openapi/responses.h"

#include "render/output/format.h"
#include "server/http/request_id.h"
#include "server/job/formats.h"
#include "server/openapi/headers.h"
#include "server/openapi/links.h"
#include "server/openapi/media.h"
#include "server/openapi/problems.h"
#include "server/openapi/strict.h"

#include <stdio.h>
#include <string.h>

static void begin_response(struct kd_json *json, const struct kd_route *route, unsigned method, unsigned status,
                           const char *description)
{
    char number[12];
    snprintf(number, sizeof number, "%u", status);
    kd_json_object(json, number);
    kd_json_string(json, "description", description);
    kd_openapi_headers(json, route, method, status);
    kd_openapi_links(json, route, status);
}

/* Writes the media types in a table of formats, each of them once. */
static void add_formats(struct kd_json *json, enum kd_gives gives)
{
    static const char stars[] = "{\"$ref\":\"#/components/schemas/Stars\"}"; /* the only picture format that is JSON */
    struct kd_job_format format;
    for (size_t i = 0; gives == KD_GIVES_PICTURE && i < kd_n_formats; i++) {
        const char *known = strstr(kd_formats[i]->media_type, "json") ? stars : "";
        kd_openapi_media(json, kd_formats[i]->media_type, known, strlen(known));
    }
    for (size_t i = 0; gives == KD_GIVES_RESULT && kd_job_format(i, &format); i++)
        kd_openapi_media(json, format.media_type, "", 0);
}

/* Writes a media type of an answer. For JSON, the route gives the schema. */
static void add_type(struct kd_json *json, const struct kd_route *route, unsigned method, const char *type, size_t n)
{
    char name[64];
    const char *known = NULL;
    snprintf(name, sizeof name, "%.*s", (int)n, type);
    for (size_t i = 0; i < sizeof route->schemas / sizeof *route->schemas && !strcmp(name, KD_JSON_TYPE); i++)
        if (!known && kd_route_for(route->schemas[i].methods, method))
            known = route->schemas[i].text;
    kd_openapi_media(json, name, known ? known : "", known ? strlen(known) : 0);
}

static void add_typed(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    add_type(json, route, method, route->answer, strcspn(route->answer, ";"));
    for (const char *also = route->also; also && *also; also += strspn(also, " ")) {
        add_type(json, route, method, also, strcspn(also, " "));
        also += strcspn(also, " ");
    }
}

static void add_answer(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    kd_json_object(json, "content");
    if (route->gives == KD_GIVES_ITS_ANSWER)
        add_typed(json, route, method);
    else
        add_formats(json, route->gives);
    kd_json_end(json);
}

size_t kd_openapi_successes(const struct kd_route *route, unsigned method, unsigned out[KD_OPENAPI_SUCCESSES])
{
    /* If POST creates an object with 201, GET answers with the first status. */
    const bool makes = route->status[1] == 201;
    size_t n = 0;
    out[n++] = method == KD_DELETE ? 204 : makes && method == KD_POST ? 201 : route->status[0] ? route->status[0] : 200;
    if (route->status[1] && method != KD_DELETE && (!makes || method == KD_PUT))
        out[n++] = route->status[1];
    if (route->parts && method == KD_GET)
        out[n++] = 206;
    if (route->page)
        out[n++] = 303;
    return n;
}

static void add_part(struct kd_json *json)
{
    static const char bytes[] = "{\"type\":\"string\",\"format\":\"binary\"}";
    kd_json_object(json, "content");
    kd_openapi_media(json, "*/*", bytes, strlen(bytes));
    kd_json_end(json);
}

static const char *about(const struct kd_route *route, unsigned status)
{
    return status == 304   ? "The client's copy is still valid"
           : status == 206 ? "The part that Range requests"
           : status == 303 ? "The address had an access token; the page is at Location"
                           : route->summary;
}

void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    unsigned statuses[KD_OPENAPI_SUCCESSES];
    const size_t n = kd_openapi_successes(route, method, statuses);
    kd_json_object(json, "responses");
    for (size_t i = 0; i < n; i++) {
        begin_response(json, route, method, statuses[i], about(route, statuses[i]));
        if (statuses[i] == 206)
            add_part(json);
        else if (statuses[i] < 203)
            add_answer(json, route, method);
        kd_json_end(json);
    }
    kd_openapi_problems(json, route, method);
    kd_json_end(json);
}
