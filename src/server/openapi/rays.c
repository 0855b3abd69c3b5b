#include "server/openapi/rays.h"

#include "render/rays/schema.h"
#include "server/openapi/media.h"

#include <stdio.h>

void kd_openapi_rays_parameters(struct kd_json *json)
{
    const char *name, *help;
    for (size_t i = 0; (name = kd_rays_field_name(i, &help)); i++) {
        char description[200];
        snprintf(description, sizeof description, "%s; with a body of application/x-npy only", help);
        kd_json_object(json, NULL);
        kd_json_string(json, "name", name);
        kd_json_string(json, "in", "query");
        kd_json_string(json, "description", description);
        kd_rays_field_schema(json, i);
        kd_json_end(json);
    }
}

void kd_openapi_rays_body(struct kd_json *json)
{
    kd_openapi_body_begin(json);
    kd_json_object(json, "application/json");
    kd_rays_request_schema(json, "schema");
    kd_json_end(json);
    kd_openapi_media(json, "application/x-npy", "", 0);
    kd_openapi_body_end(json);
}

void kd_openapi_rays_answer(struct kd_json *json)
{
    static const char answer[] = KD_SCHEMA_REF("RaysAnswer");
    kd_openapi_media(json, "application/json", answer, sizeof answer - 1);
    kd_openapi_media(json, "application/x-npy", "", 0);
}
