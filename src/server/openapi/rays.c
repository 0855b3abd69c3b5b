#include "server/openapi/rays.h"

#include "render/rays/check.h"
#include "server/openapi/media.h"

#define STRING(x) #x
#define TEXT(x) STRING(x)
#define NUMBER "{\"type\":\"number\"}"
#define PROFILES "{\"enum\":[\"draft\",\"interactive\",\"balanced\",\"high\",\"reference\"]}"
#define TOLERANCE "{\"anyOf\":[{\"const\":\"profile\"},{\"type\":\"number\",\"exclusiveMinimum\":0,\"exclusiveMaximum\":1}]}"
#define ENGINES "{\"enum\":[\"auto\",\"closed\",\"mino-rkn4\",\"mino-rkn6\",\"ks-euler\",\"ks-rk4\",\"ks-tao6\"]}"
#define PRECISIONS "{\"enum\":[\"auto\",\"f32\",\"f64\"]}"
#define STEPS "{\"type\":\"integer\",\"minimum\":0,\"maximum\":" TEXT(KD_STEPS_MAX) ",\"multipleOf\":4}"
#define ORDERS "{\"type\":\"integer\",\"minimum\":1,\"maximum\":" TEXT(KD_RAYS_MAX_ORDERS) "}"
#define SPIN "{\"type\":\"number\",\"exclusiveMinimum\":-1,\"exclusiveMaximum\":1}"
/* A horizon is above 1 M whatever the spin: 1 + sqrt(1 - a^2), Bardeen, Press & Teukolsky 1972. */
#define RADIUS "{\"anyOf\":[{\"const\":\"infinity\"},{\"type\":\"number\",\"exclusiveMinimum\":1,\"maximum\":1e7}]}"
#define INCLINATION "{\"type\":\"number\",\"minimum\":0,\"maximum\":180}"
#define OBJECT "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{"
#define OBSERVER "\"observer\":" OBJECT "\"r\":" RADIUS ",\"inclination_deg\":" INCLINATION "}}"

#define ROW(name, schema) { name, schema, sizeof schema - 1 }
static const struct {
    const char *name, *schema;
    size_t size;
} parameters[] = {
    ROW("spin", SPIN), ROW("r", RADIUS), ROW("inclination_deg", INCLINATION), ROW("orders", ORDERS), ROW("profile", PROFILES),
    ROW("tolerance", TOLERANCE), ROW("engine", ENGINES), ROW("precision", PRECISIONS), ROW("steps", STEPS),
};
#undef ROW

static const char request[] =
    "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"rays\"],\"properties\":{\"spin\":" SPIN "," OBSERVER
    ",\"rays\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":" TEXT(KD_RAYS_MAX) ",\"items\":{\"type\":\"array\","
    "\"minItems\":2,\"maxItems\":2,\"items\":{\"type\":\"number\",\"minimum\":-1e7,\"maximum\":1e7}}},\"orders\":" ORDERS
    ",\"accuracy\":" OBJECT "\"profile\":" PROFILES ",\"tolerance\":" TOLERANCE ",\"engine\":" ENGINES ",\"precision\":" PRECISIONS ",\"steps\":" STEPS "}}}}";

static const char answer[] =
    "{\"type\":\"object\",\"properties\":{\"spin\":" NUMBER "," OBSERVER ",\"orders\":" ORDERS
    ",\"accuracy\":{\"type\":\"object\",\"properties\":{\"engine\":" ENGINES ",\"precision\":" PRECISIONS ",\"steps\":" STEPS
    ",\"rays\":" NUMBER ",\"undecided\":" NUMBER ",\"tolerance\":" NUMBER ",\"followed_again\":" NUMBER ",\"beyond\":" NUMBER ",\"holds\":" NUMBER ",\"worst_error\":" NUMBER ",\"median_error\":" NUMBER "}},"
    "\"approximations\":{\"type\":\"array\",\"items\":{\"type\":\"string\"}},"
    "\"rays\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"properties\":{"
    "\"fate\":{\"enum\":[\"captured\",\"escaped\",\"undecided\"]},"
    "\"crossings\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"properties\":{\"order\":{\"type\":\"integer\"},"
    "\"r\":" NUMBER ",\"phi\":" NUMBER ",\"delay\":" NUMBER ",\"g\":" NUMBER "}}},"
    "\"sky\":{\"type\":\"object\",\"properties\":{\"theta\":" NUMBER ",\"phi\":" NUMBER "}},\"error\":" NUMBER "}}}}}";

void kd_openapi_rays_parameters(struct kd_json *json)
{
    for (size_t i = 0; i < sizeof parameters / sizeof *parameters; i++) {
        kd_json_object(json, NULL);
        kd_json_string(json, "name", parameters[i].name);
        kd_json_string(json, "in", "query");
        kd_json_string(json, "description", "with a body of application/x-npy only");
        kd_json_raw(json, "schema", parameters[i].schema, parameters[i].size);
        kd_json_end(json);
    }
}

void kd_openapi_rays_body(struct kd_json *json)
{
    kd_openapi_body(json, request, sizeof request - 1, "application/x-npy");
}

void kd_openapi_rays_answer(struct kd_json *json)
{
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    kd_openapi_media(json, "application/x-npy", "", 0);
}
