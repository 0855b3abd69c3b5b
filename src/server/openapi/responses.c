#include "server/openapi/responses.h"

#include "render/output/format.h"
#include "server/http/request_id.h"
#include "server/job/formats.h"
#include "server/openapi/access.h"
#include "server/openapi/answers.h"
#include "server/openapi/assets.h"
#include "server/openapi/media.h"
#include "server/openapi/orbits.h"
#include "server/openapi/rays.h"
#include "server/openapi/strict.h"

#include <stdio.h>
#include <string.h>

static void add_header(struct kd_json *json, const char *name, const char *schema, const char *help)
{
    kd_json_object(json, name);
    kd_json_string(json, "description", help);
    kd_schema_text(json, "schema", schema);
    kd_json_end(json);
}

void kd_openapi_cors(struct kd_json *json)
{
    kd_schema_text(json, "Access-Control-Allow-Origin", "{\"$ref\":\"#/components/headers/AllowOrigin\"}");
    kd_schema_text(json, "Access-Control-Expose-Headers", "{\"$ref\":\"#/components/headers/ExposeHeaders\"}");
}

static void add_request_id(struct kd_json *json)
{
    kd_schema_text(json, KD_REQUEST_ID_HEADER, "{\"$ref\":\"#/components/headers/RequestId\"}");
}

void kd_openapi_headers(struct kd_json *json)
{
    kd_json_object(json, "headers");
    add_header(json, "RequestId", KD_SCHEMA_TEXT, "by which the log knows the request: what it said as " KD_REQUEST_ID_HEADER ", if that is 1 to 64 letters, digits and -._+/=, else a new one");
    kd_json_end(json);
}

/* Headers that a client goes by. kept: the answer may be asked for again by its tag. */
static void add_headers(struct kd_json *json, bool made, bool kept)
{
    kd_json_object(json, "headers");
    kd_openapi_cors(json);
    add_request_id(json);
    if (made)
        add_header(json, "Location", "{\"type\":\"string\",\"format\":\"uri-reference\"}", "where it is, relative to the address that was asked");
    if (kept)
        add_header(json, "ETag", KD_SCHEMA_TEXT, "for If-None-Match");
    kd_json_end(json);
}

static void begin_response(struct kd_json *json, const struct kd_route *route, unsigned status, const char *description)
{
    char number[12];
    snprintf(number, sizeof number, "%u", status);
    kd_json_object(json, number);
    kd_json_string(json, "description", description);
    add_headers(json, status == 201 || status == 202, status == 304 || (status == 200 && route->status[1] == 304));
}

/* Writes those of routes whose media types stand in a table; each once. */
static void add_formats(struct kd_json *json, enum kd_gives gives)
{
    static const char stars[] = "{\"$ref\":\"#/components/schemas/Stars\"}"; /* the one format that is JSON */
    struct kd_job_format format;
    for (size_t i = 0; gives == KD_GIVES_PICTURE && i < kd_n_formats; i++) {
        const char *known = strstr(kd_formats[i]->media_type, "json") ? stars : "";
        kd_openapi_media(json, kd_formats[i]->media_type, known, strlen(known));
    }
    for (size_t i = 0; gives == KD_GIVES_RESULT && kd_job_format(i, &format); i++)
        kd_openapi_media(json, format.media_type, "", 0);
}

/* A media type of an answer, with the schema that the table of answers has where it is JSON. */
static void add_known(struct kd_json *json, const struct kd_route *route, unsigned method, const char *type)
{
    const char *known = strcmp(type, "application/json") ? NULL : kd_openapi_answer(route->path, method);
    kd_openapi_media(json, type, known ? known : "", known ? strlen(known) : 0);
}

static void add_typed(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    char type[64];
    snprintf(type, sizeof type, "%.*s", (int)strcspn(route->answer, ";"), route->answer);
    switch (route->takes) {
    case KD_TAKES_RAYS: kd_openapi_rays_answer(json); break;
    case KD_TAKES_ORBITS: kd_openapi_orbits_answer(json); break;
    case KD_TAKES_ASSET: kd_openapi_asset_answer(json, method); break;
    default: add_known(json, route, method, type);
    }
    for (const char *also = route->also; also && *also; also += strspn(also, " ")) {
        snprintf(type, sizeof type, "%.*s", (int)strcspn(also, " "), also);
        add_known(json, route, method, type);
        also += strlen(type);
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

void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    kd_json_object(json, "responses");
    const bool makes = method == KD_POST && route->status[1] == 201;
    begin_response(json, route, method == KD_DELETE ? 204 : makes ? 201 : route->status[0] ? route->status[0] : 200, route->summary);
    if (method != KD_DELETE)
        add_answer(json, route, method);
    kd_json_end(json);
    const unsigned also = method == KD_DELETE || (route->status[1] == 201 && method != KD_PUT) ? 0 : route->status[1];
    if (also) {
        begin_response(json, route, also, also == 304 ? "What If-None-Match names" : route->summary);
        if (also == 201)
            add_answer(json, route, method);
        kd_json_end(json);
    }
    kd_openapi_access_refusals(json, route, method);
    kd_schema_text(json, "default", "{\"$ref\":\"#/components/responses/Problem\"}");
    kd_json_end(json);
}

void kd_openapi_problem_schema(struct kd_json *json)
{
    static const struct kd_openapi_member problem[] = {
        { "type", NULL, false, kd_problem_uri }, { "title", KD_SCHEMA_TEXT }, { "status", "{\"type\":\"integer\",\"minimum\":400,\"maximum\":599}" }, { "detail", KD_SCHEMA_TEXT },
        { "pointer", "{\"type\":\"string\",\"description\":\"into the request (RFC 6901)\"}", true },
        { "offered", "{\"type\":\"string\",\"description\":\"media types that would do\"}", true },
        { "request_id", "{\"type\":\"string\",\"description\":\"as in the header X-Request-Id\"}", true },
    };
    KD_OPENAPI_STRICT(json, "Problem", problem);
}

void kd_openapi_problem(struct kd_json *json)
{
    kd_json_object(json, "headers");
    add_header(json, "AllowOrigin", KD_SCHEMA_TEXT, "the Origin of a request, where kerrd serve --cors-origin names it; a preflight (OPTIONS) of such a one is answered 204 on each path");
    add_header(json, "ExposeHeaders", KD_SCHEMA_TEXT, "beside it: the headers of answers that scripts of that origin may read");
    kd_json_end(json);
    kd_json_object(json, "responses");
    kd_json_object(json, "Problem");
    kd_json_string(json, "description", "What went wrong (RFC 9457)");
    kd_json_object(json, "headers");
    kd_openapi_cors(json);
    add_request_id(json);
    add_header(json, "Retry-After", KD_SCHEMA_COUNT, "seconds, where another try may go better");
    add_header(json, "WWW-Authenticate", "{\"const\":\"Bearer\"}", "of 401");
    add_header(json, "Allow", KD_SCHEMA_TEXT, "of 405: the methods that would do");
    kd_json_end(json);
    kd_json_object(json, "content");
    kd_openapi_media(json, "application/problem+json", KD_SCHEMA_REF("Problem"), strlen(KD_SCHEMA_REF("Problem")));
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
}
