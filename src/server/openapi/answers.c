#include "server/openapi/answers.h"

#include "server/http/route.h"
#include "server/openapi/strict.h"

#include <string.h>

static const struct { const char *path; unsigned methods; const char *schema; } answers[] = {
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
