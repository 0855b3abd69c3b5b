#include "server/openapi/jobs.h"

#include "job/spec.h"
#include "render/frame/blur.h"
#include "server/job/routes.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"
#include "server/openapi/timeline.h"

#include <stdio.h>

#define OBJECT KD_OPENAPI_OBJECT
#define COUNT KD_SCHEMA_COUNT

/* What a job makes of its frames: a list of names. */
#define OUTPUT "\"output\":{\"enum\":[%s]}"

/* Whether pictures whose exposure is "auto" have the same one. */
#define EXPOSURE(words) "\"exposure\":{\"enum\":[" words "]}"
#define ANY_EXPOSURE EXPOSURE("\"one\",\"each\"")

/* Fields with their values; a field has its own schema in Scene. */
static const char axes[] = "{\"type\":\"object\",\"minProperties\":1,\"maxProperties\":8,\"propertyNames\":" KD_SCHEMA_REF("FieldPath") ",\"additionalProperties\":{\"anyOf\":[{\"type\":\"array\",\"minItems\":1," \
    "\"maxItems\":100000,\"items\":{\"anyOf\":[{\"type\":\"number\"},{\"type\":\"string\"},{\"type\":\"boolean\"},{\"type\":\"array\",\"items\":{\"type\":\"string\"}}]}},{\"type\":\"string\",\"pattern\":\"^" KD_OPENAPI_DECIMAL ":" KD_OPENAPI_DECIMAL "(:" KD_OPENAPI_DECIMAL "|/([1-9][0-9]{0,5}))$\",\"description\":\"START:STOP:STEP or START:STOP/HOW MANY\"}]}}";

/* A scene with axes. */
#define SWEEP OBJECT "\"required\":[\"axes\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE ",\"axes\":" KD_SCHEMA_REF("SweepAxes") "," EXPOSURE("\"each\"") "," OUTPUT "}}"

static const char plan_request[] = "{\"oneOf\":[" KD_OPENAPI_SCENE "," SWEEP "]}";

/* A film of a playground. */
#define FILM OBJECT "\"required\":[\"playground\",\"every\"],\"properties\":{\"playground\":{\"type\":\"object\",\"description\":\"a document of a playground, or a " \
    "snapshot, as POST /v1/playground takes them, without rate, paused and scene\"},\"every\":{\"type\":\"number\",\"exclusiveMinimum\":0,\"maximum\":1e12," \
    "\"description\":\"M from a frame to the next\"},\"scene\":" KD_OPENAPI_SCENE "," \
    KD_OPENAPI_TIMELINE("frame", "{\"type\":\"integer\",\"minimum\":0,\"maximum\":9999}") ",\"frames\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":10000}," EXPOSURE("\"each\"") "," OUTPUT "}}"

static const char blur[] = "\"motion_blur\":" OBJECT "\"required\":[\"samples\"],\"properties\":{\"samples\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":64},\"shutter\":"
    "{\"type\":\"number\",\"exclusiveMinimum\":0,\"maximum\":1,\"default\":0.5,\"description\":\"the part of a frame's time in which the shutter is open\"}}}";

static const char request[] =
    "{\"oneOf\":[" OBJECT "\"required\":[\"scene\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE "," KD_OPENAPI_TIMELINE(
        "frame", "{\"type\":\"integer\",\"minimum\":0,\"maximum\":9999}")
    ",\"frames\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":10000},"
    "%s," ANY_EXPOSURE "," OUTPUT "}}," SWEEP "," FILM "," OBJECT "\"required\":[\"scenes\"],\"properties\":{\"scenes\":{\"type\":\"array\","
    "\"minItems\":1,\"maxItems\":10000,\"items\":" KD_OPENAPI_SCENE "}," ANY_EXPOSURE "," OUTPUT "}}]}";

_Static_assert(KD_JOB_FRAMES_MAX == 10000 && KD_SWEEP_AXES == 8 && KD_SWEEP_MOST == 100000 && KD_BLUR_SAMPLES == 64, "openapi.json says so");

/* "pictures","light-curve" */
static void list_series(char *out, size_t size)
{
    for (size_t i = 0, n = 0; i < kd_n_series && n < size; i++)
        n += (size_t)snprintf(out + n, size - n, "%s\"%s\"", i ? "," : "", kd_series_all[i]->name);
}

void kd_openapi_jobs_body(struct kd_json *json)
{
    char names[200], schema[sizeof request + sizeof blur + 4 * sizeof names];
    list_series(names, sizeof names);
    int n = snprintf(schema, sizeof schema, request, blur, names, names, names, names);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

void kd_openapi_plan_body(struct kd_json *json)
{
    char names[200], schema[sizeof plan_request + sizeof names];
    list_series(names, sizeof names);
    int n = snprintf(schema, sizeof schema, plan_request, names);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

static const char *series(size_t i) { return i < kd_n_series ? kd_series_all[i]->name : NULL; }

void kd_openapi_job_schema(struct kd_json *json)
{
    static const struct kd_openapi_member job[] = {
        { "id", KD_SCHEMA_TEXT, false }, { "token", KD_SCHEMA_TEXT, true },
        { "state", NULL, false, kd_job_state_word }, { "output", NULL, false, series }, { "place", COUNT, false },
        { "frames", COUNT, false }, { "finished", COUNT, false }, { "fraction", KD_SCHEMA_NUMBER, false }, { "remaining_s", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "bytes", COUNT, false }, { "lens_maps_traced", COUNT, false }, { "exposure", KD_SCHEMA_NUMBER, true }, { "axes", "{\"type\":\"object\",\"additionalProperties\":" COUNT "}", true },
        { "created", KD_SCHEMA_NUMBER, false }, { "ended", KD_SCHEMA_NUMBER_OR_NULL, false }, { "delayed", KD_SCHEMA_TEXT, true }, { "error", KD_SCHEMA_TEXT, true },
    };
    kd_schema_text(json, "SweepAxes", axes);
    KD_OPENAPI_STRICT(json, "Job", job);
}
