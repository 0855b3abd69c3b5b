#include "server/openapi/orbits.h"

#include "orbit/schema.h"

void kd_openapi_orbits_schema(struct kd_json *json)
{
    kd_orbit_schemas(json);
    kd_orbit_request_schema(json, "OrbitsRequest");
    kd_orbit_answer_schemas(json);
}
