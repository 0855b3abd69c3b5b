#include "server/openapi/sessions.h"

#include "render/output/particle_list.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"
#include "server/openapi/timeline.h"
#include "server/session/sessions.h"

#include <string.h>

/* Writes the schemas of a session's answers. They include the token, which is sent only to the client that has
 * created the session. */
void kd_openapi_session_schemas(struct kd_json *json)
{
    static const struct kd_openapi_member emitter[] = {
        { "name", KD_SCHEMA_TEXT, false },  { "title", KD_SCHEMA_TEXT, false },   { "at", KD_SCHEMA_TEXT, false },
        { "apart", KD_SCHEMA_BOOL, false }, { "sentence", KD_SCHEMA_TEXT, true },
    };
    static const struct kd_openapi_member path[] = { { "at", KD_SCHEMA_NUMBER, false },
                                                     { "end", KD_SCHEMA_NUMBER, false } };
    static const struct kd_openapi_member progress[] = { { "fraction", KD_SCHEMA_NUMBER, false },
                                                         { "remaining_s", KD_SCHEMA_NUMBER_OR_NULL, false } };
    static const struct kd_openapi_member clock[] = {
        { "proper_time_to_horizon", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "proper_time_to_end", KD_SCHEMA_NUMBER, false },
        { "proper_time_to_horizon_s", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "proper_time_to_end_s", KD_SCHEMA_NUMBER, false },
    };
    static const struct kd_openapi_member session[] = {
        { "id", KD_SCHEMA_TEXT, false },
        { "token", KD_SCHEMA_TEXT, true },
        { "revision", KD_SCHEMA_COUNT, false },
        { "frame", KD_SCHEMA_COUNT, false },
        { "viewers", KD_SCHEMA_COUNT, false },
        { "scene", KD_SCHEMA_REF("Scene"), false },
        { "varies", KD_SCHEMA_LIST(KD_SCHEMA_REF("SessionVaries")), false },
        { "emitters", KD_SCHEMA_LIST(KD_SCHEMA_REF("EmitterTold")), false },
        { "path", KD_SCHEMA_REF("SessionPath"), true },
        { "rendering", KD_SCHEMA_REF("SessionRendering"), true },
        { "refining", KD_SCHEMA_REF("SessionRefining"), true },
        { "clock", KD_SCHEMA_REF("FallClock"), true },
        { "order", KD_SCHEMA_COUNT, true },
    };
    static const struct kd_openapi_member patched[] = { { "revision", KD_SCHEMA_COUNT, false },
                                                        { "order", KD_SCHEMA_COUNT, true } };
    kd_schema_enum(json, "SessionVaries", kd_session_varies_word);
    KD_OPENAPI_STRICT(json, "EmitterTold", emitter);
    KD_OPENAPI_TOLD(json, "SessionPath", "times in seconds", path);
    KD_OPENAPI_TOLD(json, "SessionRendering", "times in seconds", progress);
    KD_OPENAPI_TOLD(json, "SessionRefining", "times in seconds", progress);
    KD_OPENAPI_TOLD(json, "FallClock", "in M, and in seconds where a name ends in _s", clock);
    KD_OPENAPI_STRICT(json, "Session", session);
    KD_OPENAPI_STRICT(json, "SessionPatched", patched); /* the answer to PATCH with Prefer: return=minimal */
}

void kd_openapi_strike_body(struct kd_json *json, const struct kd_route *route)
{
    (void)route;
    static const char body[] = "{\"required\":false,\"content\":{\"application/"
                               "json\":{\"schema\":{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{"
                               "\"amplitude\":{\"type\":\"number\",\"minimum\":0,\"maximum\":1,\"description\":\"new "
                               "style.ringdown; default: the present value, or 1 if it is 0\"}}}}}}";
    kd_json_raw(json, "requestBody", body, sizeof body - 1);
}

const char kd_openapi_path_schema[] =
    KD_OPENAPI_OBJECT "\"required\":[\"keyframes\"],\"properties\":{" KD_OPENAPI_TIMELINE(
        "at", "{\"type\":\"number\",\"minimum\":0,\"maximum\":3600,\"description\":\"seconds from now\"}") "}}";
_Static_assert(KD_SESSION_PATH_S == 3600, "openapi.json says so");

static void begin(struct kd_json *json, const char *name, const char *help)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name);
    kd_json_string(json, "in", "query");
    kd_json_string(json, "description", help);
}

void kd_openapi_particles_parameters(struct kd_json *json, unsigned method, const struct cJSON *schema)
{
    (void)method, (void)schema;
    static const struct {
        const char *name, *help, *schema;
    } known[] = {
        { "first", "number of the first particle; default 0", "{\"type\":\"integer\",\"minimum\":0}" },
        { "stride", "step from one particle number to the next; default 1", "{\"type\":\"integer\",\"minimum\":1}" },
        { "count", "number of particles; default: all", "{\"type\":\"integer\",\"minimum\":1}" },
        { "time", "time in M; default: the session's present time",
          "{\"type\":\"number\",\"minimum\":-1e12,\"maximum\":1e12}" },
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        begin(json, known[i].name, known[i].help);
        kd_json_raw(json, "schema", known[i].schema, strlen(known[i].schema));
        kd_json_end(json);
    }
    begin(json, "fields", "columns of a row; default x,y,z");
    kd_json_string(json, "style", "form");
    kd_json_bool(json, "explode", false);
    kd_json_object(json, "schema");
    kd_json_string(json, "type", "array");
    kd_json_bool(json, "uniqueItems", true);
    kd_json_object(json, "items");
    kd_json_array(json, "enum");
    for (int i = 0; i < KD_PARTICLE_N_COLUMNS; i++)
        kd_json_string(json, NULL, kd_particle_column_name((enum kd_particle_column)i));
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
}
