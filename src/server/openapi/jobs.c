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

#define FRAME "{\"type\":\"integer\",\"minimum\":0,\"maximum\":9999}"

/* The member "output": what a job makes of its frames. The argument of this format string is a list of names. */
#define OUTPUT "\"output\":{\"enum\":[%s]}"
/* Excludes exposure and motion blur unless the output is pictures. The argument of this format string is the list of
 * all other outputs. */
#define PICTURES_ALONE \
    "\"not\":{\"anyOf\":[{\"required\":[\"exposure\"]},{\"required\":[\"motion_blur\"]}],\"required\":[\"output\"]," \
    "\"properties\":{\"output\":{\"enum\":[%s]}}},"
/* Excludes members that are meaningful only together with keyframes. */
#define TAKES_KEYFRAMES \
    "\"if\":{\"not\":{\"required\":[\"keyframes\"]}},\"then\":{\"not\":{\"anyOf\":[{\"required\":[\"frames\"]},{" \
    "\"required\":[\"interpolation\"]}," \
    "{\"required\":[\"distances\"]},{\"required\":[\"angles\"]},{\"required\":[\"ease\"]},{\"required\":[\"look_at\"]" \
    "},{\"required\":[\"motion_blur\"]}]}},"

/* The member "exposure": whether pictures whose exposure is "auto" share one exposure or not. */
#define EXPOSURE(words) "\"exposure\":{\"enum\":[" words "]}"
#define ANY_EXPOSURE EXPOSURE("\"one\",\"each\"")

/* Axes: fields, each with its values. The schema Scene contains the schema of each field. */
static const char axes[] =
    "{\"type\":\"object\",\"minProperties\":1,\"maxProperties\":8,\"propertyNames\":{\"allOf\":[" KD_SCHEMA_REF(
        "FieldPath") "],\"not\":{\"const\":\"version\"}},\"additionalProperties\":{\"anyOf\":[{\"type\":\"array\","
                     "\"minItems\":1,"
                     "\"maxItems\":100000,\"items\":{\"anyOf\":[{\"type\":\"number\"},{\"type\":\"string\"},{\"type\":"
                     "\"boolean\"},{\"type\":\"array\",\"items\":{\"type\":\"string\"}}]}},{\"type\":\"string\","
                     "\"pattern\":\"^" KD_SCHEMA_DECIMAL ":" KD_SCHEMA_DECIMAL "(:" KD_SCHEMA_DECIMAL
                     "|/([1-9][0-9]{0,5}))$\",\"description\":\"START:STOP:STEP or START:STOP/HOW MANY\"}]}}";

/* Variants of a request for a job. Each is a format string with two arguments: the list of all outputs except
 * pictures, and the list of all outputs. This first variant is a scene with axes. */
static const char sweep[] =
    OBJECT PICTURES_ALONE "\"required\":[\"axes\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE
                          ",\"axes\":" KD_SCHEMA_REF("SweepAxes") "," EXPOSURE("\"each\"") "," OUTPUT "}}";

/* Variant of a request for a job: a film of a playground. */
static const char film[] = OBJECT PICTURES_ALONE
    "\"required\":[\"playground\",\"every\"],\"anyOf\":[{\"required\":[\"frames\"]},{\"required\":[\"keyframes\"]}],"
    "\"properties\":{\"playground\":{\"allOf\":[" KD_SCHEMA_REF(
        "Playground") ",{\"not\":{\"anyOf\":[{\"required\":[\"rate\"]},{\"required\":[\"paused\"]},{\"required\":["
                      "\"scene\"]}]}}],\"description\":\"a document of a playground, or a snapshot, as POST "
                      "/v1/playground takes them, without rate, paused and "
                      "scene\"},\"every\":{\"type\":\"number\",\"exclusiveMinimum\":0,\"maximum\":1e12,\"description\":"
                      "\"time in M from one frame to the next\"},\"scene\":" KD_OPENAPI_SCENE
                      "," KD_OPENAPI_TIMELINE("frame", FRAME) ",\"frames\":{\"type\":\"integer\",\"minimum\":1,"
                                                              "\"maximum\":10000}," EXPOSURE("\"each\"") "," OUTPUT
                                                                                                         "}}";

#define BLUR \
    "\"motion_blur\":" OBJECT \
    "\"required\":[\"samples\"],\"properties\":{\"samples\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":64}," \
    "\"shutter\":{\"type\":\"number\",\"exclusiveMinimum\":0,\"maximum\":1,\"default\":0.5,\"description\":\"open " \
    "time of the shutter, as a fraction of a frame's time\"}}}"

static const char sequence[] = OBJECT PICTURES_ALONE TAKES_KEYFRAMES
    "\"required\":[\"scene\"],\"properties\":{\"scene\":" KD_OPENAPI_SCENE
    "," KD_OPENAPI_TIMELINE("frame", FRAME) ",\"frames\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":10000}," BLUR
                                            "," ANY_EXPOSURE "," OUTPUT "}}";

static const char list[] =
    OBJECT PICTURES_ALONE "\"required\":[\"scenes\"],\"properties\":{\"scenes\":{\"type\":\"array\",\"minItems\":1,"
                          "\"maxItems\":10000,\"items\":" KD_OPENAPI_SCENE "}," ANY_EXPOSURE "," OUTPUT "}}";

_Static_assert(KD_JOB_FRAMES_MAX == 10000 && KD_SWEEP_AXES == 8 && KD_SWEEP_MOST == 100000 && KD_BLUR_SAMPLES == 64,
               "openapi.json says so");

typedef bool is_series(const struct kd_series *one);
static bool any(const struct kd_series *one) { return (void)one, true; }
static bool of_any_job(const struct kd_series *one) { return !one->swept; }
static bool of_numbers(const struct kd_series *one) { return !(one->frame->carries & KD_CARRIES_PICTURE); }

/* Names of the series for which `is` returns true, such as "pictures","light-curve". */
struct names { char text[200]; };
static struct names names_of(is_series *is)
{
    struct names out = { "" };
    for (size_t i = 0, n = 0; i < kd_n_series && n < sizeof out.text; i++)
        if (is(kd_series_all[i]))
            n += (size_t)snprintf(out.text + n, sizeof out.text - n, "%s\"%s\"", n ? "," : "", kd_series_all[i]->name);
    return out;
}

static void add_way(struct kd_json *json, const char *format, is_series *is)
{
    const struct names numbers = names_of(of_numbers), known = names_of(is);
    char schema[sizeof film + sizeof sequence + 2 * sizeof known];
    snprintf(schema, sizeof schema, format, numbers.text, known.text);
    kd_schema_text(json, NULL, schema);
}

static void begin_body(struct kd_json *json)
{
    kd_openapi_body_begin(json);
    kd_json_object(json, KD_JSON_TYPE);
    kd_json_object(json, "schema");
    kd_json_array(json, "oneOf");
}

static void end_body(struct kd_json *json)
{
    kd_json_end(json);
    kd_json_end(json);
    kd_json_end(json);
    kd_openapi_body_end(json);
}

void kd_openapi_jobs_body(struct kd_json *json, const struct kd_route *route)
{
    (void)route;
    begin_body(json);
    add_way(json, sequence, of_any_job);
    add_way(json, sweep, any);
    add_way(json, film, of_any_job);
    add_way(json, list, of_any_job);
    end_body(json);
}

void kd_openapi_plan_body(struct kd_json *json, const struct kd_route *route)
{
    (void)route;
    begin_body(json);
    kd_schema_text(json, NULL, KD_OPENAPI_SCENE);
    add_way(json, sweep, any);
    end_body(json);
}

static const char *series(size_t i) { return i < kd_n_series ? kd_series_all[i]->name : NULL; }

void kd_openapi_job_schema(struct kd_json *json)
{
    static const struct kd_openapi_member job[] = {
        { "id", KD_SCHEMA_TEXT, false },
        { "token", KD_SCHEMA_TEXT, true },
        { "state", NULL, false, kd_job_state_word },
        { "output", NULL, false, series },
        { "place", COUNT, false },
        { "frames", COUNT, false },
        { "finished", COUNT, false },
        { "fraction", KD_SCHEMA_NUMBER, false },
        { "remaining_s", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "bytes", COUNT, false },
        { "lens_maps_traced", COUNT, false },
        { "exposure", KD_SCHEMA_NUMBER, true },
        { "axes", "{\"type\":\"object\",\"additionalProperties\":" COUNT "}", true },
        { "created", KD_SCHEMA_NUMBER, false },
        { "ended", KD_SCHEMA_NUMBER_OR_NULL, false },
        { "delayed", KD_SCHEMA_TEXT, true },
        { "error", KD_SCHEMA_TEXT, true },
    };
    kd_schema_text(json, "SweepAxes", axes);
    KD_OPENAPI_TOLD(json, "Job", "created and ended are seconds since 1970", job);
}
