#include "server/openapi/jobs.h"

#include "server/job/spec.h"
#include "server/openapi/media.h"

#define SCENE "{\"$ref\":\"#/components/schemas/Scene\"}"
#define OBJECT "{\"type\":\"object\",\"additionalProperties\":false,"
#define COUNT "{\"type\":\"integer\",\"minimum\":0}"

#define OUTPUT "\"output\":{\"enum\":[\"pictures\",\"light-curve\"]}"

static const char request[] =
    "{\"oneOf\":[" OBJECT "\"required\":[\"scene\"],\"properties\":{\"scene\":" SCENE ",\"keyframes\":{\"type\":\"array\",\"minItems\":1,"
    "\"maxItems\":1000,\"items\":" OBJECT "\"required\":[\"frame\",\"scene\"],\"properties\":{\"frame\":{\"type\":\"integer\",\"minimum\":0,"
    "\"maximum\":9999},\"scene\":" SCENE "}}},\"frames\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":10000},"
    "\"interpolation\":{\"enum\":[\"linear\",\"smooth\"]}," OUTPUT "}}," OBJECT "\"required\":[\"scenes\"],\"properties\":{\"scenes\":{\"type\":\"array\","
    "\"minItems\":1,\"maxItems\":10000,\"items\":" SCENE "}," OUTPUT "}}]}";

static const char answer[] =
    "{\"type\":\"object\",\"properties\":{\"id\":{\"type\":\"string\"},\"token\":{\"type\":\"string\"},\"state\":{\"enum\":[\"waiting\",\"running\","
    "\"done\",\"failed\",\"deleted\"]}," OUTPUT ",\"place\":" COUNT ",\"frames\":" COUNT ",\"finished\":" COUNT ",\"fraction\":{\"type\":\"number\"},"
    "\"remaining_s\":{\"type\":[\"number\",\"null\"]},\"bytes\":" COUNT ",\"created\":{\"type\":\"number\"},\"ended\":{\"type\":[\"number\","
    "\"null\"]},\"delayed\":{\"type\":\"string\"},\"error\":{\"type\":\"string\"}}}";

_Static_assert(KD_JOB_FRAMES_MAX == 10000, "openapi.json says so");

void kd_openapi_jobs_body(struct kd_json *json)
{
    kd_openapi_body(json, request, sizeof request - 1, NULL);
}

void kd_openapi_jobs_answer(struct kd_json *json)
{
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
}
