/* This is what openapi.json says of POST /v1/rays. */
#ifndef KD_SERVER_OPENAPI_RAYS_H
#define KD_SERVER_OPENAPI_RAYS_H

#include "base/json.h"

/* Appends to the operation's list the parameters that go with an array. */
void kd_openapi_rays_parameters(struct kd_json *json);
/* The operation's requestBody; what belongs into the content of its answer. */
void kd_openapi_rays_body(struct kd_json *json);
void kd_openapi_rays_answer(struct kd_json *json);
/* The components of both. */
void kd_openapi_rays_schemas(struct kd_json *json);

#endif
