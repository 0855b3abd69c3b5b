#include "server/openapi/problems.h"

#include "server/http/access.h"
#include "server/openapi/headers.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"

#include <stdio.h>
#include <string.h>

static bool always(const struct kd_route *route, unsigned method) { return (void)route, (void)method, true; }
static bool never(const struct kd_route *route, unsigned method)
{
    return (void)route, (void)method, false;
} /* 405 is not listed: it means that this address does not have the operation */
static bool closed(const struct kd_route *route, unsigned method) { return (void)method, !route->open; }
static bool has_body(const struct kd_route *route, unsigned method)
{
    return (void)route, method == KD_POST || method == KD_PATCH || method == KD_PUT;
}

/* True if the operation may answer 403. Reasons are a wrong role, a signed link that is not valid, a page of another
 * site, or a wrong token of the object. */
static bool forbids(const struct kd_route *route, unsigned method)
{
    return !strncmp(route->path, "/v1/", 4) || route->signable ||
           (!route->open && !kd_role_may(KD_ROLE_VIEW, route, method));
}

static bool is_found_by_name(const struct kd_route *route, unsigned method)
{
    return (void)method, strchr(route->path, '{') && route->takes != KD_TAKES_QUANTITY;
}

/* True if the client chooses the format of an answer by the header Accept. */
static bool negotiates(const struct kd_route *route, unsigned method)
{
    return (void)method, route->gives != KD_GIVES_ITS_ANSWER;
}

static bool is_made_once(const struct kd_route *route, unsigned method) { return method == KD_POST && route->once; }

static bool checks_what_it_is_given(const struct kd_route *route, unsigned method)
{
    return kd_route_checks_query(route) ||
           (method != KD_DELETE && (has_body(route, method) || route->takes != KD_TAKES_NOTHING));
}

static bool makes_films(const struct kd_route *route, unsigned method)
{
    return (void)method, route->gives == KD_GIVES_RESULT;
}
static bool sends_parts(const struct kd_route *route, unsigned method) { return method == KD_GET && route->parts; }

static const struct {
    unsigned status;
    bool (*of)(const struct kd_route *route, unsigned method);
} rows[] = {
    { 400, always },           { 401, closed },       { 403, forbids },
    { 404, is_found_by_name }, { 405, never },        { 406, negotiates },
    { 408, always },           { 409, is_made_once }, { 412, always },
    { 413, always },           { 414, always },       { 415, has_body },
    { 416, sends_parts },      { 421, always },       { 422, checks_what_it_is_given },
    { 429, always },           { 431, always },       { 500, closed },
    { 501, makes_films },      { 503, always },       { 505, always },
    { 507, makes_films },
};

bool kd_openapi_has_problem(const struct kd_route *route, unsigned method, unsigned status)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].status == status && rows[i].of(route, method))
            return true;
    for (size_t i = 0; i < sizeof route->may / sizeof *route->may; i++)
        if (route->may[i].status == status && kd_route_for(route->may[i].methods, method))
            return true;
    return false;
}

bool kd_openapi_problem_is_common(unsigned status)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].status == status)
            return rows[i].of == always || rows[i].of == closed || rows[i].of == forbids;
    return false;
}

void kd_openapi_problems(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char status[12], reference[80];
        if (!kd_openapi_has_problem(route, method, rows[i].status))
            continue;
        snprintf(status, sizeof status, "%u", rows[i].status);
        snprintf(reference, sizeof reference, "{\"$ref\":\"#/components/responses/Problem%s\"}", status);
        kd_schema_text(json, status, reference);
    }
}

/* Writes the titles of all problems with this status. */
static void describe(struct kd_json *json, unsigned status)
{
    char text[500] = "";
    for (size_t i = 0, n = 0; kd_problem_uri(i) && n < sizeof text; i++)
        if (kd_problem_status((enum kd_problem_type)i) == status)
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s", n ? "; " : "",
                                  kd_problem_title((enum kd_problem_type)i));
    kd_json_string(json, "description", text);
}

static void add_response(struct kd_json *json, unsigned status)
{
    char name[20];
    snprintf(name, sizeof name, "Problem%u", status);
    kd_json_object(json, name);
    describe(json, status);
    kd_openapi_problem_headers(json, status);
    kd_json_object(json, "content");
    kd_openapi_media(json, KD_PROBLEM_TYPE, KD_SCHEMA_REF("Problem"), strlen(KD_SCHEMA_REF("Problem")));
    kd_json_end(json);
    kd_json_end(json);
}

void kd_openapi_problem_responses(struct kd_json *json)
{
    kd_json_object(json, "responses");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        add_response(json, rows[i].status);
    kd_json_end(json);
}

void kd_openapi_problem_schema(struct kd_json *json)
{
    static const struct kd_openapi_member problem[] = {
        { "type", NULL, false, kd_problem_uri },
        { "title", KD_SCHEMA_TEXT },
        { "status", "{\"type\":\"integer\",\"minimum\":400,\"maximum\":599}" },
        { "detail", KD_SCHEMA_TEXT },
        { "pointer", "{\"type\":\"string\",\"description\":\"JSON pointer into the request (RFC 6901)\"}", true },
        { "offered", "{\"type\":\"string\",\"description\":\"accepted media types\"}", true },
        { "request_id", "{\"type\":\"string\",\"description\":\"as in the header X-Request-Id\"}", true },
    };
    KD_OPENAPI_STRICT(json, "Problem", problem);
}
