#include "server/openapi/integrals.h"

#include "integral/answer.h"
#include "server/openapi/media.h"

void kd_openapi_integral_body(struct kd_json *json, const char *path)
{
    kd_openapi_body_begin(json);
    kd_json_object(json, "application/json");
    kd_integral_request_schema(json, "schema", kd_integral_of_route(path));
    kd_json_end(json);
    kd_openapi_body_end(json);
}

void kd_openapi_integral_schemas(struct kd_json *json)
{
    static const char *const names[KD_INTEGRALS] = { "LineProfile", "TransferFunction", "DiskSpectrum", "VolumeSpectrum", "Visibilities" };
    for (int i = 0; i < KD_INTEGRALS; i++)
        kd_integral_answer_schema(json, names[i], (enum kd_integral)i);
}
