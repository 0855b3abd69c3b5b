#include "server/openapi/orbits.h"

#include "orbit/request.h"
#include "server/openapi/media.h"

#define NUMBER "{\"type\":\"number\"}"
#define BOOLEAN "{\"type\":\"boolean\"}"
#define SPIN "\"spin\":{\"type\":\"number\",\"exclusiveMinimum\":-1,\"exclusiveMaximum\":1}"
#define RANGE(least, most) "{\"type\":\"number\",\"minimum\":" least ",\"maximum\":" most "}"
/* A horizon is above 1 M whatever the spin: 1 + sqrt(1 - a^2), Bardeen, Press & Teukolsky 1972. */
#define RADIUS "{\"type\":\"number\",\"exclusiveMinimum\":1,\"maximum\":1e20}"
#define OBJECT "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{"
#define NEEDS(names) "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[" names "],\"properties\":{" SPIN ","
#define BETA RANGE("-1", "1")

#define SHAPE NEEDS("\"p\",\"e\"") "\"p\":" RADIUS ",\"e\":{\"type\":\"number\",\"minimum\":0,\"exclusiveMaximum\":1}," \
    "\"inclination_deg\":" RANGE("0", "180") "}}"
#define CONSTANTS NEEDS("\"energy\",\"angular_momentum\"") "\"energy\":" RANGE("-1e6", "1e6") \
    ",\"angular_momentum\":" RANGE("-1e20", "1e20") ",\"carter\":" RANGE("0", "1e30") ",\"r\":" RADIUS ",\"outward\":" BOOLEAN "}}"
#define STATE NEEDS("\"position\"") "\"position\":{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"r\"]," \
    "\"properties\":{\"r\":" RADIUS ",\"theta_deg\":" RANGE("0", "180") ",\"phi_deg\":" RANGE("-360", "360") "}}," \
    "\"velocity\":" OBJECT "\"frame\":{\"enum\":[\"static\",\"zamo\"]},\"v_r\":" BETA ",\"v_theta\":" BETA ",\"v_phi\":" BETA "}}}}"
#define CASE NEEDS("\"case\"") "\"case\":{\"enum\":[\"mercury\",\"zoom-whirl\",\"plunge\",\"isco\",\"spherical\"]}}}"
static const char orbit[] = "{\"oneOf\":[" SHAPE "," CONSTANTS "," STATE "," CASE "]}";

#define ORBIT "{\"$ref\":\"#/components/schemas/Orbit\"}"
/* Of orbit and orbits. No oneOf: generators of clients would make a union of it, and no class with the fields. */
#define ONE_OF_THEM "\"if\":{\"required\":[\"orbits\"]},\"then\":{\"not\":{\"required\":[\"orbit\"]}},\"else\":{\"required\":[\"orbit\"]}"

static const char request[] =
    "{\"type\":\"object\",\"additionalProperties\":false," ONE_OF_THEM ",\"properties\":{" SPIN ",\"orbit\":" ORBIT
    ",\"orbits\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":10000,\"items\":" ORBIT "}"
    ",\"duration\":{\"type\":\"object\",\"additionalProperties\":false,\"not\":{\"required\":[\"periods\",\"time\"]},\"properties\":{"
    "\"periods\":" RANGE("0", "1e9") ",\"time\":" RANGE("0", "1e30") "}}"
    ",\"samples\":{\"type\":\"integer\",\"minimum\":0,\"maximum\":200000,\"not\":{\"const\":1}},\"series\":" BOOLEAN
    ",\"method\":{\"enum\":[\"yoshida6\",\"rkn6\",\"closed\"]},\"steps\":{\"type\":\"integer\",\"minimum\":0,\"maximum\":100000000}"
    ",\"tolerance\":{\"type\":\"number\",\"minimum\":1e-14,\"maximum\":1e-3},\"r_max\":{\"type\":\"number\",\"minimum\":2,\"maximum\":1e6}"
    ",\"mass_msun\":" RANGE("1e-20", "1e20") "}}";

static const char answer[] =
    "{\"type\":\"object\",\"properties\":{" SPIN ",\"fate\":{\"enum\":[\"bound\",\"plunge\",\"escape\"]},\"circular\":" BOOLEAN
    ",\"constants\":{\"type\":\"object\"},\"turning_points\":{\"type\":\"object\"},\"shape\":{\"type\":\"object\"}"
    ",\"frequencies\":{\"type\":\"object\"},\"advance\":{\"type\":\"object\"},\"series\":{\"type\":\"object\",\"properties\":{"
    "\"columns\":{\"type\":\"array\",\"items\":{\"type\":\"string\"}},\"rows\":{\"type\":\"array\",\"items\":{\"type\":\"array\","
    "\"items\":{\"type\":[\"number\",\"null\"]}}}}},\"result\":{\"type\":\"object\"},\"orbits\":{\"type\":\"array\",\"items\":{\"type\":\"object\"}}}}";

_Static_assert(KD_ORBITS_MAX == 10000 && KD_ORBIT_SAMPLES_MAX == 200000, "openapi.json says so");

void kd_openapi_orbits_body(struct kd_json *json)
{
    kd_openapi_body(json, request, sizeof request - 1, NULL);
}

void kd_openapi_orbits_schema(struct kd_json *json)
{
    kd_json_raw(json, "Orbit", orbit, sizeof orbit - 1);
}

void kd_openapi_orbits_answer(struct kd_json *json)
{
    static const char *const others[] = { "application/x-ndjson", "text/csv", "application/x-npy" };
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    for (int i = 0; i < 3; i++)
        kd_openapi_media(json, others[i], "", 0);
}
