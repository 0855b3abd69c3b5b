/* The service described by itself: OpenAPI 3.1 from the route table, the scene's schema and the problem
 * table. */
#include "server/openapi_jobs.h"
#include "server/openapi_orbits.h"
#include "server/openapi_physics.h"
#include "server/openapi_rays.h"
#include "server/openapi_sessions.h"
#include "server/reply.h"
#include "server/request.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

static cJSON *reference(const char *to)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "$ref", to);
    return o;
}

static cJSON *content(const char *type, cJSON *schema)
{
    cJSON *o = cJSON_CreateObject(), *media = cJSON_AddObjectToObject(o, type);
    cJSON_AddItemToObject(media, "schema", schema);
    return o;
}

static void add_parameter(cJSON *list, const char *in, const char *name, bool required, cJSON *schema)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "name", name);
    cJSON_AddStringToObject(o, "in", in);
    if (required)
        cJSON_AddTrueToObject(o, "required");
    cJSON_AddItemToObject(o, "schema", schema);
    cJSON_AddItemToArray(list, o);
}

static cJSON *string_type(void)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "type", "string");
    return o;
}

/* Every scalar of the schema by its dotted path. */
static void add_fields(cJSON *list, const cJSON *schema, const char *prefix)
{
    const cJSON *property;
    cJSON_ArrayForEach(property, cJSON_GetObjectItemCaseSensitive(schema, "properties"))
    {
        char name[128];
        snprintf(name, sizeof name, "%s%s%s", prefix, *prefix ? "." : "", property->string);
        if (cJSON_GetObjectItemCaseSensitive(property, "properties"))
            add_fields(list, property, name);
        else
            add_parameter(list, "query", name, false, cJSON_Duplicate(property, true));
    }
}

static void add_parameters(cJSON *operation, const struct kd_route *route, bool post, const cJSON *schema)
{
    cJSON *list = cJSON_CreateArray();
    const char *brace = strchr(route->path, '{');

    if (brace) {
        char name[20];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(brace + 1, "}"), brace + 1);
        add_parameter(list, "path", name, true, string_type());
    }
    if (route->takes == KD_TAKES_SCENE && !(route->methods & KD_PATCH)) {
        add_parameter(list, "query", "preset", false, string_type());
        if (!post)
            add_fields(list, schema, "");
    }
    if (route->takes == KD_TAKES_JOB)
        add_parameter(list, "query", "preset", false, string_type());
    if (route->takes == KD_TAKES_RAYS)
        kd_openapi_rays_parameters(list);
    if (route->takes == KD_TAKES_PARTICLES)
        kd_openapi_particles_parameters(list);
    if (cJSON_GetArraySize(list))
        cJSON_AddItemToObject(operation, "parameters", list);
    else
        cJSON_Delete(list);
}

static void add_body(cJSON *operation, unsigned method)
{
    cJSON *body = cJSON_AddObjectToObject(operation, "requestBody");
    cJSON_AddTrueToObject(body, "required");
    cJSON *media = content("application/json", reference("#/components/schemas/Scene"));
    if (method == KD_PATCH)
        cJSON_AddItemToObject(cJSON_AddObjectToObject(media, KD_PATCH_TYPE), "schema", reference("#/components/schemas/Scene"));
    cJSON_AddItemToObject(body, "content", media);
}

static cJSON *add_response(cJSON *responses, unsigned status, const char *description)
{
    char number[12];
    snprintf(number, sizeof number, "%u", status);
    cJSON *o = cJSON_AddObjectToObject(responses, number);
    cJSON_AddStringToObject(o, "description", description);
    return o;
}

static void add_answer(cJSON *operation, cJSON *ok, const struct kd_route *route)
{
    char type[64];
    snprintf(type, sizeof type, "%.*s", (int)strcspn(route->answer, ";"), route->answer);
    if (route->takes == KD_TAKES_RAYS)
        kd_openapi_rays_bodies(operation, ok);
    else if (route->takes == KD_TAKES_ORBITS)
        kd_openapi_orbits_bodies(operation, ok);
    else if (route->takes == KD_TAKES_JOB)
        kd_openapi_jobs_bodies(operation, ok);
    else
        cJSON_AddItemToObject(ok, "content", content(type, cJSON_CreateObject()));
}

static cJSON *operation(const struct kd_route *route, unsigned method, const cJSON *schema)
{
    cJSON *o = cJSON_CreateObject();
    bool body = method == KD_POST || method == KD_PATCH;
    cJSON_AddStringToObject(o, "summary", route->summary);
    add_parameters(o, route, body, schema);
    if (body && route->takes == KD_TAKES_SCENE)
        add_body(o, method);
    if (route->takes == KD_TAKES_STRIKE)
        kd_openapi_strike_body(o);
    cJSON *responses = cJSON_AddObjectToObject(o, "responses");
    if (method == KD_DELETE)
        add_response(responses, 204, route->summary);
    else
        add_answer(o, add_response(responses, route->status[0] ? route->status[0] : 200, route->summary), route);
    if (method != KD_DELETE && route->status[1])
        add_response(responses, route->status[1], route->status[1] == 304 ? "What If-None-Match names" : route->summary);
    cJSON_AddItemToObject(responses, "default", reference("#/components/responses/Problem"));
    return o;
}

static cJSON *problem_schema(void)
{
    static const char *const texts[] = { "type", "title", "detail", "pointer", "offered" };
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "type", "object");
    cJSON *properties = cJSON_AddObjectToObject(o, "properties");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        cJSON_AddItemToObject(properties, texts[i], string_type());
    cJSON_AddStringToObject(cJSON_AddObjectToObject(properties, "status"), "type", "integer");
    return o;
}

static void add_components(cJSON *root, cJSON *schema)
{
    cJSON *components = cJSON_AddObjectToObject(root, "components");
    cJSON *schemas = cJSON_AddObjectToObject(components, "schemas");
    cJSON_AddItemToObject(schemas, "Scene", schema);
    cJSON_AddItemToObject(schemas, "Problem", problem_schema());
    cJSON *responses = cJSON_AddObjectToObject(components, "responses");
    cJSON *problem = cJSON_AddObjectToObject(responses, "Problem");
    cJSON_AddStringToObject(problem, "description", "What went wrong (RFC 9457)");
    cJSON_AddItemToObject(problem, "content",
                          content("application/problem+json", reference("#/components/schemas/Problem")));
}

static cJSON *document(cJSON *schema)
{
    static const struct { const char *name; unsigned bit; } methods[] = {
        { "get", KD_GET }, { "post", KD_POST }, { "patch", KD_PATCH }, { "delete", KD_DELETE },
    };
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "openapi", "3.1.0");
    cJSON *info = cJSON_AddObjectToObject(root, "info");
    cJSON_AddStringToObject(info, "title", "kerrd");
    cJSON_AddStringToObject(info, "version", KD_VERSION);
    cJSON *paths = cJSON_AddObjectToObject(root, "paths");
    for (size_t i = 0; i < kd_n_routes; i++) {
        const struct kd_route *route = &kd_routes[i];
        if (route->takes == KD_TAKES_QUANTITY) {
            kd_openapi_physics_paths(paths);
            continue;
        }
        cJSON *item = cJSON_AddObjectToObject(paths, route->path);
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
            if (route->methods & methods[k].bit)
                cJSON_AddItemToObject(item, methods[k].name, operation(route, methods[k].bit, schema));
    }
    add_components(root, schema);
    return root;
}

enum MHD_Result kd_handle_openapi(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    enum kd_status status = kd_scene_schema(&json);
    cJSON *schema = status ? NULL : cJSON_ParseWithLength((const char *)json.data, json.size);
    kd_buffer_finish(&json);
    if (!schema)
        return kd_reply_json(request, KD_ENOMEM, &json, "");
    cJSON *root = document(schema);
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    status = text ? kd_buffer_printf(&json, "%s\n", text) : KD_ENOMEM;
    cJSON_free(text);
    return kd_reply_json(request, status, &json, request->route->answer);
}
