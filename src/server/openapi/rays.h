/* POST /v1/rays in openapi.json. */
#ifndef KD_SERVER_OPENAPI_RAYS_H
#define KD_SERVER_OPENAPI_RAYS_H

#include "base/json.h"

/* Appends the parameters that accompany an array to the operation's list. */
void kd_openapi_rays_parameters(struct kd_json *json);
/* Write the operation's requestBody, and the content of its answer. */
void kd_openapi_rays_body(struct kd_json *json);
void kd_openapi_rays_answer(struct kd_json *json);
/* Writes the components of both. */
void kd_openapi_rays_schemas(struct kd_json *json);

#endif
