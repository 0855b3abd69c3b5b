#include "server/openapi/orbits.h"

#include "orbit/schema.h"
#include "server/openapi/media.h"

#define BOOLEAN "{\"type\":\"boolean\"}"
#define SPIN "\"spin\":{\"type\":\"number\",\"exclusiveMinimum\":-1,\"exclusiveMaximum\":1}"
static const char answer[] =
    "{\"type\":\"object\",\"properties\":{" SPIN ",\"fate\":{\"enum\":[\"bound\",\"plunge\",\"escape\"]},\"circular\":" BOOLEAN
    ",\"constants\":{\"type\":\"object\"},\"turning_points\":{\"type\":\"object\"},\"shape\":{\"type\":\"object\"}"
    ",\"frequencies\":{\"type\":\"object\"},\"advance\":{\"type\":\"object\"},\"series\":{\"type\":\"object\",\"properties\":{"
    "\"columns\":{\"type\":\"array\",\"items\":{\"type\":\"string\"}},\"rows\":{\"type\":\"array\",\"items\":{\"type\":\"array\","
    "\"items\":{\"type\":[\"number\",\"null\"]}}}}},\"result\":{\"type\":\"object\"},\"orbits\":{\"type\":\"array\",\"items\":{\"type\":\"object\"}}}}";

void kd_openapi_orbits_body(struct kd_json *json)
{
    kd_openapi_body_begin(json);
    kd_json_object(json, "application/json");
    kd_orbit_request_schema(json, "schema", "{\"$ref\":\"#/components/schemas/Orbit\"}");
    kd_json_end(json);
    kd_openapi_body_end(json);
}

void kd_openapi_orbits_schema(struct kd_json *json)
{
    kd_orbit_schema(json, "Orbit");
}

void kd_openapi_orbits_answer(struct kd_json *json)
{
    static const char *const others[] = { "application/x-ndjson", "text/csv", "application/x-npy" };
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    for (int i = 0; i < 3; i++)
        kd_openapi_media(json, others[i], "", 0);
}
