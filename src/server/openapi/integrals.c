#include "server/openapi/integrals.h"

#include "integral/answer.h"
#include "server/openapi/media.h"

#include <stdio.h>

/* The name of the request schema of each integral. Spectra of disks and of volumes have the same schema. */
static const char *const requests[KD_INTEGRALS] = {
    [KD_INTEGRAL_LINE] = "LineRequest",         [KD_INTEGRAL_TRANSFER] = "TransferFunctionRequest",
    [KD_INTEGRAL_SPECTRUM] = "SpectrumRequest", [KD_INTEGRAL_IMPULSE] = "ImpulseRequest",
    [KD_INTEGRAL_LAGS] = "LagsRequest",         [KD_INTEGRAL_VISIBILITY] = "VisibilityRequest",
    [KD_INTEGRAL_COMPARE] = "CompareRequest",   [KD_INTEGRAL_OBSERVE] = "ObserveRequest"
};

void kd_openapi_integral_body(struct kd_json *json, const struct kd_route *route)
{
    char schema[80];
    int n = snprintf(schema, sizeof schema, "{\"$ref\":\"#/components/schemas/%s\"}",
                     requests[kd_integral_of_route(route->path)]);
    kd_openapi_body(json, schema, (size_t)n, NULL);
}

void kd_openapi_integral_schemas(struct kd_json *json)
{
    static const char *const names[KD_INTEGRALS] = { [KD_INTEGRAL_LINE] = "LineProfile",
                                                     [KD_INTEGRAL_TRANSFER] = "TransferFunction",
                                                     [KD_INTEGRAL_SPECTRUM] = "DiskSpectrum",
                                                     [KD_INTEGRAL_IMPULSE] = "ImpulseResponse",
                                                     [KD_INTEGRAL_LAGS] = "Lags",
                                                     [KD_INTEGRAL_VOLUME] = "VolumeSpectrum",
                                                     [KD_INTEGRAL_VISIBILITY] = "Visibilities",
                                                     [KD_INTEGRAL_COMPARE] = "Comparison",
                                                     [KD_INTEGRAL_SETS] = "ComparisonOfSets",
                                                     [KD_INTEGRAL_OBSERVE] = "Simulation" };
    for (int i = 0; i < KD_INTEGRALS; i++) {
        if (requests[i])
            kd_integral_request_schema(json, requests[i], (enum kd_integral)i);
        kd_integral_answer_schema(json, names[i], (enum kd_integral)i);
    }
}
