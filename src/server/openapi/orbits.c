#include "server/openapi/orbits.h"

#include "orbit/schema.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"

void kd_openapi_orbits_body(struct kd_json *json)
{
    static const char request[] = KD_SCHEMA_REF("OrbitsRequest");
    kd_openapi_body(json, request, sizeof request - 1, NULL);
}

void kd_openapi_orbits_schema(struct kd_json *json)
{
    kd_orbit_schemas(json);
    kd_orbit_request_schema(json, "OrbitsRequest");
    kd_orbit_answer_schemas(json);
}

void kd_openapi_orbits_answer(struct kd_json *json)
{
    static const char answer[] = "{\"oneOf\":[" KD_SCHEMA_REF("OrbitPath") "," KD_SCHEMA_REF("OrbitPaths") "]}";
    static const char *const others[] = { "application/x-ndjson", "text/csv", "application/x-npy" };
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    for (int i = 0; i < 3; i++)
        kd_openapi_media(json, others[i], "", 0);
}
