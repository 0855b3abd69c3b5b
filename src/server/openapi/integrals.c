#include "server/openapi/integrals.h"

#include "integral/answer.h"
#include "server/openapi/media.h"

#include <stdio.h>

/* Names of each integral's request schema. Spectra of disks and of volumes share one. */
static const char *const requests[KD_INTEGRALS] = { "LineRequest", "TransferFunctionRequest", "SpectrumRequest",
                                                    NULL,          "VisibilityRequest",       "CompareRequest",
                                                    NULL,          "ObserveRequest" };

void kd_openapi_integral_body(struct kd_json *json, const struct kd_route *route)
{
    char schema[80];
    int n = snprintf(schema, sizeof schema, "{\"$ref\":\"#/components/schemas/%s\"}",
                     requests[kd_integral_of_route(route->path)]);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

void kd_openapi_integral_schemas(struct kd_json *json)
{
    static const char *const names[KD_INTEGRALS] = { "LineProfile",      "TransferFunction", "DiskSpectrum",
                                                     "VolumeSpectrum",   "Visibilities",     "Comparison",
                                                     "ComparisonOfSets", "Simulation" };
    for (int i = 0; i < KD_INTEGRALS; i++) {
        if (requests[i])
            kd_integral_request_schema(json, requests[i], (enum kd_integral)i);
        kd_integral_answer_schema(json, names[i], (enum kd_integral)i);
    }
}
