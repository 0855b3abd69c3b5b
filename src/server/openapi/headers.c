#include "server/openapi/headers.h"

#include "base/schema.h"
#include "server/http/once.h"
#include "server/http/query.h"
#include "server/http/request_id.h"

#include <stdio.h>
#include <string.h>

#define NUMBER KD_SCHEMA_NUMBER
#define COUNT KD_SCHEMA_COUNT
#define TEXT KD_SCHEMA_TEXT

/* required: true if the header is present in every answer for which it is listed. */
static const struct {
    const char *name, *schema, *help;
    bool required;
} headers[] = {
    { "Location", "{\"type\":\"string\",\"format\":\"uri-reference\"}",
      "address of the new resource, relative to the request's address", true },
    { "ETag", TEXT, "tag of this version of the resource, for If-None-Match", true },
    { "Accept-Ranges", "{\"const\":\"bytes\"}", "the resource supports Range", false },
    { "Content-Range", TEXT, "bytes FIRST-LAST/ALL of a part; bytes */ALL if the range is beyond the end", true },
    { "Repr-Digest", TEXT, "sha-256 of the whole (RFC 9530)", false },
    { "Content-Digest", TEXT, "sha-256 of the whole, if the answer is not a part", false },
    { "Content-Disposition", TEXT, "the name of a file", false },
    { "Server-Timing", TEXT, "times in ms: queue, each pass, encoding", false },
    { "Preference-Applied", TEXT, "return=minimal, if Prefer requested it", false },
    { "Set-Cookie", TEXT, "cookie with the access token, if the address had one", false },
    { "Kerrd-Scene-Hash", "{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{64}$\"}", "SHA-256 of the canonical scene",
      true },
    { "Kerrd-Accuracy", TEXT, "engine of the picture, and its measured error", false },
    { "Kerrd-Approximations", TEXT,
      "names of the approximations, separated by commas; /v1/approximations explains each name", false },
    { "Kerrd-Clock", TEXT, "proper time of a falling observer", false },
    { "Kerrd-Flux", TEXT, "flux of a picture at a radio frequency", false },
    { "Kerrd-Frame", COUNT, "the number of the frame", false },
    { "Kerrd-Revision", COUNT, "revision of the scene in the picture", false },
    { "Kerrd-Time", NUMBER, "time of the picture or of the particles, M", false },
    { "Kerrd-Azimuth", NUMBER, "azimuth of the camera, degrees", false },
    { "Kerrd-Sentences", COUNT, "number that represents the approximations; send it as sentences in the next request",
      false },
    { "Kerrd-Quality", TEXT, "the quality in force", false },
    { "Kerrd-Waited", NUMBER, "time in ms that the request waited for the frame", false },
    { "Kerrd-Patched", COUNT, "revision after the patch", false },
    { "Kerrd-Rows", TEXT, "ROWS/HEIGHT of an unfinished frame", false },
    { "Kerrd-Fields", TEXT, "columns of a row", true },
    { "Kerrd-Count", COUNT, "number of rows", true },
    { "Kerrd-Particles", COUNT, "number of particles", true },
    { "Kerrd-Generation", COUNT, "generation of the data; send it as after in the next request", true },
    { "RateLimit-Policy", TEXT,
      "\"device-seconds\";q=SECONDS;w=60: device time that one client may use in a minute, if kerrd serve "
      "--client-device-seconds limits it",
      false },
    { "RateLimit", TEXT,
      "\"device-seconds\";r=LEFT;t=SECONDS: remaining device time, and the seconds until all of it is available again",
      false },
    { "Deprecation", "{\"const\":\"" KD_DEPRECATION "\"}",
      "if the query has a former name of a parameter: the time since which that name is deprecated (RFC 9745)", false },
    { "Link", TEXT, "with Deprecation: address of the document that has the present names", false },
    { "Retry-After", COUNT, "seconds to wait before another attempt", false },
    { "WWW-Authenticate", "{\"const\":\"Bearer\"}", "scheme of authentication", true },
    { "Allow", TEXT, "methods of this address", true },
    { KD_REQUEST_ID_HEADER, TEXT,
      "id of the request in the log: the request's " KD_REQUEST_ID_HEADER
      ", if it has 1 to 64 letters, digits and -._+/=, otherwise a new one",
      false },
    { "Access-Control-Allow-Origin", TEXT,
      "the Origin of the request, if kerrd serve --cors-origin names it; a preflight (OPTIONS) from such an origin "
      "gets 204 on every path",
      false },
    { "Access-Control-Expose-Headers", TEXT, "headers of answers that scripts of that origin may read", false },
};

#define EVERY \
    KD_REQUEST_ID_HEADER " RateLimit-Policy RateLimit Access-Control-Allow-Origin Access-Control-Expose-Headers"
static bool is_kept(const struct kd_route *route, unsigned method)
{
    return method != KD_DELETE && (route->status[0] == 304 || route->status[1] == 304);
}
static bool sends_parts(const struct kd_route *route, unsigned method) { return method == KD_GET && route->parts; }
static bool tells_events(const struct kd_route *route, unsigned method)
{
    return (void)method, route->answer && !strcmp(route->answer, KD_EVENTS_TYPE);
}
static bool is_made_once(const struct kd_route *route, unsigned method) { return method == KD_POST && route->once; }
static bool may_say_little(const struct kd_route *route, unsigned method) { return method == KD_PATCH && route->brief; }

/* Request headers whose meaning here goes beyond that in HTTP. */
static const struct {
    const char *name, *help;
    bool (*of)(const struct kd_route *route, unsigned method);
    const char *schema; /* NULL: any text */
} asked[] = {
    { "If-None-Match", "ETag of the client's copy; if it is still valid, the answer is 304", is_kept },
    { "Range",
      "bytes=FIRST-LAST, bytes=FIRST- or bytes=-COUNT (the last bytes): the answer is this part, with status 206; for "
      "several ranges, or another form, the answer is the whole",
      sends_parts },
    { "If-Range", "ETag of the client's partial copy; if it is no longer valid, the answer is the whole", sends_parts },
    { "Last-Event-ID",
      "id of the client's last event, after which the stream continues; a value that is not a number is ignored",
      tells_events },
    { KD_ONCE_HEADER,
      "key of 1 to 128 characters, new for each request: a repeated request with the same key and body gets the "
      "resource of the first, while it exists",
      is_made_once,
      "{\"type\":\"string\",\"pattern\":\"^[ \\\\t]*(\\\"[ !#-\\\\[\\\\]-~]{1,128}\\\"|[!#-+\\\\-"
      "-\\\\[\\\\]-~]([ !#-+\\\\--\\\\[\\\\]-~]{0,126}[!#-+\\\\--\\\\[\\\\]-~])?)[ \\\\t]*$\"}" },
    { "Prefer", "return=minimal (RFC 7240): the answer is the revision alone", may_say_little },
};

bool kd_openapi_is_asked_by_header(const struct kd_route *route, unsigned method)
{
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++)
        if (asked[i].of(route, method))
            return true;
    return false;
}

void kd_openapi_asked_headers(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        if (!asked[i].of(route, method))
            continue;
        kd_json_object(json, NULL);
        kd_json_string(json, "name", asked[i].name);
        kd_json_string(json, "in", "header");
        kd_json_string(json, "description", asked[i].help);
        kd_schema_text(json, "schema", asked[i].schema ? asked[i].schema : TEXT);
        kd_json_end(json);
    }
}

static void refer(struct kd_json *json, const char *name, size_t n)
{
    char member[40], reference[80];
    snprintf(member, sizeof member, "%.*s", (int)n, name);
    snprintf(reference, sizeof reference, "{\"$ref\":\"#/components/headers/%s\"}", member);
    kd_schema_text(json, member, reference);
}

static void refer_all(struct kd_json *json, const char *names)
{
    for (size_t n; *names; names += n + strspn(names + n, " "))
        refer(json, names, n = strcspn(names, " "));
}

static const char *names_of(const struct kd_route *route, unsigned method, unsigned status)
{
    for (size_t i = 0; i < sizeof route->tells / sizeof *route->tells; i++)
        if (route->tells[i].status == status && kd_route_for(route->tells[i].methods, method))
            return route->tells[i].headers;
    return NULL;
}

static bool has_former_names(const struct kd_route *route, unsigned method)
{
    for (const struct kd_query *query = route->queries; query && query->name; query++)
        if (query->was && kd_route_for(query->methods, method))
            return true;
    return false;
}

void kd_openapi_headers(struct kd_json *json, const struct kd_route *route, unsigned method, unsigned status)
{
    const char *names = names_of(route, method, status);
    const bool made = status == 201 || status == 202, part = status == 206;
    const bool whole = status == 200 && route->status[1] == 304,
               kept = status == 304 || part || (whole && !route->changes);
    kd_json_object(json, "headers");
    refer_all(json, EVERY);
    if (made)
        refer_all(json, "Location");
    if (kept)
        refer_all(json, "ETag");
    else if (whole)
        kd_schema_text(
            json, "ETag",
            "{\"description\":\"for If-None-Match; streams, tables and unfinished frames have none\",\"schema\":" TEXT
            "}");
    if (part)
        refer_all(json, "Content-Range Content-Disposition");
    if (part || (status == 200 && sends_parts(route, method)))
        refer_all(json, "Accept-Ranges Repr-Digest");
    if (status == 200 && sends_parts(route, method))
        refer_all(json, "Content-Digest");
    if (names)
        refer_all(json, names);
    if (has_former_names(route, method))
        refer_all(json, "Deprecation Link");
    kd_json_end(json);
}

void kd_openapi_problem_headers(struct kd_json *json, unsigned status)
{
    const char *names = status == 401                                                      ? "WWW-Authenticate"
                        : status == 405                                                    ? "Allow"
                        : status == 416                                                    ? "Content-Range"
                        : status == 409 || status == 429 || status == 503 || status == 507 ? "Retry-After"
                                                                                           : NULL;
    kd_json_object(json, "headers");
    refer_all(json, EVERY);
    if (names)
        refer_all(json, names);
    kd_json_end(json);
}

void kd_openapi_header_components(struct kd_json *json)
{
    kd_json_object(json, "headers");
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        kd_json_object(json, headers[i].name);
        kd_json_string(json, "description", headers[i].help);
        if (headers[i].required)
            kd_json_bool(json, "required", true);
        kd_schema_text(json, "schema", headers[i].schema);
        kd_json_end(json);
    }
    kd_json_end(json);
}
