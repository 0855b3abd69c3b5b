/* POST /v1/rays in openapi.json. */
#ifndef KD_SERVER_OPENAPI_RAYS_H
#define KD_SERVER_OPENAPI_RAYS_H

#include "base/json.h"

/* Appends to an operation's list the parameters that accompany an NPY array. */
void kd_openapi_rays_parameters(struct kd_json *json);
/* kd_openapi_rays_body writes the operation's requestBody, kd_openapi_rays_answer the content of its answer. */
void kd_openapi_rays_body(struct kd_json *json);
void kd_openapi_rays_answer(struct kd_json *json);
/* Writes the components that body and answer refer to. */
void kd_openapi_rays_schemas(struct kd_json *json);

#endif
