/* POST /v1/rays in openapi.json. */
#ifndef KD_SERVER_OPENAPI_RAYS_H
#define KD_SERVER_OPENAPI_RAYS_H

#include "base/json.h"

struct cJSON;

/* Appends the parameters that accompany an NPY array to the list of parameters of an operation. */
void kd_openapi_rays_parameters(struct kd_json *json, unsigned method, const struct cJSON *schema);
/* Writes the components to which the body and the answer refer. */
void kd_openapi_rays_schemas(struct kd_json *json);

#endif
