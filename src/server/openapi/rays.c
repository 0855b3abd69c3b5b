#include "server/openapi/rays.h"

#include "render/rays/schema.h"

#include <stdio.h>

void kd_openapi_rays_parameters(struct kd_json *json, unsigned method, const struct cJSON *schema)
{
    (void)method, (void)schema;
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

void kd_openapi_rays_schemas(struct kd_json *json)
{
    kd_rays_request_schema(json, "RaysRequest");
    kd_rays_answer_schemas(json);
}
