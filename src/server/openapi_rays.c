#include "server/openapi_rays.h"

#include "render/rays_check.h"

#include <string.h>

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
#define RADIUS "{\"anyOf\":[{\"const\":\"infinity\"},{\"type\":\"number\",\"maximum\":1e7}]}"
#define INCLINATION "{\"type\":\"number\",\"minimum\":0,\"maximum\":180}"
#define OBJECT "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{"
#define OBSERVER "\"observer\":" OBJECT "\"r\":" RADIUS ",\"inclination_deg\":" INCLINATION "}}"

static const char parameters[] =
    "{\"spin\":" SPIN ",\"r\":" RADIUS ",\"inclination_deg\":" INCLINATION ",\"orders\":" ORDERS ",\"profile\":" PROFILES ",\"tolerance\":" TOLERANCE ",\"engine\":" ENGINES
    ",\"precision\":" PRECISIONS ",\"steps\":" STEPS "}";

static const char request[] =
    "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"rays\"],\"properties\":{\"spin\":" SPIN "," OBSERVER
    ",\"rays\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":" TEXT(KD_RAYS_MAX) ",\"items\":{\"type\":\"array\","
    "\"minItems\":2,\"maxItems\":2,\"items\":{\"type\":\"number\",\"minimum\":-1e7,\"maximum\":1e7}}},\"orders\":" ORDERS
    ",\"accuracy\":" OBJECT "\"profile\":" PROFILES ",\"tolerance\":" TOLERANCE ",\"engine\":" ENGINES ",\"precision\":" PRECISIONS ",\"steps\":" STEPS "}}}}";

static const char answer[] =
    "{\"type\":\"object\",\"properties\":{\"spin\":" NUMBER "," OBSERVER ",\"orders\":" ORDERS
    ",\"accuracy\":{\"type\":\"object\",\"properties\":{\"engine\":" ENGINES ",\"precision\":" PRECISIONS ",\"steps\":" STEPS
    ",\"rays\":" NUMBER ",\"undecided\":" NUMBER ",\"holds\":" NUMBER ",\"worst_error\":" NUMBER ",\"median_error\":" NUMBER "}},"
    "\"approximations\":{\"type\":\"array\",\"items\":{\"type\":\"string\"}},"
    "\"rays\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"properties\":{"
    "\"fate\":{\"enum\":[\"captured\",\"escaped\",\"undecided\"]},"
    "\"crossings\":{\"type\":\"array\",\"items\":{\"type\":\"object\",\"properties\":{\"order\":{\"type\":\"integer\"},"
    "\"r\":" NUMBER ",\"phi\":" NUMBER ",\"delay\":" NUMBER ",\"g\":" NUMBER "}}},"
    "\"sky\":{\"type\":\"object\",\"properties\":{\"theta\":" NUMBER ",\"phi\":" NUMBER "}},\"error\":" NUMBER "}}}}}";

void kd_openapi_rays_parameters(cJSON *list)
{
    cJSON *all = cJSON_Parse(parameters);
    for (cJSON *one; all && (one = cJSON_DetachItemFromArray(all, 0));) {
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", one->string);
        cJSON_AddStringToObject(o, "in", "query");
        cJSON_AddStringToObject(o, "description", "with a body of application/x-npy only");
        cJSON_AddItemToObject(o, "schema", one);
        cJSON_AddItemToArray(list, o);
    }
    cJSON_Delete(all);
}

static void add_content(cJSON *to, const char *schema)
{
    cJSON *content = cJSON_AddObjectToObject(to, "content");
    cJSON_AddItemToObject(cJSON_AddObjectToObject(content, "application/json"), "schema", cJSON_Parse(schema));
    cJSON_AddObjectToObject(content, "application/x-npy");
}

void kd_openapi_rays_bodies(cJSON *operation, cJSON *ok)
{
    cJSON *body = cJSON_AddObjectToObject(operation, "requestBody");
    cJSON_AddTrueToObject(body, "required");
    add_content(body, request);
    add_content(ok, answer);
}
