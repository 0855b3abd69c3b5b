#include "server/openapi/answers.h"

#include "server/http/route.h"
#include "server/openapi/strict.h"

#include <string.h>

static const struct {
    const char *path;
    unsigned methods;
    const char *schema;
} answers[] = {
    { "/healthz", KD_GET,
      "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"status\"],\"properties\":{\"status\":{"
      "\"const\":\"alive\"}}}" },
    { "/readyz", KD_GET,
      "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"status\"],\"properties\":{\"status\":{"
      "\"const\":\"ready\"}}}" },
    { "/v1/device", KD_GET, KD_SCHEMA_REF("Device") },
    { "/v1/accuracy", KD_GET, KD_SCHEMA_REF("AccuracyTable") },
    { "/v1/presets", KD_GET, KD_SCHEMA_REF("Presets") },
    { "/v1/approximations", KD_GET, KD_SCHEMA_REF("Approximations") },
    { "/v1/presets/{name}", KD_GET, KD_SCHEMA_REF("Scene") },
    { "/v1/physics", KD_GET, KD_SCHEMA_REF("Quantities") },
    { "/v1/plan", KD_POST, "{\"oneOf\":[" KD_SCHEMA_REF("Plan") "," KD_SCHEMA_REF("SweepPlan") "]}" },
    { "/v1/share", KD_GET | KD_POST, KD_SCHEMA_REF("Share") },
    { "/oembed", KD_GET, KD_SCHEMA_REF("OEmbed") },
    { "/v1/pixel", KD_GET | KD_POST, KD_SCHEMA_REF("Pixel") },
    { "/v1/line", KD_POST, KD_SCHEMA_REF("LineProfile") },
    { "/v1/transfer-function", KD_POST, KD_SCHEMA_REF("TransferFunction") },
    { "/v1/spectrum", KD_POST, "{\"oneOf\":[" KD_SCHEMA_REF("DiskSpectrum") "," KD_SCHEMA_REF("VolumeSpectrum") "]}" },
    { "/v1/visibility", KD_POST, KD_SCHEMA_REF("Visibilities") },
    { "/v1/compare", KD_POST, "{\"oneOf\":[" KD_SCHEMA_REF("Comparison") "," KD_SCHEMA_REF("ComparisonOfSets") "]}" },
    { "/v1/observe", KD_POST, KD_SCHEMA_REF("Simulation") },
    { "/v1/jobs", KD_POST, KD_SCHEMA_REF("Job") },
    { "/v1/jobs/{id}", KD_GET, KD_SCHEMA_REF("Job") },
    { "/v1/sessions", KD_POST, KD_SCHEMA_REF("Session") },
    { "/v1/sessions/{id}", KD_GET, KD_SCHEMA_REF("Session") },
    { "/v1/sessions/{id}", KD_PATCH, "{\"oneOf\":[" KD_SCHEMA_REF("Session") "," KD_SCHEMA_REF("SessionPatched") "]}" },
    { "/v1/sessions/{id}/ringdown", KD_POST, KD_SCHEMA_REF("Session") },
    { "/v1/sessions/{id}/path", KD_POST, KD_SCHEMA_REF("Session") },
    { "/v1/lessons", KD_POST, KD_SCHEMA_REF("Lesson") },
    { "/v1/lessons/{id}", KD_GET | KD_PATCH, KD_SCHEMA_REF("Lesson") },
    { "/v1/lessons/{id}/hands", KD_POST, KD_SCHEMA_REF("Lesson") },
    { "/v1/playground", KD_GET, KD_SCHEMA_REF("PlaygroundCatalogue") },
    { "/v1/playground", KD_POST, KD_SCHEMA_REF("PlaygroundStatus") },
    { "/v1/playground/{id}", KD_GET | KD_PATCH, KD_SCHEMA_REF("PlaygroundStatus") },
    { "/v1/playground/{id}/step", KD_POST, KD_SCHEMA_REF("PlaygroundStatus") },
    { "/v1/playground/{id}/snapshot", KD_GET, KD_SCHEMA_REF("Playground") },
    { "/v1/playground/{id}/series", KD_GET, KD_SCHEMA_REF("PlaygroundSeries") },
};

const char *kd_openapi_answer(const char *path, unsigned method)
{
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++)
        if (answers[i].methods & method && !strcmp(answers[i].path, path))
            return answers[i].schema;
    return NULL;
}
