/* Writes the OpenAPI 3.1 document from the route table, the scene's schema and the problem table. */
#include "server/openapi/openapi.h"
#include "server/http/served.h"
#include "server/job/formats.h"
#include "server/openapi/access.h"
#include "server/openapi/assets.h"
#include "server/openapi/fields.h"
#include "server/openapi/headers.h"
#include "server/openapi/integrals.h"
#include "server/openapi/jobs.h"
#include "server/openapi/lessons.h"
#include "server/openapi/media.h"
#include "server/openapi/orbits.h"
#include "server/openapi/physics.h"
#include "server/openapi/pixel.h"
#include "server/openapi/playground.h"
#include "server/openapi/problems.h"
#include "server/openapi/rays.h"
#include "server/openapi/reports.h"
#include "server/openapi/responses.h"
#include "server/openapi/sessions.h"
#include "server/openapi/share.h"
#include "server/openapi/strict.h"
#include "server/playground/sessions.h"
#include "server/http/query.h"
#include "server/http/request.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

/* Parameters of the document. */
struct subject {
    const char *base_path;
    const cJSON *schema; /* schema of a scene */
    bool closed;         /* the server has a token file */
};

static void add_reference(struct kd_json *json, const char *name, const char *to)
{
    kd_json_object(json, name);
    kd_json_string(json, "$ref", to);
    kd_json_end(json);
}

/* Writes {"TYPE": {"schema": {"$ref": TO}}}. */
static void add_content(struct kd_json *json, const char *type, const char *to)
{
    kd_json_object(json, type);
    add_reference(json, "schema", to);
    kd_json_end(json);
}

static void begin_parameter(struct kd_json *json, const char *in, const char *name)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name);
    kd_json_string(json, "in", in);
}

static void add_preset_schema(struct kd_json *json)
{
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; i < kd_scene_preset_count(); i++)
        kd_json_string(json, NULL, kd_scene_preset_name(i));
    kd_json_end(json);
    kd_json_end(json);
}

static void add_preset_parameter(struct kd_json *json)
{
    begin_parameter(json, "query", "preset");
    add_preset_schema(json);
    kd_json_end(json);
}

/* Writes the schema of a file's name below the folder in the route. */
static void add_file_schema(struct kd_json *json, const char *path)
{
    size_t skip = strlen("/web/"), n = strcspn(path, "{") - skip;
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; i < kd_n_page_files; i++)
        if (!strncmp(kd_page_files[i].name, path + skip, n) && !strchr(kd_page_files[i].name + n, '/'))
            kd_json_string(json, NULL, kd_page_files[i].name + n);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_path_parameter(struct kd_json *json, const char *path)
{
    static const char id[] = "{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{16}$\"}";
    static const char hash[] = "{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{64}$\"}";
    const char *brace = strchr(path, '{');
    char name[20];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(brace + 1, "}"), brace + 1);
    begin_parameter(json, "path", name);
    kd_json_bool(json, "required", true);
    if (!strcmp(name, "id"))
        kd_json_raw(json, "schema", id, sizeof id - 1);
    else if (!strcmp(name, "sha256"))
        kd_json_raw(json, "schema", hash, sizeof hash - 1);
    else if (!strcmp(name, "code"))
        kd_json_raw(json, "schema", KD_OPENAPI_CODE, sizeof KD_OPENAPI_CODE - 1);
    else if (!strncmp(path, "/web/", 5))
        add_file_schema(json, path);
    else
        add_preset_schema(json);
    kd_json_end(json);
}

#define INT "{\"type\":\"integer\",\"minimum\":0,\"maximum\":999999999999999999}" /* range of kd_target_number */
#define PART "{\"type\":\"number\",\"minimum\":" KD_SCHEMA_DIGITS(KD_LEAST_MIN) ",\"maximum\":1}"
#define PACE_MS \
    "{\"type\":\"number\",\"minimum\":" KD_SCHEMA_DIGITS(KD_PATIENCE_MS_MIN) ",\"maximum\":" KD_SCHEMA_DIGITS( \
        KD_PATIENCE_MS_MAX) "}"
#define ORDER \
    "order", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":" KD_SCHEMA_DIGITS(KD_ORDER_MAX) "}", \
        "order of concurrent patches: the highest number counts, and a patch that arrives after a higher one has no " \
        "effect"
#define LEAST \
    "least", PART, "smallest width of a frame while the scene changes, as a fraction of image.width; default 0.25"
#define PATIENCE \
    "patience_ms", PACE_MS, "limit of a frame's time in ms: frames that take longer are made narrower than least"
#define MOMENT "{\"type\":\"integer\",\"minimum\":0,\"maximum\":" KD_SCHEMA_DIGITS(KD_WAIT_MS_MAX) "}"

#define ROOM(least, most) \
    "{\"type\":\"integer\",\"minimum\":" KD_SCHEMA_DIGITS(least) ",\"maximum\":" KD_SCHEMA_DIGITS(most) "}"

/* Query parameters that are not fields of a scene. schema NULL: the names of the formats of the
 * route's answers. */
static const struct {
    const char *path, *name, *schema, *help;
    unsigned methods; /* methods that accept the parameter; 0: all methods of the route */
    bool required;
} queries[] = {
    { "/v1/sessions", LEAST },
    { "/v1/sessions", PATIENCE },
    { "/v1/sessions/{id}", LEAST, KD_PATCH },
    { "/v1/sessions/{id}", PATIENCE, KD_PATCH },
    { "/v1/sessions/{id}/frame.png", "after", INT, "number of the client's last frame; default 0" },
    { "/v1/sessions/{id}/frame.png", "wait_ms", MOMENT, "time in ms to wait for a newer one" },
    { "/v1/sessions/{id}", ORDER, KD_PATCH },
    { "/v1/sessions/{id}/frame", ORDER, KD_PATCH },
    { "/v1/sessions/{id}/frame", "after", INT, "number of the client's last frame; default 0" },
    { "/v1/sessions/{id}/frame", "wait_ms", MOMENT, "time in ms to wait for a newer one" },
    { "/v1/sessions/{id}/frame", "lossy",
      "{\"type\":\"integer\",\"minimum\":1,\"maximum\":" KD_SCHEMA_DIGITS(KD_LOSSY_MAX) "}",
      "quality of JPEG for frames before the last; without it all frames are PNG" },
    { "/v1/sessions/{id}/frame", "sentences",
      "{\"type\":\"integer\",\"minimum\":0,\"maximum\":" KD_SCHEMA_DIGITS(KD_SENTENCES_MAX) "}",
      "Kerrd-Sentences of the client's frame; a newer frame with the same approximations omits them" },
    { "/v1/playground/{id}/frame.png", "after", INT, "number of the client's last frame; default 0" },
    { "/v1/playground/{id}/frame.png", "wait_ms", MOMENT, "time in ms to wait for a newer one" },
    { "/v1/playground/{id}/bodies", "after", INT,
      "generation of the client's data; without it the answer is immediate" },
    { "/v1/playground/{id}/bodies", "wait_ms", MOMENT, "time in ms to wait for a newer one" },
    { "/v1/playground/{id}/debris", "after", INT,
      "generation of the client's data; without it the answer is immediate" },
    { "/v1/playground/{id}/debris", "wait_ms", MOMENT, "time in ms to wait for a newer one" },
    { "/v1/playground/{id}/debris", "at_most", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":1000000}",
      "largest number of pieces; of more, the answer has every k-th; default 20000" },
    { "/v1/playground/{id}/events", "since", INT,
      "number of the event after which the stream begins, like Last-Event-ID; default: all stored events" },
    { "/v1/pixel", "at", "{\"type\":\"string\",\"pattern\":\"^" KD_OPENAPI_DECIMAL "," KD_OPENAPI_DECIMAL "$\"}",
      "position X,Y of the pixel, in pixels from the upper left corner", 0, true },
    { "/v1/pixel", "trace", "{\"const\":\"steps\"}", "steps: the answer has the engine's steps along the middle ray" },
    { "/v1/render", "format", NULL, "format of the picture, instead of Accept" },
    { "/v1/render", "quality", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":" KD_SCHEMA_DIGITS(KD_QUALITY_MAX) "}",
      "quality of a jpg or webp; without format the answer is then one of these two; default 90" },
    { "/v1/render", "v", "{\"type\":\"string\",\"minLength\":1,\"maxLength\":" KD_SCHEMA_DIGITS(KD_VERSION_LETTERS) "}",
      "version for which the address was made: if it is this server's, and the scene names no asset, caches may keep "
      "the picture for a year" },
    { "/v1/share/{code}/picture.png", "width", ROOM(64, 1200),
      "width in pixels, from which the height follows; default 1200" },
    { "/oembed", "url", "{\"type\":\"string\",\"format\":\"uri\"}", "the address of a shared scene", 0, true },
    { "/oembed", "maxwidth", ROOM(64, 1000000), "available width in pixels" },
    { "/oembed", "maxheight", ROOM(34, 1000000), "likewise" },
    { "/oembed", "format", "{\"const\":\"json\"}", "format of the answer; only json" },
    { "/v1/jobs/{id}/result", "format", NULL,
      "json and csv: a light curve; fits and npz without frame: the cube of a sweep; mp4 and webm: a film of pictures, "
      "by the program ffmpeg; the others: pictures or files of numbers" },
    { "/v1/jobs/{id}/result", "frame", INT,
      "number of a single frame, with format=png, fits, npz, npy or exr; with format=stream, number of the first "
      "frame" },
    { "/v1/jobs/{id}/result", "rate", "{\"type\":\"integer\",\"minimum\":1,\"maximum\":120}",
      "frames a second, with format=mp4 or webm; default 24" },
};

_Static_assert(KD_PLAYGROUND_DEBRIS_MAX == 1000000 && KD_PLAY_DEBRIS == 20000, "the row of at_most says so");

static bool has_query(const struct kd_route *route)
{
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++)
        if (!strcmp(queries[i].path, route->path))
            return true;
    return false;
}

static void add_format_schema(struct kd_json *json, enum kd_gives gives)
{
    struct kd_job_format format;
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; gives == KD_GIVES_PICTURE && i < kd_n_formats; i++)
        kd_json_string(json, NULL, kd_formats[i]->name);
    for (size_t i = 0; gives == KD_GIVES_RESULT && kd_job_format(i, &format); i++)
        kd_json_string(json, NULL, format.name);
    kd_json_end(json);
    kd_json_end(json);
}

static void add_query(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++) {
        if (strcmp(queries[i].path, route->path) || (queries[i].methods && !(queries[i].methods & method)))
            continue;
        begin_parameter(json, "query", queries[i].name);
        kd_json_string(json, "description", queries[i].help);
        if (queries[i].required)
            kd_json_bool(json, "required", true);
        if (queries[i].schema)
            kd_json_raw(json, "schema", queries[i].schema, strlen(queries[i].schema));
        else
            add_format_schema(json, route->gives);
        kd_json_end(json);
    }
}

static bool has_parameters(const struct kd_route *route, unsigned method)
{
    return kd_openapi_is_asked_by_header(route, method) || strchr(route->path, '{') ||
           (route->takes == KD_TAKES_SCENE && !(route->methods & KD_PATCH)) || route->takes == KD_TAKES_JOB ||
           route->takes == KD_TAKES_PLAN || route->takes == KD_TAKES_RAYS || route->takes == KD_TAKES_PARTICLES ||
           has_query(route);
}

static void add_parameters(struct kd_json *json, const struct kd_route *route, unsigned method, const cJSON *schema)
{
    kd_json_array(json, "parameters");
    if (strchr(route->path, '{'))
        add_path_parameter(json, route->path);
    add_query(json, route, method);
    kd_openapi_asked_headers(json, route, method);
    if (route->takes == KD_TAKES_SCENE && !(route->methods & KD_PATCH)) {
        add_preset_parameter(json);
        if (method != KD_POST)
            kd_openapi_field_parameters(json, schema);
    }
    if (route->takes == KD_TAKES_JOB || route->takes == KD_TAKES_PLAN)
        add_preset_parameter(json);
    if (route->takes == KD_TAKES_RAYS)
        kd_openapi_rays_parameters(json);
    if (route->takes == KD_TAKES_PARTICLES)
        kd_openapi_particles_parameters(json);
    kd_json_end(json);
}

static void add_scene_body(struct kd_json *json, unsigned method)
{
    kd_json_object(json, "requestBody");
    kd_json_bool(json, "required", true);
    kd_json_object(json, "content");
    add_content(json, "application/json", "#/components/schemas/Scene");
    if (method == KD_PATCH)
        add_content(json, KD_PATCH_TYPE, "#/components/schemas/Scene");
    kd_json_end(json);
    kd_json_end(json);
}

static void add_body(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    switch (route->takes) {
    case KD_TAKES_SCENE:
        if (method == KD_POST || method == KD_PATCH)
            add_scene_body(json, method);
        break;
    case KD_TAKES_RAYS: kd_openapi_rays_body(json); break;
    case KD_TAKES_ORBITS: kd_openapi_orbits_body(json); break;
    case KD_TAKES_INTEGRAL: kd_openapi_integral_body(json, route->path); break;
    case KD_TAKES_JOB: kd_openapi_jobs_body(json); break;
    case KD_TAKES_PLAN: kd_openapi_plan_body(json); break;
    case KD_TAKES_LESSON:
        if (method == KD_POST || method == KD_PATCH)
            kd_openapi_lesson_body(json, method == KD_PATCH);
        break;
    case KD_TAKES_HAND: kd_openapi_hand_body(json); break;
    case KD_TAKES_STRIKE: kd_openapi_strike_body(json); break;
    case KD_TAKES_PLAYGROUND:
        if (method == KD_POST || method == KD_PATCH)
            kd_openapi_playground_body(json, method == KD_PATCH, KD_PATCH_TYPE);
        break;
    case KD_TAKES_STEP: kd_openapi_step_body(json); break;
    case KD_TAKES_PATH:
        if (method == KD_POST)
            kd_openapi_path_body(json);
        break;
    case KD_TAKES_ASSET:
        if (method == KD_PUT)
            kd_openapi_asset_body(json);
        break;
    default: break;
    }
}

static void add_operation(struct kd_json *json, const char *name, const struct kd_route *route, unsigned method,
                          const struct subject *subject)
{
    char id[80];
    kd_openapi_operation_id(id, sizeof id, name, route->path);
    kd_json_object(json, name);
    kd_json_string(json, "operationId", id);
    kd_json_string(json, "summary", route->summary);
    kd_openapi_access_operation(json, route, method, subject->closed);
    if (has_parameters(route, method))
        add_parameters(json, route, method, subject->schema);
    add_body(json, route, method);
    kd_openapi_responses(json, route, method);
    kd_json_end(json);
}

static void add_components(struct kd_json *json, const cJSON *fields, const struct kd_buffer *schema)
{
    kd_json_object(json, "components");
    kd_openapi_access_schemes(json);
    kd_json_object(json, "schemas");
    kd_json_raw(json, "Scene", (const char *)schema->data, schema->size);
    kd_openapi_field_paths(json, fields);
    kd_openapi_rays_schemas(json);
    kd_openapi_orbits_schema(json);
    kd_openapi_integral_schemas(json);
    kd_openapi_playground_schemas(json);
    kd_openapi_asset_schema(json);
    kd_openapi_report_schemas(json);
    kd_openapi_pixel_schemas(json);
    kd_openapi_share_schemas(json);
    kd_openapi_session_schemas(json);
    kd_openapi_lesson_schema(json);
    kd_openapi_job_schema(json);
    kd_openapi_problem_schema(json);
    kd_json_end(json);
    kd_openapi_header_components(json);
    kd_openapi_problem_responses(json);
    kd_json_end(json);
}

static void add_path(struct kd_json *json, const struct kd_route *route, const struct subject *subject)
{
    kd_json_object(json, route->path);
    for (size_t k = 0; k < KD_METHODS; k++)
        if (route->methods & kd_methods[k].bit)
            add_operation(json, kd_methods[k].lower, route, kd_methods[k].bit, subject);
    kd_json_end(json);
}

static enum kd_status document(const struct subject *subject, const struct kd_buffer *schema_text,
                               struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "openapi", "3.1.0");
    kd_json_object(&json, "info");
    kd_json_string(&json, "title", "kerrd");
    kd_json_string(&json, "version", KD_VERSION);
    kd_json_end(&json);
    kd_json_array(&json, "servers");
    kd_json_object(&json, NULL);
    kd_json_string(&json, "url", *subject->base_path ? subject->base_path : ".");
    kd_json_end(&json);
    kd_json_end(&json);
    kd_openapi_access_default(&json, subject->closed);
    kd_json_object(&json, "paths");
    for (size_t i = 0; i < kd_n_routes; i++)
        if (kd_routes[i].takes == KD_TAKES_QUANTITY)
            kd_openapi_physics_paths(&json, &kd_routes[i]);
        else
            add_path(&json, &kd_routes[i], subject);
    kd_json_end(&json);
    add_components(&json, subject->schema, schema_text);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

enum kd_status kd_openapi_json(const char *base_path, bool closed, struct kd_buffer *out)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_scene_schema(&text);
    cJSON *schema = status ? NULL : cJSON_ParseWithLength((const char *)text.data, text.size);
    if (!status)
        status = schema ? document(&(struct subject) { base_path, schema, closed }, &text, out) : KD_ENOMEM;
    cJSON_Delete(schema);
    kd_buffer_finish(&text);
    return status;
}
