#include "server/openapi_orbits.h"

#include "orbit/request.h"
#include "server/openapi_media.h"

#define NUMBER "{\"type\":\"number\"}"
#define BOOLEAN "{\"type\":\"boolean\"}"
#define SPIN "\"spin\":{\"type\":\"number\",\"exclusiveMinimum\":-1,\"exclusiveMaximum\":1}"
#define POSITIVE "{\"type\":\"number\",\"minimum\":0}"
#define OBJECT "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{"
#define NEEDS(names) "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[" names "],\"properties\":{" SPIN ","
#define BETA "{\"type\":\"number\",\"minimum\":-1,\"maximum\":1}"

#define SHAPE NEEDS("\"p\",\"e\"") "\"p\":" POSITIVE ",\"e\":{\"type\":\"number\",\"minimum\":0,\"exclusiveMaximum\":1}," \
    "\"inclination_deg\":{\"type\":\"number\",\"minimum\":0,\"maximum\":180}}}"
#define CONSTANTS NEEDS("\"energy\",\"angular_momentum\"") "\"energy\":" NUMBER ",\"angular_momentum\":" NUMBER ",\"carter\":" POSITIVE \
    ",\"r\":" POSITIVE ",\"outward\":" BOOLEAN "}}"
#define STATE NEEDS("\"position\"") "\"position\":" OBJECT "\"r\":" POSITIVE ",\"theta_deg\":" NUMBER ",\"phi_deg\":" NUMBER "}}," \
    "\"velocity\":" OBJECT "\"frame\":{\"enum\":[\"static\",\"zamo\"]},\"v_r\":" BETA ",\"v_theta\":" BETA ",\"v_phi\":" BETA "}}}}"
#define CASE NEEDS("\"case\"") "\"case\":{\"enum\":[\"mercury\",\"zoom-whirl\",\"plunge\",\"isco\",\"spherical\"]}}}"
#define ORBIT "{\"oneOf\":[" SHAPE "," CONSTANTS "," STATE "," CASE "]}"

static const char request[] =
    OBJECT SPIN ",\"orbit\":" ORBIT ",\"orbits\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":10000,\"items\":" ORBIT "}"
    ",\"duration\":" OBJECT "\"periods\":" POSITIVE ",\"time\":" POSITIVE "}}"
    ",\"samples\":{\"type\":\"integer\",\"minimum\":0,\"maximum\":200000},\"series\":" BOOLEAN
    ",\"method\":{\"enum\":[\"yoshida6\",\"rkn6\",\"closed\"]},\"steps\":{\"type\":\"integer\",\"minimum\":0}"
    ",\"tolerance\":{\"type\":\"number\",\"minimum\":1e-14,\"maximum\":1e-3},\"r_max\":{\"type\":\"number\",\"minimum\":2,\"maximum\":1e6}"
    ",\"mass_msun\":" POSITIVE "}}";

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

void kd_openapi_orbits_answer(struct kd_json *json)
{
    static const char *const others[] = { "application/x-ndjson", "text/csv", "application/x-npy" };
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    for (int i = 0; i < 3; i++)
        kd_openapi_media(json, others[i], "", 0);
}
