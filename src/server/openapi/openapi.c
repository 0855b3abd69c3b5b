/* Writes the OpenAPI 3.1 document from the table of routes, the schema of a scene, and the table of problems. */
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
#include "server/http/request.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

/* The parameters of the document. */
struct subject {
    const char *base_path;
    const cJSON *schema; /* schema of a scene */
    bool closed;         /* true if the server has a token file */
};

static void begin_parameter(struct kd_json *json, const char *in, const char *name)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name);
    kd_json_string(json, "in", in);
}

static void add_file_schema(struct kd_json *json)
{
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "string");
    kd_json_array(json, "enum");
    for (size_t i = 0; i < kd_n_page_files; i++)
        kd_json_string(json, NULL, kd_page_files[i].name);
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
    else if (!strcmp(name, "file"))
        add_file_schema(json);
    else
        kd_openapi_preset_schema(json);
    kd_json_end(json);
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

static void add_query(struct kd_json *json, const struct kd_query *query, enum kd_gives gives, bool was)
{
    char former[60];
    snprintf(former, sizeof former, "former name of %s", query->name);
    begin_parameter(json, "query", was ? query->was : query->name);
    kd_json_string(json, "description", was ? former : query->help);
    if (was)
        kd_json_bool(json, "deprecated", true);
    if (query->required)
        kd_json_bool(json, "required", true);
    if (query->schema)
        kd_json_raw(json, "schema", query->schema, strlen(query->schema));
    else
        add_format_schema(json, gives);
    kd_json_end(json);
}

static void add_queries(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    for (const struct kd_query *query = route->queries; query && query->name; query++)
        if (kd_route_for(query->methods, method)) {
            add_query(json, query, route->gives, false);
            if (query->was)
                add_query(json, query, route->gives, true);
        }
}

static void add_parameters(struct kd_json *json, const struct kd_route *route, unsigned method, const cJSON *schema)
{
    /* If a route also has PATCH, the body of POST holds a whole object. */
    const struct kd_taken *taken = route->methods & KD_PATCH ? &kd_taken[KD_TAKES_NOTHING] : &kd_taken[route->takes];
    const bool in_path = strchr(route->path, '{');
    if (!in_path && !route->queries && !taken->parameters && !kd_openapi_is_asked_by_header(route, method))
        return;
    kd_json_array(json, "parameters");
    if (in_path)
        add_path_parameter(json, route->path);
    add_queries(json, route, method);
    kd_openapi_asked_headers(json, route, method);
    if (taken->parameters)
        taken->parameters(json, method, schema);
    kd_json_end(json);
}

static void add_body(struct kd_json *json, const struct kd_route *route, unsigned method)
{
    const struct kd_taken *taken = &kd_taken[route->takes];
    const char *schema = method == KD_PATCH ? taken->changes : taken->schema;
    if (method == KD_GET || method == KD_DELETE)
        return;
    if (taken->body)
        taken->body(json, route);
    if (!schema && !taken->types)
        return;
    kd_openapi_body_begin(json);
    if (schema)
        kd_openapi_media(json, KD_JSON_TYPE, schema, strlen(schema));
    for (const char *at = taken->types; at && *at; at += strspn(at, " ")) {
        char type[64];
        snprintf(type, sizeof type, "%.*s", (int)strcspn(at, " "), at);
        if (strcmp(type, KD_JSON_TYPE))
            kd_openapi_media(json, type, "", 0);
        at += strlen(type);
    }
    if (method == KD_PATCH)
        kd_openapi_media(json, KD_PATCH_TYPE, schema, strlen(schema));
    kd_openapi_body_end(json);
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
