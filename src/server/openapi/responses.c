#include "server/openapi/responses.h"

#include "render/output/format.h"
#include "server/http/request_id.h"
#include "server/job/formats.h"
#include "server/openapi/answers.h"
#include "server/openapi/assets.h"
#include "server/openapi/headers.h"
#include "server/openapi/links.h"
#include "server/openapi/media.h"
#include "server/openapi/orbits.h"
#include "server/openapi/problems.h"
#include "server/openapi/rays.h"
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

/* Writes the media types that a table lists, each of them once. */
static void add_formats(struct kd_json *json, enum kd_gives gives)
{
    static const char stars[] = "{\"$ref\":\"#/components/schemas/Stars\"}"; /* the only format that is JSON */
    struct kd_job_format format;
    for (size_t i = 0; gives == KD_GIVES_PICTURE && i < kd_n_formats; i++) {
        const char *known = strstr(kd_formats[i]->media_type, "json") ? stars : "";
        kd_openapi_media(json, kd_formats[i]->media_type, known, strlen(known));
    }
    for (size_t i = 0; gives == KD_GIVES_RESULT && kd_job_format(i, &format); i++)
        kd_openapi_media(json, format.media_type, "", 0);
}

/* Writes a media type of an answer. For JSON it adds the schema in the table of answers. */
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

/* Writes the redirect of a page: from an address with an access token to the address without the token. */
static void add_led_on(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    if (!route->page)
        return;
    begin_response(json, route, method, 303, "If the address had an access token");
    kd_json_end(json);
}

static void add_part(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    static const char bytes[] = "{\"type\":\"string\",\"format\":\"binary\"}";
    begin_response(json, route, method, 206, "The part that Range requests");
    kd_json_object(json, "content");
    kd_openapi_media(json, "*/*", bytes, strlen(bytes));
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_responses(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    kd_json_object(json, "responses");
    const bool makes = method == KD_POST && route->status[1] == 201;
    begin_response(json, route, method,
                   method == KD_DELETE ? 204
                   : makes             ? 201
                   : route->status[0]  ? route->status[0]
                                       : 200,
                   route->summary);
    if (method != KD_DELETE)
        add_answer(json, route, method);
    kd_json_end(json);
    const unsigned also = method == KD_DELETE || (route->status[1] == 201 && method != KD_PUT) ? 0 : route->status[1];
    if (also) {
        begin_response(json, route, method, also, also == 304 ? "The client's copy is still valid" : route->summary);
        if (also == 201)
            add_answer(json, route, method);
        kd_json_end(json);
    }
    if (method == KD_GET && route->parts)
        add_part(json, route, method);
    add_led_on(json, route, method);
    kd_openapi_problems(json, route, method);
    kd_json_end(json);
}
