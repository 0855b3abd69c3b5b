#include "server/openapi/jobs.h"

#include "server/job/spec.h"
#include "server/openapi/media.h"
#include "server/openapi/timeline.h"

#include <stdio.h>

#define OBJECT KD_OPENAPI_OBJECT
#define COUNT "{\"type\":\"integer\",\"minimum\":0}"

/* What a job makes of its frames: a list of names. */
#define OUTPUT "\"output\":{\"enum\":[%s]}"

/* Fields with their values; a field has its own schema in Scene. */
#define AXES "{\"type\":\"object\",\"minProperties\":1,\"maxProperties\":8,\"additionalProperties\":{\"anyOf\":[{\"type\":\"array\",\"minItems\":1," \
    "\"maxItems\":100000,\"items\":{\"anyOf\":[{\"type\":\"number\"},{\"type\":\"string\"},{\"type\":\"boolean\"},{\"type\":\"array\",\"items\":{\"type\":\"string\"}}]}},{\"type\":\"string\",\"description\":\"START:STOP:STEP or START:STOP/HOW MANY\"}]}}"

/* A scene with axes. */
#define SWEEP OBJECT "\"required\":[\"axes\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE ",\"axes\":" AXES "," OUTPUT "}}"

static const char plan_request[] = "{\"oneOf\":[" KD_OPENAPI_SCENE "," SWEEP "]}";

static const char request[] =
    "{\"oneOf\":[" OBJECT "\"required\":[\"scene\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE "," KD_OPENAPI_TIMELINE(
        "frame", "{\"type\":\"integer\",\"minimum\":0,\"maximum\":9999}")
    ",\"frames\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":10000},"
    OUTPUT "}}," SWEEP "," OBJECT "\"required\":[\"scenes\"],\"properties\":{\"scenes\":{\"type\":\"array\","
    "\"minItems\":1,\"maxItems\":10000,\"items\":" KD_OPENAPI_SCENE "}," OUTPUT "}}]}";

static const char answer[] =
    "{\"type\":\"object\",\"properties\":{\"id\":{\"type\":\"string\"},\"token\":{\"type\":\"string\"},\"state\":{\"enum\":[\"waiting\",\"running\","
    "\"done\",\"failed\",\"deleted\"]}," OUTPUT ",\"place\":" COUNT ",\"frames\":" COUNT ",\"finished\":" COUNT ",\"fraction\":{\"type\":\"number\"},"
    "\"remaining_s\":{\"type\":[\"number\",\"null\"]},\"bytes\":" COUNT ",\"lens_maps_traced\":" COUNT ",\"axes\":{\"type\":\"object\",\"additionalProperties\":" COUNT "},\"created\":{\"type\":\"number\"},\"ended\":{\"type\":[\"number\","
    "\"null\"]},\"delayed\":{\"type\":\"string\"},\"error\":{\"type\":\"string\"}}}";

_Static_assert(KD_JOB_FRAMES_MAX == 10000 && KD_SWEEP_AXES == 8 && KD_SWEEP_MOST == 100000, "openapi.json says so");

/* "pictures","light-curve" */
static void list_series(char *out, size_t size)
{
    for (size_t i = 0, n = 0; i < kd_n_series && n < size; i++)
        n += (size_t)snprintf(out + n, size - n, "%s\"%s\"", i ? "," : "", kd_series_all[i]->name);
}

void kd_openapi_jobs_body(struct kd_json *json)
{
    char names[200], schema[sizeof request + 3 * sizeof names];
    list_series(names, sizeof names);
    int n = snprintf(schema, sizeof schema, request, names, names, names);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

void kd_openapi_plan_body(struct kd_json *json)
{
    char names[200], schema[sizeof plan_request + sizeof names];
    list_series(names, sizeof names);
    int n = snprintf(schema, sizeof schema, plan_request, names);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

void kd_openapi_jobs_answer(struct kd_json *json)
{
    char names[200], schema[sizeof answer + sizeof names];
    list_series(names, sizeof names);
    int n = snprintf(schema, sizeof schema, answer, names);
    kd_openapi_media(json, "application/json", schema, (size_t)n);
}
